//! When two bodies of different islands may come within reach of each other, by the bounds of their paths.

use crate::island::PathBound;
use gyration::body::Solid;
use gyration::model::{Cutoff, Model};
use gyration::neighbours::BodyPair;
use std::cmp::Ordering;

/// Two islands may meet within steps of which the later one begins at this time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    pub time: f64,
    /// The two bodies, and the rule by which they meet.
    pub pair: BodyPair,
    /// By which the paths of their islands were known.
    pub revisions: [u64; 2],
}

impl Eq for Meeting {}

impl PartialOrd for Meeting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Meeting {
    /// By time, then in the order of pairs.
    fn cmp(&self, other: &Self) -> Ordering {
        let rest = |meeting: &Self| (meeting.pair, meeting.revisions);
        self.time.total_cmp(&other.time).then(rest(self).cmp(&rest(other)))
    }
}

/// Two bodies that may come within reach of each other.
pub(super) struct Approaching<'a> {
    cutoff: Cutoff,
    solids: [&'a Solid; 2],
}

impl<'a> Approaching<'a> {
    /// The two of a pair, in an order; none if nothing ever keeps them apart.
    pub fn of(model: &'a Model, pair: &BodyPair, order: [usize; 2]) -> Option<Self> {
        Some(Self { cutoff: model.cutoff(pair)?, solids: order.map(|body| &*model.bodies[body].solid) })
    }

    /// When a step of the first and the first of the steps of the second begin within which they may be within reach.
    pub fn first_meeting(&self, bound: &PathBound, others: &[PathBound]) -> Option<f64> {
        let from = others.partition_point(|other| other.end <= bound.start);
        let mut beside = others[from..].iter().take_while(|other| other.start < bound.end);
        let met = beside.find(|other| bound.may_meet(other, &self.cutoff, self.solids));
        met.map(|other| bound.start.max(other.start))
    }
}
