//! Where the formulas of a model go over to others: the switching functions of `abs`, `min` and `max` in its
//! potentials, forces, frictions, bonds and motors.
//!
//! Rates are smooth as long as none of them changes its sign. Where one does, a potential's force may jump, or the
//! slope of any.

use super::loads::undefined;
use super::{Scratch, Workspace};
use crate::acting::Load;
use crate::extended::Numbers;
use crate::inadmissible::{FormulaOf, Inadmissible};
use crate::instant::{BodyAt, Instant};
use crate::model::Model;

impl Workspace {
    /// The switching functions of a model in a state, always in the same order; none where no formula has any.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn switching(&mut self, model: &Model, time: f64, state: Numbers) -> Result<Vec<f64>, Inadmissible> {
        let (instant, scratch) = self.read_at(model, time, state)?;
        scratch.formulas.watch_switching();
        let evaluated = evaluate(&instant, scratch);
        let found = scratch.formulas.take_switching();
        evaluated.map(|()| found)
    }
}

/// Evaluates each formula once.
fn evaluate(instant: &Instant, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    instant.evaluate_formulas(&mut scratch.formulas)?;
    (0..instant.model().bodies.len()).try_for_each(|index| evaluate_own(&instant.at(index), scratch))
}

/// Evaluates the formulas of the forces that a body has of its own.
fn evaluate_own(at: &BodyAt, scratch: &mut Scratch) -> Result<(), Inadmissible> {
    let (place, formulas) = (&at.motion.placement, &mut scratch.formulas);
    at.try_each_load(|load| {
        let (evaluated, of) = match load {
            Load::Potential(potential) => (potential.loads(place, at.time, formulas), FormulaOf::Potential),
            Load::BodyForce(body_force) => (body_force.loads(place, at.time, formulas), FormulaOf::BodyForce),
            Load::PointForce(point_force) => (point_force.loads(place, at.time, formulas), FormulaOf::PointForce),
            Load::OwnFriction(friction) => {
                let loads = friction.loads((place, at.time), &at.inverse(), &at.motion.velocity, formulas);
                (loads, FormulaOf::Friction)
            }
            // Formulas of bonds and motors belong to two bodies; what follows has none.
            Load::Bond(_)
            | Load::Joint(_)
            | Load::Contact(_)
            | Load::Spring(_)
            | Load::Pair(_)
            | Load::Couple(_)
            | Load::Applied(_)
            | Load::Resistance(_)
            | Load::MassFriction(_)
            | Load::SelfGravity(_)
            | Load::Fluid(..)
            | Load::Walls(_)
            | Load::Neighbours(_) => return Ok(()),
        };
        evaluated.map(|_| ()).map_err(undefined(at, of))
    })
}
