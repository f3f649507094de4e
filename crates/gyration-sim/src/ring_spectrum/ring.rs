//! The cells of a run that is a ring, and what its bodies do as coordinates of the cell.
//!
//!   δp = u,   P = exp(A) P_i,   ξ_R: (u, A P_i) of all bodies of a cell along coordinates of mass one

use super::NoRingSpectrum;
use crate::modes::bands::LatticeWaves;
use crate::waves::{logarithm, origin, resting};
use gyration::model::Model;
use gyration::state::{Start, State};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::{Built, CellBlock, UnitCell};
use nalgebra::{Complex, DVector};

type C64 = Complex<f64>;

/// The cells of a ring.
#[derive(Debug, Clone)]
pub(super) struct Ring {
    repeat: [u32; 3],
    /// How many of them one has in which bands are.
    unit: [u32; 3],
    /// How many of these there are along each direction.
    pub counts: [usize; 3],
}

/// What the cells of a ring do at a sample, coordinate by coordinate, cell by cell.
pub(super) struct CellMotions {
    /// ξ.
    pub places: Vec<Vec<C64>>,
    /// ξ̇.
    pub rates: Vec<Vec<C64>>,
    /// The largest |A|.
    pub spread: f64,
}

/// What a body does.
#[derive(Clone, Copy)]
struct Moved {
    places: (Vec3, Mat3),
    rates: (Vec3, Mat3),
}

impl Ring {
    /// Of a scene, with the cell that repeats.
    pub fn of(built: &Built) -> Result<(Self, &UnitCell), NoRingSpectrum> {
        let (Some(CellBlock { repeat, periodic }), Some(cell)) = (built.block, &built.cell) else {
            return Err(NoRingSpectrum::NoLattice);
        };
        let along: [bool; 3] = std::array::from_fn(|a| periodic[a] && a < cell.periodic.len());
        if !along.contains(&true) {
            return Err(NoRingSpectrum::NoRing);
        }
        let unit = std::array::from_fn(|a| if along[a] { 1 } else { repeat[a] });
        Ok((Self { repeat, unit, counts: std::array::from_fn(|a| (repeat[a] / unit[a]) as usize) }, cell))
    }

    /// How many cells there are.
    pub fn count(&self) -> usize {
        self.counts.iter().product()
    }

    /// The wave vectors that fit, ascending, the first direction fastest, and where sums have them.
    pub fn wave_vectors(&self) -> Vec<([f64; 3], usize)> {
        let along = |a: usize| {
            let count = self.counts[a] as i64;
            (-(count - 1) / 2..=count / 2).map(move |j| (j as f64 / count as f64, j.rem_euclid(count) as usize))
        };
        let [x, y, _] = self.counts;
        let wave = |[first, second, third]: [(f64, usize); 3]| {
            ([first.0, second.0, third.0], first.1 + x * (second.1 + y * third.1))
        };
        let all = along(2).flat_map(|c| along(1).flat_map(move |b| along(0).map(move |a| [a, b, c])));
        all.map(wave).collect()
    }

    /// The body of the cell that one of the run is a copy of, and the place of its cell among all.
    fn origin(&self, body: usize) -> (usize, usize) {
        let (kind, at) = origin(body, &self.repeat, &self.unit);
        let [x, y, z]: [usize; 3] = std::array::from_fn(|a| (at[a] / self.unit[a]) as usize);
        (kind, x + self.counts[0] * (y + self.counts[1] * z))
    }

    /// The state in which all its bodies rest.
    pub fn at_rest(&self, model: &Model, waves: &LatticeWaves) -> State {
        let rests = &waves.rest().bodies;
        let starts = (0..model.bodies.len()).map(|body| resting(&model.bodies[body], &rests[self.origin(body).0]));
        State::start(model, &starts.collect::<Vec<Start>>())
    }

    /// What its cells do in a state.
    ///
    /// # Errors
    /// `TooFar`.
    pub fn motions(&self, model: &Model, state: &State, waves: &LatticeWaves) -> Result<CellMotions, NoRingSpectrum> {
        let (cells, coordinates) = (self.count(), waves.coordinate_count());
        let rests = &waves.rest().bodies;
        let mut moved = vec![vec![None; rests.len()]; cells];
        let mut most: f64 = 0.0;
        for body in 0..model.bodies.len() {
            let (kind, cell) = self.origin(body);
            let rest = &rests[kind].placement;
            let motion = state.motion(model, body);
            let inverse = rest.gradient.try_inverse().unwrap_or_else(Mat3::identity);
            let log = logarithm(&(motion.placement.gradient * inverse), &(motion.velocity.gradient_rate * inverse));
            let too_far = || NoRingSpectrum::TooFar { body: model.name(body).to_owned(), time: state.time };
            let [spread, spread_rate] = log.ok_or_else(too_far)?;
            most = most.max(spread.norm());
            moved[cell][kind] = Some(Moved {
                places: (motion.placement.position - rest.position, spread * rest.gradient),
                rates: (motion.velocity.velocity, spread_rate * rest.gradient),
            });
        }
        let mut found = CellMotions {
            places: vec![vec![C64::new(0.0, 0.0); cells]; coordinates],
            rates: vec![vec![C64::new(0.0, 0.0); cells]; coordinates],
            spread: most,
        };
        let still = Moved { places: (Vec3::zeros(), Mat3::zeros()), rates: (Vec3::zeros(), Mat3::zeros()) };
        for (cell, own) in moved.iter().enumerate() {
            let of = |kind: usize| own[kind].unwrap_or(still);
            let put = |into: &mut Vec<Vec<C64>>, along: DVector<f64>| {
                into.iter_mut().zip(along.iter()).for_each(|(cells, part)| cells[cell] = C64::new(*part, 0.0));
            };
            put(&mut found.places, waves.along(|kind| of(kind).places));
            put(&mut found.rates, waves.along(|kind| of(kind).rates));
        }
        Ok(found)
    }
}
