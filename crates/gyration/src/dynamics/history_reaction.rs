//! What the memory of the fluid adds to the loads of a sphere: history and added mass.

use super::Scratch;
use super::affine_history::AffineHistory;
use super::body_rates::body_rates;
use super::history::RigidHistory;
use crate::body::Slots;
use crate::fluid::HistoryReaction;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::load::Loads;
use crate::tensor::{Mat3, Vec3};

/// Force and moment of the history and of the added mass on a body at an instant; none without a history.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub(crate) fn history_reaction(at: &BodyAt, scratch: &mut Scratch) -> Result<Option<HistoryReaction>, Inadmissible> {
    if at.body.history().is_none() {
        return Ok(None);
    }
    let slots = Slots::with_inertia(at.body, 0);
    let mut rates = scratch.take_numbers(slots.block().len());
    let done = body_rates(at, &slots, scratch, &mut rates);
    let linear = Vec3::from_column_slice(&rates[slots.velocity()]);
    let own = &rates[slots.rate()];
    let reaction = match at.kind() {
        KindAt::Rigid(_, turn) => {
            RigidHistory::of(at, turn).map(|sphere| sphere.reaction(&linear, &Vec3::from_column_slice(own)))
        }
        KindAt::Affine(affine, gyration) => AffineHistory::of(at, affine, gyration)
            .map(|sphere| sphere.reaction(&linear, &Mat3::from_column_slice(own))),
        KindAt::Contractile(..) => None,
    };
    scratch.give_back(rates);
    done.map(|_| reaction)
}

/// f and M of the history and of the added mass; zero without a history.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub(crate) fn of_history(at: &BodyAt, scratch: &mut Scratch) -> Result<Loads, Inadmissible> {
    let reaction = history_reaction(at, scratch)?;
    Ok(reaction.map_or_else(Loads::default, |reaction| reaction.loads(&at.inverse())))
}
