//! The slabs between bodies that meet, and those at the beginning of a step, from which the planes of its stages are
//! looked for.

use crate::load::Interactions;
use crate::model::Model;
use crate::neighbours::{NeighbourList, Pair};
use crate::pair::{Guess, PairGap};
use crate::party::Party;

/// The slabs between the bodies of the listed pairs at a state.
#[derive(Debug, Clone, Default)]
pub struct PairGaps {
    pairs: Interactions<Pair>,
    /// By the number of the pair.
    slabs: Vec<PairGap>,
    /// Whether all pairs are listed that there are.
    is_whole: bool,
}

/// Where the planes of pairs were, from which they are looked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Remembered {
    /// When they were there [s]; none if that is not remembered.
    since: Option<f64>,
    gaps: PairGaps,
    /// The list of pairs that was last asked for, if any was since, and the place of each among these; empty if they
    /// are the same.
    list: Option<Interactions<Pair>>,
    places: Vec<usize>,
}

impl PairGaps {
    /// Each pair with its slab, which is infinite where the two are out of reach; in order of the pairs.
    pub fn iter(&self) -> impl Iterator<Item = (&Pair, &PairGap)> {
        self.pairs.all().iter().zip(&self.slabs)
    }

    /// The slabs of a body.
    pub fn of(&self, body: usize) -> impl Iterator<Item = &PairGap> {
        self.pairs.of(body).filter_map(|end| self.slabs.get(end.number))
    }

    /// The slabs of a body with those that it acts on: whether others are listed depends on who asks. Bodies that
    /// deform act on all.
    pub fn acting_on<'a>(&'a self, model: &'a Model, body: usize) -> impl Iterator<Item = &'a PairGap> {
        let deforms = |party: &Party| party.body().is_some_and(|body| model.bodies[body].affine().is_some());
        self.pairs.of(body).filter_map(move |end| {
            let (pair, slab) = (&self.pairs.all()[end.number], self.slabs.get(end.number)?);
            let is_within = pair.form.range.is_none_or(|range| slab.gap < range);
            (is_within || pair.parties.iter().any(deforms)).then_some(slab)
        })
    }

    /// Whether all pairs are listed that there are; those that are not are out of reach.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Forgets the slabs.
    pub(super) fn clear(&mut self) {
        self.slabs.clear();
    }

    /// Begins anew for a list of pairs, none of which is near; their slabs, to be found.
    pub(super) fn begin(&mut self, near: &NeighbourList) -> &mut [PairGap] {
        self.clear();
        self.slabs.resize(near.pairs().all().len(), PairGap::FAR);
        self.is_whole = near.is_whole();
        if !self.pairs.are(near.pairs()) {
            self.pairs = near.pairs().clone();
        }
        &mut self.slabs
    }

    /// Becomes that of a model without pairs.
    pub(super) fn become_empty(&mut self) {
        self.clear();
        self.is_whole = true;
        if !self.pairs.all().is_empty() {
            self.pairs = Interactions::default();
        }
    }
}

impl Remembered {
    /// Those that are remembered, if any are.
    pub fn slabs(&self) -> Option<&PairGaps> {
        self.since.map(|_| &self.gaps)
    }

    /// Remembers nothing.
    pub fn forget(&mut self) {
        self.since = None;
    }

    /// Remembers the slabs of a time [s]; those of before are given back.
    pub fn keep(&mut self, time: f64, slabs: &mut PairGaps) -> &PairGaps {
        self.since = Some(time);
        std::mem::swap(&mut self.gaps, slabs);
        slabs.clear();
        // They are found among these at the next instant.
        self.list = None;
        &self.gaps
    }

    /// Where the plane of a listed pair is looked for first at a time.
    pub fn guess(&self, number: usize, time: f64) -> Option<Guess> {
        let since = self.since?;
        let place = if self.places.is_empty() { number } else { *self.places.get(number)? };
        self.gaps.slabs.get(place)?.guess(time - since)
    }

    /// Finds the pairs of a list among those that are remembered. What is remembered stays: a pair may leave the list
    /// and come back.
    pub fn find(&mut self, pairs: &Interactions<Pair>) {
        if self.list.as_ref().is_some_and(|list| list.are(pairs)) {
            return;
        }
        self.list = Some(pairs.clone());
        self.places.clear();
        if !self.gaps.pairs.are(pairs) {
            let known = self.gaps.pairs.all();
            let place = |pair: &Pair| known.binary_search_by_key(&pair.key(), Pair::key).unwrap_or(usize::MAX);
            self.places.extend(pairs.all().iter().map(place));
        }
    }
}
