//! `affine.material`: what a deformable body is made of, an energy of its placement gradient.
//!
//! With `bulk` a material that has one is compressible, without it is incompressible: det P = 1. Where two moduli make
//! a material, Young's modulus E and Poisson's ratio ν may take their place, those of small strains.

use crate::quantity::{NonNegative, Positive, Pressure};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An elastic energy of the placement gradient P, per unit reference volume.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Material {
    /// c1 (ι₁ − 3) + c2 (ι₂ − 3).
    MooneyRivlin(MooneyRivlin),
    /// μ/2 (ι₁ − 3).
    NeoHookean(NeoHookean),
    /// Σ μ_p/α_p (Σ λ_i^α_p − 3), of the principal stretches λ_i.
    Ogden(Ogden),
    /// μ/(2b) (e^{b(ι₁ − 3)} − 1).
    Fung(Fung),
    /// μ/2 (ι₁ − 3) − μ ln J + λ/2 ln²J; compressible.
    NeoHookeanLog(NeoHookeanLog),
    /// λ/2 tr²E + μ E·E, E = (PᵀP − I)/2; compressible.
    StVenantKirchhoff(StVenantKirchhoff),
    /// μ |dev ln U|² + K/2 ln²J; compressible.
    Hencky(Hencky),
    /// κ |PᵀP − I|²; compressible.
    Orthogonality(Orthogonality),
    /// Soft rubber: `neo_hookean`, E = 1.5 MPa, incompressible, 1100 kg/m³.
    Rubber,
    /// Silicone: `neo_hookean`, E = 2 MPa, incompressible, 1030 kg/m³.
    Silicone,
    /// Nylon: `hencky`, E = 2.7 GPa, ν = 0.39, 1140 kg/m³.
    Nylon,
    /// Glass: `hencky`, E = 70 GPa, ν = 0.23, 2500 kg/m³.
    Glass,
    /// Aluminium: `hencky`, E = 70 GPa, ν = 0.33, 2700 kg/m³.
    Aluminium,
    /// Steel: `hencky`, E = 200 GPa, ν = 0.3, 7850 kg/m³.
    Steel,
}

impl Material {
    /// The law and the density \[kg/m³\] that a name stands for; none of a law that is written.
    ///
    /// E, ν and density within the ranges of Gere, *Mechanics of Materials*, tables H-1 and H-2, and Callister,
    /// *Materials Science and Engineering*, appendix B; silicone as Sylgard 184 by Johnston et al., *J. Micromech.
    /// Microeng.* 24, 035017 (2014), and its data sheet.
    pub(crate) fn named(&self) -> Option<(Self, f64)> {
        let rubbery = |youngs_modulus: f64| {
            Self::NeoHookean(NeoHookean {
                shear: None,
                bulk: None,
                youngs_modulus: Some(Positive(Pressure(youngs_modulus))),
                poissons_ratio: Some(0.5),
            })
        };
        let stiff = |youngs_modulus: f64, ratio: f64| {
            Self::Hencky(Hencky {
                shear: None,
                bulk: None,
                youngs_modulus: Some(Positive(Pressure(youngs_modulus))),
                poissons_ratio: Some(ratio),
            })
        };
        match self {
            Self::Rubber => Some((rubbery(1.5e6), 1100.0)),
            Self::Silicone => Some((rubbery(2e6), 1030.0)),
            Self::Nylon => Some((stiff(2.7e9, 0.39), 1140.0)),
            Self::Glass => Some((stiff(70e9, 0.23), 2500.0)),
            Self::Aluminium => Some((stiff(70e9, 0.33), 2700.0)),
            Self::Steel => Some((stiff(200e9, 0.3), 7850.0)),
            Self::MooneyRivlin(_)
            | Self::NeoHookean(_)
            | Self::Ogden(_)
            | Self::Fung(_)
            | Self::NeoHookeanLog(_)
            | Self::StVenantKirchhoff(_)
            | Self::Hencky(_)
            | Self::Orthogonality(_) => None,
        }
    }
}

/// Mooney–Rivlin; shear modulus 2(c1 + c2).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MooneyRivlin {
    /// c₁ (Pa).
    pub c1: NonNegative<Pressure>,
    /// c₂ (Pa).
    pub c2: NonNegative<Pressure>,
    /// Bulk modulus K (Pa); incompressible without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bulk: Option<Positive<Pressure>>,
}

/// Neo-Hookean: Mooney–Rivlin with c1 = shear/2, c2 = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NeoHookean {
    /// Shear modulus μ (Pa).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear: Option<NonNegative<Pressure>>,
    /// Bulk modulus K (Pa); incompressible without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bulk: Option<Positive<Pressure>>,
    /// Young's modulus E (Pa), with `poissons_ratio` in the place of `shear` and `bulk`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Positive<Pressure>>,
    /// Poisson's ratio ν, above −1, at most 0.5: incompressible.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poissons_ratio: Option<f64>,
}

/// Ogden; shear modulus ½ Σ mu·alpha.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ogden {
    /// μ_p of each term (Pa), of the sign of its α_p.
    #[schemars(length(min = 1))]
    pub mu: Vec<Pressure>,
    /// α_p of each term, not 0; as many as there are in mu.
    #[schemars(length(min = 1))]
    pub alpha: Vec<f64>,
    /// Bulk modulus K (Pa); incompressible without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bulk: Option<Positive<Pressure>>,
}

/// Fung: stiffens exponentially.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fung {
    /// Shear modulus at rest μ (Pa).
    pub shear: NonNegative<Pressure>,
    /// b > 0.
    pub exponent: Positive<f64>,
    /// Bulk modulus K (Pa); incompressible without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bulk: Option<Positive<Pressure>>,
}

/// Neo-Hookean with ln J.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NeoHookeanLog {
    /// Lamé's μ, the shear modulus (Pa).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mu: Option<NonNegative<Pressure>>,
    /// Lamé's λ (Pa).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lambda: Option<NonNegative<Pressure>>,
    /// Young's modulus E (Pa), with `poissons_ratio` in the place of `mu` and `lambda`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Positive<Pressure>>,
    /// Poisson's ratio ν, from 0 to below 0.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poissons_ratio: Option<f64>,
}

/// St Venant–Kirchhoff: soft, in the end unstable, under strong compression.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StVenantKirchhoff {
    /// Lamé's λ (Pa), at least −2/3 mu.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lambda: Option<Pressure>,
    /// Lamé's μ, the shear modulus (Pa).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mu: Option<NonNegative<Pressure>>,
    /// Young's modulus E (Pa), with `poissons_ratio` in the place of `mu` and `lambda`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Positive<Pressure>>,
    /// Poisson's ratio ν, above −1 and below 0.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poissons_ratio: Option<f64>,
}

/// Hencky: quadratic in the logarithmic strain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hencky {
    /// Shear modulus μ (Pa).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear: Option<NonNegative<Pressure>>,
    /// Bulk modulus K (Pa).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bulk: Option<NonNegative<Pressure>>,
    /// Young's modulus E (Pa), with `poissons_ratio` in the place of `shear` and `bulk`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Positive<Pressure>>,
    /// Poisson's ratio ν, above −1 and below 0.5.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poissons_ratio: Option<f64>,
}

/// The orthogonality energy of affine body dynamics: St Venant–Kirchhoff with λ = 0, μ = 4κ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Orthogonality {
    /// κ (Pa).
    pub kappa: NonNegative<Pressure>,
}
