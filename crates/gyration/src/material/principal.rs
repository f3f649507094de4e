//! Energies that are functions of the principal values c_i of C = PᵀP.
//!
//! With C = N diag(c) Nᵀ and s_i = 2 ∂φ/∂c_i,
//!
//!   S = P N diag(s) Nᵀ,    dS = dP N diag(s) Nᵀ + P N M Nᵀ
//!   M_ii = Σ_j (∂s_i/∂c_j) D_jj,   M_ij = (s_i − s_j)/(c_i − c_j) D_ij,   D = Nᵀ dC N
//!
//! The quotients are divided differences, which the materials give in closed form without dividing by c_i − c_j: equal
//! and nearly equal stretches are no special case. Source: Ogden, *Non-linear elastic deformations*, §6.1.

use super::Tangent;
use crate::tensor::Mat3;

/// φ and its derivatives with the principal values.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Principal {
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
pub(super) struct ByPrincipal {
    p: Mat3,
    axes: Mat3,
    principal: Principal,
    /// N diag(s) Nᵀ.
    second_piola: Mat3,
}

impl ByPrincipal {
    pub fn new(p: &Mat3, energy: &dyn Fn(&[f64; 3]) -> Principal) -> Self {
        let eigen = p.tr_mul(p).symmetric_eigen();
        let axes = eigen.eigenvectors;
        let principal = energy(&eigen.eigenvalues.into());
        let second_piola = axes * Mat3::from_diagonal(&principal.slopes.into()) * axes.transpose();
        Self { p: *p, axes, principal, second_piola }
    }

    pub fn energy(&self) -> f64 {
        self.principal.energy
    }

    /// S.
    pub fn stress(&self) -> Mat3 {
        self.p * self.second_piola
    }

    /// ∂S/∂P.
    pub fn tangent(&self) -> Tangent {
        let mut tangent = Tangent::zeros();
        for place in 0..9 {
            let mut dp = Mat3::zeros();
            dp[(place % 3, place / 3)] = 1.0;
            tangent.column_mut(place).copy_from_slice(self.change(&dp).as_slice());
        }
        tangent
    }

    /// dS.
    fn change(&self, dp: &Mat3) -> Mat3 {
        let Self { p, axes, principal, second_piola } = self;
        let half = axes.tr_mul(&(p.tr_mul(dp) * axes));
        let d = half + half.transpose();
        let mut m = Mat3::zeros();
        for (i, row) in principal.curvature.iter().enumerate() {
            m[(i, i)] = row.iter().enumerate().map(|(j, slope)| slope * d[(j, j)]).sum();
        }
        for (quotient, (i, j)) in principal.quotients.iter().zip(PAIRS) {
            m[(i, j)] = quotient * d[(i, j)];
            m[(j, i)] = m[(i, j)];
        }
        dp * second_piola + p * (axes * m * axes.transpose())
    }
}

/// (a^n − b^n)/(a − b) for a, b > 0: n b^(n−1) where they meet.
pub(super) fn power_quotient(n: f64, a: f64, b: f64) -> f64 {
    let r = (a - b) / b;
    let slope = if r == 0.0 { n } else { (n * r.ln_1p()).exp_m1() / r };
    b.powf(n - 1.0) * slope
}

/// (ln a − ln b)/(a − b) for a, b > 0.
pub(super) fn log_quotient(a: f64, b: f64) -> f64 {
    let r = (a - b) / b;
    if r == 0.0 { 1.0 / b } else { r.ln_1p() / (r * b) }
}
