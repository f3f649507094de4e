//! Who hangs together through joints: the bodies and joints of each linkage, and where their equations stand.
//!
//! Two joints are coupled if they share a body. Order and places of the factors of G B Gᵀ follow from that alone, so
//! that a model has them once.

use super::Joint;
use crate::load::{Interaction, Party};
use gyration_blocks::{Analysis, BlockMatrix, Components, Pattern};
use std::ops::Range;

/// The joints of a model as a graph.
#[derive(Debug, Clone)]
pub struct JointGraph {
    /// The bodies with joints, ascending.
    pub bodies: Vec<usize>,
    /// Where the equations of each joint stand among all.
    pub ranges: Vec<Range<usize>>,
    /// The bodies of each linkage, ascending, by their places among those with joints.
    pub linkages: Vec<Vec<usize>>,
    /// The joints of each body, by its place, and which of their ends it is.
    pub joints_of: Vec<Vec<(usize, usize)>>,
    /// Which joints share a body.
    pub pattern: Pattern,
    /// The order in which the multipliers are eliminated.
    pub analysis: Analysis,
}

impl JointGraph {
    /// That of some joints; none without any.
    pub fn of(joints: &[Joint]) -> Option<Self> {
        if joints.is_empty() {
            return None;
        }
        let ends = || joints.iter().flat_map(|joint| joint.parties().into_iter().filter_map(Party::body));
        let mut bodies: Vec<usize> = ends().collect();
        bodies.sort_unstable();
        bodies.dedup();
        let place = |body: usize| bodies.partition_point(|known| *known < body);
        let mut joints_of = vec![Vec::new(); bodies.len()];
        let mut end = 0;
        let mut ranges = Vec::with_capacity(joints.len());
        for (number, joint) in joints.iter().enumerate() {
            ranges.push(end..end + joint.rows().len());
            end += joint.rows().len();
            for (own, party) in joint.parties().into_iter().enumerate() {
                if let Some(body) = party.body() {
                    joints_of[place(body)].push((number, own));
                }
            }
        }
        let shared = joints_of.iter().flat_map(|own: &Vec<(usize, usize)>| {
            own.iter().flat_map(|(one, _)| own.iter().map(|(other, _)| (*one, *other)))
        });
        let pattern = Pattern::new(joints.len(), shared.filter(|(one, other)| one != other));
        let mut matrix = BlockMatrix::new(&ranges);
        matrix.arrange(&pattern);
        let all: Vec<usize> = (0..joints.len()).collect();
        let analysis = Analysis::of(&all, &ranges, &matrix);
        let pairs = joints.iter().filter_map(Joint::bodies).map(|pair| pair.map(place));
        let linkages = Components::joined(bodies.len(), pairs).listed(bodies.len());
        let linkages = linkages.iter().map(<[usize]>::to_vec).collect();
        Some(Self { bodies, ranges, linkages, joints_of, pattern, analysis })
    }

    /// How many equations there are.
    pub fn equations(&self) -> usize {
        self.ranges.last().map_or(0, |range| range.end)
    }

    /// The place of a body among those with joints.
    pub fn place(&self, body: usize) -> Option<usize> {
        self.bodies.binary_search(&body).ok()
    }
}
