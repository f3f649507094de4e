//! Plane supports, fixed or moving. A support sees a point and a time, never a law.
//!
//!   gap d = (p − o(t))·n,   o(t) = o + displacement(t),   w = ṗ − ȯ(t)

use crate::kinematics::Placement;
use crate::surface::GapField;
use crate::tensor::Vec3;
use std::f64::consts::TAU;

/// A plane with a unit normal that points to the free side.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Its name in the scene.
    pub name: String,
    /// o, a point of the plane before any motion [m].
    pub origin: Vec3,
    /// n, unit normal.
    pub normal: Vec3,
    /// How it moves.
    pub motion: SupportMotion,
}

/// A prescribed translation of a support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SupportMotion {
    /// At rest.
    Fixed,
    /// Constant velocity [m/s].
    Velocity(Vec3),
    /// Displacement = direction · amplitude · sin(2πft + phase).
    Oscillation {
        /// Unit direction.
        direction: Vec3,
        /// Amplitude [m].
        amplitude: f64,
        /// f [Hz].
        frequency: f64,
        /// Phase [rad].
        phase: f64,
    },
}

impl SupportMotion {
    /// The displacement [m] from the given origin at time t.
    pub fn displacement(&self, time: f64) -> Vec3 {
        match self {
            Self::Fixed => Vec3::zeros(),
            Self::Velocity(velocity) => velocity * time,
            Self::Oscillation { direction, amplitude, frequency, phase } => {
                direction * (amplitude * libm::sin(TAU * frequency * time + phase))
            }
        }
    }

    /// The velocity [m/s] at time t.
    pub fn velocity(&self, time: f64) -> Vec3 {
        match self {
            Self::Fixed => Vec3::zeros(),
            Self::Velocity(velocity) => *velocity,
            Self::Oscillation { direction, amplitude, frequency, phase } => {
                let omega = TAU * frequency;
                direction * (amplitude * omega * libm::cos(omega * time + phase))
            }
        }
    }
}

impl Support {
    /// The gap of a body as a function of the material point, d(X) = (p₀ − o(t))·n + (Pᵀn)·X.
    #[inline]
    pub fn gap_field(&self, placement: &Placement, time: f64) -> GapField {
        GapField::new(self.gap(&placement.position, time), placement.gradient.tr_mul(&self.normal))
    }

    /// The gap (p − o(t))·n [m] of a point.
    #[inline]
    pub fn gap(&self, point: &Vec3, time: f64) -> f64 {
        (point - self.origin - self.motion.displacement(time)).dot(&self.normal)
    }
}
