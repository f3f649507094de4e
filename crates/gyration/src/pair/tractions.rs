//! The tractions of a pair, over parts of the surfaces of both.
//!
//! With the plane, the weights of the repulsion and the velocity of the mediator known, what acts on a side is linear
//! in its moments: those of a part of its surface tell what acts there. The parts add up to the loads of the whole.
//!
//! What a tension adds (`tension`) has no resultant force, and is left aside.

use super::fault::PairFault;
use super::form::PairForm;
use super::mediator::{Mediator, Shares};
use super::side::{Half, Side};
use super::state::{PairScratch, PairState, ViscousMoments};
use crate::surface::{GapField, Surface};
use crate::tensor::Vec3;

/// The tractions of a pair whose plane is found.
pub struct PairTractions<'a> {
    state: PairState<'a>,
    /// Damping and friction, with κ d^ν′ of both sides and the place of their moments.
    mediators: Vec<Resisting>,
}

struct Resisting {
    mediator: Mediator,
    coefficients: [f64; 2],
    place: usize,
}

impl<'a> PairTractions<'a> {
    /// Places the plane between two bodies.
    ///
    /// # Errors
    /// [`PairFault`] if no plane separates them.
    pub fn new(pair: &'a PairForm, sides: [&'a Side; 2], scratch: &mut PairScratch) -> Result<Self, PairFault> {
        let state = PairState::new(pair, sides, None, scratch)?;
        let shares = Shares::of_weights(&pair.laws, state.placed.weights);
        let mut mediators = Vec::new();
        state.each_mediator(ViscousMoments::Values, scratch, |law, _, mediator, _| {
            let coefficients = [0, 1].map(|side| shares.coefficient(law, side));
            mediators.push(Resisting { mediator: mediator.clone(), coefficients, place: law.value });
        })?;
        Ok(Self { state, mediators })
    }

    /// The distance of the points of a side from the plane, and the smallest [m].
    pub fn gaps(&self, side: usize) -> (GapField, f64) {
        let (half, plane) = (&self.state.halves[side], &self.state.placed.plane);
        (half.field(plane), half.smallest_gap(plane).0)
    }

    /// The force on a part of the surface of a side [N].
    ///
    /// # Errors
    /// [`PairFault`] if the part reaches the plane.
    pub fn force_on(&self, side: usize, surface: &Surface, scratch: &mut PairScratch) -> Result<Vec3, PairFault> {
        let PairState { pair, halves, placed, pulled, .. } = &self.state;
        let part = Side { surface, ..*halves[side].side };
        let half = Half { side: &part, ..halves[side] };
        let (laws, plane) = (&pair.laws, &placed.plane);
        let [room, _] = scratch.take(laws.placing.requests().len());
        let own = half.potential(laws, plane, room)?;
        let pressing = placed.weights[side] * own.first[0];
        let mut force = half.sign * pressing * plane.normal;
        if let (Some(pulled), Some(pull)) = (pulled, &laws.pull) {
            let [room, _] = scratch.take(pull.values.requests().len());
            half.moments(plane, &pull.values, room)?;
            let on = half.sign * pulled.on_part(side, &plane.normal, room, &own);
            force = placed.switch.value * Vec3::from(on.column(0)) + (1.0 + placed.switch.lift * pulled.energy) * force;
        }
        if !self.mediators.is_empty() {
            let [room, _] = scratch.take(laws.resisting.requests().len());
            half.moments(plane, &laws.resisting, room)?;
            for Resisting { mediator, coefficients, place } in &self.mediators {
                force += mediator.on_part(side, coefficients[side], &room[*place]).column(0);
            }
        }
        Ok(force)
    }

    /// The largest exponent of the powers of the gap in its tractions.
    pub fn steepest(&self) -> f64 {
        let laws = &self.state.pair.laws;
        let pulls = laws.pull.iter().flat_map(|pull| pull.terms.iter().flatten().map(|term| term.exponent));
        let resists = laws.viscous.iter().map(|law| law.exponent);
        pulls.chain(resists).fold(laws.repulsion.exponent, f64::max)
    }
}
