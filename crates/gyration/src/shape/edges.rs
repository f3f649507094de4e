//! The edges of a surface of triangles: which triangles meet there, and which way they face.
//!
//! A closed, oriented surface has every edge exactly twice, once in each sense. Everything else is a fault with a
//! place. Found by sorting, so that meshes of millions of triangles need little more memory than they have themselves.

use std::fmt;

use super::polyhedron::{Polyhedron, PolyhedronError};
use crate::tensor::Vec3;

/// How many places a message lists.
const LISTED: usize = 3;

/// An edge by the points of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// One end \[m\].
    pub from: Vec3,
    /// The other end \[m\].
    pub to: Vec3,
}

impl fmt::Display for Edge {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (a, b) = (&self.from, &self.to);
        write!(formatter, "({}, {}, {})–({}, {}, {})", a.x, a.y, a.z, b.x, b.y, b.z)
    }
}

/// One side of a triangle: an edge as one triangle runs along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// The vertices at the ends, the lower index first.
    pub ends: [usize; 2],
    /// Whether the triangle runs from the higher to the lower index.
    pub runs_back: bool,
    /// Index of the triangle.
    pub triangle: usize,
}

/// The sides of all triangles, those of the same edge together.
pub(super) fn sides(triangles: &[[usize; 3]]) -> Vec<Side> {
    let of_triangle = |(triangle, &[a, b, c]): (usize, &[usize; 3])| {
        let side = |from: usize, to: usize| Side { ends: [from.min(to), from.max(to)], runs_back: from > to, triangle };
        [side(a, b), side(b, c), side(c, a)]
    };
    let mut sides: Vec<Side> = triangles.iter().enumerate().flat_map(of_triangle).collect();
    sides.sort_unstable();
    sides
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
        for meeting in sides(&surface.triangles).chunk_by(|a, b| a.ends == b.ends) {
            let [from, to] = meeting[0].ends;
            let edge = Edge { from: surface.vertices[from], to: surface.vertices[to] };
            match meeting {
                [a, b] if a.runs_back != b.runs_back => {}
                [_, _] => faults.misoriented.add(edge),
                [_] => faults.open.add(edge),
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
