//! What two bodies that meet do to each other.
//!
//!   (f | M)_i = σ_i λ_i n⊗a_i + adhesion + damping + friction
//!
//! The plane is in balance, so that the wrenches of the two are opposite; computed apart they differ by rounding, which
//! near contact is more than that of the forces. B therefore takes exactly what A leaves, about a point of the plane.

use super::Mat34;
use super::exchange::PairLoads;
use super::fault::PairFault;
use super::form::PairForm;
use super::gjk::separate;
use super::plane::Guess;
use super::pulled::Pulled;
use super::side::{Half, Side};
use super::state::{PairScratch, PairState, ViscousMoments};
use crate::contact::LawKind;
use crate::load::Loads;
use crate::tensor::{Mat3, axial, cross_matrix};

impl PairState<'_> {
    /// The powers of the laws [W], given (f | M) of the repulsion on both sides: those of damping and friction are
    /// zero.
    pub fn powers(&self, repulsion: &[Mat34; 2]) -> [f64; LawKind::COUNT] {
        let rates = self.halves.each_ref().map(Half::rates);
        let mut powers = [0.0; LawKind::COUNT];
        powers[self.pair.laws.placed_by as usize] = repulsion[0].dot(&rates[0]) + repulsion[1].dot(&rates[1]);
        powers
    }

    /// (f | M) of adhesion on a side, as far as it is within reach; none without adhesion.
    fn adhesion(&self, side: usize) -> Option<Mat34> {
        let Pulled { energy, on, .. } = self.pulled.as_ref()?;
        let switch = &self.placed.switch;
        Some(switch.value * on[side] + switch.lift * *energy * self.repulsion(side))
    }

    /// Adds adhesion to (f | M) on both sides and to the powers of the laws [W].
    pub fn add_adhesion(&self, on: &mut [Mat34; 2], powers: &mut [f64; LawKind::COUNT]) {
        for (side, on) in on.iter_mut().enumerate() {
            let Some(adhesion) = self.adhesion(side) else { return };
            powers[LawKind::Adhesion as usize] += adhesion.dot(&self.halves[side].rates());
            *on += adhesion;
        }
    }

    /// What is exchanged, given (f | M) on both sides and the powers of the laws [W].
    pub fn exchange(&self, on: [Mat34; 2], powers: [f64; LawKind::COUNT]) -> PairLoads {
        let plane = &self.placed.plane;
        let faded = |store: fn(&Pulled) -> f64| {
            self.pulled.as_ref().map_or(0.0, |pulled| self.placed.switch.value * store(pulled))
        };
        PairLoads {
            on: self.opposite(on),
            energy: self.placed.energy + faded(|pulled| pulled.energy),
            stored: self.placed.energy + faded(|pulled| pulled.stored),
            powers,
            gap: self.halves.iter().map(|half| half.smallest_gap(plane).0).sum(),
            normal: plane.normal,
            point: self.halves[0].side.placement.position + self.foot,
        }
    }

    /// The loads that (f | M) of both sides are, B's opposite to A's.
    fn opposite(&self, on: [Mat34; 2]) -> [Loads; 2] {
        let [above, below] =
            on.map(|on| Loads { force: on.column(0).into(), moment: on.fixed_columns::<3>(1).into_owned() });
        let about_foot = |half: &Half, loads: &Loads| {
            let arm = half.columns.column(0) - self.foot;
            let own: Mat3 = loads.moment * half.side.placement.gradient.transpose();
            arm.cross(&loads.force) + axial(&own)
        };
        let force = -above.force;
        let taken = Loads { force, moment: below.moment };
        let left = about_foot(&self.halves[0], &above) + about_foot(&self.halves[1], &taken);
        let back = 0.5 * cross_matrix(&left) * self.halves[1].side.inverse.transpose();
        [above, Loads { force, moment: below.moment - back }]
    }
}

impl PairLoads {
    /// Nothing, and the slab along some plane between two bodies: what is told of a pair out of reach whose plane of
    /// least potential is beyond the digits of a number.
    ///
    /// # Errors
    /// [`PairFault`] if no plane separates them.
    pub fn nothing(pair: &PairForm, sides: [&Side; 2]) -> Result<Self, PairFault> {
        let halves = pair.halves(sides);
        let plane = separate(halves.each_ref()).map_err(PairFault::of_gap)?;
        let [above, below] = halves.each_ref().map(|half| half.smallest_gap(&plane).0);
        let point = sides[0].placement.position + plane.offset * plane.normal;
        Ok(Self { gap: above + below, normal: plane.normal, point, ..Self::default() })
    }

    /// Places the plane between two bodies, and integrates the laws over both.
    ///
    /// # Errors
    /// [`PairFault`] if no plane separates them.
    pub fn integrate(
        pair: &PairForm,
        sides: [&Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<Self, PairFault> {
        if let Some(balls) = pair.balls(sides) {
            return balls?.loads(&pair.laws, sides, pair.threshold, &mut scratch.axial);
        }
        let state = PairState::new(pair, sides, guess, scratch)?;
        let mut on = [state.repulsion(0), state.repulsion(1)];
        let mut powers = state.powers(&on);
        state.add_adhesion(&mut on, &mut powers);
        state.each_mediator(ViscousMoments::Values, scratch, |_, _, mediator, _| {
            powers[mediator.kind as usize] += mediator.power();
            on[0] += mediator.loads(0);
            on[1] += mediator.loads(1);
        })?;
        Ok(state.exchange(on, powers))
    }
}
