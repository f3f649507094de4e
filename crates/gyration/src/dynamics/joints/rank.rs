//! Equations of joints that follow from others: the pivots of the symmetric elimination of G A B Gᵀ, joint by joint.

use super::super::Workspace;
use super::{JointEquations, Room};
use crate::extended::Numbers;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::load::{Interaction, Party};
use crate::model::Model;
use nalgebra::DMatrix;
use std::ops::Range;

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

impl DependentJoint {
    /// The state as one outside the model.
    pub fn inadmissible(&self, model: &Model) -> Inadmissible {
        dependent(model, self.joint)
    }
}

/// A state in which the equations of a joint follow from others.
pub(super) fn dependent(model: &Model, joint: usize) -> Inadmissible {
    let body = model.joints()[joint].parties().into_iter().find_map(Party::body).unwrap_or(0);
    Inadmissible { body, quantity: Quantity::Joints { joint }, value: 0.0 }
}

impl Workspace {
    /// The first joint of a model that is over-determined in a state, if there is one.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn dependent_joint(
        &mut self,
        model: &Model,
        time: f64,
        state: Numbers,
    ) -> Result<Option<DependentJoint>, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        let motions = instants.motions(model, time, state)?;
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
        let pivots = self.relative_pivots();
        let depends = |range: &Range<usize>| pivots[range.clone()].iter().filter(|pivot| **pivot <= DEPENDENT).count();
        let mut found = graph.ranges.iter().map(depends).enumerate();
        let (joint, dependent) = found.find(|(_, dependent)| *dependent > 0)?;
        Some(DependentJoint { joint, dependent })
    }

    /// The joint whose equations are nearest to dependence on those before them; the first of several.
    pub(super) fn least_independent(&self) -> usize {
        let pivots = self.relative_pivots();
        let least = pivots.iter().copied().fold(f64::INFINITY, f64::min);
        let at = pivots.iter().position(|pivot| *pivot <= least).unwrap_or(0);
        let ranges = self.room.iter().flat_map(|room| &room.graph.ranges);
        ranges.into_iter().position(|range| range.contains(&at)).unwrap_or(0)
    }

    /// The pivot of each equation over its diagonal entry: about zero where it follows from those before it.
    fn relative_pivots(&self) -> Vec<f64> {
        let Some(Room { graph, .. }) = &self.room else { return Vec::new() };
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
        let mut pivots = Vec::with_capacity(count);
        for k in 0..count {
            let pivot = matrix[(k, k)];
            // An equation of nothing that moves has the diagonal zero.
            let relative = if diagonal[k] > 0.0 { pivot / diagonal[k] } else { 0.0 };
            pivots.push(relative);
            if relative > DEPENDENT {
                for i in k + 1..count {
                    let factor = matrix[(i, k)] / pivot;
                    if factor != 0.0 {
                        (k..count).for_each(|j| matrix[(i, j)] -= factor * matrix[(k, j)]);
                    }
                }
            }
        }
        pivots
    }
}
