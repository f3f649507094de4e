//! Plane supports, fixed or moving. A support sees a point and a time, never a law.
//!
//!   gap d = (p − o(t))·n(t),   o(t) = R o + b,   n(t) = R n,   w = ṗ − v(p),   v(x) = ḃ + ω × (x − b)

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
    /// n, unit normal before any motion.
    pub normal: Vec3,
    /// How it moves.
    pub motion: SupportMotion,
}

/// A plane at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneAt {
    /// A point of the plane, before it is displaced [m].
    pub origin: Vec3,
    /// Its displacement [m].
    pub shift: Vec3,
    /// n.
    pub normal: Vec3,
}

/// How a plane moves at a time: v(x) = velocity + spin × (x − center).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneMotion {
    /// The velocity of the centre [m/s].
    pub velocity: Vec3,
    /// ω [rad/s]; none of one that does not turn.
    pub spin: Option<Vec3>,
    /// The centre, a point of space [m].
    pub center: Vec3,
}

impl PlaneMotion {
    /// The velocity with which a place is carried along [m/s].
    #[inline]
    pub fn at(&self, place: &Vec3) -> Vec3 {
        match &self.spin {
            None => self.velocity,
            Some(spin) => self.velocity + spin.cross(&(place - self.center)),
        }
    }
}

impl PlaneAt {
    /// The gap (p − o)·n [m] of a point.
    #[inline]
    pub fn gap(&self, point: &Vec3) -> f64 {
        (point - self.origin - self.shift).dot(&self.normal)
    }
}

impl Support {
    /// The same at rest where it is at a time [s].
    #[must_use]
    pub fn held_at(&self, time: f64) -> Self {
        let PlaneAt { origin, shift, normal } = self.at(time);
        Self { origin: origin + shift, normal, motion: SupportMotion::default(), ..self.clone() }
    }

    /// How far one that moves to and fro comes forward from its origin along its normal [m].
    pub fn forward_amplitude(&self) -> f64 {
        let forward = |part: &MotionPart| match part {
            MotionPart::Oscillation { direction, amplitude, .. } => (amplitude * direction.dot(&self.normal)).abs(),
            MotionPart::Velocity(_) | MotionPart::Rotation { .. } => 0.0,
        };
        self.motion.parts().iter().map(forward).sum()
    }

    /// Where it is at a time [s].
    #[inline]
    pub fn at(&self, time: f64) -> PlaneAt {
        if self.motion.is_fixed() {
            return PlaneAt { origin: self.origin, shift: Vec3::zeros(), normal: self.normal };
        }
        if self.motion.turns() {
            let carried = self.motion.carriage(time);
            let (origin, normal) = (carried.place(&self.origin), carried.rotation * self.normal);
            return PlaneAt { origin, shift: Vec3::zeros(), normal };
        }
        PlaneAt { origin: self.origin, shift: self.motion.displacement(time), normal: self.normal }
    }

    /// How it moves at a time [s].
    #[inline]
    pub fn motion_at(&self, time: f64) -> PlaneMotion {
        if self.motion.is_fixed() {
            return PlaneMotion { velocity: Vec3::zeros(), spin: None, center: Vec3::zeros() };
        }
        if self.motion.turns() {
            let carried = self.motion.carriage(time);
            return PlaneMotion { velocity: carried.velocity, spin: Some(carried.spin), center: carried.shift };
        }
        PlaneMotion { velocity: self.motion.velocity(time), spin: None, center: Vec3::zeros() }
    }

    /// The gap of a body as a function of the material point, d(X) = (p₀ − o)·n + (Pᵀn)·X.
    #[inline]
    pub fn gap_field(&self, placement: &Placement, time: f64) -> GapField {
        let plane = self.at(time);
        GapField::new(plane.gap(&placement.position), placement.gradient.tr_mul(&plane.normal))
    }

    /// The gap (p − o)·n [m] of a point.
    #[inline]
    pub fn gap(&self, point: &Vec3, time: f64) -> f64 {
        self.at(time).gap(point)
    }
}
