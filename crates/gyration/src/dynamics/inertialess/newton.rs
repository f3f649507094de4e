//! The balance of bodies without inertia under loads that are not linear in the velocities: a bounded friction.
//!
//! What is sought makes a convex function of the velocities least, the power of the fluid and Ψ of the bounds less that
//! of all other forces. Newton's method begins at the velocities of viscous friction; a step is halved while the next
//! one with the same matrix would be longer than it. The constraint on the volume is linear, and holds from the start.
//! Of a body whose forces cancel all velocities are rounding: a step ends the search, too, that is small beside the
//! speed which the forces would give one by one.

use super::super::{Scratch, each_push};
use super::{Group, Member, begin, factors, give_back, move_all, unbalanced, without_resistance};
use crate::acting::Load;
use crate::body::Slots;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::Instant;
use std::ops::Range;

/// A step that is so small beside the velocities leaves an error of its square, which is rounding.
const LAST_STEP: f64 = 1e-7;
/// Rounding of velocities, in parts of the speed that the forces give one by one.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// More steps than are taken: friction far beyond its bound takes some fifteen.
const MOST_STEPS: usize = 60;
/// More halvings of a step than are needed.
const MOST_HALVINGS: usize = 30;

impl Group {
    /// Whether all that acts on its bodies is linear in the velocities.
    pub(super) fn is_linear(&self, instant: &Instant) -> bool {
        let is_linear = |body: &usize| {
            instant.at(*body).try_each_load(|load| {
                let linear = match load {
                    Load::Contact(contact) => contact.law_set.is_linear(),
                    Load::Pair(pair) => !pair.acts() || pair.end.interaction.form.laws.is_linear(),
                    Load::Spring(_)
                    | Load::Bond(_)
                    | Load::Joint(_)
                    | Load::Couple(_)
                    | Load::Applied(_)
                    | Load::Resistance(_)
                    | Load::Potential(_)
                    | Load::BodyForce(_)
                    | Load::PointForce(_)
                    | Load::OwnFriction(_)
                    | Load::MassFriction(_)
                    | Load::SelfGravity(_)
                    | Load::Fluid(..)
                    | Load::Walls(_)
                    | Load::Neighbours(_) => true,
                };
                if linear { Ok(()) } else { Err(()) }
            })
        };
        self.bodies.iter().all(|body| is_linear(body).is_ok())
    }

    /// Goes on from the velocities that were found to those of the balance.
    ///
    /// # Errors
    /// [`Inadmissible`] where nothing resists a motion, or no balance is found.
    pub(super) fn converge(
        &mut self,
        instant: &mut Instant,
        scratch: &mut Scratch,
        members: &mut Vec<Member>,
        side: &mut Vec<f64>,
    ) -> Result<(), Inadmissible> {
        let nothing_resists = without_resistance(self.bodies[0]);
        let (mut relative, mut least) = (f64::NAN, None);
        for _ in 0..MOST_STEPS {
            instant.differentiate_felt_pairs()?;
            give_back(members, scratch);
            for body in &self.bodies {
                members.push(Member::at(&instant.at(*body), scratch)?);
            }
            let Self { bodies, ranges, together, velocities, start, step } = self;
            let mut factors = factors(together, instant, bodies, members).ok_or(nothing_resists)?;
            if least.is_none() {
                pushed(instant, scratch, bodies, ranges, side)?;
                factors.solve(side).ok_or(nothing_resists)?;
                least = Some(ROUNDING * longest(instant, bodies, ranges, side));
            }
            unbalanced(instant, scratch, bodies, ranges, side)?;
            factors.solve(side).ok_or(nothing_resists)?;
            step.clone_from(side);
            start.clone_from(velocities);
            let (length, mut part) = (longest(instant, bodies, ranges, step), 1.0);
            relative = length / longest(instant, bodies, ranges, start);
            let is_last = relative < LAST_STEP || least.is_some_and(|least| length <= least);
            for _ in 0..MOST_HALVINGS {
                let moved = velocities.iter_mut().zip(&*start).zip(&*step);
                moved.for_each(|((velocity, start), step)| *velocity = start + part * step);
                move_all(instant, bodies, ranges, velocities)?;
                instant.find_felt_pairs()?;
                if is_last {
                    return Ok(());
                }
                unbalanced(instant, scratch, bodies, ranges, side)?;
                factors.solve(side).ok_or(nothing_resists)?;
                if longest(instant, bodies, ranges, side) <= length {
                    break;
                }
                part *= 0.5;
            }
        }
        Err(Inadmissible { body: self.bodies[0], quantity: Quantity::Balance, value: relative })
    }
}

/// Writes the right-hand side of the forces on each body, each as great as all of them [m/s²].
fn pushed(
    instant: &Instant,
    scratch: &mut Scratch,
    bodies: &[usize],
    ranges: &[Range<usize>],
    side: &mut Vec<f64>,
) -> Result<(), Inadmissible> {
    begin(ranges, side);
    for (index, range) in bodies.iter().zip(ranges) {
        let at = instant.at(*index);
        let mut force = 0.0;
        each_push(&at, scratch, |push| force += push.force)?;
        let acceleration = at.model.gravity.norm() + force / at.body.solid.mass.mass;
        side[range.start..range.start + Slots::with_inertia(at.body, 0).velocity().len()].fill(acceleration);
    }
    Ok(())
}

/// The longest motion of a point of a body with these velocities, roughly [m/s].
fn longest(instant: &Instant, bodies: &[usize], ranges: &[Range<usize>], velocities: &[f64]) -> f64 {
    let of_body = |(body, range): (&usize, &Range<usize>)| {
        let body = &instant.model().bodies[*body];
        let slots = Slots::with_inertia(body, 0);
        let own = &velocities[range.start..range.start + slots.velocities().len()];
        let (linear, turning) = own.split_at(slots.velocity().len());
        let most = |numbers: &[f64]| numbers.iter().fold(0.0_f64, |most, number| most.max(number.abs()));
        most(linear).max(body.size * most(turning))
    };
    bodies.iter().zip(ranges).map(of_body).fold(0.0, f64::max)
}
