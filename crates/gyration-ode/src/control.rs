//! The next step size, from the errors and sizes of the last two steps.
//!
//!   explicit, predictive:              h' = h · 0.9 ‖e‖^−⅛ · (h/h_old) (‖e_old‖/‖e‖)^⅛
//!   implicit, predictive (Gustafsson): h' = h · min( φ ‖e‖^−p, φ (h/h_old) (‖e_old‖/‖e‖²)^p )
//!
//! with p = 1/(s + 1) for s stages and φ = 0.9 (2m + 1)/(2m + n) for n of at most m Newton iterations, and not beyond a
//! size for which these have just failed. Both go on with the trend: towards a contact the steps that the error allows
//! shrink by a nearly constant factor from one to the next, and a law that looks at the last error only would be
//! rejected every other time. Both are bounded, and a step that follows a rejection does not grow. Leaving the domain
//! says nothing on accuracy and leaves the memory of errors alone. Source: Gustafsson, *ACM Trans. Math. Softw.* 20
//! (1994) 496; Hairer, Wanner II, §IV.2, IV.8; code radau5.f.

use crate::context::{Context, Point};
use crate::extended::Extended;
use crate::norm::norm;
use crate::radau::Radau;
use crate::report::{Cause, Stepper};
use crate::system::System;

/// Aim below the tolerance by this factor, so that few steps are rejected.
const SAFETY: f64 = 0.9;
/// One over the order of the explicit error estimate.
const EXPLICIT_EXPONENT: f64 = 1.0 / 8.0;
/// The factors by which an explicit step may change.
const EXPLICIT_FACTORS: (f64, f64) = (1.0 / 3.0, 6.0);
/// Errors below this are taken for it: a step all but free of error says little on the trend.
const EXPLICIT_LEAST: f64 = 1e-4;
/// Shrinking after leaving the domain: the boundary is somewhere within the attempt, the error says nothing of where.
const DOMAIN_FACTOR: f64 = 0.25;
/// Shrinking after Newton's method failed.
const NEWTON_FACTOR: f64 = 0.5;

/// The part of a step that Newton's method could not solve to which steps are held.
const HEED: f64 = 0.7;
/// For so many steps: a stiff body that turns would else be refused every other step, an impact is over sooner.
const HEEDED_STEPS: f64 = 16.0;

/// What the next step size depends on, besides the last step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct StepControl {
    /// The error of the last explicit step; 0 if there is none.
    pub explicit_error: f64,
    /// The size of the last explicit step.
    pub explicit_step: f64,
    /// The error of the last implicit step.
    pub implicit_error: f64,
    /// The size of the last implicit step; 0 if there is none.
    pub implicit_step: f64,
    /// The size of the last step for which Newton's method failed.
    pub refused: f64,
    /// For how many steps it is still heeded.
    pub heeded: f64,
}

/// An accepted step of the implicit stepper.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ImplicitStep {
    /// The error relative to the error allowed.
    pub error: f64,
    pub h: f64,
    /// Newton iterations it took.
    pub iterations: u32,
}

impl StepControl {
    /// The factor on the step after an attempt that was rejected.
    pub fn retreat<I>(stepper: Stepper, method: &Radau, cause: &Cause<I>) -> f64 {
        match (cause, stepper) {
            (Cause::Inadmissible(_) | Cause::NotFinite { .. }, _) => DOMAIN_FACTOR,
            (Cause::Newton, _) => NEWTON_FACTOR,
            (Cause::Error { norm, .. }, Stepper::Explicit) => {
                at_least(SAFETY * libm::pow(*norm, -EXPLICIT_EXPONENT), EXPLICIT_FACTORS.0)
            }
            (Cause::Error { norm, .. }, Stepper::Implicit) => {
                at_least(SAFETY * libm::pow(*norm, -1.0 / method.error_exponent()), 1.0 / 8.0)
            }
        }
    }

    /// The factor on the step after an accepted explicit one of size h.
    pub fn after_explicit(&mut self, error: f64, h: f64, rejected: bool) -> f64 {
        // The bound below keeps a step without any error from exploding the next one.
        let mut factor = SAFETY * libm::pow(error.max(1e-10), -EXPLICIT_EXPONENT);
        let error = error.max(EXPLICIT_LEAST);
        if self.explicit_error > 0.0 {
            factor *= libm::pow(self.explicit_error / error, EXPLICIT_EXPONENT) * h / self.explicit_step;
        }
        (self.explicit_error, self.explicit_step) = (error, h);
        let (least, most) = EXPLICIT_FACTORS;
        factor.clamp(least, if rejected { 1.0 } else { most })
    }

    /// Remembers the size of a step for which Newton's method failed.
    pub fn refuse(&mut self, h: f64) {
        (self.refused, self.heeded) = (h, HEEDED_STEPS);
    }

    /// The largest factor on a step of size h in view of the one that was refused: below that for some steps, then by
    /// doubling.
    fn heed(&mut self, h: f64) -> f64 {
        if self.heeded > 0.0 {
            self.heeded -= 1.0;
            return (HEED * self.refused / h).max(1.0);
        }
        if h > self.refused {
            self.refused = 0.0;
        }
        if self.refused > 0.0 { 1.0 / NEWTON_FACTOR } else { f64::INFINITY }
    }

    /// The factor on the step after an accepted implicit one.
    pub fn after_implicit(&mut self, method: &Radau, step: &ImplicitStep, rejected: bool) -> f64 {
        let (most, exponent) = (f64::from(method.most_iterations()), 1.0 / method.error_exponent());
        let ImplicitStep { error, h, iterations } = *step;
        let safety = SAFETY * (2.0 * most + 1.0) / (2.0 * most + f64::from(iterations));
        let error = error.max(1e-10);
        let mut factor = (safety * libm::pow(error, -exponent)).clamp(1.0 / 5.0, 8.0);
        if self.implicit_step > 0.0 {
            let trend = libm::pow(self.implicit_error / (error * error), exponent) * h / self.implicit_step;
            factor = factor.min((SAFETY * trend).clamp(1.0 / 5.0, 8.0));
        }
        (self.implicit_error, self.implicit_step) = (error.max(1e-2), h);
        factor = factor.min(self.heed(h));
        if rejected { factor.min(1.0) } else { factor }
    }
}

/// The larger of a value and a bound; the bound if the value is not a number.
fn at_least(value: f64, bound: f64) -> f64 {
    if value > bound { value } else { bound }
}

/// The size of the first attempt: small enough for an explicit Euler step to see little change in the rate.
///
///   h₀ = ‖u‖/(100 ‖u̇‖),   h₁ = (0.01 / max(‖u̇‖, ‖f(u + h₀ u̇) − u̇‖/h₀))^(1/8),   h = min(100 h₀, h₁, h_max)
///
/// Source: Hairer, Nørsett, Wanner I, §II.4. Where the Euler step leaves the domain, a shorter one is tried.
pub(crate) fn initial_step<S: System>(
    context: &mut Context<'_, S>,
    from: &Point,
    beside: &mut Point,
    max_step: f64,
) -> f64 {
    let layout = context.layout;
    let size = |vector: &[f64]| norm(layout, vector, &from.scale, &from.scale).value;
    let (state, speed) = (size(&from.u), size(&from.rate));
    let mut h = if state < 1e-5 || speed < 1e-5 { 1e-6 } else { 0.01 * state / speed };
    h = h.min(max_step);
    // 1e-6 ⋅ 8^−20 is below the resolution of any time worth the name.
    for _ in 0..20 {
        for ((value, start), slope) in beside.u.iter_mut().zip(&from.u).zip(&from.rate) {
            *value = start + h * slope;
        }
        let state = Extended { high: &beside.u, low: &from.low };
        if context.evaluate(from.t + h, state, &mut beside.rate).is_ok() {
            for (value, slope) in beside.rate.iter_mut().zip(&from.rate) {
                *value -= slope;
            }
            let curvature = size(&beside.rate) / h;
            let largest = speed.max(curvature);
            let wanted = if largest <= 1e-15 { (h * 1e-3).max(1e-6) } else { libm::pow(0.01 / largest, 1.0 / 8.0) };
            let chosen = wanted.min(100.0 * h).min(max_step);
            return if chosen > 0.0 { chosen } else { h };
        }
        h /= 8.0;
    }
    h
}
