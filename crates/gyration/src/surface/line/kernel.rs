//! Moments of a power of the gap along a segment: what every exact contact integral is made of.
//!
//! Along a straight segment the gap is affine, d(x) = c + δ x with x from 0 at the near end (gap c) to 1 at the far end
//! (gap e = c + δ ≥ c > 0). This module evaluates
//!
//!   m_k = ∫₀¹ x^k κ(c + δ x) dx,   k = 0 … 5,   κ = d^−ν or ln d,
//!
//! from the functions of the two ends alone. Integration by parts gives
//!
//!   (k + 1 − ν) δ m_k = e^(1−ν) − k c m_(k−1).
//!
//! When the gaps differ enough it runs upwards from m_0, with a separate formula at the one k where k + 1 − ν is small
//! (there the integral is a logarithm or nearly one). When they are close that would cancel: then the highest moment is
//! the hypergeometric series
//!
//!   m_k = e^−ν/(k + 1) Σ_n (ν)_n/(k + 2)_n θ^n,   θ = 1 − c/e        (DLMF 15.6.1, all terms positive for ν > 0)
//!
//! and the recurrence runs downwards, where it adds positive terms or subtracts a minor one. No power is evaluated
//! along the segment. The relative error is below 1e-12 (4e-12 for m_5) for −1 ≤ ν ≤ 17 and any ratio e/c.

use super::ends::{HIGHEST_DEGREE, LineMoments, RECIPROCAL, TERMS};
use super::integer::integer_exponent;
use crate::surface::Kernel;

/// Binomial coefficients (k over p).
pub(super) const BINOMIAL: [[f64; 6]; 6] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 2.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 3.0, 3.0, 1.0, 0.0, 0.0],
    [1.0, 4.0, 6.0, 4.0, 1.0, 0.0],
    [1.0, 5.0, 10.0, 10.0, 5.0, 1.0],
];

/// The sums of a series that run side by side.
pub(super) const SERIES_LANES: usize = 4;

/// The series of `TERMS` terms serves while θ (a + b max(ν, 0)) ≤ 1, with (a, b) for the degree 0 to 5.
///
/// Fits, on the safe side, to the θ at which the remainder reaches 2e-14 (1e-13 from degree 4 on).
const NEAR: [(f64, f64); HIGHEST_DEGREE + 1] =
    [(2.12, 0.195), (2.12, 0.195), (2.0, 0.175), (1.89, 0.165), (1.7, 0.15), (1.6, 0.137)];

/// The same for 8 and for 16 terms, from degree 1 on.
const NEARER: [(usize, f64, f64); 2] = [(8, 24.0, 12.0), (16, 4.75, 0.86)];

/// The recurrence divides by k + 1 − ν where that is larger than this; below, the logarithmic formula takes over.
const LOGARITHMIC: f64 = 0.25;

/// What the closed forms need of a point: its gap and the functions of it that are shared between segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapSample {
    /// The gap d [m], positive.
    pub gap: f64,
    /// d^−ν (d^−1 for the logarithmic kernel).
    pub power: f64,
    /// ln d, or 0 where [`LineKernel::needs_log`] says that it is not read.
    pub log: f64,
}

impl GapSample {
    /// A sample that fills unused places of a table.
    pub const UNIT: Self = Self { gap: 1.0, power: 1.0, log: 0.0 };
}

/// A kernel prepared for integration along segments, up to one degree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineKernel {
    pub(super) kernel: Kernel,
    /// ν of the power that is integrated; 1 for the logarithmic kernel.
    exponent: f64,
    /// ν as an integer, where it is a small one.
    pub(crate) integer: Option<i32>,
    /// ν, where the formulas of `integer` serve.
    pub(super) closed: Option<usize>,
    /// The highest degree of the power's moments: one above the wanted for the logarithmic kernel.
    degree: usize,
    /// k + 1 − ν and, except at `log_degree`, its reciprocal.
    pub(super) steps: [(f64, f64); HIGHEST_DEGREE + 1],
    /// The degree k at which k + 1 − ν is small.
    pub(super) log_degree: usize,
    /// 1/θ below which the numbers of terms in `NEARER`, then `TERMS`, are enough.
    pub(super) limits: [f64; 3],
    /// (ν)_n/(degree + 2)_n/(degree + 1).
    pub(super) series: [[f64; SERIES_LANES]; TERMS / SERIES_LANES],
}

impl LineKernel {
    /// What unused places of a table hold: the constant 1, degree 0.
    pub const UNIT: Self = Self {
        kernel: Kernel::Power(0.0),
        exponent: 0.0,
        integer: Some(0),
        closed: None,
        degree: 0,
        steps: [(1.0, 1.0); HIGHEST_DEGREE + 1],
        log_degree: usize::MAX,
        limits: [0.0; 3],
        series: [[0.0; SERIES_LANES]; TERMS / SERIES_LANES],
    };

    /// Prepares a kernel for moments of any degree; the exponent may be any real number from −1 to 17.
    pub fn new(kernel: Kernel) -> Self {
        Self::up_to(kernel, HIGHEST_DEGREE)
    }

    /// Prepares a kernel for moments up to `degree`, which makes them faster.
    ///
    /// Degrees above 5 (4 for the logarithmic kernel) are lowered to that.
    pub fn up_to(kernel: Kernel, degree: usize) -> Self {
        let (exponent, degree) = match kernel {
            Kernel::Power(exponent) => (exponent, degree.clamp(1, HIGHEST_DEGREE)),
            Kernel::Log => (1.0, (degree + 1).clamp(1, HIGHEST_DEGREE)),
        };
        let mut line = Self { kernel, exponent, integer: None, degree, ..Self::UNIT };
        if exponent.fract() == 0.0 && exponent.abs() <= 64.0 {
            line.integer = Some(exponent as i32);
        }
        line.closed = integer_exponent(kernel, degree);
        for (k, step) in line.steps.iter_mut().enumerate().take(degree + 1) {
            let value = (k + 1) as f64 - exponent;
            if value.abs() < LOGARITHMIC {
                line.log_degree = k;
            }
            *step = (value, 1.0 / value);
        }
        let growing = exponent.max(0.0);
        let limit = |a: f64, b: f64| a + b * growing;
        let [(_, a8, b8), (_, a16, b16)] = NEARER;
        line.limits = [limit(a8, b8), limit(a16, b16), limit(NEAR[degree].0, NEAR[degree].1)];
        let mut term = 1.0 / (degree + 1) as f64;
        for (n, coefficient) in line.series.as_flattened_mut().iter_mut().enumerate() {
            *coefficient = term;
            term *= (exponent + n as f64) * RECIPROCAL[degree + 2 + n];
        }
        line
    }

    /// Whether the logarithm of a gap is read.
    #[inline]
    pub fn needs_log(&self) -> bool {
        self.log_degree <= HIGHEST_DEGREE || self.kernel == Kernel::Log
    }

    /// Whether `segments` reads logarithms, or powers that are found from them.
    pub(crate) fn needs_log_in_registers(&self) -> bool {
        self.integer.is_none() || (self.needs_log() && self.closed.is_none())
    }

    /// The sample at the gap d > 0.
    #[inline]
    pub fn sample(&self, gap: f64) -> GapSample {
        let log = if self.needs_log() { libm::log(gap) } else { 0.0 };
        GapSample { gap, power: self.power(gap), log }
    }

    /// d^−ν.
    #[inline]
    fn power(&self, gap: f64) -> f64 {
        match self.integer {
            Some(exponent) => integer_power(gap, exponent),
            None => libm::pow(gap, -self.exponent),
        }
    }

    /// The moments m_0 … m_degree = ∫₀¹ x^k κ dx, with x = 0 at the near end.
    ///
    /// Requires near.gap ≤ far.gap, both samples of this kernel, and a degree that it is prepared for. The relative
    /// error, against ∫ x^k |κ| dx, is below 1e-12. Entries above the degree have no meaning.
    #[inline(always)]
    pub fn moments(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments<f64> {
        debug_assert!(near.gap <= far.gap && near.gap > 0.0 && degree <= self.degree);
        match self.kernel {
            Kernel::Power(_) => self.powers(near, far, degree),
            Kernel::Log => self.logarithms(near, far, degree),
        }
    }

    /// Moments of d^−ν, by the direction of the recurrence that is stable.
    #[inline(always)]
    fn powers(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments<f64> {
        if (far.gap - near.gap) * self.limits[2] > far.gap {
            self.upward(near, far, degree.min(self.degree))
        } else {
            // The usual case, in which the compiler knows the degree.
            if degree == self.degree { self.downward(near, far, degree) } else { self.downward(near, far, self.degree) }
        }
    }

    /// Moments of ln d: (k + 1) ∫ x^k ln d dx = ln e − δ ∫ x^(k+1)/d dx.
    fn logarithms(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments<f64> {
        let reciprocal = self.powers(near, far, degree + 1);
        let difference = far.gap - near.gap;
        let mut moments = [0.0; HIGHEST_DEGREE + 1];
        for k in 0..self.degree.min(degree + 1) {
            moments[k] = (far.log - difference * reciprocal[k + 1]) * RECIPROCAL[k + 1];
        }
        moments
    }

    /// From m_0 up: stable, because the near end dominates wherever k + 1 < ν.
    #[inline(always)]
    fn upward(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments<f64> {
        let inverse = 1.0 / (far.gap - near.gap);
        let end = far.gap * far.power;
        let mut moments = [0.0; HIGHEST_DEGREE + 1];
        // Stands for k m_(k−1), which at k = 0 is c^−ν.
        let mut previous = near.power;
        for (k, moment) in moments.iter_mut().enumerate().take(degree + 1) {
            let value = if k == self.log_degree {
                self.near_logarithm(near, far, k)
            } else {
                (end - near.gap * previous) * (inverse * self.steps[k].1)
            };
            *moment = value;
            previous = (k + 1) as f64 * value;
        }
        moments
    }

    /// The highest moment by its series, the others downwards: k c m_(k−1) = e^(1−ν) − (k + 1 − ν) δ m_k.
    #[inline(always)]
    fn downward(&self, near: &GapSample, far: &GapSample, degree: usize) -> LineMoments<f64> {
        let difference = far.gap - near.gap;
        let theta = difference / far.gap;
        let terms = if theta * self.limits[0] <= 1.0 {
            NEARER[0].0
        } else if theta * self.limits[1] <= 1.0 {
            NEARER[1].0
        } else {
            TERMS
        };
        let mut moments = [0.0; HIGHEST_DEGREE + 1];
        let mut value = far.power * sum_side_by_side(&self.series[..terms / SERIES_LANES], theta);
        moments[degree] = value;
        let end = far.gap * far.power;
        let inverse = 1.0 / near.gap;
        for k in (1..=degree).rev() {
            value = (end - self.steps[k].0 * difference * value) * (inverse * RECIPROCAL[k]);
            moments[k - 1] = value;
        }
        moments
    }

    /// m_k where s = k + 1 − ν is small, from the integrals L_p = ∫ d^(p−ν) dd of the powers that make up (d − c)^k.
    ///
    ///   m_k = δ^−(k+1) [ c^s ℓ φ(s ℓ) + Σ_(p<k) (k over p) (−c)^(k−p) L_p ],   ℓ = ln(e/c), φ(z) = (e^z − 1)/z
    #[inline]
    fn near_logarithm(&self, near: &GapSample, far: &GapSample, degree: usize) -> f64 {
        let (c, e) = (near.gap, far.gap);
        let (mut near_power, mut far_power) = (c * near.power, e * far.power);
        let inverse = 1.0 / (e - c);
        let (mut lower, mut scale) = (0.0, inverse);
        for (binomial, step) in BINOMIAL[degree].iter().zip(&self.steps).take(degree) {
            // Horner in −c: after the last pass the p-th term carries (−c)^(k−p).
            lower = -c * (lower + binomial * (far_power - near_power) * step.1);
            near_power *= c;
            far_power *= e;
            scale *= inverse;
        }
        let span = far.log - near.log;
        let exponent = self.steps[degree].0 * span;
        let growth = if exponent == 0.0 { 1.0 } else { libm::expm1(exponent) / exponent };
        (near_power * span * growth + lower) * scale
    }
}

/// Σ c_n θ^n, the coefficients row after row: one Horner scheme in θ⁴ for each lane.
#[inline]
fn sum_side_by_side(coefficients: &[[f64; SERIES_LANES]], theta: f64) -> f64 {
    let squared = theta * theta;
    let fourth = squared * squared;
    let mut sums = [0.0; SERIES_LANES];
    for row in coefficients.iter().rev() {
        for (sum, coefficient) in sums.iter_mut().zip(row) {
            *sum = *sum * fourth + coefficient;
        }
    }
    (sums[0] + theta * sums[1]) + squared * (sums[2] + theta * sums[3])
}

/// d^−n by repeated squaring.
#[inline]
fn integer_power(gap: f64, exponent: i32) -> f64 {
    let mut base = if exponent >= 0 { 1.0 / gap } else { gap };
    let mut remaining = exponent.unsigned_abs();
    let mut power = 1.0;
    while remaining > 0 {
        if remaining & 1 == 1 {
            power *= base;
        }
        base *= base;
        remaining >>= 1;
    }
    power
}
