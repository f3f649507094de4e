//! The derivatives of the rates through the forces of joints.
//!
//!   (G A B Gᵀ) δλ = −(G A δv̇ + δC̈),   δv̇ + B Gᵀδλ
//!
//! δv̇ is the change at λ as it is, which the blocks have already, those of what joints do among them; δC̈ that of q,
//! q̇ and q̈ with the numbers of a body at its rates as they are. Every body of a linkage feels every other, and
//! whatever acts on one of them.

use super::super::Scratch;
use super::super::jacobian::Blocks;
use super::{JointEquations, Room, Vec12};
use crate::body::Slots;
use crate::instant::{Instant, second};
use crate::load::Interaction;

/// Who acts on linkages.
#[derive(Debug, Clone, Default)]
pub(super) struct Sources {
    /// The pairs (i, j) of bodies of which j acts on i otherwise.
    acting: Vec<(usize, usize)>,
    /// The bodies of each linkage and those that act on one of them, ascending, linkage by linkage.
    all: Vec<usize>,
    /// Where those of each linkage begin, and where the last end.
    starts: Vec<usize>,
    /// The pairs (i, j) of bodies of which j acts on i through joints.
    joins: Vec<(usize, usize)>,
}

/// Adds what changes through the forces of joints, where all else has been added.
pub(in super::super) fn add_jacobian(instant: &Instant, scratch: &mut Scratch, blocks: &mut (impl Blocks + ?Sized)) {
    if instant.model().joints().is_empty() {
        return;
    }
    let mut equations = std::mem::take(&mut scratch.joints);
    equations.add_jacobian(instant, blocks);
    scratch.joints = equations;
}

impl Sources {
    fn of(&self, linkage: usize) -> &[usize] {
        &self.all[self.starts[linkage]..self.starts[linkage + 1]]
    }
}

impl JointEquations {
    /// The pairs (i, j) of bodies of which j acts on i through joints, given those that act on each other through
    /// bodies without inertia.
    pub fn joins(&mut self, instant: &Instant, others: &[(usize, usize)]) -> &[(usize, usize)] {
        let Sources { acting, all, starts, joins } = &mut self.sources;
        joins.clear();
        let Some(graph) = instant.model().joint_graph() else { return joins };
        [&mut *all, &mut *starts].into_iter().for_each(Vec::clear);
        acting.clear();
        acting.extend(instant.joins().chain(others.iter().copied()));
        starts.push(0);
        for linkage in &graph.linkages {
            let start = all.len();
            all.extend(linkage.iter().map(|place| graph.bodies[*place]));
            let is_of = |body: &usize| graph.place(*body).is_some_and(|place| linkage.binary_search(&place).is_ok());
            all.extend(acting.iter().filter(|(on, _)| is_of(on)).map(|(_, by)| *by));
            all[start..].sort_unstable();
            let mut end = start;
            for k in start..all.len() {
                if end == start || all[k] != all[end - 1] {
                    all[end] = all[k];
                    end += 1;
                }
            }
            all.truncate(end);
            starts.push(end);
            for place in linkage {
                let on = graph.bodies[*place];
                joins.extend(all[start..].iter().filter(|by| **by != on).map(|by| (on, *by)));
            }
        }
        joins
    }

    fn add_jacobian(&mut self, instant: &Instant, blocks: &mut (impl Blocks + ?Sized)) {
        let Some(graph) = instant.model().joint_graph() else { return };
        let sources = std::mem::take(&mut self.sources);
        for (number, linkage) in graph.linkages.iter().enumerate() {
            for source in sources.of(number) {
                let columns = Slots::of(&instant.model().bodies[*source], 0).block();
                for column in columns {
                    self.side.fill(0.0);
                    for place in linkage {
                        self.add_rates((*place, *source), column, blocks);
                    }
                    if let Some(place) = graph.place(*source) {
                        self.add_change(instant, place, column);
                    }
                    self.solve_side();
                    for place in linkage {
                        let change = self.response(*place);
                        let rows = self.members[*place].slots.velocities();
                        let Some(block) = blocks.block(graph.bodies[*place], *source) else { continue };
                        let mut column = block.column_mut(column);
                        let rates = column.rows_mut(rows.start, rows.len());
                        rates.into_iter().zip(&change).for_each(|(rate, change)| *rate += change);
                    }
                }
            }
        }
        self.sources = sources;
    }

    /// Subtracts G A δv̇ of one member with a number of a body.
    fn add_rates(&mut self, (place, source): (usize, usize), column: usize, blocks: &mut (impl Blocks + ?Sized)) {
        let Self { room: Some(Room { graph, .. }), members, rows, side, .. } = self else { return };
        let Some(block) = blocks.block(graph.bodies[place], source) else { return };
        let mut rates = Vec12::zeros();
        let own = block.column(column);
        let own = own.rows(members[place].slots.velocities().start, members[place].slots.velocities().len());
        rates.iter_mut().zip(&own).for_each(|(rate, own)| *rate = *own);
        for (joint, end) in &graph.joints_of[place] {
            for number in graph.ranges[*joint].clone() {
                side[number] -= rows[number].pull[*end].dot(&rates);
            }
        }
    }

    /// Subtracts δC̈ with a number of a member.
    fn add_change(&mut self, instant: &Instant, place: usize, column: usize) {
        let Self { room: Some(Room { graph, .. }), members, side, .. } = self else { return };
        let Some(change) = members[place].change(column) else { return };
        let model = instant.model();
        for (number, end) in &graph.joints_of[place] {
            let joint = &model.joints()[*number];
            debug_assert!(joint.parties()[*end].body().is_some());
            let second = second(joint, |body| instant.motions().at(model, body));
            let jets = super::jets(joint, members, graph, second);
            for (row, out) in joint.rows().iter().zip(&mut side[graph.ranges[*number].clone()]) {
                *out -= row.change(&jets, *end, &change);
            }
        }
    }
}
