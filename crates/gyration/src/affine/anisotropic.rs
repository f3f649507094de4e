//! Anisotropic internal friction: a viscous stress linear in sym L, in axes that turn with the body.
//!
//!   τ = det P R C[Rᵀ sym L R] Rᵀ,   P = R U
//!
//! C is a symmetric positive semi-definite 6×6 matrix on (xx, yy, zz, yz, xz, xy) in Voigt's notation: it takes
//! (L_xx, L_yy, L_zz, 2L_(yz), 2L_(xz), 2L_(xy)) to the components of the Cauchy stress, as a stiffness matrix does with strains.
//! Isotropic friction η, ζ is C_xxxx = ζ + 4η/3, C_xxyy = ζ − 2η/3, C_xyxy = η. Source: Sławianowski (1975), 4.12, with the
//! sign and the volume that dissipate.

use super::Gyration;
use crate::load::{ResistanceError, mirrored, semi_definite};
use crate::tensor::{Mat3, Polar, cross_matrix};
use nalgebra::{Matrix6, Vector6};

/// C \[Pa s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnisotropicFriction(Matrix6<f64>);

impl AnisotropicFriction {
    /// The friction of a matrix.
    ///
    /// # Errors
    /// [`ResistanceError`] if it is not symmetric and positive semi-definite, naming the offending entry or eigenvalue.
    pub fn new(matrix: &Matrix6<f64>) -> Result<Self, ResistanceError> {
        let matrix = mirrored(matrix, 1.0)?;
        semi_definite(matrix.symmetric_eigenvalues().as_slice())?;
        Ok(Self(matrix))
    }

    /// τ \[Pa\] at P and L.
    pub fn kirchhoff_stress(&self, p: &Mat3, l: &Mat3) -> Mat3 {
        p.determinant() * self.cauchy_stress(&Polar::of(p).rotation, l)
    }

    /// dτ.
    pub(super) fn change(&self, p: &Mat3, gyration: &Gyration, change: &Gyration, dp: &Mat3) -> Mat3 {
        let polar = Polar::of(p);
        let r = &polar.rotation;
        let l = &gyration.gradient;
        let turn = cross_matrix(&(r * polar.turn(dp)));
        let stress = self.cauchy_stress(r, l);
        // The stress turns with the axes, and the rate seen from them turns back.
        let turned = turn * stress - stress * turn - self.cauchy_stress(r, &(turn * l - l * turn));
        let growth = (dp * gyration.inverse).trace();
        p.determinant() * (growth * stress + self.cauchy_stress(r, &change.gradient) + turned)
    }

    /// R C[Rᵀ sym L R] Rᵀ.
    fn cauchy_stress(&self, r: &Mat3, l: &Mat3) -> Mat3 {
        let d = r.tr_mul(l) * r;
        let rates = [d.m11, d.m22, d.m33, d.m23 + d.m32, d.m13 + d.m31, d.m12 + d.m21];
        let s = self.0 * Vector6::from(rates);
        r * Mat3::new(s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]) * r.transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Viscosity;
    use super::*;

    #[test]
    fn the_matrix_of_isotropic_friction_is_isotropic_friction() {
        let (eta, zeta) = (0.7, 0.3);
        let (long, cross) = (zeta + 4.0 / 3.0 * eta, zeta - 2.0 / 3.0 * eta);
        let matrix = Matrix6::from_fn(|i, j| match (i < 3 && j < 3, i == j) {
            (true, true) => long,
            (true, false) => cross,
            (false, true) => eta,
            (false, false) => 0.0,
        });
        let friction = AnisotropicFriction::new(&matrix).unwrap();
        let p = Mat3::new(1.3, 0.4, -0.2, -0.1, 0.7, 0.3, 0.5, -0.6, 1.9);
        let l = Mat3::new(0.2, -0.7, 0.1, 0.9, 0.3, -0.4, 0.5, 0.6, -0.8);
        let isotropic = Viscosity { kirchhoff: 0.0, shear: eta, bulk: zeta };
        let difference = friction.kirchhoff_stress(&p, &l) - isotropic.kirchhoff_stress(&p, &l);
        assert!(difference.norm() < 1e-14, "{difference}");
    }

    #[test]
    fn matrices_that_feed_energy_in_are_refused_with_their_eigenvalue() {
        let mut matrix = Matrix6::identity();
        matrix[(3, 3)] = -0.5;
        let refused = AnisotropicFriction::new(&matrix).unwrap_err();
        assert_eq!(refused, ResistanceError::NotSemiDefinite { eigenvalue: -0.5 });
    }
}
