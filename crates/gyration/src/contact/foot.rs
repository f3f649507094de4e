//! Where the repulsion of a contact acts: the centre of its tractions, carried over to the support.
//!
//!   X_c = a₁/a₀,   a₀ = Σ c ∫d^−ν dA,   a₁ = Σ c ∫d^−ν X dA   over the powers of the repulsion
//!
//! It is the point of the plane through which the force of the repulsion passes.

use super::law_set::{ContactScratch, LawSet};
use super::meeting::Meeting;
use super::{Action, LawKind};
use crate::surface::GapClosed;
use crate::tensor::Vec3;

/// X_c, the centre of the tractions of the repulsion in the reference shape [m]; none where nothing repels.
///
/// # Errors
/// [`GapClosed`] if a point of the surface lies on or behind the plane.
pub(crate) fn repulsion_center(
    laws: &LawSet,
    meeting: &Meeting,
    scratch: &mut ContactScratch,
) -> Result<Option<Vec3>, GapClosed> {
    let plan = laws.values();
    let moments = scratch.take(plan.requests().len());
    meeting.moments(laws, plan, moments)?;
    let repels = |kind, action| kind == LawKind::Repulsion && action == Action::Central;
    let (mut zeroth, mut first) = (0.0, Vec3::zeros());
    for planned in laws.terms().iter().filter(|planned| repels(planned.term.kind, planned.term.action)) {
        zeroth += planned.term.coefficient * moments[planned.value].zeroth;
        first += planned.term.coefficient * moments[planned.value].first;
    }
    Ok((zeroth > 0.0).then(|| first / zeroth))
}
