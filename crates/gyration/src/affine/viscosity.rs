//! Internal friction: the viscous Kirchhoff stress τ, with S_v = τ P⁻ᵀ and the dissipated power V τ·L ≥ 0.
//!
//!   τ = μ sym L + det P (2η dev(sym L) + ζ tr(L) I) = a sym L + c tr(L) I,   a = μ + 2η det P,   c = (ζ − ⅔η) det P
//!
//! The first term is that of the slides (Tatone): μ is twice a Newtonian viscosity, of the Kirchhoff stress. The second
//! is Newtonian, of the Cauchy stress (Sławianowski 4.13 with the sign and the volume that dissipate).

use super::Gyration;
use crate::simd::{F64x4, SimdMat3};
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
    /// a and c [Pa s].
    #[inline(always)]
    pub(super) fn coefficients(&self, volume_ratio: f64) -> (f64, f64) {
        (self.kirchhoff + 2.0 * self.shear * volume_ratio, (self.bulk - 2.0 / 3.0 * self.shear) * volume_ratio)
    }

    /// τ [Pa].
    pub fn kirchhoff_stress(&self, at: &Gyration) -> Mat3 {
        self.stress_at(at.volume_ratio, &SimdMat3::of(&at.velocity_gradient)).matrix()
    }

    /// τ at det P and L.
    #[inline(always)]
    pub(super) fn stress_at<F: F64x4>(&self, volume_ratio: f64, l: &SimdMat3<F>) -> SimdMat3<F> {
        let (a, c) = self.coefficients(volume_ratio);
        ((*l + l.transpose()) * (0.5 * a)).plus_unit(c * l.trace())
    }

    /// The Newtonian part alone, whose τ grows with det P; none if there is none.
    #[inline(always)]
    pub(super) fn newtonian(&self) -> Option<Self> {
        (self.shear != 0.0 || self.bulk != 0.0).then_some(Self { kirchhoff: 0.0, ..*self })
    }
}
