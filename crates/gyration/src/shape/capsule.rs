//! The capsule: the points within r of the segment |Z| ≤ h/2; h is the height of the cylinder's part.
//!
//! With m_c = ρπr²h for the cylinder and m_s = 4ρπr³/3 for the two half balls, whose centroids stand 3r/8 beyond its
//! ends,
//!
//!   V = πr²h + 4πr³/3,   J_xx = J_yy = m_c r²/4 + m_s r²/5,
//!   J_zz = m_c h²/12 + m_s (r²/5 + 3hr/8 + h²/4)

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::error::{ShapeError, positive};
use super::feature::Feature;
use super::outline::{CIRCLE_POINTS, Outline, SILHOUETTE_POINTS, circle, directions};
use super::triangulation::Triangulation;
use super::turned::{ProfileStretch, turned};
use crate::mass::MassProperties;
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3};

/// A capsule with its centre at the origin and its axis along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    /// r, of the cylinder and of the half balls \[m\].
    pub radius: f64,
    /// h, the height of the cylinder's part; the capsule is h + 2r long \[m\].
    pub height: f64,
}

impl Capsule {
    /// Checks that radius and height are finite and > 0.
    ///
    /// # Errors
    /// [`ShapeError::NotPositive`] for the first one that is not.
    pub fn validate(&self) -> Result<(), ShapeError> {
        positive("capsule", "radius", self.radius)?;
        positive("capsule", "height", self.height)
    }

    /// Mass properties for a uniform density \[kg/m³\].
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let (r, h) = (self.radius, self.height);
        let (cylinder, ball) = (PI * r * r * h, 4.0 / 3.0 * PI * r * r * r);
        let across = cylinder * r * r / 4.0 + ball * r * r / 5.0;
        let along = cylinder * h * h / 12.0 + ball * (r * r / 5.0 + 3.0 / 8.0 * h * r + h * h / 4.0);
        MassProperties {
            mass: density * (cylinder + ball),
            center: Vec3::zeros(),
            euler_tensor: Mat3::from_diagonal(&(Vec3::new(across, across, along) * density)),
            volume: cylinder + ball,
        }
    }

    /// The support function h(n) = max X·n = r |n| + (h/2) |n_z| \[m\].
    pub fn extent(&self, direction: &Vec3) -> f64 {
        self.radius * direction.norm() + 0.5 * self.height * direction.z.abs()
    }

    /// The wall and the half spheres.
    pub fn surface(&self) -> Surface {
        Surface::capsule(self.radius, self.height)
    }

    /// The sharpest feature: a smooth point of an end.
    pub fn sharpest_feature(&self) -> Feature {
        Feature::SmoothPoint
    }

    /// The circles where the half balls begin, and two meridians.
    pub fn outline(&self) -> Outline {
        let mut outline = Outline::default();
        let (x, y, z) = (Vec3::x() * self.radius, Vec3::y() * self.radius, Vec3::z() * self.radius);
        let top = Vec3::z() * (0.5 * self.height);
        outline.add_ellipse(top, x, y);
        outline.add_ellipse(-top, x, y);
        for side in [x, y] {
            let half = |end: Vec3, up: Vec3, across: Vec3| {
                (0..=CIRCLE_POINTS / 2).map(move |k| {
                    let (sine, cosine) = libm::sincos(TAU * k as f64 / CIRCLE_POINTS as f64);
                    end + across * cosine + up * sine
                })
            };
            let around = half(top, z, side).chain(half(-top, -z, -side)).chain([top + side]);
            outline.add_line(around);
        }
        outline
    }

    /// The wall and the half spheres, in about `count` triangles.
    pub fn triangulation(&self, count: usize) -> Triangulation {
        let (radius, top) = (self.radius, 0.5 * self.height);
        let half = |z: f64, angles| ProfileStretch::Arc { center: [0.0, z], radius, angles };
        let wall = ProfileStretch::Line { from: [radius, -top], to: [radius, top] };
        turned(&[half(-top, [-FRAC_PI_2, 0.0]), wall, half(top, [0.0, FRAC_PI_2])], count)
    }

    /// The point of the surface over a point inside, on the ray from the nearest point of the axis.
    pub(super) fn push_out(&self, point: &Vec3) -> Vec3 {
        let half = 0.5 * self.height;
        let foot = Vec3::z() * point.z.clamp(-half, half);
        foot + (point - foot).normalize() * self.radius
    }

    /// Points of the half balls.
    pub fn silhouette_points(&self) -> Vec<Vec3> {
        let equators = [0.5, -0.5].into_iter().flat_map(|end| circle(50, self.radius, end * self.height));
        let shift = |point: Vec3| point * self.radius + Vec3::z() * (0.5 * self.height.copysign(point.z));
        directions(SILHOUETTE_POINTS - 100).map(shift).chain(equators).collect()
    }
}
