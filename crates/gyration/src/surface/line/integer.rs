//! Moments of d^−ν along a register of segments for an integer ν, with one transcendental function at most.
//!
//! From the near end (gap c) to the far one (gap e), with y = x e/d, dy = c e/d² dx and θ = 1 − c/e,
//!
//!   m_k = ∫₀¹ x^k d^−ν dx = e^(−k−1) c^(k+1−ν) ∫₀¹ y^k (1 − θy)^(ν−2−k) dy,
//!
//! which is rational for k ≤ ν − 2; the next two are, by parts and by expansion in θ,
//!
//!   m_(ν−1) = e^−ν Φ_(ν−1),   m_ν = e^−ν (1 − ν (1 − θ) Φ_ν),
//!   Φ_j = ∫₀¹ y^j/(1 − θy) dy = Σ θ^n/(n + j + 1),   Φ_0 = ln(e/c)/θ,   Φ_(j−1) = 1/j + θ Φ_j.
//!
//! Lower moments follow from k c m_(k−1) = e^(1−ν) + (ν − 1 − k) δ m_k, δ = e − c, free of cancellation. Of Φ, with e/c
//! = 2^w μ, 1 ≤ μ < 2, s = (μ − 1)/(μ + 1) and artanh s = s + s³/3 + s⁵ B(s²): where w > 0, it comes from ln(e/c) = w
//! ln 2 + 2 artanh s, upwards from Φ_0 since θ ≥ ½; where w = 0, θ = 2s/(1 + s) and it comes downwards from
//!
//!   Φ_4 = (1 + s)/32 · (6 + 8s/3 + 2s²/3 + 2 (1 + s)⁴ B),   every term being positive.

use pulp::Simd;

use super::ends::{End, LineMoments, RECIPROCAL, zeros};
use crate::simd::{F64s, exponent_and_mantissa, polynomial};
use crate::surface::Kernel;
use std::f64::consts::LN_2;

/// The highest Φ for which there is a formula at w = 0.
const HIGHEST_TAIL: usize = 4;
/// The largest ν taken: the way down to the moments wanted grows with it.
const LARGEST: usize = 10;

/// B(q) = Σ q^n/(2n + 5) on [0, 1/9]: the polynomial of degree 10 of least error, which is 2e-18; the rounding of its
/// coefficients makes that 6e-17 of B.
const ARTANH_TAIL: [f64; 11] = [
    0.2,
    0.14285714285714063,
    0.11111111111190779,
    0.09090909079768987,
    0.07692308489349808,
    0.06666633498195017,
    0.05883209869336261,
    0.05249029539645652,
    0.04909942544161061,
    0.034048317141578056,
    0.07217111759405923,
];

/// ν, if the moments of this kernel up to the degree are found here.
pub(super) fn integer_exponent(kernel: Kernel, degree: usize) -> Option<usize> {
    let Kernel::Power(exponent) = kernel else { return None };
    let taken = exponent.fract() == 0.0 && (1.0..=LARGEST as f64).contains(&exponent);
    let integer = exponent.max(0.0) as usize;
    // A degree of ν − 1 needs Φ_(ν−1), one of ν Φ_ν.
    let known = degree + 2 <= integer || (degree <= integer && degree <= HIGHEST_TAIL);
    (taken && known).then_some(integer)
}

/// The moments m_0 … m_degree of d^−ν, ν being an exponent that [`integer_exponent`] takes for this degree.
#[inline(always)]
pub(super) fn integer_powers<S: Simd>(
    exponent: usize,
    near: &End<S>,
    far: &End<S>,
    degree: usize,
) -> LineMoments<F64s<S>> {
    let mut moments = zeros(near);
    let descent = Descent { exponent: exponent as f64, end: far.gap * far.power, difference: far.gap - near.gap, near };
    let mut known = degree;
    if degree + 2 <= exponent {
        let mut moment = descent.end * near.inverse * RECIPROCAL[exponent - 1];
        for k in (degree + 1..exponent - 1).rev() {
            moment = descent.down(k, moment);
        }
        moments[degree] = moment;
    } else {
        let theta = descent.difference * far.inverse;
        let tail = tail(near, far, theta, degree);
        if degree == exponent {
            let rest = near.gap * far.inverse * exponent as f64;
            moments[degree] = far.power * (1.0 - rest * tail);
            known = degree - 1;
            moments[known] = far.power * (theta * tail + RECIPROCAL[degree]);
        } else {
            moments[degree] = far.power * tail;
        }
    }
    for k in (1..=degree).rev() {
        if k <= known {
            moments[k - 1] = descent.down(k, moments[k]);
        }
    }
    moments
}

/// The way down from a moment to the next.
struct Descent<'a, S: Simd> {
    exponent: f64,
    /// e^(1−ν).
    end: F64s<S>,
    /// δ.
    difference: F64s<S>,
    near: &'a End<S>,
}

impl<S: Simd> Descent<'_, S> {
    /// m_(k−1) from m_k.
    #[inline(always)]
    fn down(&self, k: usize, moment: F64s<S>) -> F64s<S> {
        let weight = self.exponent - 1.0 - k as f64;
        (self.end + self.difference * moment * weight) * (self.near.inverse * RECIPROCAL[k])
    }
}

/// Φ_j of segments with this θ, j ≤ [`HIGHEST_TAIL`].
#[inline(always)]
fn tail<S: Simd>(near: &End<S>, far: &End<S>, theta: F64s<S>, j: usize) -> F64s<S> {
    let simd = theta.simd;
    let (zero, one) = (F64s::splat(simd, 0.0), F64s::splat(simd, 1.0));
    let ratio = far.gap * near.inverse;
    // Rounding must not put equal gaps below w = 0.
    let (binary, mantissa) = exponent_and_mantissa(ratio.less_than(one).select(one, ratio), 1.0);
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let squared = s * s;
    let b = polynomial(&ARTANH_TAIL, squared);
    if binary.smallest() > 0.0 {
        return tail_from_logarithm(theta, binary, s + s * squared * (squared * b + 1.0 / 3.0), j);
    }
    let close = tail_downwards(theta, s, b, j);
    if binary.largest() > 0.0 {
        let apart = tail_from_logarithm(theta, binary, s + s * squared * (squared * b + 1.0 / 3.0), j);
        return zero.less_than(binary).select(apart, close);
    }
    close
}

/// Φ_j upwards from Φ_0, given w (`binary`) and artanh s; θ is at least ½.
#[inline(always)]
fn tail_from_logarithm<S: Simd>(theta: F64s<S>, binary: F64s<S>, artanh: F64s<S>, j: usize) -> F64s<S> {
    let inverse = 1.0 / theta;
    let mut tail = (binary * LN_2 + (artanh + artanh)) * inverse;
    for reciprocal in &RECIPROCAL[1..=j] {
        tail = (tail - *reciprocal) * inverse;
    }
    tail
}

/// Φ_j downwards from Φ_4, given s and B; e/c is less than two.
#[inline(always)]
fn tail_downwards<S: Simd>(theta: F64s<S>, s: F64s<S>, b: F64s<S>, j: usize) -> F64s<S> {
    let grown = s + 1.0;
    let squared = grown * grown;
    let rational = s * (s * (2.0 / 3.0) + 8.0 / 3.0) + 6.0;
    let mut tail = grown * (1.0 / 32.0) * (rational + (squared * squared) * (b + b));
    for i in (j + 1..=HIGHEST_TAIL).rev() {
        tail = theta * tail + RECIPROCAL[i];
    }
    tail
}

#[cfg(test)]
mod tests {
    use super::super::ends::HIGHEST_DEGREE;
    use super::*;
    use crate::simd::{Log2, Row, WIDTH, dispatch, integer_power, registers_mut};
    use pulp::WithSimd;

    /// Moments of segments of these ratios e/c, c = 0.7.
    struct Segments {
        ratios: Row,
        exponent: usize,
        degree: usize,
    }

    const NEAR: f64 = 0.7;

    impl WithSimd for Segments {
        type Output = [Row; HIGHEST_DEGREE + 1];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let mut out = [[0.0; WIDTH]; HIGHEST_DEGREE + 1];
            let end = |gap: F64s<S>| {
                let inverse = 1.0 / gap;
                End { gap, inverse, power: integer_power(gap, inverse, self.exponent as i32), log: Log2::unread(simd) }
            };
            for register in 0..WIDTH / S::F64_LANES {
                let (near, far) = (F64s::splat(simd, NEAR), F64s::load(simd, &self.ratios, register) * NEAR);
                let moments = integer_powers(self.exponent, &end(near), &end(far), self.degree);
                for (row, moment) in out.iter_mut().zip(moments) {
                    registers_mut::<S>(row)[register] = moment.values;
                }
            }
            out
        }
    }

    /// m_k = e^−ν/(k + 1) Σ (ν)_n/(k + 2)_n θ^n, smallest terms first.
    fn series(ratio: f64, exponent: usize, k: usize) -> f64 {
        let (far, theta) = (NEAR * ratio, 1.0 - 1.0 / ratio);
        let mut terms = vec![1.0 / (k + 1) as f64];
        while terms[terms.len() - 1] > 1e-20 {
            let n = (terms.len() - 1) as f64;
            terms.push(terms[terms.len() - 1] * theta * (exponent as f64 + n) / ((k + 2) as f64 + n));
        }
        far.powi(-(exponent as i32)) * terms.iter().rev().sum::<f64>()
    }

    #[test]
    fn moments_of_integer_powers_are_those_of_the_series() {
        // Close and apart, alone and in one register; around e/c = 2, where the formulas meet.
        let ratios = [
            [1.0, 1.0 + 1e-13, 1.0 + 1e-7, 1.001, 1.1, 1.5, 1.9, 1.999],
            [2.0, 2.001, 2.5, 3.999, 4.0, 7.0, 30.0, 90.0],
            [1.0, 2.0, 1.9, 2.1, 1.01, 50.0, 1.7, 12.0],
        ];
        let mut worst: f64 = 0.0;
        for (exponent, degree) in
            (1..=LARGEST).flat_map(|exponent| (1..=HIGHEST_DEGREE).map(move |degree| (exponent, degree)))
        {
            if integer_exponent(Kernel::Power(exponent as f64), degree).is_none() {
                continue;
            }
            for ratios in ratios {
                let moments = dispatch(Segments { ratios, exponent, degree });
                for (lane, ratio) in ratios.into_iter().enumerate() {
                    for (k, moment) in moments.iter().enumerate().take(degree + 1) {
                        let error = (moment[lane] / series(ratio, exponent, k) - 1.0).abs();
                        worst = worst.max(error);
                        // Next to e/c = 2 the way up from Φ_0 loses some 200 ε at ν = 4, elsewhere a few dozen are
                        // seen.
                        assert!(error < 5e-14, "ν = {exponent}, degree {degree}, e/c = {ratio}, m_{k}: {error:e}");
                    }
                }
            }
        }
        println!("worst relative error {worst:.1e}");
    }
}
