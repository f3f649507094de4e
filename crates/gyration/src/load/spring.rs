//! A spring and dashpot between a material point and a fixed anchor.
//!
//!   F = −[k (l − l₀) + c l̇] e,   e = (x − a)/l,   l = |x − a|,   l̇ = e·ẋ
//!
//! with potential ½k(l − l₀)² and dissipation c l̇². At l = 0 the direction e is lost: outside the model unless the
//! spring has neither rest length nor dashpot.

use super::Loads;
use crate::kinematics::{Placement, Velocity};
use crate::tensor::{Mat3, Vec3};

/// A spring with a dashpot in parallel, from a material point to a point fixed in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// The material point X (from the centre of mass) [m].
    pub point: Vec3,
    /// a, fixed in space [m].
    pub anchor: Vec3,
    /// k [N/m].
    pub stiffness: f64,
    /// l₀ [m].
    pub rest_length: f64,
    /// c [N s/m].
    pub damping: f64,
}

/// The force of a spring and what its derivatives need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringLoads {
    /// F [N].
    pub force: Vec3,
    /// ∂F/∂x [N/m].
    pub by_place: Mat3,
    /// ∂F/∂ẋ [N s/m].
    pub by_velocity: Mat3,
    /// −c l̇² [W].
    pub dashpot_power: f64,
    /// The material point X (from the centre of mass) [m].
    pub point: Vec3,
}

impl Spring {
    /// The current length l [m].
    pub fn length(&self, placement: &Placement) -> f64 {
        (placement.place(&self.point) - self.anchor).norm()
    }

    /// The stored energy ½k(l − l₀)² [J].
    pub fn energy(&self, placement: &Placement) -> f64 {
        0.5 * self.stiffness * (self.length(placement) - self.rest_length).powi(2)
    }

    /// Force and derivatives, or `None` where the direction is lost (l = 0 with l₀ > 0 or a dashpot).
    pub fn loads(&self, placement: &Placement, velocity: &Velocity) -> Option<SpringLoads> {
        let along = placement.place(&self.point) - self.anchor;
        let length = along.norm();
        if self.rest_length == 0.0 && self.damping == 0.0 {
            let by_place = Mat3::from_diagonal_element(-self.stiffness);
            return Some(self.assemble(-self.stiffness * along, by_place, Mat3::zeros(), 0.0));
        }
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let e = along / length;
        let speed = velocity.at(&self.point);
        let rate = e.dot(&speed);
        let tension = self.stiffness * (length - self.rest_length) + self.damping * rate;
        let ee = e * e.transpose();
        // ∂e/∂x = (I − e⊗e)/l, and l̇ = e·ẋ turns with e as well.
        let turn = (Mat3::identity() - ee) / length;
        let by_place = -self.stiffness * ee - self.damping * e * (turn * speed).transpose() - tension * turn;
        let dashpot = -self.damping * rate * rate;
        Some(self.assemble(-tension * e, by_place, -self.damping * ee, dashpot))
    }

    fn assemble(&self, force: Vec3, by_place: Mat3, by_velocity: Mat3, dashpot_power: f64) -> SpringLoads {
        SpringLoads { force, by_place, by_velocity, dashpot_power, point: self.point }
    }
}

impl SpringLoads {
    /// f and M.
    pub fn total(&self) -> Loads {
        Loads::at_point(self.force, &self.point)
    }
}
