//! Boxes along the axes of space, and a tree of them.

use crate::tensor::Vec3;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// A place beyond which boxes have no volume that is a number [m].
const FARTHEST: f64 = 1e90;

/// A box along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    low: Vec3,
    high: Vec3,
}

/// Boxes with the bodies that are in them.
#[derive(Debug, Clone, Default)]
pub struct BoxTree(RTree<GeomWithData<Rectangle<[f64; 3]>, usize>>);

impl Bounds {
    /// About a sphere; what is no number, or too large a one, is without bound.
    pub fn about(center: &Vec3, radius: f64) -> Self {
        let held = |x: f64, side: f64| if x.is_nan() { side * FARTHEST } else { x.clamp(-FARTHEST, FARTHEST) };
        Self { low: center.map(|x| held(x - radius, -1.0)), high: center.map(|x| held(x + radius, 1.0)) }
    }

    /// About this one and another.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// Wider by a length [m] on each side.
    #[must_use]
    pub fn wider(&self, by: f64) -> Self {
        let (low, high) = (self.low.add_scalar(-by), self.high.add_scalar(by));
        Self { low: Self::about(&low, 0.0).low, high: Self::about(&high, 0.0).high }
    }

    fn corners(&self) -> [[f64; 3]; 2] {
        [self.low.into(), self.high.into()]
    }
}

impl BoxTree {
    /// Of boxes, each with its body.
    pub fn new(boxes: impl Iterator<Item = (Bounds, usize)>) -> Self {
        Self(RTree::bulk_load(boxes.map(boxed).collect()))
    }

    /// Adds a box with its body.
    pub fn insert(&mut self, bounds: Bounds, body: usize) {
        self.0.insert(boxed((bounds, body)));
    }

    /// How many boxes there are.
    pub fn count(&self) -> usize {
        self.0.size()
    }

    /// The bodies of the boxes that touch one, in no order.
    pub fn touching(&self, bounds: &Bounds) -> impl Iterator<Item = usize> {
        let [low, high] = bounds.corners();
        self.0.locate_in_envelope_intersecting(AABB::from_corners(low, high)).map(|boxed| boxed.data)
    }
}

fn boxed((bounds, body): (Bounds, usize)) -> GeomWithData<Rectangle<[f64; 3]>, usize> {
    let [low, high] = bounds.corners();
    GeomWithData::new(Rectangle::from_corners(low, high), body)
}
