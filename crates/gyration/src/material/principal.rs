//! Energies that are functions of the principal values c_i of C = PᵀP.
//!
//! With C = N diag(c) Nᵀ, s_i = 2 ∂φ/∂c_i and Q = P N,
//!
//!   S = Q diag(s) Nᵀ,    dS = dP N diag(s) Nᵀ + Q M Nᵀ
//!   M_ii = Σ_j (∂s_i/∂c_j) D_jj,   M_ij = (s_i − s_j)/(c_i − c_j) D_ij,   D = Nᵀ dC N = q ⊗ n + n ⊗ q
//!
//! for dP = e_j ⊗ e_B, with q and n the rows j of Q and B of N. The quotients are divided differences, which the
//! materials give without cancellation: equal and nearly equal stretches are no special case. Source: Ogden,
//! *Non-linear elastic deformations*, §6.1.

use super::spectrum::Spectrum;
use crate::simd::{SimdMat3, UNIT};

/// φ and its derivatives with the principal values.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Principal {
    /// φ [J/m³].
    pub energy: f64,
    /// s_i = 2 ∂φ/∂c_i.
    pub slopes: [f64; 3],
    /// ∂s_i/∂c_j.
    pub curvature: [[f64; 3]; 3],
    /// (s_i − s_j)/(c_i − c_j) for (0, 1), (0, 2), (1, 2).
    pub quotients: [f64; 3],
}

/// The pairs of the quotients.
pub(super) const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

/// An energy at a gradient, with all that stress and tangent need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ByPrincipal {
    principal: Principal,
    /// N.
    axes: SimdMat3,
    /// Q.
    carried: SimdMat3,
    /// N diag(s) Nᵀ.
    second_piola: SimdMat3,
}

impl ByPrincipal {
    #[inline(always)]
    pub fn new(p: &SimdMat3, energy: impl Fn(&[f64; 3]) -> Principal) -> Self {
        let Spectrum { values, axes, carried } = Spectrum::of(p);
        let principal = energy(&values);
        let second_piola = axes.scaled(&principal.slopes).times_transposed(&axes);
        Self { principal, axes, carried, second_piola }
    }

    #[inline(always)]
    pub fn energy(&self) -> f64 {
        self.principal.energy
    }

    /// S.
    #[inline(always)]
    pub fn stress(&self) -> SimdMat3 {
        self.carried.scaled(&self.principal.slopes).times_transposed(&self.axes)
    }

    /// ∂S/∂P_jB.
    #[inline(always)]
    pub fn slope(&self, j: usize, b: usize) -> SimdMat3 {
        let Self { principal: Principal { curvature, quotients, .. }, axes, carried, second_piola } = self;
        let q = [carried.at(j, 0), carried.at(j, 1), carried.at(j, 2)];
        let n = [axes.at(b, 0), axes.at(b, 1), axes.at(b, 2)];
        let [x, y, z] = carried.0;
        // Q M, column by column: first what the shears of D change, then what its stretches do.
        let [xy, xz, yz] = [
            quotients[0] * (q[0] * n[1] + n[0] * q[1]),
            quotients[1] * (q[0] * n[2] + n[0] * q[2]),
            quotients[2] * (q[1] * n[2] + n[1] * q[2]),
        ];
        let mut changed = SimdMat3([y * xy + z * xz, x * xy + z * yz, x * xz + y * yz]);
        for (a, row) in curvature.iter().enumerate() {
            let stretched = (row[0] * (q[0] * n[0]) + row[1] * (q[1] * n[1])) + row[2] * (q[2] * n[2]);
            changed.0[a] += carried.0[a] * (2.0 * stretched);
        }
        let mut slope = changed.times_transposed(axes);
        for a in 0..3 {
            slope.0[a] += UNIT[j] * second_piola.at(a, b);
        }
        slope
    }
}

/// S Pᵀ = Q diag(s) Qᵀ.
#[inline(always)]
pub(super) fn kirchhoff_stress(p: &SimdMat3, slopes: impl Fn(&[f64; 3]) -> [f64; 3]) -> SimdMat3 {
    let Spectrum { values, carried, .. } = Spectrum::of(p);
    carried.scaled(&slopes(&values)).times_transposed(&carried).symmetric()
}

/// Where |a − b| exceeds this part of b, a difference quotient loses no more than a few roundings by being formed as it
/// stands.
const FAR: f64 = 0.25;

/// (a^n − b^n)/(a − b) for a, b > 0 from a, b and their powers: n b^(n−1) where they meet.
#[inline]
pub(super) fn power_quotient(n: f64, [a, b]: [f64; 2], [to_a, to_b]: [f64; 2]) -> f64 {
    let r = (a - b) / b;
    if r.abs() > FAR {
        return (to_a - to_b) / (a - b);
    }
    let slope = if r == 0.0 { n } else { libm::expm1(n * libm::log1p(r)) / r };
    to_b / b * slope
}

/// (ln a − ln b)/(a − b) for a, b > 0 from a, b and their logarithms.
#[inline]
pub(super) fn log_quotient([a, b]: [f64; 2], [ln_a, ln_b]: [f64; 2]) -> f64 {
    let r = (a - b) / b;
    if r.abs() > FAR {
        return (ln_a - ln_b) / (a - b);
    }
    if r == 0.0 { 1.0 / b } else { libm::log1p(r) / (r * b) }
}
