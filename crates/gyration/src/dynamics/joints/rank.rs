//! Equations of joints that follow from others: the pivots of the symmetric elimination of G A B Gᵀ, joint by joint.

use super::super::Workspace;
use super::JointEquations;
use crate::inadmissible::Inadmissible;
use crate::model::Model;
use crate::state::State;
use nalgebra::DMatrix;

/// A pivot below this part of its diagonal entry is rounding: its equation follows from those before it.
const DEPENDENT: f64 = 1e-10;

/// A joint some of whose equations follow from those of the joints before it, or keep what cannot move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DependentJoint {
    /// Its number in the model.
    pub joint: usize,
    /// How many of its equations do.
    pub dependent: usize,
}

impl Workspace {
    /// The first joint of a model that is over-determined in a state, if there is one.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn dependent_joint(&mut self, model: &Model, state: &State) -> Result<Option<DependentJoint>, Inadmissible> {
        let Self { instants, scratch } = self;
        let motions = instants.motions(model, state.time, state.numbers())?;
        let mut equations = std::mem::take(&mut scratch.joints);
        equations.read(model, |body| motions.at(model, body), false);
        let found = equations.dependent();
        scratch.joints = equations;
        Ok(found)
    }
}

impl JointEquations {
    fn dependent(&self) -> Option<DependentJoint> {
        let graph = &self.room.as_ref()?.graph;
        let count = graph.equations();
        let mut matrix = DMatrix::<f64>::zeros(count, count);
        for own in &graph.joints_of {
            for ((one, end), (other, there)) in own.iter().flat_map(|one| own.iter().map(move |other| (one, other))) {
                for (i, j) in graph.ranges[*one].clone().flat_map(|i| graph.ranges[*other].clone().map(move |j| (i, j)))
                {
                    matrix[(i, j)] += self.rows[i].pull[*end].dot(&self.rows[j].response[*there]);
                }
            }
        }
        let diagonal: Vec<f64> = (0..count).map(|k| matrix[(k, k)]).collect();
        let mut found: Option<DependentJoint> = None;
        for (joint, range) in graph.ranges.iter().enumerate() {
            for k in range.clone() {
                let pivot = matrix[(k, k)];
                if pivot > DEPENDENT * diagonal[k] {
                    for i in k + 1..count {
                        let factor = matrix[(i, k)] / pivot;
                        if factor != 0.0 {
                            (k..count).for_each(|j| matrix[(i, j)] -= factor * matrix[(k, j)]);
                        }
                    }
                } else {
                    found.get_or_insert(DependentJoint { joint, dependent: 0 }).dependent += 1;
                }
            }
            if found.is_some() {
                return found;
            }
        }
        None
    }
}
