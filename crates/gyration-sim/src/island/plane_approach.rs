//! How long the gap of a body over a plane, or half of that between two, stays above zero by a bound on the motion.

use crate::island::step_end::StepEnd;
use gyration::contact::RelativeMotion;
use gyration::model::Model;
use gyration::support::{MotionPart, Support};
use gyration::surface::{GapField, Surface};
use gyration::tensor::Vec3;

/// The part of the time to contact that a step may take: what the bound leaves out is left to the error control.
pub(crate) const PART: f64 = 0.8;
/// The turn of a body over which its motion is taken for linear [rad].
pub(crate) const TURN: f64 = 1.0;
/// The time to contact is found to this fraction of itself.
const PRECISION: f64 = 0.05;

/// The motion of a body towards a plane that stands still or moves with constant velocity.
pub(crate) struct PlaneApproach<'a> {
    surface: &'a Surface,
    pub field: GapField,
    /// c₀ and c.
    rate: GapField,
    /// a [m/s²].
    pub acceleration: f64,
    /// Radius about the centre of mass [m].
    pub radius: f64,
    /// How fast it may grow [m/s].
    pub growth: f64,
    /// |Ω|, or the rate |Ṗ|/|P| at which the body changes its form [1/s].
    pub spin: f64,
}

/// How far a support is displaced by its constant velocities [m], and these [m/s].
fn drift(support: &Support, time: f64) -> (Vec3, Vec3) {
    let velocity = |part: &MotionPart| match part {
        MotionPart::Velocity(velocity) => *velocity,
        MotionPart::Oscillation { .. } | MotionPart::Rotation { .. } => Vec3::zeros(),
    };
    let velocity: Vec3 = support.motion.parts().iter().map(velocity).sum();
    (velocity * time, velocity)
}

impl<'a> PlaneApproach<'a> {
    pub fn of(model: &Model, index: usize, time: f64, end: &StepEnd, surface: &'a Surface, radius: f64) -> Self {
        let (support, motion) = (&model.supports[index], &end.motion);
        let mut field = support.gap_field(&motion.placement, time);
        if support.motion.turns() {
            // As seen from the support.
            let normal = support.at(time).normal;
            return Self::along(
                &normal,
                (end, &end.acceleration),
                (surface, radius),
                (field, motion.velocity.velocity),
            );
        }
        let mut velocity = RelativeMotion::to(support, motion, time).velocity;
        if support.motion.oscillates() {
            let (way, speed) = drift(support, time);
            field.height =
                (motion.placement.position - support.origin - way).dot(&support.normal) - support.forward_amplitude();
            velocity = motion.velocity.velocity - speed;
        }
        Self::along(&support.normal, (end, &end.acceleration), (surface, radius), (field, velocity))
    }

    /// Towards a plane with this normal, given the gaps, and velocity and acceleration of the centre relative to it.
    pub fn along(
        normal: &Vec3,
        (end, acceleration): (&StepEnd, &Vec3),
        (surface, radius): (&'a Surface, f64),
        (field, velocity): (GapField, Vec3),
    ) -> Self {
        let motion = &end.motion;
        let rate = GapField::new(normal.dot(&velocity), motion.velocity.gradient_rate.tr_mul(normal));
        let stretching = end.stretching.map_or(0.0, |stretching| stretching.tr_mul(normal).norm() * radius);
        let acceleration = (-acceleration.dot(normal)).max(0.0) + stretching;
        let gradient = &motion.placement.gradient;
        // No point is farther from the centre than |P| times its distance in the reference shape.
        let (radius, growth, spin) = match end.stretching {
            None => (radius, 0.0, motion.angular_velocity().norm()),
            Some(_) => {
                let (size, rate) = (gradient.norm(), motion.velocity.gradient_rate.norm());
                (radius * size, radius * rate, rate / size)
            }
        };
        Self { surface, field, rate, acceleration, radius, growth, spin }
    }

    /// The longest step [s] that this approach allows, at most `longest`.
    pub fn time(&self, longest: f64) -> f64 {
        let within = longest / PART;
        let clear = PART * first_root(within, |t| self.sphere_gap(t));
        if clear >= longest {
            return longest;
        }
        let straight = PART * first_root(within, |t| self.smallest_gap(t));
        clear.max(straight.min(TURN / self.spin)).min(longest)
    }

    /// A bound on the gap of the sphere around the body [m].
    fn sphere_gap(&self, t: f64) -> f64 {
        self.field.height + t * (self.rate.height - self.growth) - self.radius - 0.5 * self.acceleration * t * t
    }

    /// A bound on the gap of the body while it turns little [m].
    pub fn smallest_gap(&self, t: f64) -> f64 {
        let height = self.field.height + t * self.rate.height;
        let direction = self.field.direction + t * self.rate.direction;
        self.surface.smallest_gap(&GapField::new(height, direction)).0 - 0.5 * self.acceleration * t * t
    }
}

/// A time just before the root in (0, longest] of a concave function; `longest` if there is none, 0 if it starts below.
///
/// Binary fractions of a second alone are tried, so that a root within two longest times is the same number: how long a
/// run goes on must leave no trace in its steps.
pub(crate) fn first_root(longest: f64, function: impl Fn(f64) -> f64) -> f64 {
    if function(0.0) <= 0.0 {
        return 0.0;
    }
    if function(longest) > 0.0 {
        return longest;
    }
    let (mut left, mut right) = (0.0, power_of_two_above(longest));
    while right - left > PRECISION * right {
        let middle = 0.5 * (left + right);
        if middle < longest && function(middle) > 0.0 {
            left = middle
        } else {
            right = middle
        }
        if right < f64::MIN_POSITIVE {
            break;
        }
    }
    left
}

/// The next power of two that is not below a positive time.
fn power_of_two_above(time: f64) -> f64 {
    let (mantissa, exponent) = libm::frexp(time);
    libm::ldexp(1.0, if mantissa == 0.5 { exponent - 1 } else { exponent })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_root_is_approached_from_the_safe_side() {
        for root in [1e-6, 0.3, 0.9999] {
            let found = first_root(1.0, |t| root - t);
            assert!(found <= root && found >= root * (1.0 - 2.0 * PRECISION), "{found} for {root}");
        }
        assert_eq!(first_root(1.0, |t| 2.0 - t), 1.0);
        assert_eq!(first_root(1.0, |_| -1.0), 0.0);
    }

    #[test]
    fn a_root_does_not_depend_on_how_far_it_is_looked_for() {
        for longest in [0.31, 0.5, 0.7, 1.0, 3.0, 1e9] {
            assert_eq!(first_root(longest, |t| 0.3 - t), first_root(0.3, |t| 0.3 - t));
        }
    }
}
