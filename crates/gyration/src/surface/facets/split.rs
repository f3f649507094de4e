//! Moments over a facet for any exponent, from moments of κ along two or three segments.
//!
//! With the corners sorted, d₀ ≤ d₁ ≤ d₂, the level line through the middle corner cuts the triangle in two, each with
//! an edge on which the gap is constant. With τ = (d₁ − d₀)/(d₂ − d₀), x the height and u uniform on [0, 1] along the
//! level,
//!
//!   lower part:  λ₁ = x (1 − u),        λ₂ = τ x u,                 d = d₀ + x (d₁ − d₀),  dA = 2 τ A x dx du
//!   upper part:  λ₁ = (1 − x)(1 − u),   λ₂ = x + τ (1 − x) u,       d = d₁ + x (d₂ − d₁),  dA = 2 (1 − τ) A (1 − x) dx du
//!
//! so that J_ab = ∫ λ₁^a λ₂^b κ dA are sums, all positive, of the moments of κ along a segment (`power`). Equal gaps
//! need no special case: τ is then any number in [0, 1].
//!
//! A parallelogram is cut by the level lines of its two middle corners. The lower part is that of the triangle, and the
//! same from the opposite corner the upper one, λ₁ = 1 − (1 − x)(1 − u), λ₂ = 1 − τ (1 − x) u with d = d₂ + x (d₃ −
//! d₂); between them
//!
//!   λ₁ = 1 − u,   λ₂ = (1 − τ) x + τ u,   d = d₁ + x (d₂ − d₁),   dA = (1 − τ) |E₁×E₂| dx du

use pulp::Simd;

use super::facet::{Facet, LevelSplit, Weights};
use crate::simd::{F64s, Log2, SplitExponent, integer_power};
use crate::surface::line::{End, HIGHEST_DEGREE, LineKernel, LineMoments, line_moments};
use crate::surface::{Kernel, MomentRequest};

/// A kernel prepared for the moments of one order over split facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SplitKernel {
    line: LineKernel,
    exponent: SplitExponent,
}

impl SplitKernel {
    /// Prepares any kernel.
    pub fn new(request: &MomentRequest) -> Self {
        let exponent = match request.kernel {
            Kernel::Power(exponent) => exponent,
            Kernel::Log => 1.0,
        };
        let line = LineKernel::up_to(request.kernel, request.order.min(3) + 1);
        Self { line, exponent: SplitExponent::new(exponent) }
    }

    /// Whether it reads the logarithms of the gaps.
    pub fn needs_logs(&self) -> bool {
        self.line.needs_log_in_registers()
    }

    /// The weights J_ab for a + b ≤ ORDER.
    #[inline(always)]
    pub fn weights<S: Simd, const ORDER: usize, const WHOLE: bool>(
        &self,
        facet: &Facet<S, WHOLE>,
        levels: &LevelSplit<S>,
        weights: &mut Weights<S>,
    ) {
        let (gaps, inverses, logs) = (&facet.gaps, &facet.inverses, &levels.logs);
        let mut ends = [self.end(gaps[0], inverses[0], logs[0]); 4];
        for k in 1..3 {
            ends[k] = self.end(gaps[k], inverses[k], logs[k]);
        }
        if WHOLE {
            ends[3] = self.end(facet.farthest.0, facet.farthest.1, logs[3]);
        }
        let mut moments = [[F64s::splat(facet.spanned.simd, 0.0); HIGHEST_DEGREE + 1]; 3];
        // A loop, since the formulas are long and the code of one pass of it is enough.
        for (part, moments) in moments.iter_mut().enumerate().take(if WHOLE { 3 } else { 2 }) {
            *moments = line_moments(&self.line, &ends[part], &ends[part + 1], ORDER + 1);
        }
        let [first, second, third] = &moments;
        let shares @ [tau, rest] = levels.shares;
        set_lower::<S, ORDER>(weights, first, facet.spanned * tau, tau);
        if WHOLE {
            add_between::<S, ORDER>(weights, second, facet.spanned * rest, shares);
            add_opposite::<S, ORDER>(weights, third, facet.spanned * tau, tau);
        } else {
            add_upper::<S, ORDER>(weights, second, facet.spanned * rest, tau);
        }
    }

    #[inline(always)]
    fn end<S: Simd>(&self, gap: F64s<S>, inverse: F64s<S>, log: Log2<S>) -> End<S> {
        let power = match self.line.integer {
            Some(exponent) => integer_power(gap, inverse, exponent),
            None => log.negative_power(&self.exponent),
        };
        End { gap, inverse, power, log }
    }
}

/// Lower part: J_ab = w τ^b E_ab m_(a+b+1), E_ab = ∫ (1 − u)^a u^b du = a! b!/(a + b + 1)!.
#[inline(always)]
fn set_lower<S: Simd, const ORDER: usize>(
    weights: &mut Weights<S>,
    m: &LineMoments<F64s<S>>,
    w: F64s<S>,
    tau: F64s<S>,
) {
    weights[0] = w * m[1];
    if ORDER >= 1 {
        let first = (w * m[2]) * 0.5;
        weights[1] = first;
        weights[2] = first * tau;
    }
    if ORDER >= 2 {
        let second = (w * m[3]) * (1.0 / 3.0);
        let mixed = second * tau;
        weights[3] = second;
        weights[4] = mixed * 0.5;
        weights[5] = mixed * tau;
    }
    if ORDER >= 3 {
        let third = (w * m[4]) * 0.25;
        let (once, twice) = (third * tau, third * tau * tau);
        weights[6] = third;
        weights[7] = once * (1.0 / 3.0);
        weights[8] = twice * (1.0 / 3.0);
        weights[9] = twice * tau;
    }
}

/// Part of a parallelogram between the levels of its middle corners: J_ab += w Σ_j (b over j) (1 − τ)^(b−j) τ^j E_aj
/// m_(b−j).
#[inline(always)]
fn add_between<S: Simd, const ORDER: usize>(
    weights: &mut Weights<S>,
    m: &LineMoments<F64s<S>>,
    w: F64s<S>,
    [tau, rest]: [F64s<S>; 2],
) {
    let zeroth = w * m[0];
    weights[0] += zeroth;
    if ORDER == 0 {
        return;
    }
    let (first, turned) = ((w * m[1]) * rest, zeroth * tau);
    weights[1] += zeroth * 0.5;
    weights[2] += first + turned * 0.5;
    if ORDER == 1 {
        return;
    }
    let (second, mixed, twice) = ((w * m[2]) * (rest * rest), first * tau, turned * tau);
    weights[3] += zeroth * (1.0 / 3.0);
    weights[4] += first * 0.5 + turned * (1.0 / 6.0);
    weights[5] += (second + mixed) + twice * (1.0 / 3.0);
    if ORDER == 2 {
        return;
    }
    let third = (w * m[3]) * ((rest * rest) * rest);
    weights[6] += zeroth * 0.25;
    weights[7] += first * (1.0 / 3.0) + turned * (1.0 / 12.0);
    weights[8] += (second * 0.5 + mixed * (1.0 / 3.0)) + twice * (1.0 / 12.0);
    weights[9] += (third + (second * tau) * 1.5) + (mixed * tau + (twice * tau) * 0.25);
}

/// Upper part of a parallelogram, the lower one from the opposite corner: with J′_ab = w τ^b E_ab ∫ (1 − x)^(a+b+1) κ
/// dx there, J_ab += Σ_ij (a over i) (b over j) (−1)^(i+j) J′_ij.
#[inline(always)]
fn add_opposite<S: Simd, const ORDER: usize>(
    weights: &mut Weights<S>,
    m: &LineMoments<F64s<S>>,
    w: F64s<S>,
    tau: F64s<S>,
) {
    // ∫ (1 − x)^k x^j κ dx from those with k − 1: the near end dominates, so that little cancels.
    let mut falling = *m;
    let mut own = [falling[0]; HIGHEST_DEGREE + 1];
    for (k, own) in own.iter_mut().enumerate().take(ORDER + 2).skip(1) {
        for j in 0..=ORDER + 1 - k {
            falling[j] = falling[j] - falling[j + 1];
        }
        *own = falling[0];
    }
    let mut j = *weights;
    set_lower::<S, ORDER>(&mut j, &own, w, tau);
    weights[0] += j[0];
    if ORDER == 0 {
        return;
    }
    weights[1] += j[0] - j[1];
    weights[2] += j[0] - j[2];
    if ORDER == 1 {
        return;
    }
    let (along, across) = (j[0] - j[1] * 2.0, j[0] - j[2] * 2.0);
    weights[3] += along + j[3];
    weights[4] += ((j[0] - j[1]) - j[2]) + j[4];
    weights[5] += across + j[5];
    if ORDER == 2 {
        return;
    }
    weights[6] += (j[0] - j[1] * 3.0) + (j[3] * 3.0 - j[6]);
    weights[7] += ((along + j[3]) - j[2]) + (j[4] * 2.0 - j[7]);
    weights[8] += ((across + j[5]) - j[1]) + (j[4] * 2.0 - j[8]);
    weights[9] += (j[0] - j[2] * 3.0) + (j[5] * 3.0 - j[9]);
}

/// Upper part: J_ab += w Σ_j (b over j) τ^j E_aj B(1 + a + j, b − j), B(i, j) = ∫ (1 − x)^i x^j κ dx.
#[inline(always)]
fn add_upper<S: Simd, const ORDER: usize>(
    weights: &mut Weights<S>,
    m: &LineMoments<F64s<S>>,
    w: F64s<S>,
    tau: F64s<S>,
) {
    // B(i, j) = B(i − 1, j) − B(i − 1, j + 1); the near end dominates B(i − 1, j), so that little cancels.
    let b1 = [w * (m[0] - m[1]), w * (m[1] - m[2]), w * (m[2] - m[3]), w * (m[3] - m[4])];
    weights[0] += b1[0];
    if ORDER == 0 {
        return;
    }
    let b2 = [b1[0] - b1[1], b1[1] - b1[2], b1[2] - b1[3]];
    let half = b2[0] * 0.5;
    weights[1] += half;
    weights[2] += b1[1] + tau * half;
    if ORDER == 1 {
        return;
    }
    let b3 = [b2[0] - b2[1], b2[1] - b2[2]];
    let (third, squared) = (b3[0] * (1.0 / 3.0), tau * tau);
    weights[3] += third;
    weights[4] += b2[1] * 0.5 + (tau * third) * 0.5;
    weights[5] += (b1[2] + tau * b2[1]) + squared * third;
    if ORDER == 2 {
        return;
    }
    let b4 = b3[0] - b3[1];
    let (quarter, twelfth) = (b4 * 0.25, b4 * (1.0 / 12.0));
    weights[6] += quarter;
    weights[7] += b3[1] * (1.0 / 3.0) + tau * twelfth;
    weights[8] += (b2[2] * 0.5 + (tau * b3[1]) * (1.0 / 3.0)) + squared * twelfth;
    weights[9] += (b1[3] + (tau * b2[2]) * 1.5) + (squared * b3[1] + (squared * tau) * quarter);
}
