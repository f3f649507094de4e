//! What acts on a body, gravity and the reaction of a pin aside: f and M in all, and kind by kind.
//!
//!   f = Σ f_k,   M = Σ M_k,   M_k − f_k ⊗ r about a pin at r
//!
//! Each load is asked once more, and falls in the one kind that `Load::kind` says. A sphere whose past motion the fluid
//! feels has the force of that history, added mass included, among its drag. Source: `docs/theory-affine.md`.

use super::Scratch;
use super::history_reaction::of_history;
use super::loads::Acting;
use crate::acting::LoadKind;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, MotionAt};
use crate::load::Loads;

/// f [N] and M [N m] of what acts on a body, by kind; M about the centre of mass or the pin.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadsByKind([Loads; LoadKind::COUNT]);

impl LoadsByKind {
    /// f and M of one kind.
    pub fn of(&self, kind: LoadKind) -> &Loads {
        &self.0[kind as usize]
    }
}

/// f and M of what acts on a body, by kind.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn loads_by_kind(at: &BodyAt, scratch: &mut Scratch) -> Result<LoadsByKind, Inadmissible> {
    let mut kinds = LoadsByKind::default();
    at.try_each_load(|load| {
        let mut alone = Acting::default();
        alone.add(&load, at, scratch)?;
        kinds.0[load.kind() as usize] += alone.total;
        Ok(())
    })?;
    kinds.0[LoadKind::Drag as usize] += of_history(at, scratch)?;
    Ok(LoadsByKind(kinds.0.map(|loads| about_pin(at, &loads))))
}

/// f and M of the friction that is linear in the velocities; M about the centre of mass or the pin.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub(crate) fn linear_friction(at: &BodyAt, scratch: &mut Scratch) -> Result<Loads, Inadmissible> {
    let mut friction = Acting::default();
    at.try_each_load(|load| match load.kind() {
        LoadKind::Friction => friction.add(&load, at, scratch),
        LoadKind::Contact | LoadKind::Pair | LoadKind::Spring | LoadKind::Drag | LoadKind::Load => Ok(()),
    })?;
    Ok(about_pin(at, &friction.total))
}

/// Loads about the centre of mass, about the pin if there is one.
pub(crate) fn about_pin(at: &MotionAt, loads: &Loads) -> Loads {
    let Some(pin) = &at.body.pin else { return *loads };
    Loads { force: loads.force, moment: loads.moment - loads.force * pin.point.transpose() }
}
