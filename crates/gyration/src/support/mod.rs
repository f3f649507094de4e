//! Plane supports, fixed or moving. A support sees a point and a time, never a law.
//!
//!   gap d = (p − o(t))·n,   o(t) = o + displacement(t),   w = ṗ − ȯ(t)

mod motion;

pub use motion::{Carriage, MotionBound, MotionPart, SupportMotion};

use crate::kinematics::Placement;
use crate::surface::GapField;
use crate::tensor::Vec3;

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

impl Support {
    /// The same at rest where it is at a time [s].
    #[must_use]
    pub fn held_at(&self, time: f64) -> Self {
        let origin = self.origin + self.motion.displacement(time);
        Self { origin, motion: SupportMotion::default(), ..self.clone() }
    }

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
