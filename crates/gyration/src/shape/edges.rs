//! The edges of a surface of triangles: which triangles meet there, and which way they face.
//!
//! Found by sorting, so that meshes of millions of triangles need little more memory than they have themselves.

use std::fmt;

use crate::tensor::Vec3;

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

/// An edge as one triangle runs along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct HalfEdge {
    /// The vertices at the ends, the lower index first.
    pub ends: [usize; 2],
    /// Whether the triangle runs from the higher to the lower index.
    pub runs_back: bool,
    /// Index of the triangle.
    pub triangle: usize,
}

/// The half-edges of all triangles, those of the same edge together.
pub(super) fn half_edges(triangles: &[[usize; 3]]) -> Vec<HalfEdge> {
    let of_triangle = |(triangle, &[a, b, c]): (usize, &[usize; 3])| {
        let half_edge =
            |from: usize, to: usize| HalfEdge { ends: [from.min(to), from.max(to)], runs_back: from > to, triangle };
        [half_edge(a, b), half_edge(b, c), half_edge(c, a)]
    };
    let mut half_edges: Vec<HalfEdge> = triangles.iter().enumerate().flat_map(of_triangle).collect();
    half_edges.sort_unstable();
    half_edges
}
