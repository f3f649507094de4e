//! Moments of a kernel along as many segments as a register holds: the formulas of `kernel`, lane by lane.
//!
//! Lanes in which the gaps differ enough take the recurrence upwards, the others the series and the recurrence
//! downwards. Where both occur in one register both are computed, and each lane keeps its own: what a lane gets does
//! not depend on its neighbours.

use pulp::{Simd, WithSimd};

use super::ends::{End, LineMoments, RECIPROCAL, zeros};
use super::integer::integer_powers;
use super::kernel::{BINOMIAL, LineKernel, SERIES_LANES};
use crate::simd::{F64s, polynomial};
use crate::surface::Kernel;

/// Terms of φ(z) = Σ z^n/(n + 1)! for |z| ≤ 1: the next is below 1e-17.
const GROWTH_TERMS: usize = 18;

/// 1/(n + 1)!.
const GROWTH: [f64; GROWTH_TERMS] = {
    let mut series = [1.0; GROWTH_TERMS];
    let mut n = 1;
    while n < GROWTH_TERMS {
        series[n] = series[n - 1] / (n + 1) as f64;
        n += 1;
    }
    series
};

/// The moments m_0 … m_degree = ∫₀¹ x^k κ dx, with x = 0 at the near end, the gap of which is not the larger one.
///
/// `degree` is that for which the kernel was prepared, 1 to 4; it stands here so that the compiler knows it. A build
/// with optimizations writes the formulas out in every sweep, which saves 3 to 7 % of a cylinder's or capsule's
/// instructions; others compile them once for each degree, which saves a third of the time that this crate takes.
#[inline(always)]
pub(crate) fn line_moments<S: Simd>(
    line: &LineKernel,
    near: &End<S>,
    far: &End<S>,
    degree: usize,
) -> LineMoments<F64s<S>> {
    let simd = near.gap.simd;
    if !cfg!(debug_assertions) {
        return along(line, near, far, degree);
    }
    debug_assert!((1..=4).contains(&degree), "a degree of 1 to 4");
    match degree {
        1 => simd.vectorize(Along::<S, 1> { line, near, far }),
        2 => simd.vectorize(Along::<S, 2> { line, near, far }),
        3 => simd.vectorize(Along::<S, 3> { line, near, far }),
        _ => simd.vectorize(Along::<S, 4> { line, near, far }),
    }
}

#[inline(always)]
fn along<S: Simd>(line: &LineKernel, near: &End<S>, far: &End<S>, degree: usize) -> LineMoments<F64s<S>> {
    match line.kernel {
        Kernel::Power(_) => powers(line, near, far, degree),
        Kernel::Log => logarithms(line, near, far, degree),
    }
}

/// A register of segments, and the degree up to which their moments are wanted, as a function of its own.
struct Along<'a, S: Simd, const DEGREE: usize> {
    line: &'a LineKernel,
    near: &'a End<S>,
    far: &'a End<S>,
}

impl<S: Simd, const DEGREE: usize> WithSimd for Along<'_, S, DEGREE> {
    type Output = LineMoments<F64s<S>>;

    // The instruction set of what is called is that of the numbers.
    #[inline(always)]
    fn with_simd<T: Simd>(self, _simd: T) -> Self::Output {
        along(self.line, self.near, self.far, DEGREE)
    }
}

/// Moments of ln d: (k + 1) ∫ x^k ln d dx = ln e − δ ∫ x^(k+1)/d dx.
#[inline(always)]
fn logarithms<S: Simd>(line: &LineKernel, near: &End<S>, far: &End<S>, degree: usize) -> LineMoments<F64s<S>> {
    let reciprocal = powers(line, near, far, degree + 1);
    let (difference, log) = (far.gap - near.gap, far.log.natural());
    let mut moments = zeros(near);
    for (k, moment) in moments.iter_mut().enumerate().take(degree + 1) {
        *moment = (log - difference * reciprocal[k + 1]) * RECIPROCAL[k + 1];
    }
    moments
}

/// Moments of d^−ν.
#[inline(always)]
fn powers<S: Simd>(line: &LineKernel, near: &End<S>, far: &End<S>, degree: usize) -> LineMoments<F64s<S>> {
    if let Some(exponent) = line.closed {
        return integer_powers(exponent, near, far, degree);
    }
    let zero = F64s::splat(far.gap.simd, 0.0);
    let margin = (far.gap - near.gap) * line.limits[2] - far.gap;
    if margin.smallest() > 0.0 {
        return upward(line, near, far, degree);
    }
    let mut moments = downward(line, near, far, degree);
    if margin.largest() > 0.0 {
        let apart = zero.less_than(margin);
        let upward = upward(line, near, far, degree);
        for k in 0..=degree {
            moments[k] = apart.select(upward[k], moments[k]);
        }
    }
    moments
}

/// From m_0 up, with the logarithmic formula where k + 1 − ν is small.
#[inline(always)]
fn upward<S: Simd>(line: &LineKernel, near: &End<S>, far: &End<S>, degree: usize) -> LineMoments<F64s<S>> {
    let inverse = 1.0 / (far.gap - near.gap);
    let end = far.gap * far.power;
    let mut moments = zeros(near);
    let logarithmic = if line.log_degree <= degree { near_logarithm(line, near, far, inverse) } else { moments[0] };
    // Stands for k m_(k−1), which at k = 0 is c^−ν.
    let mut previous = near.power;
    for (k, moment) in moments.iter_mut().enumerate().take(degree + 1) {
        *moment =
            if k == line.log_degree { logarithmic } else { (end - near.gap * previous) * (inverse * line.steps[k].1) };
        previous = *moment * (k + 1) as f64;
    }
    moments
}

/// The highest moment by its series, the others downwards.
#[inline(always)]
fn downward<S: Simd>(line: &LineKernel, near: &End<S>, far: &End<S>, degree: usize) -> LineMoments<F64s<S>> {
    let difference = far.gap - near.gap;
    let mut moments = zeros(near);
    let mut value = far.power * series(&line.series, difference * far.inverse);
    moments[degree] = value;
    let end = far.gap * far.power;
    for k in (1..=degree).rev() {
        value = (end - difference * value * line.steps[k].0) * (near.inverse * RECIPROCAL[k]);
        moments[k - 1] = value;
    }
    moments
}

/// m_k at the one k where s = k + 1 − ν is small; see `LineKernel::near_logarithm`.
#[inline(always)]
fn near_logarithm<S: Simd>(line: &LineKernel, near: &End<S>, far: &End<S>, inverse: F64s<S>) -> F64s<S> {
    let degree = line.log_degree;
    let (mut near_power, mut far_power) = (near.gap * near.power, far.gap * far.power);
    let (mut lower, mut scale) = (F64s::splat(inverse.simd, 0.0), inverse);
    for (binomial, step) in BINOMIAL[degree % BINOMIAL.len()].iter().zip(&line.steps).take(degree) {
        lower = -near.gap * (lower + (far_power - near_power) * (binomial * step.1));
        near_power = near_power * near.gap;
        far_power = far_power * far.gap;
        scale = scale * inverse;
    }
    let span = near.log.natural_ratio_to(&far.log);
    let exponent = line.steps[degree % line.steps.len()].0;
    let leading = if exponent == 0.0 {
        near_power * span
    } else {
        let z = span * exponent;
        let small = z * z;
        let grown = (far_power - near_power) * (1.0 / exponent);
        F64s::splat(z.simd, 1.0).less_than(small).select(grown, near_power * span * polynomial(&GROWTH, z))
    };
    (leading + lower) * scale
}

/// Σ c_n θ^n, the coefficients row after row: one Horner scheme in θ⁴ for each column.
#[inline(always)]
fn series<S: Simd, const ROWS: usize>(coefficients: &[[f64; SERIES_LANES]; ROWS], theta: F64s<S>) -> F64s<S> {
    let squared = theta * theta;
    let fourth = squared * squared;
    let mut sums = [F64s::splat(theta.simd, 0.0); SERIES_LANES];
    for row in coefficients.iter().rev() {
        for (sum, coefficient) in sums.iter_mut().zip(row) {
            *sum = *sum * fourth + *coefficient;
        }
    }
    (sums[0] + theta * sums[1]) + squared * (sums[2] + theta * sums[3])
}
