//! A triangle and the step from scalar weights to tensors.
//!
//! With the corners in the order of their gaps, d₀ ≤ d₁ ≤ d₂, and X = V₀ + λ₁ E₁ + λ₂ E₂, every moment of X follows from
//!
//!   J_ab = ∫ λ₁^a λ₂^b κ(d) dA,   a + b ≤ 3.
//!
//! Starting at the corner with the smallest gap keeps the tensors free of cancellation where κ is concentrated there.

use super::Moments;
use crate::tensor::{Mat3, Vec3};

/// J_ab for (a, b) = 00, 10, 01, 20, 11, 02, 30, 21, 12, 03; those above the wanted order are zero.
pub(super) type Weights = [f64; 10];

/// A corner of a triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// Its place in the tables of the cluster.
    pub place: usize,
    /// Its gap [m].
    pub gap: f64,
    /// The reciprocal of the gap [1/m].
    pub inverse: f64,
}

/// A triangle with its corners in the order of their gaps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    /// The corners, the lowest first.
    pub corners: [Corner; 3],
    /// Twice the area [m²].
    pub twice_area: f64,
    /// V₀.
    origin: Vec3,
    /// E₁ = V₁ − V₀, E₂ = V₂ − V₀.
    edges: [Vec3; 2],
}

impl Triangle {
    /// Sorts the corners; `points` are those of the cluster.
    #[inline]
    pub fn new([mut a, mut b, mut c]: [Corner; 3], points: &[Vec3], twice_area: f64) -> Self {
        if b.gap < a.gap {
            std::mem::swap(&mut a, &mut b);
        }
        if c.gap < b.gap {
            std::mem::swap(&mut b, &mut c);
            if b.gap < a.gap {
                std::mem::swap(&mut a, &mut b);
            }
        }
        let origin = points[a.place];
        Self { corners: [a, b, c], twice_area, origin, edges: [points[b.place] - origin, points[c.place] - origin] }
    }
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
