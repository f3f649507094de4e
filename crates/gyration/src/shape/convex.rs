//! The convex parts of a shape: what bodies meet one another with.
//!
//! A plane stands between two convex bodies, so that any other shape has to be a union of convex ones. A ring is none,
//! and a mesh is one where it bends outward over all its edges.

use super::edges::half_edges;
use super::{Polyhedron, Shape, UnionPart};
use crate::surface::Surface;

/// How far a corner may stand out beyond a neighbouring face, relative to the size: coordinates in decimals.
const BULGE: f64 = 1e-9;

/// Why a shape has no convex parts.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NotConvex {
    /// A ring.
    #[error("a torus is not convex")]
    Ring,
    /// A mesh with a dent.
    #[error("the mesh is not convex: it bends inward by {depth:e} m at the edge from vertex {} to {}", .edge[0], .edge[1])]
    Dent {
        /// The vertices of an edge.
        edge: [usize; 2],
        /// How far the corner behind it stands out \[m\].
        depth: f64,
    },
    /// A mesh of several pieces.
    #[error("the mesh has several pieces")]
    Pieces,
}

impl Shape {
    /// Whether it is convex, or a union of convex parts.
    ///
    /// # Errors
    /// [`NotConvex`] where a part is not.
    pub fn check_convex(&self) -> Result<(), NotConvex> {
        match self {
            Self::Torus(_) => Err(NotConvex::Ring),
            Self::Polyhedron(polyhedron) => polyhedron.check_convex(),
            Self::Union(union) => union.parts.iter().try_for_each(|part| part.shape.check_convex()),
            _ => Ok(()),
        }
    }

    /// The surfaces of the parts of a union, those of its unions among them, in the shape's frame; none of any other.
    pub fn part_surfaces(&self) -> Vec<Surface> {
        let Self::Union(union) = self else { return Vec::new() };
        let surfaces = |part: &UnionPart| {
            let own = match &part.shape {
                Self::Union(_) => part.shape.part_surfaces(),
                shape => shape.surface().into_iter().collect(),
            };
            own.into_iter().map(|surface| surface.transformed(&part.rotation, &part.offset)).collect::<Vec<_>>()
        };
        union.parts.iter().flat_map(surfaces).collect()
    }
}

impl Polyhedron {
    /// Whether it bends outward over every edge, which makes a closed surface in one piece convex.
    fn check_convex(&self) -> Result<(), NotConvex> {
        let size = self.vertices.iter().map(|vertex| (vertex - self.vertices[0]).norm()).fold(0.0, f64::max);
        let half_edges = half_edges(&self.triangles);
        for pair in half_edges.chunks_exact(2) {
            let edge = pair[0].ends;
            let [one, other] = [0, 1].map(|side| &self.triangles[pair[side].triangle]);
            let [a, b, c] = self.corners(one);
            let area = (b - a).cross(&(c - a));
            let Some(corner) = other.iter().find(|corner| !edge.contains(corner)) else { continue };
            let depth = (self.vertices[*corner] - a).dot(&area) / area.norm();
            if depth > BULGE * size {
                return Err(NotConvex::Dent { edge, depth });
            }
        }
        let mut corners: Vec<usize> = self.triangles.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        // Euler: corners − edges + faces are two for each piece without a hole.
        if corners.len() + self.triangles.len() == half_edges.len() / 2 + 2 { Ok(()) } else { Err(NotConvex::Pieces) }
    }
}
