//! The equations of joints as linear forms on velocities: what a configuration leaves is their null space.

use super::super::Workspace;
use super::Vec12;
use crate::inadmissible::Inadmissible;
use crate::load::{Interaction, Party};
use crate::model::Model;
use crate::state::State;

/// One equation of a joint at a configuration, Ċ = Σ (Aᵀ Gᵀ)·v over its bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointEquation {
    /// The number of its joint in the model.
    pub joint: usize,
    /// Each of its two parties that is a body, and ∂Ċ/∂v, v its numbers (velocity, rate) in order, then zeros.
    pub ends: [Option<(usize, Vec12)>; 2],
}

impl Workspace {
    /// The equations of all joints of a model at the places of a state, in order.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn joint_equations(&mut self, model: &Model, state: &State) -> Result<Vec<JointEquation>, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        let motions = instants.motions(model, state.time, state.numbers())?;
        scratch.joints.read(model, |body| motions.at(model, body), false);
        let Some(graph) = model.joint_graph() else { return Ok(Vec::new()) };
        let of_joint = |(joint, range): (usize, &std::ops::Range<usize>)| {
            let parties = model.joints()[joint].parties();
            let rows = scratch.joints.rows[range.clone()].iter();
            rows.map(move |row| JointEquation {
                joint,
                ends: [0, 1].map(|end| Party::body(parties[end]).map(|body| (body, row.pull[end]))),
            })
        };
        Ok(graph.ranges.iter().enumerate().flat_map(of_joint).collect())
    }
}
