//! The edges of a surface of triangles: which triangles meet there, and which way they face.
//!
//! A closed, oriented surface has every edge exactly twice, once in each sense. Everything else is a fault with a place.

use std::collections::BTreeMap;
use std::fmt;

use super::polyhedron::{Polyhedron, PolyhedronError};
use crate::tensor::Vec3;

/// How many places a message lists.
const LISTED: usize = 3;

/// An edge by the points of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// One end [m].
    pub from: Vec3,
    /// The other end [m].
    pub to: Vec3,
}

impl fmt::Display for Edge {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (a, b) = (&self.from, &self.to);
        write!(formatter, "({}, {}, {})–({}, {}, {})", a.x, a.y, a.z, b.x, b.y, b.z)
    }
}

/// The triangles at an edge, by the sense in which they run along it.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    /// Triangles that run from the lower to the higher index.
    pub forward: Vec<usize>,
    /// Triangles that run from the higher to the lower index.
    pub backward: Vec<usize>,
}

/// The edges of a surface by their vertices, lower index first, in the order of the indices.
pub(super) fn edges(triangles: &[[usize; 3]]) -> BTreeMap<[usize; 2], Sides> {
    let mut edges: BTreeMap<[usize; 2], Sides> = BTreeMap::new();
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let sides = edges.entry([from.min(to), from.max(to)]).or_default();
            if from < to { sides.forward.push(triangle) } else { sides.backward.push(triangle) }
        }
    }
    edges
}

/// The edges at which a surface is not closed and oriented.
#[derive(Debug, Clone, Default)]
pub(super) struct EdgeFaults {
    open: Faults,
    branching: Faults,
    misoriented: Faults,
}

#[derive(Debug, Clone, Default)]
struct Faults {
    count: usize,
    first: Vec<Edge>,
}

impl Faults {
    fn add(&mut self, edge: Edge) {
        self.count += 1;
        if self.first.len() < LISTED {
            self.first.push(edge);
        }
    }
}

impl EdgeFaults {
    /// Finds the faults of a surface whose indices are valid.
    pub fn of(surface: &Polyhedron) -> Self {
        let mut faults = Self::default();
        for ([from, to], sides) in edges(&surface.triangles) {
            let edge = Edge { from: surface.vertices[from], to: surface.vertices[to] };
            match (sides.forward.len(), sides.backward.len()) {
                (1, 1) => {}
                (1, 0) | (0, 1) => faults.open.add(edge),
                (2, 0) | (0, 2) => faults.misoriented.add(edge),
                _ => faults.branching.add(edge),
            }
        }
        faults
    }

    /// The worst kind of fault as an error.
    pub fn into_result(self) -> Result<(), PolyhedronError> {
        let Self { open, branching, misoriented } = self;
        if open.count > 0 {
            return Err(PolyhedronError::Open { count: open.count, first: open.first });
        }
        if branching.count > 0 {
            return Err(PolyhedronError::NonManifold { count: branching.count, first: branching.first });
        }
        if misoriented.count > 0 {
            return Err(PolyhedronError::Misoriented { count: misoriented.count, first: misoriented.first });
        }
        Ok(())
    }
}
