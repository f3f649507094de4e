//! A flat triangle with all that the integrals need: axes, corners in its plane, slopes of its shape functions.

use crate::inner::PlaneTriangle;
use crate::surface::ClosedSurface;
use crate::vector::{Mat3, Vec3};

/// A flat triangle.
#[derive(Debug, Clone)]
pub(crate) struct FlatPanel {
    pub corners: [Vec3; 3],
    /// The unknowns at the corners, by node.
    pub nodes: [usize; 3],
    pub centroid: Vec3,
    /// Distance of the farthest corner from the centroid [length].
    pub radius: f64,
    pub area: f64,
    /// Columns: along the first side, across it in the plane, the outward normal.
    pub axes: Mat3,
    /// The corners in the first two axes, from the first corner.
    pub outline: PlaneTriangle,
    /// Gradients of the three shape functions in the plane.
    pub slopes: [[f64; 2]; 3],
    /// The points of the rule of degree 2: λ = (2/3, 1/6, 1/6) and its permutations.
    pub points: [Vec3; 3],
}

impl FlatPanel {
    pub fn new(corners: [Vec3; 3], nodes: [usize; 3]) -> Self {
        let [a, b, c] = corners;
        let first = (b - a).normalize();
        let doubled = (b - a).cross(&(c - a));
        let normal = doubled.normalize();
        let second = normal.cross(&first);
        let plane = corners.map(|p| [(p - a).dot(&first), (p - a).dot(&second)]);
        let doubled = doubled.norm();
        // ∇φ_k is the opposite side turned inward, over twice the area.
        let slope = |k: usize| {
            let (from, to) = (plane[(k + 1) % 3], plane[(k + 2) % 3]);
            [(from[1] - to[1]) / doubled, (to[0] - from[0]) / doubled]
        };
        let centroid = (a + b + c) / 3.0;
        Self {
            corners,
            nodes,
            centroid,
            radius: corners.iter().map(|p| (p - centroid).norm()).fold(0.0, f64::max),
            area: 0.5 * doubled,
            axes: Mat3::from_columns(&[first, second, normal]),
            outline: PlaneTriangle::new(plane),
            slopes: [slope(0), slope(1), slope(2)],
            points: corners.map(|p| 0.5 * (p + centroid)),
        }
    }

    /// All the triangles of a surface.
    pub fn all(surface: &ClosedSurface) -> Vec<Self> {
        let corners = surface.triangles.iter().map(|t| t.map(|corner| surface.points[corner]));
        corners.zip(&surface.nodes).map(|(corners, nodes)| Self::new(corners, *nodes)).collect()
    }

    pub fn normal(&self) -> Vec3 {
        self.axes.column(2).into()
    }

    /// The point with these barycentric coordinates.
    pub fn at(&self, barycentric: &[f64; 3]) -> Vec3 {
        self.corners[0] * barycentric[0] + self.corners[1] * barycentric[1] + self.corners[2] * barycentric[2]
    }
}
