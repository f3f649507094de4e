//! Moments over a triangle for an integer exponent ν ≥ n + 3: a polynomial in the reciprocal gaps.
//!
//! With u_i = 1/d_i, a multi-index a of degree n and M = ν − n − 3 ≥ 0,
//!
//!   ∫ λ^a d^−ν dA = 2A a! (ν − n − 3)!/(ν − 1)! Π u_i^(a_i + 1) · h_M(u₀ [a₀ + 1 times], u₁ [a₁ + 1], u₂ [a₂ + 1])
//!
//! where h_M is the complete homogeneous symmetric polynomial (Carlson's R with its Euler transformation, DLMF 19.16
//! and 19.19). Adding a variable is h_k(…, u) = h_k(…) + u h_(k−1)(…, u). All terms are positive: no sorting, no
//! splitting, no cancellation, however the gaps compare. A parallelogram is two of them: the one at its lowest corner,
//! and the one of the three others.

use pulp::Simd;

use super::facet::{Facet, Weights};
use crate::simd::F64s;

/// The largest exponent taken: the cost grows with ν, and that of a split triangle does not.
const LARGEST: f64 = 24.0;

/// An integer exponent prepared for the moments of one order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct IntegerExponent {
    /// M = ν − n − 3.
    degree: usize,
    /// (ν − n − 3)!/(ν − 1)!.
    factor: f64,
}

/// The pairs of corners 00, 01, 02, 11, 12, 22.
const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// The triples 000, 001, 002, 011, 012, 022, 111, 112, 122, 222 as a pair and one more corner.
const TRIPLES: [(usize, usize); 10] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2), (3, 1), (3, 2), (4, 2), (5, 2)];

/// a! for the triples.
const TRIPLE_FACTORIALS: [f64; 10] = [6.0, 2.0, 2.0, 2.0, 1.0, 2.0, 6.0, 2.0, 2.0, 6.0];

impl IntegerExponent {
    /// Prepares ν for the order n ≤ 3; none if ν is no integer or is below n + 3.
    pub fn new(exponent: f64, order: usize) -> Option<Self> {
        let degree = exponent - (order + 3) as f64;
        if exponent.fract() != 0.0 || degree < 0.0 || exponent > LARGEST {
            return None;
        }
        let product: f64 = (1..=order + 2).map(|i| exponent - i as f64).product();
        Some(Self { degree: degree as usize, factor: 1.0 / product })
    }

    /// The weights J_ab of facets up to the order that this was prepared for.
    #[inline(always)]
    pub fn weights<S: Simd, const ORDER: usize, const WHOLE: bool>(
        &self,
        facet: &Facet<S, WHOLE>,
        weights: &mut Weights<S>,
    ) {
        let [low, middle, high] = facet.inverses;
        self.of_triangle::<S, ORDER>([low, middle, high], facet.spanned, weights);
        if WHOLE {
            let mut rest = *weights;
            self.of_triangle::<S, ORDER>([middle, facet.farthest.1, high], facet.spanned, &mut rest);
            add_rest::<S, ORDER>(weights, &rest);
        }
    }

    /// Those of a triangle with the reciprocal gaps u.
    #[inline(always)]
    fn of_triangle<S: Simd, const ORDER: usize>(&self, u: [F64s<S>; 3], spanned: F64s<S>, weights: &mut Weights<S>) {
        let h = Homogeneous::raised::<ORDER>(self.degree, &u);
        let scale = (spanned * self.factor) * ((u[0] * u[1]) * u[2]);
        match ORDER {
            0 => weights[0] = scale * h.base[2],
            1 => {
                let j = [scale * u[0] * h.one[0], scale * u[1] * h.one[1], scale * u[2] * h.one[2]];
                weights[..3].copy_from_slice(&[(j[0] + j[1]) + j[2], j[1], j[2]]);
            }
            2 => {
                let mut j = [scale; 6];
                for (i, j) in j.iter_mut().enumerate() {
                    let (p, q) = PAIRS[i];
                    let product = *j * u[p] * u[q] * h.two[i];
                    // The factorials a! double the squares.
                    *j = if p == q { product + product } else { product };
                }
                fill_second(weights, &j);
            }
            _ => third(weights, &u, &h.three, scale),
        }
    }
}

/// Adds the triangle of V₁, V₁ + E₂ and V₂ of a parallelogram, with μ₁ and μ₂ the coordinates of the last two: λ₁ = 1 −
/// μ₂, λ₂ = μ₁ + μ₂.
#[inline(always)]
fn add_rest<S: Simd, const ORDER: usize>(weights: &mut Weights<S>, j: &Weights<S>) {
    weights[0] += j[0];
    if ORDER == 0 {
        return;
    }
    let along = j[1] + j[2];
    weights[1] += j[0] - j[2];
    weights[2] += along;
    if ORDER == 1 {
        return;
    }
    let (mixed, squared) = (j[4] + j[5], (j[3] + j[4] * 2.0) + j[5]);
    weights[3] += (j[0] - j[2] * 2.0) + j[5];
    weights[4] += along - mixed;
    weights[5] += squared;
    if ORDER == 2 {
        return;
    }
    weights[6] += (j[0] - j[2] * 3.0) + (j[5] * 3.0 - j[9]);
    weights[7] += (along - mixed * 2.0) + (j[8] + j[9]);
    weights[8] += squared - ((j[7] + j[8] * 2.0) + j[9]);
    weights[9] += (j[6] + j[9]) + (j[7] + j[8]) * 3.0;
}

/// Up to the third order from h_M with three more corners.
#[inline(always)]
fn third<S: Simd>(weights: &mut Weights<S>, u: &[F64s<S>; 3], three: &[F64s<S>; 10], scale: F64s<S>) {
    let mut j = [scale; 10];
    for (i, j) in j.iter_mut().enumerate() {
        let (pair, r) = TRIPLES[i];
        let (p, q) = PAIRS[pair];
        *j = *j * TRIPLE_FACTORIALS[i] * u[p] * u[q] * u[r] * three[i];
    }
    // Summing over the third index lowers 000 … 222 to 00 … 22.
    let lower = [
        (j[0] + j[1]) + j[2],
        (j[1] + j[3]) + j[4],
        (j[2] + j[4]) + j[5],
        (j[3] + j[6]) + j[7],
        (j[4] + j[7]) + j[8],
        (j[5] + j[8]) + j[9],
    ];
    fill_second(weights, &lower);
    weights[6..].copy_from_slice(&j[6..]);
}

/// J_ab up to the second order from ∫ λ_p λ_q κ dA over the pairs.
#[inline(always)]
fn fill_second<S: Simd>(weights: &mut Weights<S>, j: &[F64s<S>; 6]) {
    let first = (j[1] + j[3]) + j[4];
    let second = (j[2] + j[4]) + j[5];
    let zeroth = ((j[0] + j[1]) + j[2]) + (first + second);
    weights[..6].copy_from_slice(&[zeroth, first, second, j[3], j[4], j[5]]);
}

/// h_k of the corners taken once: u₀; u₀ u₁; u₀ u₁ u₂, and with one, two and three more.
struct Homogeneous<S: Simd> {
    base: [F64s<S>; 3],
    one: [F64s<S>; 3],
    two: [F64s<S>; 6],
    three: [F64s<S>; 10],
}

impl<S: Simd> Homogeneous<S> {
    /// h_degree, with as many more corners as the order asks for.
    #[inline(always)]
    fn raised<const ORDER: usize>(degree: usize, u: &[F64s<S>; 3]) -> Self {
        let unit = F64s::splat(u[0].simd, 1.0);
        let mut h = Self { base: [unit; 3], one: [unit; 3], two: [unit; 6], three: [unit; 10] };
        for _ in 0..degree {
            h.raise::<ORDER>(u);
        }
        h
    }

    /// From k to k + 1.
    #[inline(always)]
    fn raise<const ORDER: usize>(&mut self, u: &[F64s<S>; 3]) {
        self.base[0] = self.base[0] * u[0];
        self.base[1] = self.base[0] + u[1] * self.base[1];
        self.base[2] = self.base[1] + u[2] * self.base[2];
        if ORDER >= 1 {
            for (one, u) in self.one.iter_mut().zip(u) {
                *one = self.base[2] + *u * *one;
            }
        }
        if ORDER >= 2 {
            for i in 0..6 {
                self.two[i] = self.one[PAIRS[i].0] + u[PAIRS[i].1] * self.two[i];
            }
        }
        if ORDER >= 3 {
            for i in 0..10 {
                self.three[i] = self.two[TRIPLES[i].0] + u[TRIPLES[i].1] * self.three[i];
            }
        }
    }
}
