//! The derivatives of what two bodies do to each other, by the coordinates and velocities of both.
//!
//! They are taken along each of the twelve coordinates of each body in turn, with the change of the plane: moments
//! change by those of one more power of the gap, and everything else by the chain rule.

use super::Mat34;
use super::equilibrium::Change;
use super::exchange::{PairLoads, PairSlopes};
use super::fault::PairFault;
use super::form::PairForm;
use super::mediator::Slope;
use super::plane::Guess;
use super::side::Side;
use super::state::{PairScratch, PairState, ViscousMoments};
use crate::load::{COORDINATES, Mat12};

impl PairSlopes {
    /// Places the plane between two bodies, integrates the laws over both, and differentiates them.
    ///
    /// The area factor of a body that deforms is held. Those of rigid balls are by what they can do, turn and not
    /// deform.
    ///
    /// # Errors
    /// [`PairFault`] if no plane separates them.
    pub fn integrate(
        pair: &PairForm,
        sides: [&Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<Self, PairFault> {
        if pair.laws.viscous.is_empty()
            && let Some(balls) = pair.balls(sides)
        {
            return balls?.slopes(sides, pair.threshold);
        }
        let state = PairState::new(pair, sides, guess, scratch)?;
        let halves = state.halves.each_ref();
        let mut on = [state.repulsion(0), state.repulsion(1)];
        let mut powers = state.powers(&on);
        let zeros = [[Mat12::zeros(); 2]; 2];
        let mut slopes = Self { loads: PairLoads::default(), by_place: zeros, by_rate: None };
        let changes: [Change; BOTH] =
            std::array::from_fn(|column| state.placed.along(halves, places(column).each_ref()));
        for (column, change) in changes.iter().enumerate() {
            add(&mut slopes.by_place, column, [0, 1].map(|side| state.repulsion_along(side, change)));
        }
        if state.placed.is_out_of_reach() {
            slopes.loads = state.exchange(on, powers);
            return Ok(slopes);
        }
        let normal = &state.placed.plane.normal;
        let mut by_rate = None;
        state.each_mediator(ViscousMoments::Slopes, scratch, |law, shares, mediator, moments| {
            powers[mediator.kind as usize] += mediator.power();
            on[0] += mediator.loads(0);
            on[1] += mediator.loads(1);
            let bent = [0, 1].map(|side| Slope::new(law, shares, side, moments[side]));
            for (column, change) in changes.iter().enumerate() {
                let (placed, places) = ((&state.placed, shares), places(column));
                let (foot, places) = ((&state.foot, &bent), (places.each_ref(), change));
                add(&mut slopes.by_place, column, mediator.along_places(law, halves, placed, foot, places));
                let (body, moved) = (column / COORDINATES, unit(column % COORDINATES));
                add(by_rate.get_or_insert(zeros), column, mediator.along_rates(normal, body, &moved));
            }
        })?;
        slopes.loads = state.exchange(on, powers);
        Ok(Self { by_rate, ..slopes })
    }
}

/// The coordinates of both bodies.
const BOTH: usize = 2 * COORDINATES;

/// The columns of a matrix that are one, counted by (p₀ | P) column by column.
fn unit(coordinate: usize) -> Mat34 {
    let mut unit = Mat34::zeros();
    unit[coordinate] = 1.0;
    unit
}

/// (δq_A, δq_B) of one coordinate of the two.
fn places(column: usize) -> [Mat34; 2] {
    [0, 1].map(|body| if column / COORDINATES == body { unit(column % COORDINATES) } else { Mat34::zeros() })
}

/// Adds the change of (f | M) on both with one coordinate of the two.
fn add(slopes: &mut [[Mat12; 2]; 2], column: usize, change: [Mat34; 2]) {
    let (body, coordinate) = (column / COORDINATES, column % COORDINATES);
    for (rows, change) in slopes.iter_mut().zip(&change) {
        for (entry, number) in rows[body].column_mut(coordinate).iter_mut().zip(change.iter()) {
            *entry += number;
        }
    }
}

impl PairState<'_> {
    /// The change of the repulsion on a side.
    fn repulsion_along(&self, side: usize, change: &Change) -> Mat34 {
        let (normal, first) = (&self.placed.plane.normal, &self.placed.potentials[side].first);
        let pressed = (change.weights[side] * normal + change.normal) * first.transpose();
        self.halves[side].sign * self.placed.weights[side] * (pressed + normal * change.first[side].transpose())
    }
}
