//! Pairs of bodies across the cells of a lattice: which body meets which image of which.
//!
//! They are listed once, by where the bodies of a cell start, as far as they reach when each has come away from there,
//! beside the first body, and has grown, by no more than a bound together: one that strays farther leaves the model. So
//! nothing is looked for while a lattice moves, whatever the number of cells, and all of them may drift together.

use super::BodyPair;
use crate::lattice::Cell;
use crate::tensor::Vec3;
use std::sync::Arc;

/// A body, and the image of another, or of itself, in a cell as seen from its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct ImagePair {
    /// The rule and the bodies.
    pub pair: BodyPair,
    /// The cell of the second.
    pub cell: Cell,
}

/// The pairs of a lattice.
#[derive(Debug, Clone, PartialEq)]
pub struct ImagePairs {
    /// Ascending.
    all: Arc<[ImagePair]>,
    /// Where each body starts in its cell, and how far it extends there [m].
    starts: Arc<[Extent]>,
    /// Whether each meets anybody.
    meets: Arc<[bool]>,
    /// How far a body may come away from there, beside the first one, and grow [m].
    stray: f64,
}

/// Where a body is, and a sphere about it in which it lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Its centre in its cell [m].
    pub place: Vec3,
    /// [m].
    pub radius: f64,
}

impl ImagePairs {
    /// Of bodies that start like this in their cells.
    pub fn new(mut all: Vec<ImagePair>, starts: Vec<Extent>, stray: f64) -> Self {
        all.sort_unstable();
        all.dedup();
        let mut meets = vec![false; starts.len()];
        all.iter().flat_map(|image| image.pair.bodies).for_each(|body| meets[body] = true);
        Self { all: all.into(), starts: starts.into(), meets: meets.into(), stray }
    }

    /// All of them, ascending.
    pub fn all(&self) -> &[ImagePair] {
        &self.all
    }

    /// Whether a body meets another, or an image.
    pub fn meets(&self, body: usize) -> bool {
        self.meets[body]
    }

    /// The first body that has come too far from its start, beside the first of all, or grown too much, and how far
    /// [m].
    pub fn strayed(&self, extent: impl Fn(usize) -> Extent) -> Option<(usize, f64)> {
        let drift = extent(0).place - self.starts[0].place;
        let distance = |body: usize| {
            let (now, start) = (extent(body), &self.starts[body]);
            (now.place - start.place - drift).norm() + (now.radius - start.radius).max(0.0)
        };
        (0..self.starts.len()).map(|body| (body, distance(body))).find(|(_, distance)| *distance > self.stray)
    }

    /// Those between some bodies, which ascend, by their places among these.
    #[must_use]
    pub fn among(&self, members: &[usize]) -> Self {
        let place = |body: usize| members.binary_search(&body).ok();
        let within = |image: &ImagePair| {
            let [one, other] = image.pair.bodies.map(place);
            Some(ImagePair { pair: BodyPair { bodies: [one?, other?], ..image.pair }, ..*image })
        };
        let starts = members.iter().map(|body| self.starts[*body]).collect();
        Self::new(self.all.iter().filter_map(within).collect(), starts, self.stray)
    }
}
