//! The circular cylinder, X² + Y² ≤ r², |Z| ≤ h/2.
//!
//!   V = πr²h,   J = m diag(r²/4, r²/4, h²/12)

use std::f64::consts::PI;

use super::error::{ShapeError, positive};
use super::feature::Feature;
use super::outline::{Outline, SILHOUETTE_POINTS, circle};
use super::triangulation::Triangulation;
use super::turned::{ProfileStretch, turned};
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// A circular cylinder with its centre at the origin and its axis along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// r \[m\].
    pub radius: f64,
    /// h \[m\].
    pub height: f64,
}

impl Cylinder {
    /// Checks that radius and height are finite and > 0.
    ///
    /// # Errors
    /// [`ShapeError::NotPositive`] for the first one that is not.
    pub fn validate(&self) -> Result<(), ShapeError> {
        positive("cylinder", "radius", self.radius)?;
        positive("cylinder", "height", self.height)
    }

    /// Mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let (radius_squared, height) = (self.radius * self.radius, self.height);
        let volume = PI * radius_squared * height;
        let mass = density * volume;
        let spread = Vec3::new(radius_squared / 4.0, radius_squared / 4.0, height * height / 12.0);
        MassProperties { mass, center: Vec3::zeros(), euler_tensor: Mat3::from_diagonal(&(spread * mass)), volume }
    }

    /// The support function h(n) = max X·n = r |n_xy| + (h/2) |n_z| \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.radius * direction.xy().norm() + 0.5 * self.height * direction.z.abs()
    }

    /// The wall and the two ends.
    pub fn surface(&self) -> Surface {
        Surface::cylinder(self.radius, self.height)
    }

    /// The sharpest feature: the rim of an end.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::Rim
    }

    /// The two rims and eight rulings.
    pub fn outline(&self) -> Outline {
        let mut outline = Outline::default();
        let (x, y) = (Vec3::x() * self.radius, Vec3::y() * self.radius);
        let top = Vec3::z() * (0.5 * self.height);
        outline.add_ellipse(top, x, y);
        outline.add_ellipse(-top, x, y);
        for foot in circle(8, self.radius, 0.0) {
            outline.add_line([foot - top, foot + top]);
        }
        outline
    }

    /// The wall and the two ends, in about `count` triangles.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        let (radius, top) = (self.radius, 0.5 * self.height);
        let line = |from, to| ProfileStretch::Line { from, to };
        let bottom = line([0.0, -top], [radius, -top]);
        turned(&[bottom, line([radius, -top], [radius, top]), line([radius, top], [0.0, top])], count)
    }

    /// Points of the two rims.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        let rim = |z: f64| circle(SILHOUETTE_POINTS / 2, self.radius, z);
        rim(0.5 * self.height).chain(rim(-0.5 * self.height)).collect()
    }
}
