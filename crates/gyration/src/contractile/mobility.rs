//! The contraction velocity that goes with a stress: the inverse of
//!
//!   A(V) = μ_γ V + (μ/2)(C V C⁻¹ + Vᵀ),   C = FᵀF = N diag(c) Nᵀ
//!
//! In the axes N the entries (i, j) and (j, i) of V = A⁻¹(R) go with each other alone: with ρ = c_i/c_j,
//!
//!   V_ii = R_ii/(μ_γ + μ),   V_ij = ((μ_γ + μ/(2ρ)) R_ij − (μ/2) R_ji)/(μ_γ² + μ_γ (μ/2)(ρ + 1/ρ))
//!
//! and, if V has to be symmetric, V_ij = (R_ij + R_ji)/2/(μ_γ + (μ/4)(ρ + 1/ρ + 2)). A is symmetric and positive: it is the derivative
//! of half the dissipation. tr A(V) = (μ_γ + μ) tr V, so that a pressure changes tr V alone.

use super::Spin;
use crate::columns::{Column, Columns};
use crate::material::Spectrum;

/// A⁻¹ at an elastic gradient, in its axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mobility {
    /// 1/(μ_γ + μ).
    stretching: f64,
    /// The factors of R_ij and R_ji in V_ij, (i, j) = (0, 1), (0, 2), (1, 2) and (1, 0), (2, 0), (2, 1).
    own: [f64; 6],
    other: [f64; 3],
}

/// The principal axes and values of C = FᵀF.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axes {
    /// N.
    pub axes: Columns,
    /// c.
    pub values: [f64; 3],
}

/// The pairs of `own`; those of the second half are turned round.
const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

impl Axes {
    /// Of an elastic gradient, where a viscosity needs them.
    #[inline(always)]
    pub fn of(elastic: &Columns, viscosity: f64) -> Option<Self> {
        (viscosity > 0.0).then(|| {
            let Spectrum { values, axes, .. } = Spectrum::of(elastic);
            Self { axes, values }
        })
    }

    /// Nᵀ A N.
    #[inline(always)]
    pub fn turned(&self, matrix: &Columns) -> Columns {
        self.axes.transpose().times(matrix).times(&self.axes)
    }
}

impl Mobility {
    /// Of μ_γ and μ [Pa s]; without axes, μ = 0 and all axes will do.
    #[inline(always)]
    pub fn new([gamma, viscosity]: [f64; 2], spin: Spin, axes: Option<&Axes>) -> Self {
        let stretching = 1.0 / (gamma + viscosity);
        let Some(Axes { values, .. }) = axes else {
            let (own, other) = match spin {
                Spin::Full => (stretching, 0.0),
                Spin::Symmetric => (0.5 * stretching, 0.5 * stretching),
            };
            return Self { stretching, own: [own; 6], other: [other; 3] };
        };
        let (mut own, mut other) = ([0.0; 6], [0.0; 3]);
        let half = 0.5 * viscosity;
        for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
            let (ratio, inverse) = (values[i] / values[j], values[j] / values[i]);
            match spin {
                Spin::Full => {
                    let per = 1.0 / (gamma * (gamma + half * (ratio + inverse)));
                    own[pair] = (gamma + half * inverse) * per;
                    own[3 + pair] = (gamma + half * ratio) * per;
                    other[pair] = -half * per;
                }
                Spin::Symmetric => {
                    let both = 0.5 / (gamma + 0.5 * half * (ratio + inverse + 2.0));
                    (own[pair], own[3 + pair], other[pair]) = (both, both, both);
                }
            }
        }
        Self { stretching, own, other }
    }

    /// A⁻¹(R), or its symmetric kin; R and the result are in the axes N.
    #[inline(always)]
    pub fn velocity(&self, stress: &Columns) -> Columns {
        let Self { own, other, stretching } = self;
        let r = |i: usize, j: usize| stress.at(i, j);
        let upper = |pair: usize, i: usize, j: usize| own[pair] * r(i, j) + other[pair] * r(j, i);
        let lower = |pair: usize, i: usize, j: usize| own[3 + pair] * r(j, i) + other[pair] * r(i, j);
        Columns([
            Column([stretching * r(0, 0), lower(0, 0, 1), lower(1, 0, 2), 0.0]),
            Column([upper(0, 0, 1), stretching * r(1, 1), lower(2, 1, 2), 0.0]),
            Column([upper(1, 0, 2), upper(2, 1, 2), stretching * r(2, 2), 0.0]),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::Mat3;

    /// A(V) as it stands.
    fn resistance([gamma, viscosity]: [f64; 2], f: &Mat3, v: &Mat3) -> Mat3 {
        let c = f.tr_mul(f);
        gamma * v + 0.5 * viscosity * (c * v * c.try_inverse().unwrap() + v.transpose())
    }

    #[test]
    fn mobility_is_the_inverse_of_the_resistance() {
        let f = Mat3::new(1.3, 0.4, -0.2, -0.1, 0.7, 0.3, 0.5, -0.6, 1.9);
        let r = Mat3::new(0.2, -0.7, 0.1, 0.9, 0.3, -0.4, 0.5, 0.6, -0.8);
        for f in [f, Mat3::identity(), Mat3::from_diagonal(&[1.0, 1.0 + 1e-9, 2.0].into())] {
            for coefficients in [[0.7, 0.0], [0.7, 2.0], [0.01, 30.0]] {
                let solve = |spin| {
                    let axes = Axes::of(&Columns::of(&f), coefficients[1]);
                    let mobility = Mobility::new(coefficients, spin, axes.as_ref());
                    let n = axes.map_or(Mat3::identity(), |axes| axes.axes.matrix());
                    n * mobility.velocity(&Columns::of(&(n.transpose() * r * n))).matrix() * n.transpose()
                };
                let v = solve(Spin::Full);
                let off = (resistance(coefficients, &f, &v) - r).norm();
                // Roundings of the terms, the largest of which is μ c_i/c_j V.
                assert!(off < 1e-14 * (1.0 + 30.0 * v.norm()), "{off:e}");
                let v = solve(Spin::Symmetric);
                let left = resistance(coefficients, &f, &v) - r;
                let off = (left + left.transpose()).norm().max((v - v.transpose()).norm());
                assert!(off < 1e-14 * (1.0 + 30.0 * v.norm()), "{off:e}");
            }
        }
    }
}
