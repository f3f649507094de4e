//! A body as seen from a support with a shape: the support stands still there, however it is carried.
//!
//!   w = ṗ₀ − v_s − ω × (p₀ − p_s),   W = Ṗ − [ω]× P,   |ẅ| ≤ |p̈₀| + |p̈_s| + 2 |ω| |w| + |ω|² |p₀ − p_s|
//!
//! v_s, p_s, ω velocity, place and angular velocity of the support.

use crate::island::step_end::StepEnd;
use gyration::kinematics::Velocity;
use gyration::solid_support::SolidSupport;
use gyration::state::BodyMotion;
use gyration::tensor::{Vec3, cross_matrix};

/// A body and a support at the end of a step, as seen from the support.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeenFromSupport {
    /// The body.
    pub body: StepEnd,
    /// The support, at rest.
    pub support: StepEnd,
    /// How much more than the body in space it may accelerate [m/s²].
    pub bend: f64,
}

impl SeenFromSupport {
    /// At a time [s].
    pub fn of(support: &SolidSupport, time: f64, body: &StepEnd) -> Self {
        let carried = support.at(time);
        let spin = carried.angular_velocity();
        let BodyMotion { placement, velocity } = body.motion;
        let apart = placement.position - carried.placement.position;
        let seen = Velocity {
            velocity: velocity.velocity - carried.velocity.velocity - spin.cross(&apart),
            gradient_rate: velocity.gradient_rate - cross_matrix(&spin) * placement.gradient,
        };
        let rate = spin.norm();
        let bend = support.bound().acceleration + rate * (2.0 * seen.velocity.norm() + rate * apart.norm());
        let at_rest = BodyMotion { placement: carried.placement, velocity: Velocity::ZERO };
        Self {
            body: StepEnd { motion: BodyMotion { placement, velocity: seen }, ..*body },
            support: StepEnd { motion: at_rest, acceleration: Vec3::zeros(), stretching: None },
            bend,
        }
    }
}
