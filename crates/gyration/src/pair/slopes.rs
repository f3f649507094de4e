//! The derivatives of what two bodies do to each other, by the coordinates and velocities of both.
//!
//! They are taken along each of the twelve coordinates of each body in turn, of a rigid one along its six, with the
//! change of the plane: moments change by those of one more power of the gap, and everything else by the chain rule.

use super::Mat34;
use super::exchange::PairSlopes;
use super::expansion::Change;
use super::fault::PairFault;
use super::form::PairForm;
use super::mediator_slopes::{Slope, Unfolded};
use super::plane::Guess;
use super::pulled_slopes::PulledSlopes;
use super::side::Side;
use super::state::{PairScratch, PairState, ViscousMoments};
use super::tension::TensionChange;
use crate::load::{COORDINATES, Mat12};
use crate::tensor::{Mat3, Vec3, cross_matrix};

impl PairSlopes {
    /// Places the plane between two bodies, integrates the laws over both, and differentiates them.
    ///
    /// Those by the place of a rigid body are by what it can do, turn and not deform.
    ///
    /// # Errors
    /// [`PairFault`] if no plane separates them.
    pub fn integrate(
        pair: &PairForm,
        sides: [&Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<Self, PairFault> {
        let mut found = Self::default();
        found.find(pair, sides, guess, scratch)?;
        Ok(found)
    }

    /// The same in the place of what was found before: derivatives are ten kilobytes, which nobody copies.
    ///
    /// # Errors
    /// As there; what is left is then of no use.
    pub(crate) fn find(
        &mut self,
        pair: &PairForm,
        sides: [&Side; 2],
        guess: Option<&Guess>,
        scratch: &mut PairScratch,
    ) -> Result<(), PairFault> {
        self.by_place = Self::ZEROS;
        self.by_rate = None;
        if let Some(balls) = pair.balls(sides) {
            return balls?.slopes(&pair.laws, sides, pair.threshold, &mut scratch.axial, self);
        }
        let (state, expansion) = PairState::adhering(pair, sides, guess, scratch)?;
        let halves = state.halves.each_ref();
        let mut on = [state.repulsion(0), state.repulsion(1)];
        let mut powers = state.powers(&on);
        state.add_adhesion(&mut on, &mut powers);
        let mut areas = std::mem::take(&mut scratch.areas);
        let placing = areas.placing(&pair.laws, halves, &state.placed.plane)?;
        let tensions = TensionChange::of_placing(&pair.laws, &areas, &placing);
        let adhesion = match &state.pulled {
            Some(pulled) => {
                Some(PulledSlopes::new(&pair.laws, pulled, halves, &expansion, (scratch.take(1), &mut areas))?)
            }
            None => None,
        };
        let mut directions = Direction::all(sides);
        let mut columns: [Option<Column>; BOTH] = std::array::from_fn(|_| {
            let direction = directions.next()?;
            let places = direction.places();
            let change = expansion.along(halves, places.each_ref(), state.placed.switch.bend, &placing);
            let mut sum = [0, 1].map(|side| state.repulsion_along((side, &tensions[side]), &places[side], &change));
            if let Some(adhesion) = &adhesion {
                let change = state.adhesion_along(adhesion, places.each_ref(), &change, &sum);
                sum.iter_mut().zip(&change).for_each(|(sum, change)| *sum += change);
            }
            Some(Column { direction, change, sum })
        });
        let normal = &state.placed.plane.normal;
        areas.find(halves, &state.placed.plane, &pair.laws.resisting)?;
        let by_rate = &mut self.by_rate;
        state.each_mediator(ViscousMoments::Slopes, scratch, |law, shares, mediator, moments| {
            powers[mediator.kind as usize] += mediator.power();
            on[0] += mediator.loads(0);
            on[1] += mediator.loads(1);
            let bent = [0, 1].map(|side| Slope::new(law, shares, (&state, &areas), side, moments[side]));
            let mediator = Unfolded::new(mediator);
            for Column { direction, change, sum } in columns.iter_mut().flatten() {
                let change = mediator.along_places(&state, &bent, direction.places().each_ref(), change);
                sum.iter_mut().zip(&change).for_each(|(sum, change)| *sum += change);
            }
            mediator.add_by_rates(normal, by_rate.get_or_insert(Self::ZEROS));
        })?;
        scratch.areas = areas;
        let by_place = &mut self.by_place;
        columns.iter().flatten().for_each(|Column { direction, sum, .. }| direction.add_to(by_place, sum));
        self.loads = state.exchange(on, powers);
        Ok(())
    }
}

/// The coordinates of both bodies.
const BOTH: usize = 2 * COORDINATES;

/// What changes along one direction: the plane, and (f | M) on both, law by law.
struct Column {
    direction: Direction,
    change: Change,
    sum: [Mat34; 2],
}

/// A way in which one of two bodies can move.
#[derive(Debug, Clone, Copy)]
enum Direction {
    /// Along one of the twelve coordinates (p₀ | P), counted column by column.
    Coordinate { body: usize, place: usize },
    /// About an axis of its own: P [e]×.
    Turn { body: usize, gradient: Mat3 },
}

impl Direction {
    /// All those of two bodies: six of a rigid one.
    fn all<'a>(sides: [&'a Side; 2]) -> impl Iterator<Item = Self> + use<'a> {
        sides.into_iter().enumerate().flat_map(|(body, side)| {
            let gradient = &side.placement.gradient;
            let turns = if side.is_rigid() { 3 } else { 0 };
            let coordinates = if side.is_rigid() { 3 } else { COORDINATES };
            let turned = move |axis: usize| gradient * cross_matrix(&Vec3::ith(axis, 1.0));
            (0..coordinates)
                .map(move |place| Self::Coordinate { body, place })
                .chain((0..turns).map(move |axis| Self::Turn { body, gradient: turned(axis) }))
        })
    }

    /// (δq_A, δq_B).
    fn places(&self) -> [Mat34; 2] {
        let mut places = [Mat34::zeros(); 2];
        match self {
            Self::Coordinate { body, place } => places[*body] = unit(*place),
            Self::Turn { body, gradient } => places[*body].fixed_view_mut::<3, 3>(0, 1).copy_from(gradient),
        }
        places
    }

    /// Adds the change of (f | M) on both along it. Turned by θ_k = ½ P [e_k]× · δP, a rotation has no other part.
    fn add_to(&self, slopes: &mut [[Mat12; 2]; 2], change: &[Mat34; 2]) {
        match self {
            Self::Coordinate { body, place } => {
                for (rows, change) in slopes.iter_mut().zip(change) {
                    let column = rows[*body].column_mut(*place);
                    column.into_iter().zip(change.iter()).for_each(|(entry, number)| *entry += number);
                }
            }
            Self::Turn { body, gradient } => {
                for (rows, change) in slopes.iter_mut().zip(change) {
                    for (place, part) in gradient.iter().enumerate() {
                        let column = rows[*body].column_mut(3 + place);
                        column.into_iter().zip(change.iter()).for_each(|(entry, number)| *entry += 0.5 * part * number);
                    }
                }
            }
        }
    }
}

/// A change of one of the twelve coordinates, counted by (p₀ | P) column by column.
fn unit(coordinate: usize) -> Mat34 {
    let mut unit = Mat34::zeros();
    unit[coordinate] = 1.0;
    unit
}

impl PairState<'_> {
    /// The change of the repulsion on a side, with that of its tension.
    fn repulsion_along(&self, (side, taut): (usize, &Option<TensionChange>), place: &Mat34, change: &Change) -> Mat34 {
        let (normal, first, half) = (&self.placed.plane.normal, &self.placed.first[side], &self.halves[side]);
        let weight = self.placed.weights[side];
        let pressed = (change.weights[side] * normal + change.normal) * first.transpose();
        let pressed = half.sign * weight * (pressed + normal * change.first[side].transpose());
        let Some((taut, tension)) = taut.as_ref().zip(self.tensions[side]) else { return pressed };
        pressed + weight * (change.weights[side] * tension + taut.along(half, place, &change.heights[side]))
    }
}
