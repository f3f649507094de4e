//! Internal friction: the viscous Kirchhoff stress τ, with S_v = τ P⁻ᵀ and the dissipated power V τ·L ≥ 0.
//!
//!   τ = μ sym L + det P (2η dev(sym L) + ζ tr(L) I)
//!
//! The first term is that of the slides (Tatone): μ is twice a Newtonian viscosity, of the Kirchhoff stress. The second is
//! Newtonian, of the Cauchy stress (Sławianowski 4.13 with the sign and the volume that dissipate).

use super::Gyration;
use crate::tensor::Mat3;

/// Coefficients of internal friction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Viscosity {
    /// μ [Pa s].
    pub kirchhoff: f64,
    /// η [Pa s].
    pub shear: f64,
    /// ζ [Pa s].
    pub bulk: f64,
}

impl Viscosity {
    /// τ [Pa] at P and L.
    pub fn kirchhoff_stress(&self, p: &Mat3, l: &Mat3) -> Mat3 {
        let linear = self.kirchhoff * symmetric(l);
        if self.is_newtonian() { linear + p.determinant() * self.newtonian(l) } else { linear }
    }

    /// dτ; det P changes by det P tr(dP P⁻¹).
    pub(super) fn change(&self, p: &Mat3, gyration: &Gyration, change: &Gyration, dp: &Mat3) -> Mat3 {
        let linear = self.kirchhoff * symmetric(&change.gradient);
        if !self.is_newtonian() {
            return linear;
        }
        let growth = (dp * gyration.inverse).trace();
        linear + p.determinant() * (self.newtonian(&change.gradient) + growth * self.newtonian(&gyration.gradient))
    }

    fn is_newtonian(&self) -> bool {
        self.shear != 0.0 || self.bulk != 0.0
    }

    /// 2η dev(sym L) + ζ tr(L) I [Pa].
    fn newtonian(&self, l: &Mat3) -> Mat3 {
        let isotropic = (self.bulk - 2.0 / 3.0 * self.shear) * l.trace();
        2.0 * self.shear * symmetric(l) + Mat3::from_diagonal_element(isotropic)
    }
}

fn symmetric(l: &Mat3) -> Mat3 {
    0.5 * (l + l.transpose())
}
