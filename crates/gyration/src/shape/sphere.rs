//! The ball, |X| ≤ R.
//!
//!   V = 4πR³/3,   J = (m R²/5) I

use super::ellipsoid::Ellipsoid;
use super::error::{ShapeError, positive};
use super::feature::Feature;
use super::outline::Outline;
use super::triangulation::Triangulation;
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::Vec3;

/// A sphere with its centre at the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// R \[m\].
    pub radius: f64,
}

impl Sphere {
    /// Checks that the radius is finite and > 0.
    ///
    /// # Errors
    /// [`ShapeError::NotPositive`] if it is not.
    pub fn validate(&self) -> Result<(), ShapeError> {
        positive("sphere", "radius", self.radius)
    }

    /// Mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        self.as_ellipsoid().mass_properties(density)
    }

    /// The support function h(n) = max X·n = R |n| \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.radius * direction.norm()
    }

    /// The surface.
    pub fn surface(&self) -> Surface {
        Surface::sphere(self.radius)
    }

    /// The sharpest feature: a smooth point.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::SmoothPoint
    }

    /// Three great circles.
    pub fn outline(&self) -> Outline {
        self.as_ellipsoid().outline()
    }

    /// A geodesic polyhedron of about `count` triangles.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        self.as_ellipsoid().triangulation(count)
    }

    /// Points spread evenly over the sphere.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        self.as_ellipsoid().silhouette_points()
    }

    /// The point of the surface over a point inside, on the ray from the centre.
    pub(super) fn push_out(&self, point: &Vec3) -> Vec3 {
        self.as_ellipsoid().push_out(point)
    }

    fn as_ellipsoid(&self) -> Ellipsoid {
        Ellipsoid { semi_axes: Vec3::repeat(self.radius) }
    }
}
