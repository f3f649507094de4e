//! Force and torque that the memory of the fluid adds to the loads of a sphere.

use super::Scratch;
use super::body_rates::body_rates;
use super::history::RigidHistory;
use crate::body::Slots;
use crate::inadmissible::Inadmissible;
use crate::instant::BodyAt;
use crate::state::Turn;
use crate::tensor::Vec3;

/// Force [N] and torque [N m] of the history and of the added mass, in the axes of space; zero without a history.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub(crate) fn history_reaction(at: &BodyAt, turn: &Turn, scratch: &mut Scratch) -> Result<(Vec3, Vec3), Inadmissible> {
    let Some(sphere) = RigidHistory::of(at, turn) else { return Ok((Vec3::zeros(), Vec3::zeros())) };
    let slots = Slots::with_inertia(at.body, 0);
    let mut rates = scratch.take_numbers(slots.block().len());
    let done = body_rates(at, &slots, scratch, &mut rates);
    let [linear, angular] = [slots.velocity(), slots.rate()].map(|slot| Vec3::from_column_slice(&rates[slot]));
    scratch.give_back(rates);
    done?;
    let turned = at.motion.placement.gradient * angular;
    Ok((
        sphere.loads.force - sphere.history.added_mass * linear,
        sphere.loads.torque - sphere.history.added_inertia * turned,
    ))
}
