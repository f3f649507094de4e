//! A body as seen from a support that turns, or has a shape: the support stands still there, however it is carried.
//!
//!   w = ṗ₀ − v_s − ω × (p₀ − p_s),   W = Ṗ − [ω]× P,   |ẅ| ≤ |p̈₀| + |p̈_s| + 2 |ω| |w| + |ω|² |p₀ − p_s|
//!
//! v_s, p_s, ω velocity, place and angular velocity of the support.

use crate::island::step_end::StepEnd;
use gyration::kinematics::Velocity;
use gyration::solid_support::SolidSupport;
use gyration::state::BodyMotion;
use gyration::support::{PlaneMotion, Support};
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
        let center = (&carried.placement.position, &carried.velocity.velocity);
        let (motion, bend) = seen(&body.motion, center, &carried.angular_velocity());
        let at_rest = BodyMotion { placement: carried.placement, velocity: Velocity::ZERO };
        Self {
            body: StepEnd { motion, ..*body },
            support: StepEnd { motion: at_rest, acceleration: Vec3::zeros(), stretching: None },
            bend: support.bound().acceleration + bend,
        }
    }

    /// From a plane; none from one that does not turn.
    pub fn of_plane(support: &Support, time: f64, body: &StepEnd) -> Option<Self> {
        let PlaneMotion { velocity, spin, center } = support.motion_at(time);
        let (motion, bend) = seen(&body.motion, (&center, &velocity), &spin?);
        // The centre is where the origin of space is carried to.
        let carried = support.motion.bound(&Vec3::zeros()).acceleration;
        let at_rest = BodyMotion { velocity: Velocity::ZERO, ..body.motion };
        Some(Self {
            body: StepEnd { motion, ..*body },
            support: StepEnd { motion: at_rest, acceleration: Vec3::zeros(), stretching: None },
            bend: carried + bend,
        })
    }
}

/// A motion as seen from what has a centre there (place, velocity) and turns at an angular velocity [rad/s], and by how
/// much more it may accelerate for that [m/s²].
fn seen(motion: &BodyMotion, (center, velocity): (&Vec3, &Vec3), spin: &Vec3) -> (BodyMotion, f64) {
    let BodyMotion { placement, velocity: own } = motion;
    let apart = placement.position - center;
    let seen = Velocity {
        velocity: own.velocity - velocity - spin.cross(&apart),
        gradient_rate: own.gradient_rate - cross_matrix(spin) * placement.gradient,
    };
    let rate = spin.norm();
    let bend = rate * (2.0 * seen.velocity.norm() + rate * apart.norm());
    (BodyMotion { placement: *placement, velocity: seen }, bend)
}
