//! Materials: an energy per reference volume φ(P), its derivative S = ∂φ/∂P and the derivative of that.
//!
//! All are isotropic and objective, so that φ is a function of C = PᵀP: of its invariants (`invariants`: ι₁ = tr C, ι₂
//! = ½(tr²C − tr C²), J = det P), or of its principal values (`principal`).
//!
//! | material             | φ                                             | with a bulk modulus K                      |
//! |----------------------|-----------------------------------------------|--------------------------------------------|
//! | Mooney–Rivlin        | c₁(ι₁ − 3) + c₂(ι₂ − 3)                       | c₁(J^−⅔ι₁ − 3) + c₂(J^−4/3ι₂ − 3) + K/2 (J − 1)² |
//! | Fung                 | μ/(2b) (e^{b(ι₁ − 3)} − 1)                    | of J^−⅔ι₁, + K/2 (J − 1)²                  |
//! | Ogden                | Σ μ_p/α_p (Σ λ_i^α_p − 3)                     | of J^−⅓λ_i, + K/2 (J − 1)²                 |
//! | neo-Hookean with log |                                               | μ/2 (ι₁ − 3) − μ ln J + λ/2 ln²J           |
//! | St Venant–Kirchhoff  |                                               | λ/2 tr²E + μ E·E, E = (C − I)/2            |
//! | Hencky               |                                               | μ |dev ln U|² + K/2 ln²J                   |
//!
//! Without K the material is incompressible: det P = 1 is a constraint, its pressure is not part of S. The
//! orthogonality energy κ|PᵀP − I|² is St Venant–Kirchhoff with λ = 0, μ = 4κ; neo-Hookean is Mooney–Rivlin with c₁ =
//! μ/2. This module sees a gradient, never a body or a time.

mod coaxial;
mod fung;
mod hencky;
mod invariants;
mod mooney_rivlin;
mod neo_hookean_log;
mod ogden;
mod principal;
mod spectrum;
mod st_venant_kirchhoff;
mod volume;

pub(crate) use coaxial::Coaxial;
pub use fung::Fung;
pub use hencky::Hencky;
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean_log::NeoHookeanLog;
pub use ogden::{Ogden, OgdenTerm};
pub use st_venant_kirchhoff::StVenantKirchhoff;

use crate::simd::{F64x4, SimdMat3};
use crate::tensor::Mat3;
pub(crate) use invariants::ByInvariants;
use invariants::Invariants;
use nalgebra::SMatrix;
pub(crate) use principal::ByPrincipal;
pub(crate) use spectrum::Spectrum;

/// The material of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Material {
    /// Mooney–Rivlin, and neo-Hookean.
    MooneyRivlin(MooneyRivlin),
    /// Exponential.
    Fung(Fung),
    /// Powers of the stretches.
    Ogden(Ogden),
    /// Neo-Hookean with ln J, compressible.
    NeoHookeanLog(NeoHookeanLog),
    /// Quadratic in Green's strain; the orthogonality energy.
    StVenantKirchhoff(StVenantKirchhoff),
    /// Quadratic in the logarithmic strain.
    Hencky(Hencky),
}

/// Energy and stress at a gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// φ [J/m³].
    pub energy: f64,
    /// S = ∂φ/∂P, first Piola stress [Pa].
    pub stress: Mat3,
}

/// A number of a material that it cannot have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("`{name}` is {value}: it must be finite and {bound}")]
pub struct MaterialError {
    /// The number, as scenes call it.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub bound: &'static str,
}

/// The derivative of the stress at a gradient, a linear map of 3×3 matrices that are read column by column.
pub type Tangent = SMatrix<f64, 9, 9>;

/// A material at a gradient, with all that stress and tangent need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kept {
    /// An energy of the invariants.
    Invariants(ByInvariants),
    /// An energy of the principal values.
    Principal(ByPrincipal),
}

impl Kept {
    #[inline(always)]
    fn energy(&self) -> f64 {
        match self {
            Self::Invariants(kept) => kept.energy(),
            Self::Principal(kept) => kept.energy(),
        }
    }

    /// S.
    #[inline(always)]
    pub fn stress(&self) -> SimdMat3 {
        match self {
            Self::Invariants(kept) => kept.stress(),
            Self::Principal(kept) => kept.stress(),
        }
    }

    /// ∂S/∂P_jB.
    #[inline(always)]
    pub fn slope(&self, j: usize, b: usize) -> SimdMat3 {
        match self {
            Self::Invariants(kept) => kept.slope(j, b),
            Self::Principal(kept) => kept.slope(j, b),
        }
    }
}

impl Material {
    /// φ(P) and S = ∂φ/∂P, det P > 0; not finite where the energy is not.
    pub fn response(&self, p: &Mat3) -> Response {
        let kept = self.at(&SimdMat3::of(p));
        Response { energy: kept.energy(), stress: kept.stress().matrix() }
    }

    /// ∂S_iA/∂P_jB at (3A + i, 3B + j), det P > 0.
    pub fn tangent(&self, p: &Mat3) -> Tangent {
        let mut tangent = Tangent::zeros();
        for (place, slope) in self.slopes_at(&SimdMat3::of(p)).iter().enumerate() {
            slope.write(&mut tangent.as_mut_slice()[9 * place..]);
        }
        tangent
    }

    /// S Pᵀ at P and det P, symmetric to the last bit.
    #[inline(always)]
    pub(crate) fn kirchhoff_stress_at<F: F64x4>(&self, p: &SimdMat3<F>, volume: f64) -> SimdMat3<F> {
        match self {
            Self::Ogden(material) => principal::kirchhoff_stress(&p.kept(), |c| material.slopes(c)).with(p.0[0].0),
            Self::Hencky(material) => principal::kirchhoff_stress(&p.kept(), |c| material.slopes(c)).with(p.0[0].0),
            _ => invariants::energy_and_kirchhoff_stress(p, volume, self).1,
        }
    }

    /// ∂S/∂P_jB at 3B + j.
    ///
    /// A function of its own, however often it is needed: it is long, and so is what it takes in.
    #[inline(never)]
    pub(crate) fn slopes_at(&self, p: &SimdMat3) -> [SimdMat3; 9] {
        let kept = self.at(p);
        let mut slopes = [SimdMat3::default(); 9];
        for (place, slope) in slopes.iter_mut().enumerate() {
            *slope = kept.slope(place % 3, place / 3);
        }
        slopes
    }

    /// φ and S Pᵀ at P and det P.
    #[inline(always)]
    pub(crate) fn energy_and_kirchhoff_stress<F: F64x4>(&self, p: &SimdMat3<F>, volume: f64) -> (f64, SimdMat3<F>) {
        let principal = matches!(self, Self::Ogden(_) | Self::Hencky(_));
        match principal.then(|| self.by_principal(&p.kept())).flatten() {
            Some(kept) => (kept.energy(), kept.stress().with(p.0[0].0).times_transposed(p).symmetric()),
            None => invariants::energy_and_kirchhoff_stress(p, volume, self),
        }
    }

    /// The material at a gradient.
    #[inline(always)]
    pub(crate) fn at(&self, p: &SimdMat3) -> Kept {
        match self.by_principal(p) {
            Some(kept) => Kept::Principal(kept),
            None => Kept::Invariants(ByInvariants::new(p, self)),
        }
    }

    /// An energy of the principal values at a gradient; none for others.
    #[inline(never)]
    pub(crate) fn by_principal(&self, p: &SimdMat3) -> Option<ByPrincipal> {
        match self {
            Self::Ogden(material) => Some(ByPrincipal::new(p, |c| material.principal(c))),
            Self::Hencky(material) => Some(ByPrincipal::new(p, |c| material.principal(c))),
            _ => None,
        }
    }

    /// Of an energy of the invariants; zero for others.
    #[inline(always)]
    pub(crate) fn derivatives(&self, at: &Invariants) -> invariants::Derivatives {
        match self {
            Self::MooneyRivlin(material) => material.derivatives(at),
            Self::Fung(material) => material.derivatives(at),
            Self::NeoHookeanLog(material) => material.derivatives(at),
            Self::StVenantKirchhoff(material) => material.derivatives(at),
            Self::Ogden(_) | Self::Hencky(_) => invariants::Derivatives::default(),
        }
    }

    /// Whether det P = 1 is a constraint.
    pub fn is_incompressible(&self) -> bool {
        match self {
            Self::MooneyRivlin(material) => material.bulk.is_none(),
            Self::Fung(material) => material.bulk.is_none(),
            Self::Ogden(material) => material.bulk.is_none(),
            Self::NeoHookeanLog(_) | Self::StVenantKirchhoff(_) | Self::Hencky(_) => false,
        }
    }

    /// Refuses numbers for which the rest state would not be stable, or extreme stretch would be free.
    ///
    /// # Errors
    /// [`MaterialError`] naming the number.
    pub fn validate(&self) -> Result<(), MaterialError> {
        match self {
            Self::MooneyRivlin(material) => material.validate(),
            Self::Fung(material) => material.validate(),
            Self::Ogden(material) => material.validate(),
            Self::NeoHookeanLog(material) => material.validate(),
            Self::StVenantKirchhoff(material) => material.validate(),
            Self::Hencky(material) => material.validate(),
        }
    }
}

/// Refuses a number that is not finite or does not hold to its bound.
fn require(name: &'static str, value: f64, holds: bool, bound: &'static str) -> Result<(), MaterialError> {
    if holds && value.is_finite() { Ok(()) } else { Err(MaterialError { name, value, bound }) }
}

/// Refuses a modulus that is not finite and ≥ 0.
fn require_modulus(name: &'static str, value: f64) -> Result<(), MaterialError> {
    require(name, value, value >= 0.0, "≥ 0")
}

/// Refuses a bulk modulus that is not finite and > 0.
fn require_bulk(bulk: Option<f64>) -> Result<(), MaterialError> {
    bulk.map_or(Ok(()), |bulk| require("bulk", bulk, bulk > 0.0, "> 0 (leave it out for an incompressible material)"))
}
