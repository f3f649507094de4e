//! How the wrench on a rigid body changes with its motion.
//!
//! The increments are those of the place δp₀, the turn δθ (δR = R[δθ]×), the velocity δṗ₀ and the spin δΩ. With them
//!
//!   contact   δg₀ = n·δp₀,   δw₀ = δṗ₀
//!   spring    δx = δp₀ − R(X×δθ),   δẋ = δṗ₀ − R(X×δΩ + (Ω×X)×δθ),   δf = K δx + C δẋ,   δτ = X×(Rᵀδf + Rᵀf×δθ)
//!   pin       δp₀ = R(r×δθ),   δṗ₀ = R((Ω×r)×δθ + r×δΩ),   τ_p = τ − r×Rᵀ(f + m g)

use crate::contact::{ContactWrench, RigidMotion};
use crate::load::{Applied, SpringLoads, Wrench, WrenchSlope};
use crate::rates::RigidImmersion;
use crate::state::{BodyMotion, Turn};
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
        let along = motion.normal.transpose();
        let Wrench { force, torque } = &contact.by_height;
        self.wrench += contact.wrench;
        self.by_place += WrenchSlope { force: force * along, torque: torque * along };
        self.by_turn += contact.by_turn;
        self.by_velocity += contact.by_velocity;
        self.by_spin += contact.by_spin;
    }

    /// Adds a spring.
    pub fn add_spring(&mut self, spring: &SpringLoads, motion: &BodyMotion, spin: &Vec3) {
        let rotation = &motion.placement.gradient;
        let arm = cross_matrix(&spring.point);
        let (swing, sway) = (rotation * arm, rotation * cross_matrix(&spin.cross(&spring.point)));
        let lever = arm * rotation.transpose();
        let slope = |force: Mat3| WrenchSlope { force, torque: lever * force };
        self.wrench += spring.wrench(rotation);
        self.by_place += slope(spring.by_place);
        self.by_turn += slope(-(spring.by_place * swing + spring.by_velocity * sway));
        self.by_turn.torque += arm * cross_matrix(&rotation.tr_mul(&spring.force));
        self.by_velocity += slope(spring.by_velocity);
        self.by_spin += slope(-(spring.by_velocity * swing));
    }

    /// Adds what a controller applies.
    pub fn add_applied(&mut self, applied: &Applied, rotation: &Mat3) {
        self.wrench += applied.wrench(rotation);
        self.by_turn += applied.wrench_by_turn(rotation);
    }

    /// Adds the fluid.
    pub fn add_fluid(&mut self, immersed: &RigidImmersion) {
        let slopes = immersed.drag.slopes();
        self.wrench += immersed.wrench();
        self.by_place += slopes.by_place;
        self.by_turn += slopes.by_turn;
        self.by_turn += immersed.lift_by_turn();
        self.by_velocity += slopes.by_velocity;
        self.by_spin += slopes.by_spin;
    }

    /// Ties the place and the velocity to the turn and the spin about a pin at `arm` = r, and takes torques about it.
    ///
    /// `weight` is m g [N].
    pub fn tie_to_pin(&mut self, arm: &Vec3, weight: &Vec3, (motion, turn): (&BodyMotion, &Turn)) {
        let rotation = &motion.placement.gradient;
        let across = cross_matrix(arm);
        let (swing, sway) = (rotation * across, rotation * cross_matrix(&turn.spin.cross(arm)));
        self.by_turn += self.by_place.times(&swing);
        self.by_turn += self.by_velocity.times(&sway);
        self.by_spin += self.by_velocity.times(&swing);
        let force = rotation.tr_mul(&(self.wrench.force + weight));
        self.by_turn.torque -= across * (rotation.tr_mul(&self.by_turn.force) + cross_matrix(&force));
        self.by_spin.torque -= across * rotation.tr_mul(&self.by_spin.force);
    }
}
