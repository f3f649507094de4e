//! Moments over one triangle, from the gaps of its corners.
//!
//! The corners are sorted, d₀ ≤ d₁ ≤ d₂, and the level line through the middle corner cuts the triangle in two, each with
//! an edge on which the gap is constant. With τ = (d₁ − d₀)/(d₂ − d₀), x the height and u uniform on [0, 1] along the level,
//!
//!   lower part, area τ A:        λ₁ = x (1 − u),        λ₂ = τ x u,                 d = d₀ + x (d₁ − d₀), dA = 2 τ A x dx du
//!   upper part, area (1 − τ) A:  λ₁ = (1 − x)(1 − u),   λ₂ = x + τ (1 − x) u,       d = d₁ + x (d₂ − d₁), dA = 2 (1 − τ) A (1 − x) dx du
//!
//! so that J_ab = ∫ λ₁^a λ₂^b κ dA are sums, all positive, of the moments of κ along a segment (`power`). Then X = V₀ + λ₁ E₁ + λ₂ E₂
//! gives the tensors. Equal gaps need no special case: τ is then any number in [0, 1].

use super::Moments;
use super::power::{GapSample, LineKernel, LineMoments};
use crate::tensor::{Mat3, Vec3};

/// J_ab = ∫ λ₁^a λ₂^b κ dA for (a, b) = 00, 10, 01, 20, 11, 02, 30, 21, 12, 03; those above the wanted order are zero.
pub(super) type Weights = [f64; 10];

/// A corner of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// Its place in the table of samples.
    pub place: usize,
    /// Its gap [m].
    pub gap: f64,
    /// Its material point [m].
    pub point: Vec3,
}

/// A triangle with its corners in the order of their gaps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    places: [usize; 3],
    /// V₀.
    origin: Vec3,
    /// E₁ = V₁ − V₀, E₂ = V₂ − V₀.
    edges: [Vec3; 2],
    twice_area: f64,
    /// τ and 1 − τ.
    parts: [f64; 2],
}

impl Triangle {
    /// Sorts the corners.
    #[inline]
    pub fn new([mut a, mut b, mut c]: [Corner; 3], twice_area: f64) -> Self {
        if b.gap < a.gap {
            std::mem::swap(&mut a, &mut b);
        }
        if c.gap < b.gap {
            std::mem::swap(&mut b, &mut c);
            if b.gap < a.gap {
                std::mem::swap(&mut a, &mut b);
            }
        }
        let range = c.gap - a.gap;
        let parts = if range > 0.0 { [(b.gap - a.gap) / range, (c.gap - b.gap) / range] } else { [0.5, 0.5] };
        Self {
            places: [a.place, b.place, c.place],
            origin: a.point,
            edges: [b.point - a.point, c.point - a.point],
            twice_area,
            parts,
        }
    }

    /// The weights J_ab for a + b ≤ order, from the samples of the vertices.
    #[inline]
    pub fn weights(&self, kernel: &LineKernel, samples: &[GapSample], order: usize) -> Weights {
        let [low, middle, high] = self.places.map(|place| &samples[place]);
        let mut weights = [0.0; 10];
        let lower = kernel.moments(low, middle, order + 1);
        add_lower(&mut weights, &lower, self.twice_area * self.parts[0], self.parts[0], order);
        let upper = kernel.moments(middle, high, order + 1);
        add_upper(&mut weights, &upper, self.twice_area * self.parts[1], self.parts[0], order);
        weights
    }
}

/// Lower part: J_ab += w τ^b E_ab m_(a+b+1), E_ab = ∫ (1 − u)^a u^b du = a! b!/(a + b + 1)!.
#[inline]
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
#[inline]
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

/// Adds the moments of X = V₀ + λ₁ E₁ + λ₂ E₂ up to `order`.
///
/// Each order is built from the one below with the weights multiplied by λ₁ and λ₂:
/// A_n = V₀ ⊗ A_(n−1)[J] + E₁ ⊗ A_(n−1)[λ₁ J] + E₂ ⊗ A_(n−1)[λ₂ J], every factor being symmetric as a whole.
#[inline]
pub(super) fn add_tensors(sums: &mut Moments, j: &Weights, triangle: &Triangle, order: usize) {
    let (v, [e1, e2]) = (&triangle.origin, &triangle.edges);
    let vector = |a: usize, b: usize, c: usize| v * j[a] + e1 * j[b] + e2 * j[c];
    sums.zeroth += j[0];
    if order == 0 {
        return;
    }
    let first = vector(0, 1, 2);
    sums.first += first;
    if order == 1 {
        return;
    }
    let (first1, first2) = (vector(1, 3, 4), vector(2, 4, 5));
    let second = symmetric(v, &first, e1, &first1, e2, &first2);
    sums.second +=
        Mat3::new(second[0], second[1], second[2], second[1], second[3], second[4], second[2], second[4], second[5]);
    if order == 2 {
        return;
    }
    let (first11, first12, first22) = (vector(3, 6, 7), vector(4, 7, 8), vector(5, 8, 9));
    let second1 = symmetric(v, &first1, e1, &first11, e2, &first12);
    let second2 = symmetric(v, &first2, e1, &first12, e2, &first22);
    // The ten components ijk as the product of component i of a vector and component jk of a matrix.
    const COMPONENTS: [(usize, usize); 10] =
        [(0, 0), (0, 1), (0, 2), (0, 3), (0, 4), (0, 5), (1, 3), (1, 4), (1, 5), (2, 5)];
    for (sum, (i, jk)) in sums.third.0.iter_mut().zip(COMPONENTS) {
        *sum += v[i] * second[jk] + e1[i] * second1[jk] + e2[i] * second2[jk];
    }
}

/// The components xx, xy, xz, yy, yz, zz of a⊗b + c⊗d + e⊗f, known to be symmetric.
#[inline]
fn symmetric(a: &Vec3, b: &Vec3, c: &Vec3, d: &Vec3, e: &Vec3, f: &Vec3) -> [f64; 6] {
    let entry = |i: usize, j: usize| a[i] * b[j] + c[i] * d[j] + e[i] * f[j];
    [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)]
}
