//! Moments of a power of the gap along a segment: the kernel of every exact contact integral.
//!
//! Along a straight segment the gap is affine, d(x) = c + δ x with x from 0 at the near end (gap c) to 1 at the far end
//! (gap e = c + δ ≥ c > 0). This module evaluates
//!
//!   m_k = ∫₀¹ x^k κ(c + δ x) dx,   k = 0 … 5,   κ = d^−ν or ln d,
//!
//! from the ends alone when the gaps differ enough: integration by parts gives
//!
//!   (k + 1 − ν) δ m_k = e^(1−ν) − k c m_(k−1),
//!
//! with a separate formula at the one k where k + 1 − ν is small (there the integral is a logarithm or close to one).
//! When the gaps are close that subtraction cancels, and a Gauss rule whose error is below 1e-13 takes its place.
//! All m_k are positive sums or mild differences: their relative error stays below 1e-12 for −1 ≤ ν ≤ 17 and any ratio e/c.

mod rules;

use super::Kernel;
use rules::{EIGHT_POINTS, FOUR_POINTS, Rule, TWELVE_POINTS};

/// The highest degree of a moment along a segment.
pub const HIGHEST_DEGREE: usize = 5;

/// Moments m_0 … m_5 along a segment; those above the wanted degree are zero.
pub type LineMoments = [f64; HIGHEST_DEGREE + 1];

/// Binomial coefficients (k over p).
const BINOMIAL: [[f64; 6]; 6] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 2.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 3.0, 3.0, 1.0, 0.0, 0.0],
    [1.0, 4.0, 6.0, 4.0, 1.0, 0.0],
    [1.0, 5.0, 10.0, 10.0, 5.0, 1.0],
];

/// What the closed forms need of a point: its gap and the functions of it that are shared between segments.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GapSample {
    /// The gap d [m], positive.
    pub gap: f64,
    /// d^−ν (d^−1 for the logarithmic kernel).
    pub power: f64,
    /// ln d, or 0 where [`LineKernel::needs_log`] says that it is not read.
    pub log: f64,
}

/// A kernel prepared for integration along segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineKernel {
    kernel: Kernel,
    /// ν of the power that is integrated; 1 for the logarithmic kernel.
    exponent: f64,
    /// ν as an integer, where it is one.
    integer: Option<i32>,
    /// 1/(k + 1 − ν), not read at `log_degree`.
    reciprocal: LineMoments,
    /// The degree k with |k + 1 − ν| < ½, where the recurrence divides by almost nothing.
    log_degree: usize,
}

impl LineKernel {
    /// Prepares a kernel; the exponent may be any real number from −1 to 17.
    pub fn new(kernel: Kernel) -> Self {
        let exponent = match kernel {
            Kernel::Power(exponent) => exponent,
            Kernel::Log => 1.0,
        };
        let mut reciprocal = [0.0; HIGHEST_DEGREE + 1];
        let mut log_degree = usize::MAX;
        for (k, value) in reciprocal.iter_mut().enumerate() {
            let step = (k + 1) as f64 - exponent;
            *value = 1.0 / step;
            if step.abs() < 0.5 {
                log_degree = k;
            }
        }
        let whole = exponent.fract() == 0.0 && exponent.abs() <= 64.0;
        Self { kernel, exponent, integer: whole.then_some(exponent as i32), reciprocal, log_degree }
    }

    /// Whether [`GapSample::log`] is read.
    pub fn needs_log(&self) -> bool {
        self.log_degree <= HIGHEST_DEGREE || self.kernel == Kernel::Log
    }

    /// The sample at the gap d > 0.
    pub fn sample(&self, gap: f64) -> GapSample {
        let log = if self.needs_log() { gap.ln() } else { 0.0 };
        GapSample { gap, power: self.power(gap), log }
    }

    /// d^−ν.
    #[inline]
    fn power(&self, gap: f64) -> f64 {
        match self.integer {
            Some(exponent) => gap.powi(-exponent),
            None => gap.powf(-self.exponent),
        }
    }

    /// The moments m_0 … m_degree = ∫₀¹ x^k κ dx, with x = 0 at the near end.
    ///
    /// Requires near.gap ≤ far.gap and both samples of this kernel; degree ≤ 5 (≤ 4 for the logarithmic kernel).
    /// The relative error, against ∫ x^k |κ| dx, is below 1e-12.
    #[inline]
    pub fn moments(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments {
        debug_assert!(near.gap <= far.gap && near.gap > 0.0);
        match self.kernel {
            Kernel::Power(_) => self.power_moments(near, far, degree),
            Kernel::Log => self.log_moments(near, far, degree),
        }
    }

    /// Moments of ln d: (k + 1) ∫ x^k ln d dx = ln e − δ ∫ x^(k+1)/d dx.
    fn log_moments(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments {
        let reciprocal = self.power_moments(near, far, degree + 1);
        let difference = far.gap - near.gap;
        let mut moments = [0.0; HIGHEST_DEGREE + 1];
        for k in 0..=degree.min(HIGHEST_DEGREE - 1) {
            moments[k] = (far.log - difference * reciprocal[k + 1]) / (k + 1) as f64;
        }
        moments
    }

    /// Chooses by the ratio ρ = (e − c)/(e + c).
    ///
    /// The thresholds are fits, on the safe side, to the ratio at which the rule's relative error in m_5 reaches 1e-13.
    #[inline]
    fn power_moments(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments {
        let (sum, difference) = (far.gap + near.gap, far.gap - near.gap);
        let exponent = self.exponent.max(0.0);
        if difference * (1.65 + 0.27 * exponent) > sum {
            self.recurrence(near, far, degree)
        } else if difference * (3.9 + 1.08 * exponent) > sum {
            self.gauss(&TWELVE_POINTS, near.gap, difference, degree)
        } else if difference * (2200.0 * (1.0 + exponent)) > sum {
            self.gauss(&EIGHT_POINTS, near.gap, difference, degree)
        } else {
            self.gauss(&FOUR_POINTS, near.gap, difference, degree)
        }
    }

    /// The forward recurrence from m_0 up; stable because the near end dominates wherever k + 1 < ν.
    #[inline]
    fn recurrence(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments {
        let inverse = 1.0 / (far.gap - near.gap);
        let end = far.gap * far.power;
        let mut moments = [0.0; HIGHEST_DEGREE + 1];
        let mut previous = near.power;
        for k in 0..=degree.min(HIGHEST_DEGREE) {
            let weight = if k == 0 { 1.0 } else { k as f64 };
            moments[k] = if k == self.log_degree {
                self.near_logarithm(near, far, k)
            } else {
                (end - weight * near.gap * previous) * (inverse * self.reciprocal[k])
            };
            previous = moments[k];
        }
        moments
    }

    /// m_k where s = k + 1 − ν is small, from the integrals L_p = ∫ d^(p−ν) dd of the powers that make up (d − c)^k.
    ///
    ///   m_k = δ^−(k+1) [ c^s ℓ φ(s ℓ) + Σ_(p<k) (k over p) (−c)^(k−p) L_p ],   ℓ = ln(e/c), φ(z) = (e^z − 1)/z
    #[cold]
    fn near_logarithm(&self, near: &GapSample, far: &GapSample, degree: usize) -> f64 {
        let (c, e) = (near.gap, far.gap);
        let (mut near_power, mut far_power) = (c * near.power, e * far.power);
        let mut lower = 0.0;
        for p in 0..degree {
            // Horner in −c: after the last pass the p-th term carries (−c)^(k−p).
            lower = -c * (lower + BINOMIAL[degree][p] * (far_power - near_power) * self.reciprocal[p]);
            near_power *= c;
            far_power *= e;
        }
        let span = far.log - near.log;
        let step = ((degree + 1) as f64 - self.exponent) * span;
        let growth = if step == 0.0 { 1.0 } else { step.exp_m1() / step };
        let inverse = 1.0 / (e - c);
        (near_power * span * growth + lower) * inverse.powi(degree as i32 + 1)
    }

    /// The moments by a Gauss rule in x.
    #[inline]
    fn gauss<const N: usize>(&self, rule: &Rule<N>, gap: f64, difference: f64, degree: usize) -> LineMoments {
        let values: [f64; N] = std::array::from_fn(|i| self.power(gap + difference * rule.nodes[i]));
        let mut moments = [0.0; HIGHEST_DEGREE + 1];
        for (moment, weights) in moments.iter_mut().zip(&rule.weights).take(degree + 1) {
            *moment = weights.iter().zip(&values).map(|(weight, value)| weight * value).sum();
        }
        moments
    }
}
