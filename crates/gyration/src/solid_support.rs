//! Supports with a shape: solids that move as prescribed, whatever pushes at them.
//!
//!   p(X, t) = R(t) (p₀ + P X) + b(t)
//!
//! A body meets one as it meets another body; what the support would feel is taken by whoever moves it.

use crate::body::Solid;
use crate::kinematics::{BodyMotion, Placement, Velocity};
use crate::support::{MotionBound, SupportMotion};
use crate::tensor::cross_matrix;
use std::sync::Arc;

/// A solid that moves as prescribed.
#[derive(Debug, Clone)]
pub struct SolidSupport {
    /// Its name in the scene.
    pub name: String,
    /// Shape and surface; its mass is infinite.
    pub solid: Arc<Solid>,
    /// A length by which gaps are judged [m].
    pub size: f64,
    /// p₀ and P before any motion.
    pub start: Placement,
    /// How it moves.
    pub motion: SupportMotion,
}

impl SolidSupport {
    /// Where it is at a time [s], and how it moves.
    pub fn at(&self, time: f64) -> BodyMotion {
        if self.motion.is_fixed() {
            return BodyMotion { placement: self.start, velocity: Velocity::ZERO };
        }
        let carried = self.motion.carriage(time);
        let gradient = carried.rotation * self.start.gradient;
        let position = carried.place(&self.start.position);
        BodyMotion {
            placement: Placement { position, gradient },
            velocity: Velocity {
                velocity: carried.velocity_at(&position),
                gradient_rate: cross_matrix(&carried.spin) * gradient,
            },
        }
    }

    /// The same at rest where it is at a time [s].
    #[must_use]
    pub fn held_at(&self, time: f64) -> Self {
        Self { start: self.at(time).placement, motion: SupportMotion::default(), ..self.clone() }
    }

    /// Bounds on the motion of its centre.
    pub fn bound(&self) -> MotionBound {
        self.motion.bound(&self.start.position)
    }

    /// The largest speed of its points [m/s], or more.
    pub fn largest_speed(&self) -> f64 {
        let bound = self.bound();
        bound.speed + bound.spin * self.solid.radius().unwrap_or(0.0)
    }
}
