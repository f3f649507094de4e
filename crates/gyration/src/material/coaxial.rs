//! The tangent of a material in the axes of C = FᵀF = N diag(c) Nᵀ, where it hardly couples anything.
//!
//! With s_i = 2 ∂φ/∂c_i and Σ = Fᵀ ∂φ/∂F = N diag(c s) Nᵀ, an increment δF = F ξ, ξ in the axes, changes ∂φ/∂F by
//! 𝔸[Fξ], and
//!
//!   (Fᵀ 𝔸[Fξ])_ik = a_ik ξ_ik + b_ik ξ_ki,   a_ik = c_i (c_i s_i − c_k s_k)/(c_i − c_k),   b_ik = c_i c_k (s_i − s_k)/(c_i − c_k)
//!   (Fᵀ 𝔸[Fξ])_ii = Σ_j d_ij ξ_jj,           d_ij = 2 c_i c_j ∂s_i/∂c_j + δ_ij c_i s_i
//!
//! off the diagonal and on it. Of an energy of the invariants, s_i = 2(f₁ + f₂ y_i) + f₃J/c_i with y_i = ι₁ − c_i, the
//! quotients are polynomials, with l the third of i, k, l:
//!
//!   a_ik = 2c_i (f₁ + f₂ c_l),   b_ik = −2f₂ c_i c_k − f₃J
//!   d_ij = 4c_i c_j (f₁₁ + f₁₂(y_i + y_j) + f₂₂ y_i y_j) + 2J (c_i (f₁₃ + f₂₃ y_i) + c_j (f₁₃ + f₂₃ y_j)) + J² f₃₃ + f₃J
//!          + (i = j: 2c_i (f₁ + f₂ y_i) − f₃J;  i ≠ j: 4 f₂ c_i c_j)

use super::Material;
use super::invariants::{Derivatives, Invariants};
use super::principal::Principal;
use crate::simd::{SimdMat3, SimdVec3};

/// φ, Σ and the tangent in the axes of C.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Coaxial {
    /// φ.
    pub energy: f64,
    /// c_i s_i.
    pub mandel: [f64; 3],
    /// a and b, zero on the diagonal.
    pub own: SimdMat3,
    pub other: SimdMat3,
    /// d.
    pub along: SimdMat3,
}

/// The other two of three.
const OTHERS: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

impl Material {
    /// At the principal values of C and det F.
    ///
    /// A function of its own: none of it is done in fours.
    #[inline(never)]
    pub(crate) fn coaxial(&self, c: &[f64; 3], volume: f64) -> Coaxial {
        match self {
            Self::Ogden(material) => by_principal(c, &material.principal(c)),
            Self::Hencky(material) => by_principal(c, &material.principal(c)),
            _ => {
                let [x, y, z] = *c;
                let squares = SimdMat3([
                    SimdVec3([x, 0.0, 0.0, 0.0]),
                    SimdVec3([0.0, y, 0.0, 0.0]),
                    SimdVec3([0.0, 0.0, z, 0.0]),
                ]);
                let invariants = Invariants::of(&squares, volume);
                by_invariants(c, volume, &self.derivatives(&invariants))
            }
        }
    }
}

fn by_principal(c: &[f64; 3], at: &Principal) -> Coaxial {
    let Principal { slopes: s, curvature, quotients: [xy, zx, yz], .. } = at;
    let mut coaxial = Coaxial { energy: at.energy, ..Coaxial::default() };
    // By the one that is left out.
    let quotients = [*yz, *zx, *xy];
    for i in 0..3 {
        coaxial.mandel[i] = c[i] * s[i];
        for j in 0..3 {
            coaxial.along.0[j].0[i] = 2.0 * c[i] * c[j] * curvature[i][j];
        }
        coaxial.along.0[i].0[i] += c[i] * s[i];
        let [j, k] = OTHERS[i];
        for (j, k) in [(j, k), (k, j)] {
            coaxial.own.0[k].0[j] = c[j] * (s[k] + quotients[i] * c[j]);
            coaxial.other.0[k].0[j] = c[j] * c[k] * quotients[i];
        }
    }
    coaxial
}

fn by_invariants(c: &[f64; 3], volume: f64, at: &Derivatives) -> Coaxial {
    let ([f1, f2, f3], [f11, f12, f13, f22, f23, f33]) = (at.first, at.second);
    let (pressure, grown) = (f3 * volume, f33 * volume * volume + f3 * volume);
    let mut coaxial = Coaxial { energy: at.energy, ..Coaxial::default() };
    let across = [c[1] + c[2], c[2] + c[0], c[0] + c[1]];
    for i in 0..3 {
        let [j, k] = OTHERS[i];
        let first = 2.0 * c[i] * (f1 + f2 * across[i]);
        coaxial.mandel[i] = first + pressure;
        let (straight, spread) = (c[i] * across[i], c[i] * volume * (f13 + f23 * across[i]));
        let square = 4.0 * (c[i] * c[i] * f11 + 2.0 * c[i] * straight * f12 + straight * straight * f22);
        coaxial.along.0[i].0[i] = (square + 4.0 * spread + grown) + (first - pressure);
        // The pair (j, k).
        let product = c[j] * c[k];
        let curved = f11 + f12 * (across[j] + across[k]) + f22 * (across[j] * across[k]) + f2;
        let spread = c[j] * (f13 + f23 * across[j]) + c[k] * (f13 + f23 * across[k]);
        let along = 4.0 * product * curved + 2.0 * volume * spread + grown;
        let (own, other) = (2.0 * (f1 + f2 * c[i]), -2.0 * f2 * product - pressure);
        for (j, k) in [(j, k), (k, j)] {
            coaxial.along.0[k].0[j] = along;
            coaxial.own.0[k].0[j] = own * c[j];
            coaxial.other.0[k].0[j] = other;
        }
    }
    coaxial
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Fung, Hencky, MooneyRivlin, NeoHookeanLog, Ogden, OgdenTerm, Spectrum};
    use crate::tensor::Mat3;

    #[test]
    fn tangent_in_the_axes_is_the_tangent() {
        let f = Mat3::new(1.3, 0.4, -0.2, -0.1, 0.7, 0.3, 0.5, -0.6, 1.9);
        let xi = Mat3::new(0.2, -0.7, 0.1, 0.9, 0.3, -0.4, 0.5, 0.6, -0.8);
        let terms = vec![OgdenTerm { mu: 1.0, alpha: 1.3 }, OgdenTerm { mu: -0.3, alpha: -2.0 }];
        let materials = [None, Some(7.0)].into_iter().flat_map(|bulk| {
            let ogden = Ogden { terms: terms.clone(), bulk };
            [
                Material::MooneyRivlin(MooneyRivlin { c1: 2.0, c2: 1.0, bulk }),
                Material::Fung(Fung { shear: 2.0, exponent: 0.3, bulk }),
                Material::Ogden(ogden),
                Material::NeoHookeanLog(NeoHookeanLog { mu: 2.0, lambda: 5.0 }),
                Material::Hencky(Hencky { shear: 2.0, bulk: 5.0 }),
            ]
        });
        for material in materials {
            let Spectrum { values, axes, carried } = Spectrum::of(&SimdMat3::of(&f));
            let (n, carried) = (axes.matrix(), carried.matrix());
            let Coaxial { energy, mandel, own, other, along } = material.coaxial(&values, f.determinant());
            let change = f * n * xi * n.transpose();
            let moved = material.tangent(&f) * nalgebra::SVector::<f64, 9>::from_column_slice(change.as_slice());
            let known = carried.transpose() * Mat3::from_column_slice(moved.as_slice()) * n;
            let off = own.matrix().component_mul(&xi) + other.matrix().component_mul(&xi.transpose());
            let found = off + Mat3::from_diagonal(&(along.matrix() * xi.diagonal()));
            // Some roundings of numbers of order 10².
            assert!((found - known).norm() < 1e-13 * known.norm().max(1.0) * 10.0, "{material:?}: {found} {known}");
            assert!((energy - material.response(&f).energy).abs() < 1e-13 * energy, "{material:?}");
            let stress = carried.transpose() * material.response(&f).stress * n;
            assert!((stress - Mat3::from_diagonal(&mandel.into())).norm() < 1e-12 * stress.norm(), "{material:?}");
        }
    }
}
