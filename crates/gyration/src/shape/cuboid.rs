//! The box, |X_i| ≤ a_i/2.
//!
//!   V = a₁a₂a₃,   J = m diag(a_i²)/12

use super::error::{ShapeError, positive};
use super::feature::Feature;
use super::outline::Outline;
use super::triangulation::Triangulation;
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// A box with its centre at the origin and its edges along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    /// The lengths of the edges \[m\].
    pub size: Vec3,
}

impl Cuboid {
    /// Checks that the edges are finite and > 0.
    ///
    /// # Errors
    /// [`ShapeError::NotPositive`] for the first edge that is not.
    pub fn validate(&self) -> Result<(), ShapeError> {
        self.size.iter().try_for_each(|&edge| positive("box", "size", edge))
    }

    /// Mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let volume = self.size.product();
        let mass = density * volume;
        let euler_tensor = Mat3::from_diagonal(&(self.size.component_mul(&self.size) * (mass / 12.0)));
        MassProperties { mass, center: Vec3::zeros(), euler_tensor, volume }
    }

    /// The support function h(n) = max X·n = Σ |n_i| a_i/2 \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        0.5 * direction.abs().dot(&self.size)
    }

    /// The six faces.
    pub fn surface(&self) -> Surface {
        Surface::cuboid(&self.size)
    }

    /// The sharpest feature: a vertex.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::Vertex
    }

    /// The twelve edges.
    pub fn outline(&self) -> Outline {
        let mut polylines = Vec::with_capacity(12);
        for corner in 0..8_usize {
            let upper_ends = [1, 2, 4].into_iter().filter(|axis| corner & axis == 0);
            polylines.extend(upper_ends.map(|axis| vec![corner, corner | axis]));
        }
        Outline { points: self.silhouette_points(), polylines }
    }

    /// The six faces, two triangles each, on the eight corners.
    pub fn triangulation(&self, _count: usize) -> Triangulation {
        // Corners by their bits, counter-clockwise seen from outside.
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Triangulation { points: self.silhouette_points(), triangles }
    }

    /// The eight corners; bit k of the index says whether axis k is on its positive side.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        let side = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { 0.5 } else { -0.5 };
        (0..8).map(|corner| Vec3::from_fn(|axis, _| side(corner, axis) * self.size[axis])).collect()
    }
}
