//! Runs that end at rest, of what is driven.

use crate::plan::RunPlan;
use gyration::model::Model;
use gyration::support::SupportMotion;

/// What must be told where rest may come before what drives the bodies has begun.
pub(super) fn note(model: &Model, plan: &RunPlan) -> Option<String> {
    let rest = plan.stop_at_rest.as_ref()?;
    let mut supports = model.supports.iter().map(|support| &support.motion);
    let mut solid = model.solid_supports.iter().map(|support| &support.motion);
    if !model.is_driven() && supports.all(SupportMotion::is_fixed) && solid.all(SupportMotion::is_fixed) {
        return None;
    }
    Some(format!(
        "`stop_at_rest` looks at speeds alone, and what is driven here may move later: slower than {} m/s for {} s, \
         the run ends, whatever the drive does after that",
        rest.speed, rest.hold
    ))
}
