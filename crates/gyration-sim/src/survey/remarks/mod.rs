//! What a user must be told of a scene that runs all the same: what it leaves out, and what it cannot mean.
//!
//! A note is worth a line; a warning says that the answer may not be the one that was asked for. Nothing here changes a
//! run, and all of it takes a time that grows as the number of bodies.

mod begun;
mod cut;
mod endless;
mod far;
mod felt;
mod fluid;
mod joined;
mod meshes;
mod neighbor;
mod plates;
mod reaches;
mod reachless;
mod resting;
mod rows;
mod stored;
mod strangers;
mod stretched;
mod trial;
mod turning;
mod untouched;

pub(crate) use endless::warning as endless;
pub(crate) use fluid::LeftOut;
pub(crate) use stretched::Stretched;

use crate::plan::RunPlan;
use gyration::model::Model;
use gyration::state::State;
use serde::Serialize;

/// Notes and warnings, a line each.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Remarks {
    /// What is as it was asked for, and may not be meant.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// What makes the answer another than that of the question.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

impl Remarks {
    /// Those of a model in its first state, which is to be run by a plan.
    pub fn at_start(model: &Model, start: &State, plan: &RunPlan) -> Self {
        let mut remarks = Self::without_fluid(model, start, plan);
        remarks.warnings.extend(LeftOut::at(model, start).warnings(model));
        remarks.warnings.extend(Stretched::at(model, start).warning(model));
        remarks
    }

    /// The same without what the fluid between bodies would do, and how far bodies are stretched in it.
    pub(crate) fn without_fluid(model: &Model, start: &State, plan: &RunPlan) -> Self {
        let rtol = plan.tolerance.rtol;
        let mut remarks = Self::default();
        strangers::remark(model, start, &mut remarks);
        remarks.notes.extend(plates::notes(model, start));
        remarks.notes.extend(untouched::notes(model));
        remarks.notes.extend(untouched::unfelt(model));
        remarks.notes.extend(turning::notes(model));
        remarks.notes.extend(begun::notes(model, start));
        remarks.notes.extend(reachless::notes(model, start));
        remarks.notes.extend(reachless::beside_deforming(model));
        remarks.notes.extend(felt::notes(model));
        remarks.notes.extend(resting::note(model, plan));
        remarks.warnings.extend(felt::warning(model));
        remarks.warnings.extend(meshes::warnings(model));
        remarks.warnings.extend(stored::warning(model, start));
        remarks.warnings.extend(reaches::warnings(model, start));
        remarks.warnings.extend(cut::warnings(model, start));
        remarks.warnings.extend(endless::warning(model, start, rtol));
        remarks.warnings.extend(far::warning(model, start, rtol));
        remarks
    }
}
