//! The contraction velocity that goes with a stress: the inverse of
//!
//!   A(V) = μ_γ V + (μ/2)(C V C⁻¹ + Vᵀ),   C = FᵀF = N diag(c) Nᵀ
//!
//! In the axes N the entries (i, j) and (j, i) of V = A⁻¹(R) go with each other alone: with ρ = c_i/c_j,
//!
//!   V_ii = R_ii/(μ_γ + μ),   V_ij = ((μ_γ + μ/(2ρ)) R_ij − (μ/2) R_ji)/(μ_γ² + μ_γ (μ/2)(ρ + 1/ρ))
//!
//! and, if V has to be symmetric, V_ij = (R_ij + R_ji)/2/(μ_γ + (μ/4)(ρ + 1/ρ + 2)). A is symmetric and positive: it is
//! the derivative of half the dissipation. tr A(V) = (μ_γ + μ) tr V, so that a pressure changes tr V alone.

use super::Spin;
use crate::material::Spectrum;
use crate::simd::{F64x4, SimdMat3, SimdVec3};

/// A⁻¹ at an elastic gradient, in its axes: V = X ∘ R + Y ∘ Rᵀ, entry by entry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContractionMobility {
    /// X, with 1/(μ_γ + μ) on its diagonal.
    pub own: SimdMat3,
    /// Y, zero on its diagonal.
    pub other: SimdMat3,
}

/// The principal axes and values of C = FᵀF.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ElasticAxes {
    /// N.
    pub axes: SimdMat3,
    /// F N = F⁻ᵀ N diag(c).
    pub carried: SimdMat3,
    /// c and 1/c.
    pub values: [f64; 3],
    pub inverses: [f64; 3],
}

impl ElasticAxes {
    /// Of an elastic gradient, where a viscosity needs them.
    #[inline(always)]
    pub fn of(elastic: &SimdMat3, viscosity: f64) -> Option<Self> {
        if viscosity > 0.0 { Some(Self::at(elastic)) } else { None }
    }

    /// Of an elastic gradient.
    #[inline(always)]
    pub fn at(elastic: &SimdMat3) -> Self {
        let Spectrum { values, axes, carried } = Spectrum::of(elastic);
        let [x, y, z] = values;
        Self { axes, carried, values, inverses: [1.0 / x, 1.0 / y, 1.0 / z] }
    }

    /// All c_i/c_j.
    #[inline(always)]
    pub fn ratios(&self) -> SimdMat3 {
        let [x, y, z] = self.values;
        let [a, b, c] = self.inverses;
        let values = SimdVec3([x, y, z, 0.0]);
        SimdMat3([values * a, values * b, values * c])
    }

    /// c_i/c_j.
    #[inline(always)]
    pub fn ratio(&self, i: usize, j: usize) -> f64 {
        self.values[i] * self.inverses[j]
    }
}

/// X of the entries off its diagonal and Y, for a pair with the ratios ρ and 1/ρ: those of (i, j), of (j, i), of both.
#[inline(always)]
fn pair([gamma, half]: [f64; 2], spin: Spin, [ratio, inverse]: [f64; 2]) -> [f64; 3] {
    match spin {
        Spin::Full => {
            let per = 1.0 / (gamma * (gamma + half * (ratio + inverse)));
            [(gamma + half * inverse) * per, (gamma + half * ratio) * per, -half * per]
        }
        Spin::Symmetric => [0.5 / (gamma + 0.5 * half * (ratio + inverse + 2.0)); 3],
    }
}

impl ContractionMobility {
    /// Of μ_γ and μ [Pa s]; without axes, μ = 0 and all axes will do.
    #[inline(always)]
    pub fn new([gamma, viscosity]: [f64; 2], spin: Spin, axes: Option<&ElasticAxes>) -> Self {
        let s = 1.0 / (gamma + viscosity);
        let solve = |i: usize, j: usize| {
            let ratios = axes.map_or([1.0; 2], |axes| [axes.ratio(i, j), axes.ratio(j, i)]);
            pair([gamma, 0.5 * viscosity], spin, ratios)
        };
        let ([a, b, x], [c, d, y], [e, f, z]) = (solve(0, 1), solve(0, 2), solve(1, 2));
        Self {
            own: SimdMat3([SimdVec3([s, b, d, 0.0]), SimdVec3([a, s, f, 0.0]), SimdVec3([c, e, s, 0.0])]),
            other: SimdMat3([SimdVec3([0.0, x, y, 0.0]), SimdVec3([x, 0.0, z, 0.0]), SimdVec3([y, z, 0.0, 0.0])]),
        }
    }

    /// What is left of R, R − (μ/2)(C V C⁻¹ + Vᵀ), where V = A⁻¹(R) has to be symmetric; otherwise it is μ_γ V, as this
    /// is on the diagonal. Off it, with s = 2 X_ij,
    ///
    ///   s (μ_γ + (μ/4)(1/ρ + 1)) R_ij − s (μ/4)(ρ + 1) R_ji
    #[inline(always)]
    pub fn rest(&self, [gamma, viscosity]: [f64; 2], axes: &ElasticAxes) -> Self {
        let (r, part) = (axes.ratios(), 0.25 * viscosity);
        // 1/ρ of (i, j) is ρ of (j, i).
        let (mut own, mut other): (SimdMat3, SimdMat3) = (self.own * gamma, SimdMat3::default());
        for (i, j) in [(0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)] {
            let s = 2.0 * self.own.at(i, j);
            own.0[j].0[i] = s * (gamma + part * (r.at(j, i) + 1.0));
            other.0[j].0[i] = -s * (part * (r.at(i, j) + 1.0));
        }
        Self { own, other }
    }

    /// Where V does not answer: V = 0.
    #[inline(always)]
    pub fn none() -> Self {
        Self { own: SimdMat3::default(), other: SimdMat3::default() }
    }

    /// What is left of R there: all of it.
    #[inline(always)]
    pub fn all() -> Self {
        let ones = SimdVec3([1.0, 1.0, 1.0, 0.0]);
        Self { own: SimdMat3([ones; 3]), other: SimdMat3::default() }
    }

    /// A⁻¹(R), or its symmetric kin; R and the result are in the axes N.
    #[inline(always)]
    pub fn velocity<F: F64x4>(&self, stress: &SimdMat3<F>) -> SimdMat3<F> {
        let registers = stress.0[0].0;
        let (own, other) = (self.own.with(registers), self.other.with(registers));
        own.entrywise(stress) + other.entrywise(&stress.transpose())
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
                    let axes = ElasticAxes::of(&SimdMat3::of(&f), coefficients[1]);
                    let mobility = ContractionMobility::new(coefficients, spin, axes.as_ref());
                    let n = axes.map_or(Mat3::identity(), |axes| axes.axes.matrix());
                    n * mobility.velocity(&SimdMat3::of(&(n.transpose() * r * n))).matrix() * n.transpose()
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
