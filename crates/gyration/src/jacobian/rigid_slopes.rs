//! How the wrench on a rigid body changes with its motion, in the body's own axes.
//!
//! The increments are those of the place Rᵀδp₀, the turn δθ (δR = R[δθ]×), the velocity Rᵀδṗ₀ and the spin δΩ. With them
//!
//!   contact   δg₀ = m·Rᵀδp₀,   δm = m×δθ,   δv = v×δθ + Rᵀδṗ₀
//!   spring    Rᵀδx = Rᵀδp₀ − X×δθ,   Rᵀδẋ = Rᵀδṗ₀ − X×δΩ − (Ω×X)×δθ,   δF = Rᵀ(K δx + C δẋ) + F×δθ,   δτ = X×δF
//!   pin       Rᵀδp₀ = r×δθ,   Rᵀδṗ₀ = (Ω×r)×δθ + r×δΩ,   τ_p = τ − r×(F + m Rᵀg)

use crate::contact::{ContactWrench, RigidMotion};
use crate::load::{SpringLoads, Wrench, WrenchSlope};
use crate::state::BodyMotion;
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// The wrench and its derivatives by the twelve increments.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RigidSlopes {
    pub wrench: Wrench,
    pub by_place: WrenchSlope,
    pub by_turn: WrenchSlope,
    pub by_velocity: WrenchSlope,
    pub by_spin: WrenchSlope,
}

impl RigidSlopes {
    /// Adds a contact.
    pub fn add_contact(&mut self, contact: &ContactWrench, motion: &RigidMotion) {
        let RigidMotion { normal, velocity, .. } = motion;
        self.wrench += contact.wrench;
        self.by_place += WrenchSlope {
            force: contact.by_height.force * normal.transpose(),
            torque: contact.by_height.torque * normal.transpose(),
        };
        self.by_turn += contact.by_normal.times(&cross_matrix(normal));
        self.by_turn += contact.by_velocity.times(&cross_matrix(velocity));
        self.by_velocity += contact.by_velocity;
        self.by_spin += contact.by_spin;
    }

    /// Adds a spring.
    pub fn add_spring(&mut self, spring: &SpringLoads, motion: &BodyMotion) {
        let rotation = &motion.placement.gradient;
        let (point, force) = (&spring.point, rotation.tr_mul(&spring.force));
        let stiffness = rotation.tr_mul(&spring.by_place) * rotation;
        let damping = rotation.tr_mul(&spring.by_velocity) * rotation;
        let arm = cross_matrix(point);
        let turning = damping * cross_matrix(&motion.spin.cross(point));
        let slope = |force: Mat3| WrenchSlope { force, torque: arm * force };
        self.wrench += spring.wrench(rotation);
        self.by_place += slope(stiffness);
        self.by_turn += slope(cross_matrix(&force) - stiffness * arm - turning);
        self.by_velocity += slope(damping);
        self.by_spin += slope(-damping * arm);
    }

    /// Ties the place and the velocity to the turn and the spin about a pin at `arm` = r, and takes torques about it.
    ///
    /// `weight` is m Rᵀg [N].
    pub fn tie_to_pin(&mut self, arm: &Vec3, weight: &Vec3, spin: &Vec3) {
        let across = cross_matrix(arm);
        self.by_turn += self.by_place.times(&across);
        self.by_turn += self.by_velocity.times(&cross_matrix(&spin.cross(arm)));
        self.by_spin += self.by_velocity.times(&across);
        self.by_turn.torque -= across * (self.by_turn.force + cross_matrix(weight));
        self.by_spin.torque -= across * self.by_spin.force;
    }
}
