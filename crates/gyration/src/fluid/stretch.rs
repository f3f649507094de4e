//! The form of a deformed body without its turn and its size, as five numbers.
//!
//!   P = R U,   U = j^⅓ E,   det E = 1,   ln E = Σ s_m B_m,   B_m·B_n = δ_mn,   tr B_m = 0
//!
//! so that |s| = |dev ln U|, the same for a stretch and for its inverse. With E = Σ e_i n_i ⊗ n_i and l_i = ln e_i,
//! derivatives are those of Daleckii and Krein,
//!
//!   n_i·δE n_j = ê_ij n_i·δ(ln E) n_j,   ê_ij = (e_i − e_j)/(l_i − l_j) = √(e_i e_j) sinh(d)/d,   d = (l_i − l_j)/2
//!
//! where equal stretches are no special case.

use crate::material::Spectrum;
use crate::simd::SimdMat3;
use crate::tensor::Mat3;
use nalgebra::SVector;
use std::f64::consts::FRAC_1_SQRT_2;

/// s.
pub type Strain = SVector<f64, 5>;
/// 1/√6.
const INVERSE_ROOT_SIX: f64 = 0.408_248_290_463_863;

/// Σ s_m B_m.
fn logarithm(s: &Strain) -> Mat3 {
    let [across, along] = [FRAC_1_SQRT_2 * s[0], INVERSE_ROOT_SIX * s[1]];
    let [xy, yz, zx] = [2, 3, 4].map(|m| FRAC_1_SQRT_2 * s[m]);
    Mat3::new(across - along, xy, zx, xy, -across - along, yz, zx, yz, 2.0 * along)
}

/// B_m·X of a symmetric X.
fn components(x: &Mat3) -> Strain {
    let shear = |i, j| FRAC_1_SQRT_2 * (x[(i, j)] + x[(j, i)]);
    Strain::from([
        FRAC_1_SQRT_2 * (x[(0, 0)] - x[(1, 1)]),
        INVERSE_ROOT_SIX * (2.0 * x[(2, 2)] - x[(0, 0)] - x[(1, 1)]),
        shear(0, 1),
        shear(1, 2),
        shear(2, 0),
    ])
}

/// E, by its principal stretches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalStretch {
    /// n_i, a column each.
    axes: Mat3,
    /// l_i, which add up to nought.
    logarithms: [f64; 3],
}

impl PrincipalStretch {
    /// E of a symmetric U, det U > 0.
    pub fn of(stretch: &Mat3) -> Self {
        let spectrum = Spectrum::of(&SimdMat3::of(stretch));
        Self::free_of_size(spectrum.axes.matrix(), spectrum.values.map(|square| 0.5 * libm::log(square)))
    }

    /// E of its coordinates.
    pub fn at(strain: &Strain) -> Self {
        let eigen = logarithm(strain).symmetric_eigen();
        Self::free_of_size(eigen.eigenvectors, eigen.eigenvalues.into())
    }

    fn free_of_size(axes: Mat3, logarithms: [f64; 3]) -> Self {
        let mean = logarithms.iter().sum::<f64>() / 3.0;
        Self { axes, logarithms: logarithms.map(|logarithm| logarithm - mean) }
    }

    /// s.
    pub fn strain(&self) -> Strain {
        components(&(self.axes * Mat3::from_diagonal(&self.logarithms.into()) * self.axes.transpose()))
    }

    /// E.
    pub fn matrix(&self) -> Mat3 {
        let stretches = self.logarithms.map(libm::exp);
        self.axes * Mat3::from_diagonal(&stretches.into()) * self.axes.transpose()
    }

    /// ê_ij.
    fn mean(&self, i: usize, j: usize) -> f64 {
        let (sum, half) = (self.logarithms[i] + self.logarithms[j], 0.5 * (self.logarithms[i] - self.logarithms[j]));
        // sinh(d)/d to rounding where the next term of its series, d⁴/120, is less than that.
        let growth = if half.abs() < 1e-4 { 1.0 + half * half / 6.0 } else { libm::sinh(half) / half };
        libm::exp(0.5 * sum) * growth
    }

    fn weighed(&self, tensor: &Mat3, weight: impl Fn(usize, usize) -> f64) -> Mat3 {
        let seen = self.axes.tr_mul(tensor) * self.axes;
        let weighed = Mat3::from_fn(|i, j| weight(i, j) * seen[(i, j)]);
        self.axes * weighed * self.axes.transpose()
    }

    /// ∂E/∂s_m.
    pub fn along(&self, m: usize) -> Mat3 {
        self.weighed(&logarithm(&Strain::ith(m, 1.0)), |i, j| self.mean(i, j))
    }

    /// δs for a symmetric δE, of whatever trace.
    pub fn strain_along(&self, change: &Mat3) -> Strain {
        components(&self.weighed(change, |i, j| 1.0 / self.mean(i, j)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRAINS: [[f64; 5]; 4] =
        [[0.0; 5], [0.3, -0.2, 0.5, 0.1, -0.4], [0.7, 0.0, 0.0, 0.0, 0.0], [1e-6, 2e-6, 0.0, -1e-6, 3e-6]];

    #[test]
    fn a_form_is_its_coordinates() {
        for s in STRAINS.map(Strain::from) {
            let stretch = PrincipalStretch::at(&s);
            assert!((stretch.strain() - s).norm() < 1e-14);
            assert!((stretch.matrix().determinant() - 1.0).abs() < 1e-14);
            // The size does not count; the squares of stretches are known to rounding.
            let again = PrincipalStretch::of(&(3.0 * stretch.matrix()));
            assert!((again.strain() - s).norm() < 1e-14, "{:?}", again.strain());
            assert!((stretch.strain().norm() - logarithm(&s).norm()).abs() < 1e-15);
        }
    }

    #[test]
    fn derivatives_are_those_of_the_exponential_and_its_inverse() {
        let step = 1e-5;
        for s in STRAINS.map(Strain::from) {
            for m in 0..5 {
                let shifted = |sign: f64| PrincipalStretch::at(&(s + Strain::ith(m, sign * step))).matrix();
                let difference = (shifted(1.0) - shifted(-1.0)) / (2.0 * step);
                let exact = PrincipalStretch::at(&s).along(m);
                // Third derivatives are of the order of E: step².
                assert!((difference - exact).norm() < 1e-9, "{s}, {m}");
                let back = PrincipalStretch::at(&s).strain_along(&exact);
                assert!((back - Strain::ith(m, 1.0)).norm() < 1e-13, "{s}, {m}: {back}");
            }
        }
    }
}
