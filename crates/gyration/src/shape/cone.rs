//! The circular cone, base at Z = −h/2, apex at Z = h/2.
//!
//!   V = πr²h/3,   X₀ = (0, 0, −h/4),   J = m diag(3r²/20, 3r²/20, 3h²/80)
//!
//! The origin is the middle of the axis, not the centre of mass.

use std::f64::consts::PI;

use super::error::{ShapeError, positive};
use super::feature::Feature;
use super::outline::{Outline, SILHOUETTE_POINTS, circle};
use super::triangulation::Triangulation;
use super::turned::{ProfileStretch, turned};
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// A circular cone with its axis along z and its apex up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// r, the radius of the base \[m\].
    pub radius: f64,
    /// h \[m\].
    pub height: f64,
}

impl Cone {
    /// Checks that radius and height are finite and > 0.
    ///
    /// # Errors
    /// [`ShapeError::NotPositive`] for the first one that is not.
    pub fn validate(&self) -> Result<(), ShapeError> {
        positive("cone", "radius", self.radius)?;
        positive("cone", "height", self.height)
    }

    /// Mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let (radius_squared, height) = (self.radius * self.radius, self.height);
        let volume = PI * radius_squared * height / 3.0;
        let mass = density * volume;
        let across = 3.0 / 20.0 * radius_squared;
        let spread = Vec3::new(across, across, 3.0 / 80.0 * height * height);
        MassProperties {
            mass,
            center: Vec3::z() * (-0.25 * height),
            euler_tensor: Mat3::from_diagonal(&(spread * mass)),
            volume,
        }
    }

    /// The support function h(n) = max X·n = max(r |n_xy| − (h/2) n_z, (h/2) n_z) \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        let apex = 0.5 * self.height * direction.z;
        apex.max(self.radius * direction.xy().norm() - apex)
    }

    /// The wall and the base.
    pub fn surface(&self) -> Surface {
        Surface::cone(self.radius, self.height)
    }

    /// The sharpest feature: the apex.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::Apex
    }

    /// The rim of the base and eight rulings.
    pub fn outline(&self) -> Outline {
        let mut outline = Outline::default();
        let apex = Vec3::z() * (0.5 * self.height);
        outline.add_ellipse(-apex, Vec3::x() * self.radius, Vec3::y() * self.radius);
        for foot in circle(8, self.radius, -0.5 * self.height) {
            outline.add_line([foot, apex]);
        }
        outline
    }

    /// The wall and the base, in about `count` triangles.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        let (rim, apex) = ([self.radius, -0.5 * self.height], [0.0, 0.5 * self.height]);
        let base = ProfileStretch::Line { from: [0.0, rim[1]], to: rim };
        turned(&[base, ProfileStretch::Line { from: rim, to: apex }], count)
    }

    /// The apex and points of the rim.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        let rim = circle(SILHOUETTE_POINTS - 1, self.radius, -0.5 * self.height);
        rim.chain([Vec3::z() * (0.5 * self.height)]).collect()
    }
}
