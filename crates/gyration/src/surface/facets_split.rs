//! Moments over a triangle for any exponent, from moments of κ along two segments.
//!
//! With the corners sorted, d₀ ≤ d₁ ≤ d₂, the level line through the middle corner cuts the triangle in two, each with an
//! edge on which the gap is constant. With τ = (d₁ − d₀)/(d₂ − d₀), x the height and u uniform on [0, 1] along the level,
//!
//!   lower part:  λ₁ = x (1 − u),        λ₂ = τ x u,                 d = d₀ + x (d₁ − d₀),  dA = 2 τ A x dx du
//!   upper part:  λ₁ = (1 − x)(1 − u),   λ₂ = x + τ (1 − x) u,       d = d₁ + x (d₂ − d₁),  dA = 2 (1 − τ) A (1 − x) dx du
//!
//! so that J_ab = ∫ λ₁^a λ₂^b κ dA are sums, all positive, of the moments of κ along a segment (`power`). Equal gaps need no
//! special case: τ is then any number in [0, 1].

use super::facets_triangle::{Triangle, Weights};
use super::power::{GapSample, LineKernel, LineMoments};

/// The weights J_ab for a + b ≤ order, from the samples of the kernel at the vertices.
#[inline]
pub(super) fn split_weights(triangle: &Triangle, kernel: &LineKernel, samples: &[GapSample], order: usize) -> Weights {
    match order {
        0 => in_order::<0>(triangle, kernel, samples),
        1 => in_order::<1>(triangle, kernel, samples),
        2 => in_order::<2>(triangle, kernel, samples),
        _ => in_order::<3>(triangle, kernel, samples),
    }
}

/// `split_weights` with the order known to the compiler.
#[inline]
fn in_order<const ORDER: usize>(triangle: &Triangle, kernel: &LineKernel, samples: &[GapSample]) -> Weights {
    let [low, middle, high] = triangle.corners.map(|corner| &samples[corner.place]);
    let range = high.gap - low.gap;
    let parts =
        if range > 0.0 { [(middle.gap - low.gap) / range, (high.gap - middle.gap) / range] } else { [0.5, 0.5] };
    let mut weights = [0.0; 10];
    let lower = kernel.moments(low, middle, ORDER + 1);
    add_lower(&mut weights, &lower, triangle.twice_area * parts[0], parts[0], ORDER);
    let upper = kernel.moments(middle, high, ORDER + 1);
    add_upper(&mut weights, &upper, triangle.twice_area * parts[1], parts[0], ORDER);
    weights
}

/// Lower part: J_ab += w τ^b E_ab m_(a+b+1), E_ab = ∫ (1 − u)^a u^b du = a! b!/(a + b + 1)!.
#[inline(always)]
fn add_lower(weights: &mut Weights, m: &LineMoments, w: f64, tau: f64, order: usize) {
    weights[0] += w * m[1];
    if order >= 1 {
        let first = 0.5 * w * m[2];
        weights[1] += first;
        weights[2] += first * tau;
    }
    if order >= 2 {
        let second = w * m[3] / 6.0;
        weights[3] += 2.0 * second;
        weights[4] += second * tau;
        weights[5] += 2.0 * second * tau * tau;
    }
    if order >= 3 {
        let third = w * m[4] / 12.0;
        weights[6] += 3.0 * third;
        weights[7] += third * tau;
        weights[8] += third * tau * tau;
        weights[9] += 3.0 * third * tau * tau * tau;
    }
}

/// Upper part: J_ab += w Σ_j (b over j) τ^j E_aj B(1 + a + j, b − j), B(i, j) = ∫ (1 − x)^i x^j κ dx.
#[inline(always)]
fn add_upper(weights: &mut Weights, m: &LineMoments, w: f64, tau: f64, order: usize) {
    // B(i, j) = B(i − 1, j) − B(i − 1, j + 1); the near end dominates B(i − 1, j), so that little cancels.
    let b1: [f64; 4] = std::array::from_fn(|j| w * (m[j] - m[j + 1]));
    weights[0] += b1[0];
    if order == 0 {
        return;
    }
    let b2: [f64; 3] = std::array::from_fn(|j| b1[j] - b1[j + 1]);
    weights[1] += 0.5 * b2[0];
    weights[2] += b1[1] + 0.5 * tau * b2[0];
    if order == 1 {
        return;
    }
    let b3: [f64; 2] = std::array::from_fn(|j| b2[j] - b2[j + 1]);
    let squared = tau * tau;
    weights[3] += b3[0] / 3.0;
    weights[4] += 0.5 * b2[1] + tau * b3[0] / 6.0;
    weights[5] += b1[2] + tau * b2[1] + squared * b3[0] / 3.0;
    if order == 2 {
        return;
    }
    let b4 = b3[0] - b3[1];
    weights[6] += 0.25 * b4;
    weights[7] += b3[1] / 3.0 + tau * b4 / 12.0;
    weights[8] += 0.5 * b2[2] + tau * b3[1] / 3.0 + squared * b4 / 12.0;
    weights[9] += b1[3] + 1.5 * tau * b2[2] + squared * b3[1] + 0.25 * squared * tau * b4;
}
