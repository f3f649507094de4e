//! Moments over a triangle for a whole exponent ν ≥ n + 3: a polynomial in the reciprocal gaps.
//!
//! With u_i = 1/d_i, a multi-index a of degree n and M = ν − n − 3 ≥ 0,
//!
//!   ∫ λ^a d^−ν dA = 2A a! (ν − n − 3)!/(ν − 1)! Π u_i^(a_i + 1) · h_M(u₀ [a₀ + 1 times], u₁ [a₁ + 1], u₂ [a₂ + 1])
//!
//! where h_M is the complete homogeneous symmetric polynomial (Carlson's R with its Euler transformation, DLMF 19.16 and 19.19).
//! Adding a variable is h_k(…, u) = h_k(…) + u h_(k−1)(…, u). All terms are positive: no sorting, no splitting, no
//! cancellation, however the gaps compare.

use super::facets_triangle::{Triangle, Weights};

/// The largest exponent taken: the cost grows with ν, and that of a split triangle does not.
const LARGEST: f64 = 24.0;

/// A whole exponent prepared for the moments of one order.
#[derive(Debug, Clone, Copy)]
pub(super) struct WholeExponent {
    /// n.
    order: usize,
    /// M = ν − n − 3.
    degree: usize,
    /// (ν − n − 3)!/(ν − 1)!.
    factor: f64,
}

impl WholeExponent {
    /// Prepares ν for the order n ≤ 3; none if ν is not whole or is below n + 3.
    pub fn new(exponent: f64, order: usize) -> Option<Self> {
        let degree = exponent - (order + 3) as f64;
        if exponent.fract() != 0.0 || degree < 0.0 || exponent > LARGEST {
            return None;
        }
        let product: f64 = (1..=order + 2).map(|i| exponent - i as f64).product();
        Some(Self { order, degree: degree as usize, factor: 1.0 / product })
    }

    /// The weights J_ab of a triangle.
    #[inline]
    pub fn weights(&self, triangle: &Triangle) -> Weights {
        let scale = triangle.twice_area * self.factor;
        let u = triangle.corners.map(|corner| corner.inverse);
        match self.order {
            0 => self.zeroth(u, scale),
            1 => self.first(u, scale),
            2 => self.second(u, scale),
            _ => self.third(u, scale),
        }
    }

    #[inline]
    fn zeroth(&self, u: [f64; 3], scale: f64) -> Weights {
        let mut base = Base::ONE;
        for _ in 0..self.degree {
            base.raise(u);
        }
        let mut weights = [0.0; 10];
        weights[0] = scale * u[0] * u[1] * u[2] * base.0[2];
        weights
    }

    #[inline]
    fn first(&self, u: [f64; 3], scale: f64) -> Weights {
        let (mut base, mut one) = (Base::ONE, [1.0; 3]);
        for _ in 0..self.degree {
            let sum = base.raise(u);
            one = raise_one(sum, one, u);
        }
        let scale = scale * u[0] * u[1] * u[2];
        let [j0, j1, j2]: [f64; 3] = std::array::from_fn(|i| scale * u[i] * one[i]);
        let mut weights = [0.0; 10];
        weights[..3].copy_from_slice(&[j0 + j1 + j2, j1, j2]);
        weights
    }

    #[inline]
    fn second(&self, u: [f64; 3], scale: f64) -> Weights {
        let (mut base, mut one, mut two) = (Base::ONE, [1.0; 3], [1.0; 6]);
        for _ in 0..self.degree {
            let sum = base.raise(u);
            one = raise_one(sum, one, u);
            two = raise_two(&one, &two, u);
        }
        let scale = scale * u[0] * u[1] * u[2];
        // The factorials a! double the squares.
        let j: [f64; 6] = std::array::from_fn(|i| {
            let (p, q) = PAIRS[i];
            let factorial = if p == q { 2.0 } else { 1.0 };
            scale * factorial * u[p] * u[q] * two[i]
        });
        let mut weights = [0.0; 10];
        fill_second(&mut weights, &j);
        weights
    }

    #[inline]
    fn third(&self, u: [f64; 3], scale: f64) -> Weights {
        let (mut base, mut one, mut two, mut three) = (Base::ONE, [1.0; 3], [1.0; 6], [1.0; 10]);
        for _ in 0..self.degree {
            let sum = base.raise(u);
            one = raise_one(sum, one, u);
            two = raise_two(&one, &two, u);
            three = std::array::from_fn(|i| two[TRIPLES[i].0] + u[TRIPLES[i].1] * three[i]);
        }
        let scale = scale * u[0] * u[1] * u[2];
        let j: [f64; 10] = std::array::from_fn(|i| {
            let (pair, r) = TRIPLES[i];
            let (p, q) = PAIRS[pair];
            scale * TRIPLE_FACTORIALS[i] * u[p] * u[q] * u[r] * three[i]
        });
        // Summing over the third index lowers 000 … 222 to 00 … 22.
        let lower = [
            j[0] + j[1] + j[2],
            j[1] + j[3] + j[4],
            j[2] + j[4] + j[5],
            j[3] + j[6] + j[7],
            j[4] + j[7] + j[8],
            j[5] + j[8] + j[9],
        ];
        let mut weights = [0.0; 10];
        fill_second(&mut weights, &lower);
        weights[6..].copy_from_slice(&j[6..]);
        weights
    }
}

/// The pairs of corners 00, 01, 02, 11, 12, 22.
const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// The triples 000, 001, 002, 011, 012, 022, 111, 112, 122, 222 as a pair and one more corner.
const TRIPLES: [(usize, usize); 10] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2), (3, 1), (3, 2), (4, 2), (5, 2)];

/// a! for the triples.
const TRIPLE_FACTORIALS: [f64; 10] = [6.0, 2.0, 2.0, 2.0, 1.0, 2.0, 6.0, 2.0, 2.0, 6.0];

/// h_k(u₀), h_k(u₀, u₁), h_k(u₀, u₁, u₂).
struct Base([f64; 3]);

impl Base {
    /// k = 0.
    const ONE: Self = Self([1.0; 3]);

    /// From k to k + 1; returns h_k of all three.
    #[inline]
    fn raise(&mut self, u: [f64; 3]) -> f64 {
        self.0[0] *= u[0];
        self.0[1] = self.0[0] + u[1] * self.0[1];
        self.0[2] = self.0[1] + u[2] * self.0[2];
        self.0[2]
    }
}

/// h_k with one more of each corner.
#[inline]
fn raise_one(base: f64, one: [f64; 3], u: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| base + u[i] * one[i])
}

/// h_k with one more of each pair.
#[inline]
fn raise_two(one: &[f64; 3], two: &[f64; 6], u: [f64; 3]) -> [f64; 6] {
    std::array::from_fn(|i| one[PAIRS[i].0] + u[PAIRS[i].1] * two[i])
}

/// J_ab up to the second order from ∫ λ_p λ_q κ dA over the pairs.
#[inline]
fn fill_second(weights: &mut Weights, j: &[f64; 6]) {
    let first = j[1] + j[3] + j[4];
    let second = j[2] + j[4] + j[5];
    let zeroth = j[0] + j[1] + j[2] + first + second;
    weights[..6].copy_from_slice(&[zeroth, first, second, j[3], j[4], j[5]]);
}
