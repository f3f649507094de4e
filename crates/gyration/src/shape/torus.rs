//! The torus, (√(X²+Y²) − R)² + Z² ≤ r².
//!
//!   V = 2π²Rr²,   J = m diag(R²/2 + 3r²/8, R²/2 + 3r²/8, r²/4)

use std::f64::consts::{PI, TAU};

use super::error::{ShapeError, positive};
use super::feature::Feature;
use super::outline::{Outline, circle};
use super::triangulation::Triangulation;
use super::turned::{ProfileStretch, turned};
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// A torus with its centre at the origin and its axis along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// R, from the axis to the middle of the tube \[m\].
    pub major_radius: f64,
    /// r, of the tube \[m\]; r < R.
    pub minor_radius: f64,
}

impl Torus {
    /// Checks that the radii are finite and > 0 and that the torus has a hole.
    ///
    /// # Errors
    /// [`ShapeError::NotPositive`], [`ShapeError::TorusWithoutHole`].
    pub fn validate(&self) -> Result<(), ShapeError> {
        positive("torus", "major_radius", self.major_radius)?;
        positive("torus", "minor_radius", self.minor_radius)?;
        if self.minor_radius >= self.major_radius {
            return Err(ShapeError::TorusWithoutHole { major: self.major_radius, minor: self.minor_radius });
        }
        Ok(())
    }

    /// Mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let (major_squared, minor_squared) = (self.major_radius.powi(2), self.minor_radius.powi(2));
        let volume = 2.0 * PI * PI * self.major_radius * minor_squared;
        let mass = density * volume;
        let across = major_squared / 2.0 + 3.0 / 8.0 * minor_squared;
        let spread = Vec3::new(across, across, minor_squared / 4.0);
        MassProperties { mass, center: Vec3::zeros(), euler_tensor: Mat3::from_diagonal(&(spread * mass)), volume }
    }

    /// The support function h(n) = max X·n = R |n_xy| + r |n| \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.major_radius * direction.xy().norm() + self.minor_radius * direction.norm()
    }

    /// The surface.
    pub fn surface(&self) -> Surface {
        Surface::torus(self.major_radius, self.minor_radius)
    }

    /// The sharpest feature: a smooth point.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::SmoothPoint
    }

    /// The outermost, innermost, highest and lowest circles, and eight sections of the tube.
    pub fn outline(&self) -> Outline {
        let mut outline = Outline::default();
        let (major, minor) = (self.major_radius, self.minor_radius);
        for (radius, z) in [(major + minor, 0.0), (major - minor, 0.0), (major, minor), (major, -minor)] {
            outline.add_ellipse(Vec3::z() * z, Vec3::x() * radius, Vec3::y() * radius);
        }
        for outward in circle(8, 1.0, 0.0) {
            outline.add_ellipse(outward * major, outward * minor, Vec3::z() * minor);
        }
        outline
    }

    /// The tube, in about `count` triangles.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        let tube =
            ProfileStretch::Arc { center: [self.major_radius, 0.0], radius: self.minor_radius, angles: [0.0, TAU] };
        turned(&[tube], count)
    }

    /// The point of the surface over a point inside, on the ray from the middle of the tube.
    pub(super) fn push_out(&self, point: &Vec3) -> Vec3 {
        let middle = Vec3::new(point.x, point.y, 0.0).normalize() * self.major_radius;
        middle + (point - middle).normalize() * self.minor_radius
    }

    /// Points of the outer half of the tube: the inner half lies within their hull.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        const AROUND_TUBE: usize = 8;
        const AROUND_AXIS: usize = 44;
        let ring = |k: usize| {
            let (sine, cosine) = libm::sincos(TAU * (k as f64 / AROUND_TUBE as f64 - 0.5) * 0.5);
            circle(AROUND_AXIS, self.major_radius + self.minor_radius * cosine, self.minor_radius * sine)
        };
        (0..=AROUND_TUBE).flat_map(ring).collect()
    }
}
