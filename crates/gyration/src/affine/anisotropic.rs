//! Anisotropic internal friction: a viscous stress linear in sym L, in axes that turn with the body.
//!
//!   τ = det P R C[Rᵀ sym L R] Rᵀ,   P = R U
//!
//! C is a symmetric positive semi-definite 6×6 matrix on (xx, yy, zz, yz, xz, xy) in Voigt's notation: it takes (L_xx,
//! L_yy, L_zz, 2L_(yz), 2L_(xz), 2L_(xy)) to the components of the Cauchy stress, as a stiffness matrix does with
//! strains. Isotropic friction η, ζ is C_xxxx = ζ + 4η/3, C_xxyy = ζ − 2η/3, C_xyxy = η. Source: Sławianowski (1975),
//! 4.12, with the sign and the volume that dissipate.

use super::Gyration;
use crate::load::{ResistanceError, mirrored, semi_definite, unit};
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

    /// τ \[Pa\].
    pub fn kirchhoff_stress(&self, at: &Gyration) -> Mat3 {
        at.volume_ratio * self.cauchy_stress(&Polar::of(&at.gradient).rotation, &at.velocity_gradient)
    }

    /// R C[Rᵀ sym L R] Rᵀ.
    fn cauchy_stress(&self, r: &Mat3, l: &Mat3) -> Mat3 {
        let d = r.tr_mul(l) * r;
        let rates = [d.m11, d.m22, d.m33, d.m23 + d.m32, d.m13 + d.m31, d.m12 + d.m21];
        let s = self.0 * Vector6::from(rates);
        r * Mat3::new(s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2]) * r.transpose()
    }
}

/// The friction at one instant, with all that its derivatives need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrictionSlopes<'a> {
    friction: &'a AnisotropicFriction,
    at: &'a Gyration,
    polar: Polar,
    /// τ/det P.
    stress: Mat3,
}

impl<'a> FrictionSlopes<'a> {
    pub fn new(friction: &'a AnisotropicFriction, at: &'a Gyration) -> Self {
        let polar = Polar::of(&at.gradient);
        let stress = friction.cauchy_stress(&polar.rotation, &at.velocity_gradient);
        Self { friction, at, polar, stress }
    }

    /// The derivative of τ P⁻ᵀ by P_jB.
    pub fn by_gradient(&self, j: usize, b: usize) -> Mat3 {
        let Self { friction, at, polar, stress } = self;
        let (r, f, l) = (&polar.rotation, &at.inverse, &at.velocity_gradient);
        // δP = e_j ⊗ e_B, δL = −L δP F.
        let unit = unit(3 * b + j);
        // The stress turns with the axes, and the rate seen from them turns back.
        let turn = cross_matrix(&(r * polar.turn(&unit)));
        let seen = turn * l - l * turn + l * (unit * f);
        let turned = turn * stress - stress * turn - friction.cauchy_stress(r, &seen);
        // det P grows by det P F_Bj, and τ P⁻ᵀ loses τ (δP F)ᵀ P⁻ᵀ.
        let grown = f[(b, j)] * stress - stress * (unit * f).transpose();
        at.volume_ratio * (turned + grown) * f.transpose()
    }

    /// The derivative of τ P⁻ᵀ by Ṗ_jB.
    pub fn by_rate(&self, j: usize, b: usize) -> Mat3 {
        let f = &self.at.inverse;
        // δL = δṖ F.
        let stress = self.friction.cauchy_stress(&self.polar.rotation, &(unit(3 * b + j) * f));
        self.at.volume_ratio * stress * f.transpose()
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
        let at = Gyration::of(&p, &(l * p)).unwrap();
        let difference = friction.kirchhoff_stress(&at) - isotropic.kirchhoff_stress(&at);
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
