//! The ellipsoid, Σ (X_i/a_i)² ≤ 1.
//!
//!   V = 4πa₁a₂a₃/3,   J = m diag(a_i²)/5

use std::f64::consts::PI;

use super::error::{ShapeError, positive};
use super::feature::Feature;
use super::geodesic::unit_sphere;
use super::outline::{Outline, SILHOUETTE_POINTS, directions};
use super::triangulation::Triangulation;
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// An ellipsoid with its centre at the origin and its axes along those of the frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    /// a_i \[m\].
    pub semi_axes: Vec3,
}

impl Ellipsoid {
    /// Checks that the semi-axes are finite and > 0.
    ///
    /// # Errors
    /// [`ShapeError::NotPositive`] for the first one that is not.
    pub fn validate(&self) -> Result<(), ShapeError> {
        self.semi_axes.iter().try_for_each(|&axis| positive("ellipsoid", "semi_axes", axis))
    }

    /// Mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let volume = 4.0 / 3.0 * PI * self.semi_axes.product();
        let mass = density * volume;
        let euler_tensor = Mat3::from_diagonal(&(self.semi_axes.component_mul(&self.semi_axes) * (mass / 5.0)));
        MassProperties { mass, center: Vec3::zeros(), euler_tensor, volume }
    }

    /// The support function h(n) = max X·n = √(Σ a_i² n_i²) \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.semi_axes.component_mul(direction).norm()
    }

    /// The surface.
    pub fn surface(&self) -> Surface {
        Surface::ellipsoid(&self.semi_axes)
    }

    /// The sharpest feature: a smooth point.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::SmoothPoint
    }

    /// The three principal sections.
    pub fn outline(&self) -> Outline {
        let axis = |k: usize| Vec3::ith(k, self.semi_axes[k]);
        let mut outline = Outline::default();
        for k in 0..3 {
            outline.add_ellipse(Vec3::zeros(), axis(k), axis((k + 1) % 3));
        }
        outline
    }

    /// The image of a geodesic polyhedron of about `count` triangles.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        unit_sphere(count).mapped(|point| point.component_mul(&self.semi_axes))
    }

    /// The point of the surface over a point inside, on the ray from the centre.
    pub(super) fn push_out(&self, point: &Vec3) -> Vec3 {
        point / point.component_div(&self.semi_axes).norm()
    }

    /// The image of evenly spread points of a sphere.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        directions(SILHOUETTE_POINTS).map(|point| point.component_mul(&self.semi_axes)).collect()
    }
}
