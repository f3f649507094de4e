//! Runs that end at rest, of what is driven.

use crate::plan::RunPlan;
use gyration::model::Model;

/// What must be told where rest may come before what drives the bodies has begun.
pub(super) fn note(model: &Model, plan: &RunPlan) -> Option<String> {
    let (rest, _) = plan.stop_at_rest.as_ref().zip(model.is_driven().then_some(()))?;
    Some(format!(
        "`stop_at_rest` looks at speeds alone, and what is driven here may move later: slower than {} m/s for {} s, the \
         run ends, whatever the drive does after that",
        rest.speed, rest.hold
    ))
}
