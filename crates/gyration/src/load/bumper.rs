//! Bumpers: a push of short range between the centres of two bodies.
//!
//!   F = k r (1 − l/r)₊⁴ e,   e = d/l,   l = |d|,   with the potential k r²/5 (1 − l/r)₊⁵
//!
//! It is the simplest law that begins at a reach r, smoothly. No scene has it: bodies that come and go within reach of
//! one another are tested with it.

use super::SpringLoads;
use crate::tensor::{Mat3, Vec3};

/// A push between two centres that are closer than its reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bumper {
    /// k [N/m].
    pub stiffness: f64,
    /// r [m].
    pub reach: f64,
}

impl Bumper {
    /// How far within its reach a length l [m] is, as a part of it.
    fn depth(&self, length: f64) -> f64 {
        (1.0 - length / self.reach).max(0.0)
    }

    /// The stored energy [J] at a length l [m].
    pub fn energy(&self, length: f64) -> f64 {
        0.2 * self.stiffness * self.reach * self.reach * self.depth(length).powi(5)
    }

    /// Force and derivatives on a body that is d from the other, or `None` where the direction is lost.
    pub(super) fn loads(&self, along: Vec3) -> Option<SpringLoads> {
        let length = along.norm();
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let (e, depth) = (along / length, self.depth(length));
        let ee = e * e.transpose();
        let push = self.stiffness * self.reach * depth.powi(4);
        let slope = -4.0 * self.stiffness * depth.powi(3);
        let by_place = slope * ee + push / length * (Mat3::identity() - ee);
        let (by_velocity, dashpot_power) = (Mat3::zeros(), 0.0);
        Some(SpringLoads { force: push * e, by_place, by_velocity, dashpot_power, point: Vec3::zeros() })
    }
}
