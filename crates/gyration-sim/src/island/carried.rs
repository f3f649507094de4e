//! A body as seen from a support that turns, or has a shape: the support stands still there, however it is carried.
//!
//!   w = ṗ₀ − v(p₀),   W = Ṗ − [ω]× P,   ẅ = p̈₀ − a(p₀) − 2 ω × w   as the axes of the support see it
//!
//! v(x), a(x) velocity and acceleration of the point of the support at x. While p̈₀ is what it is, and the support
//! turns little,
//!
//!   |d³w/dt³| ≤ Ω (A + 3 |ẅ| + 4 Ω |w|),   Ω ≥ |ω|, A ≥ |a| of that point at any time
//!
//! so that over τ ≤ 1/Ω the acceleration counts as |ẅ| + ⅓ (A + 3 |ẅ| + 4 Ω |w|) at most, along whatever direction. A
//! body that the support carries has ẅ = 0 and w = 0. How translations shake the support is added as it may be at any
//! time.

use crate::island::step_end::StepEnd;
use gyration::kinematics::Velocity;
use gyration::solid_support::SolidSupport;
use gyration::state::BodyMotion;
use gyration::support::{Support, SupportMotion};
use gyration::tensor::{Mat3, Vec3, cross_matrix};

/// A body at the end of a step, as seen from a support.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeenFromSupport {
    /// The body; of a support that turns its acceleration counts in `bend`.
    pub body: StepEnd,
    /// How much more it may accelerate [m/s²].
    pub bend: f64,
    /// For how long that holds [s].
    pub longest: f64,
}

impl SeenFromSupport {
    /// The body and the support with a shape, which is at rest, at a time [s].
    pub fn of(support: &SolidSupport, time: f64, body: &StepEnd) -> (Self, StepEnd) {
        let at_rest = BodyMotion { placement: support.at(time).placement, velocity: Velocity::ZERO };
        let at_rest = StepEnd { motion: at_rest, acceleration: Vec3::zeros(), stretching: None };
        (Self::from(&support.motion, time, body), at_rest)
    }

    /// From a plane; none from one that does not turn.
    pub fn of_plane(support: &Support, time: f64, body: &StepEnd) -> Option<Self> {
        support.motion.turns().then(|| Self::from(&support.motion, time, body))
    }

    fn from(motion: &SupportMotion, time: f64, body: &StepEnd) -> Self {
        let (carried, place) = (motion.carriage(time), body.motion.placement.position);
        let own = &body.motion.velocity;
        let velocity = own.velocity - carried.velocity_at(&place);
        let gradient_rate = own.gradient_rate - cross_matrix(&carried.spin) * body.motion.placement.gradient;
        let seen = BodyMotion { velocity: Velocity { velocity, gradient_rate }, ..body.motion };
        let shaken = motion.translation_bound().acceleration;
        let bound = motion.bound(&carried.start_of(&place));
        if bound.spin == 0.0 {
            return Self { body: StepEnd { motion: seen, ..*body }, bend: shaken, longest: f64::INFINITY };
        }
        let turned = carried.turning_acceleration_at(&place) + 2.0 * carried.spin.cross(&velocity);
        let bent = (body.acceleration - turned).norm();
        let grown = (bound.acceleration + 3.0 * bent + 4.0 * bound.spin * velocity.norm()) / 3.0;
        // P̈ − 2 [ω]× W − [ω]×² P of a body that deforms, as large along all directions.
        let stretching = body.stretching.map(|stretching| {
            let rate = 2.0 * gradient_rate.norm() + bound.spin * body.motion.placement.gradient.norm();
            (stretching.norm() + bound.spin * rate) * Mat3::identity()
        });
        Self {
            body: StepEnd { motion: seen, acceleration: Vec3::zeros(), stretching },
            bend: shaken + bent + grown,
            longest: bound.spin.recip(),
        }
    }
}
