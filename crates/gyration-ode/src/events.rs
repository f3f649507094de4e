//! Crossings of zero by a function of the solution, within the last step.
//!
//!   find t ∈ (t₀, t₁] with φ(t, y(t), w(t)) = 0
//!
//! The interpolant is sampled on equal subintervals, the first change of sign in the direction wanted is closed in by
//! the ITP method: secant steps, kept near enough to the middle never to need more evaluations than bisection by more
//! than one. A crossing at the end of a step belongs to it and not to the next. Two crossings within one subinterval go
//! unseen: let samples be as fine as the function asks for. Source: Oliveira, Takahashi, *ACM Trans. Math. Softw.* 47
//! (2021).

use crate::integrator::Integrator;

/// Which crossings count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrossingDirection {
    /// From negative to zero or positive.
    Rising,
    /// From positive to zero or negative.
    Falling,
    /// Either.
    Either,
}

impl CrossingDirection {
    fn crossed(self, before: f64, after: f64) -> bool {
        let rising = before < 0.0 && after >= 0.0;
        let falling = before > 0.0 && after <= 0.0;
        match self {
            Self::Rising => rising,
            Self::Falling => falling,
            Self::Either => rising || falling,
        }
    }
}

/// The first time between two times of the last step at which φ(t, y, w) crosses zero, sampled on so many subintervals.
///
/// The time returned lies just past the crossing, within a few ulp. `None` if there is no change of sign, or no last
/// step.
pub fn find_crossing(
    integrator: &mut Integrator,
    (start, end): (f64, f64),
    mut function: impl FnMut(f64, &[f64], &[f64]) -> f64,
    direction: CrossingDirection,
    samples: usize,
) -> Option<f64> {
    integrator.last_step()?;
    let mut scratch = std::mem::take(&mut integrator.event_scratch);
    let dimension = integrator.state().len();
    let (y, w) = scratch.split_at_mut(dimension);
    let mut value = |t: f64| {
        integrator.interpolate(t, y, w);
        function(t, y, w)
    };
    let samples = samples.max(1);
    let mut left = (start, value(start));
    let mut crossing = None;
    for k in 1..=samples {
        let t = if k == samples { end } else { start + (end - start) * (k as f64 / samples as f64) };
        let right = (t, value(t));
        if direction.crossed(left.1, right.1) {
            crossing = Some(close_in(left, right, &mut value));
            break;
        }
        left = right;
    }
    integrator.event_scratch = scratch;
    crossing
}

/// Closes in on a change of sign between two points to a few ulp; returns the point past it.
fn close_in(mut left: (f64, f64), mut right: (f64, f64), value: &mut impl FnMut(f64) -> f64) -> f64 {
    let sign = if right.1 > left.1 { 1.0 } else { -1.0 };
    let length = right.0 - left.0;
    let epsilon = 2.0 * f64::EPSILON * left.0.abs().max(right.0.abs());
    let mut reach = epsilon * libm::exp2(libm::log2(length / (2.0 * epsilon)).ceil().max(0.0)) * 2.0;
    while right.0 - left.0 > 2.0 * epsilon {
        let (a, b) = (left.0, right.0);
        let middle = 0.5 * (a + b);
        let secant = (right.1 * a - left.1 * b) / (right.1 - left.1);
        let toward = (middle - secant).signum();
        // Truncated towards the middle, then projected to where bisection's bound still holds.
        let nudge = 0.2 * (b - a).powi(2) / length;
        let truncated = if nudge <= (middle - secant).abs() { secant + toward * nudge } else { middle };
        let radius = (reach - 0.5 * (b - a)).max(0.0);
        let wanted = if (truncated - middle).abs() <= radius { truncated } else { middle - toward * radius };
        // A step that has arrived looks once across the root, so that the other end follows.
        let t = wanted.clamp(a + epsilon, b - epsilon);
        let point = (t, value(t));
        if sign * point.1 >= 0.0 {
            right = point
        } else {
            left = point
        }
        reach *= 0.5;
    }
    right.0
}
