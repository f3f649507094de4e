//! Springs and dashpots at material points: to a fixed anchor, or between two bodies.
//!
//!   F = −[k (l − l₀) + c l̇] e,   e = d/l,   l = |d|,   l̇ = e·ḋ
//!
//! on the point x, with d = x − a for an anchor a and d = x − y for a point y of another body, on which −F acts. The
//! potential is ½k(l − l₀)², the dissipation c l̇². At l = 0 the direction e is lost: outside the model unless the
//! spring has neither rest length nor dashpot.

use super::Loads;
use crate::kinematics::{Placement, Velocity};
use crate::tensor::{Mat3, Vec3};

/// A spring with a dashpot in parallel, whatever its ends are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringLaw {
    /// k [N/m].
    pub stiffness: f64,
    /// l₀ [m].
    pub rest_length: f64,
    /// c [N s/m].
    pub damping: f64,
}

/// A spring from a material point to a point fixed in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// The material point X (from the centre of mass) [m].
    pub point: Vec3,
    /// a, fixed in space [m].
    pub anchor: Vec3,
    /// What it does.
    pub law: SpringLaw,
}

/// The force of a spring on a material point and what its derivatives need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringLoads {
    /// F [N].
    pub force: Vec3,
    /// ∂F/∂d [N/m].
    pub by_place: Mat3,
    /// ∂F/∂ḋ [N s/m].
    pub by_velocity: Mat3,
    /// −c l̇² [W].
    pub dashpot_power: f64,
    /// The material point X (from the centre of mass) [m].
    pub point: Vec3,
}

impl SpringLaw {
    /// Whether it does anything.
    pub fn acts(&self) -> bool {
        self.stiffness > 0.0 || self.damping > 0.0
    }

    /// Whether it needs a direction, which is lost where it has no length.
    pub fn is_directed(&self) -> bool {
        self.rest_length > 0.0 || self.damping > 0.0
    }

    /// The stored energy ½k(l − l₀)² [J] at a length l [m].
    pub fn energy(&self, length: f64) -> f64 {
        0.5 * self.stiffness * (length - self.rest_length).powi(2)
    }

    /// Force and derivatives on a material point that is d from the other end and moves away with ḋ, or `None` where
    /// the direction is lost.
    pub(super) fn loads(&self, along: Vec3, speed: Vec3, point: Vec3) -> Option<SpringLoads> {
        if !self.is_directed() {
            let (force, by_place) = (-self.stiffness * along, Mat3::from_diagonal_element(-self.stiffness));
            return Some(SpringLoads { force, by_place, by_velocity: Mat3::zeros(), dashpot_power: 0.0, point });
        }
        let length = along.norm();
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let e = along / length;
        let rate = e.dot(&speed);
        let tension = self.stiffness * (length - self.rest_length) + self.damping * rate;
        let ee = e * e.transpose();
        // ∂e/∂d = (I − e⊗e)/l, and l̇ = e·ḋ turns with e as well.
        let turn = (Mat3::identity() - ee) / length;
        let by_place = -self.stiffness * ee - self.damping * e * (turn * speed).transpose() - tension * turn;
        let (by_velocity, dashpot_power) = (-self.damping * ee, -self.damping * rate * rate);
        Some(SpringLoads { force: -tension * e, by_place, by_velocity, dashpot_power, point })
    }
}

impl Spring {
    /// The current length l [m].
    pub fn length(&self, placement: &Placement) -> f64 {
        (placement.place(&self.point) - self.anchor).norm()
    }

    /// The stored energy [J].
    pub fn energy(&self, placement: &Placement) -> f64 {
        self.law.energy(self.length(placement))
    }

    /// Force and derivatives, or `None` where the direction is lost (l = 0 with l₀ > 0 or a dashpot).
    pub fn loads(&self, placement: &Placement, velocity: &Velocity) -> Option<SpringLoads> {
        self.law.loads(placement.place(&self.point) - self.anchor, velocity.at(&self.point), self.point)
    }
}

impl SpringLoads {
    /// f and M.
    pub fn total(&self) -> Loads {
        Loads::at_point(self.force, &self.point)
    }
}
