//! The bodies of an instant as granules of a medium: what each brings to the balances, and what is between two.

use super::recorded::RecordedPair;
use gyration::Inadmissible;
use gyration::dynamics::{Scratch, exchanges, joint_exchanges};
use gyration::homogeneous::BodyBalance;
use gyration::instant::Instant;
use gyration::lattice::{HERE, Lattice};
use gyration::tensor::{Mat3, Vec3};

/// The granules of an instant.
#[derive(Debug, Clone, Default)]
pub(crate) struct Granules {
    /// t \[s\].
    pub time: f64,
    /// The bodies.
    pub grains: Vec<Grain>,
    /// What is between two of them.
    pub links: Vec<Link>,
    /// What follows itself without end, as a lattice of these vectors.
    pub periods: Lattice,
}

/// A body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grain {
    /// p₀ in space \[m\].
    pub place: Vec3,
    /// ṗ₀ \[m/s\].
    pub velocity: Vec3,
    /// Ω = Ṗ P⁻¹ \[1/s\].
    pub gyration: Mat3,
    /// What it brings to the balances.
    pub balance: BodyBalance,
}

/// What two do to each other.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link {
    /// p₀ of the first \[m\].
    pub place: Vec3,
    /// l, from the first to the second \[m\].
    pub arm: Vec3,
    /// f on the first \[N\].
    pub force: Vec3,
    /// N_ij and N_ji, each about the centre of whom it acts on \[J\].
    pub moments: [Mat3; 2],
    /// What it does to both \[W\].
    pub power: f64,
}

impl Granules {
    /// Of an instant; pairs as recorded, if they are, else those of the instant.
    pub fn of(
        instant: &Instant,
        scratch: &mut Scratch,
        time: f64,
        recorded: Option<&[RecordedPair]>,
        periods: Lattice,
    ) -> Result<Self, Inadmissible> {
        let model = instant.model();
        let mut grains = Vec::with_capacity(model.bodies.len());
        for index in 0..model.bodies.len() {
            let at = instant.at(index);
            let placement = &at.motion.placement;
            let inverse = placement.gradient.try_inverse().unwrap_or(Mat3::repeat(f64::NAN));
            grains.push(Grain {
                place: model.in_space(index, &placement.position),
                velocity: at.motion.velocity.velocity,
                gyration: at.motion.velocity.gradient_rate * inverse,
                balance: BodyBalance::of(&at, scratch)?,
            });
        }
        let mut pairs = Vec::new();
        match recorded {
            Some(recorded) => pairs.extend_from_slice(recorded),
            None => {
                let mut found = Vec::new();
                exchanges(instant, scratch, &mut found)?;
                pairs.extend(found.iter().filter_map(RecordedPair::between_bodies));
            }
        }
        for (bodies, on) in joint_exchanges(instant) {
            let moment = |end: usize| instant.at(bodies[end]).motion.placement.gradient * on[end].moment.transpose();
            pairs.push(RecordedPair { bodies, cell: HERE, force: on[0].force, moments: [moment(0), moment(1)] });
        }
        let place = |body: usize| instant.at(body).motion.placement.position;
        let link = |pair: &RecordedPair| {
            let [first, second] = pair.bodies;
            let [one, other] = [&grains[first], &grains[second]];
            let turning = pair.moments[0] * one.gyration + pair.moments[1] * other.gyration;
            Link {
                place: one.place,
                arm: place(second) + model.lattice.place(pair.cell) - place(first),
                force: pair.force,
                moments: pair.moments,
                power: pair.force.dot(&(one.velocity - other.velocity)) + turning.trace(),
            }
        };
        let links = pairs.iter().map(link).collect();
        Ok(Self { time, grains, links, periods })
    }
}
