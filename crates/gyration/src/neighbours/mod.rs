//! Who meets whom: rules between sets of bodies, and the pairs of bodies that are near enough to act on one another.
//!
//! A scene says rules (two sets of bodies, laws, a reach), no list of pairs: of N bodies there are N² pairs, of which
//! each body has a few that matter. Forces out of reach are exactly zero, so that which pairs are listed beside those
//! within reach leaves no trace in any number; listed pairs keep the order of the rules, in which loads are summed.
//!
//! | file      | what                                                          |
//! |-----------|---------------------------------------------------------------|
//! | `rules`   | what a scene says: sets of bodies, laws, reach                |
//! | `boxes`   | boxes in a tree                                               |
//! | `spheres` | which spheres about bodies come near one another              |
//! | `list`    | the pairs that may act, kept while bodies move little         |
//! | `images`  | the pairs across the cells of a lattice, listed once          |
//! | `solids`  | the pairs of bodies with supports that have a shape           |

mod boxes;
mod images;
mod list;
mod rules;
mod solids;
mod spheres;

pub use boxes::{Bounds, BoxTree};
pub use images::{Extent, ImagePair, ImagePairs};
pub use list::NeighbourList;
use rules::masses;
pub use rules::{PairRule, PairRules};
pub(crate) use solids::solid_pairs;
pub use spheres::{BodyPair, Sphere, each_near, each_overlap, near};

use crate::body::Solid;
use crate::lattice::{Cell, HERE};
use crate::load::{Interaction, Party};
use crate::pair::PairForm;
use std::sync::Arc;

/// A body of a model and another, or a support with a shape, that meet, or convex parts of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The number of the rule that joins them.
    pub rule: usize,
    /// The two, A and B: a body, and a body or a support with a shape; two bodies differ in one cell.
    pub parties: [Party; 2],
    /// The cell of B as seen from that of A.
    pub cell: Cell,
    /// Which part of each.
    pub parts: [usize; 2],
    /// What they do to each other.
    pub form: Arc<PairForm>,
}

/// By what the pairs of a model are ordered: those of bodies first, each by rule, parties, cell and parts.
pub type PairKey = (bool, usize, [Party; 2], Cell, [usize; 2]);

impl Interaction for Pair {
    fn parties(&self) -> [Party; 2] {
        self.parties
    }

    fn cell(&self) -> Cell {
        self.cell
    }
}

impl Pair {
    /// The pairs of all parts of two bodies that a rule joins.
    pub(crate) fn all_of<'a>(
        rules: &'a PairRules,
        rule: usize,
        bodies: [usize; 2],
        solids: [&'a Arc<Solid>; 2],
    ) -> impl Iterator<Item = Self> + use<'a> {
        Solid::parts_of(solids.map(|solid| &**solid)).map(move |parts| {
            let form = Arc::new(form(&rules.all()[rule], solids, parts));
            Self { rule, parties: bodies.map(Party::Body), cell: HERE, parts, form }
        })
    }

    /// The two, if both are bodies.
    pub fn bodies(&self) -> Option<[usize; 2]> {
        match self.parties {
            [Party::Body(one), Party::Body(other)] => Some([one, other]),
            _ => None,
        }
    }

    /// The order in which the pairs of a model stand.
    pub fn key(&self) -> PairKey {
        (self.bodies().is_none(), self.rule, self.parties, self.cell, self.parts)
    }
}

/// What two parts do to each other by a rule.
fn form(rule: &PairRule, solids: [&Arc<Solid>; 2], parts: [usize; 2]) -> PairForm {
    let surfaces = [0, 1].map(|end| solids[end].part(parts[end]));
    let radii = [0, 1].map(|end| solids[end].part_radius(parts[end]));
    let threshold = rule.reach.map(|reach| reach.threshold(&rule.laws, masses(solids.map(|solid| &**solid), parts)));
    PairForm::of_radii(Arc::clone(&rule.laws), threshold, surfaces, radii)
}
