//! Moments over a triangle for an integer exponent ν ≥ n + 3: a polynomial in the reciprocal gaps.
//!
//! With u_i = 1/d_i, a multi-index a of degree n and M = ν − n − 3 ≥ 0,
//!
//!   ∫ λ^a d^−ν dA = 2A a! (ν − n − 3)!/(ν − 1)! Π u_i^(a_i + 1) · h_M(u₀ [a₀ + 1 times], u₁ [a₁ + 1], u₂ [a₂ + 1])
//!
//! where h_M is the complete homogeneous symmetric polynomial (Carlson's R with its Euler transformation, DLMF 19.16
//! and 19.19). Adding a variable is h_k(…, u) = h_k(…) + u h_(k−1)(…, u). All terms are positive: no sorting, no
//! splitting, no cancellation, however the gaps compare.

use pulp::Simd;

use super::triangle::{Triangle, Weights};
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

    /// The weights J_ab of triangles up to the order that this was prepared for.
    #[inline(always)]
    pub fn weights<S: Simd, const ORDER: usize>(&self, triangle: &Triangle<S>, weights: &mut Weights<S>) {
        let u = triangle.inverses;
        let h = Homogeneous::raised::<ORDER>(self.degree, &u);
        let scale = (triangle.twice_area * self.factor) * ((u[0] * u[1]) * u[2]);
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
