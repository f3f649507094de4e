//! `contractile`: a body that deforms homogeneously and drives itself, P = F G.
//!
//! F is elastic, G is the contraction: μ_γ Ġ G⁻¹ = Fᵀ S Gᵀ − det G φ I + Q. All keys of `affine` apply, the material
//! being one of F. Q is a `drive` in time, or `feedback`, or both; instead of it G may be `prescribed`.

use super::{Affine, Rows, Signal};
use crate::quantity::{Positive, Pressure, Viscosity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A body that deforms homogeneously and contracts by itself.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
// Beside keys taken over from another table serde cannot deny unknown ones; the schema does, and with it the check.
#[schemars(deny_unknown_fields)]
#[serde(default)]
pub struct Contractile {
    /// What it has in common with an affine body.
    #[serde(flatten)]
    pub affine: Affine,
    /// μ_γ (Pa s): how much stress it takes to contract; needed unless G is prescribed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contraction_viscosity: Option<Positive<Viscosity>>,
    /// Initial contraction G.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contraction: Option<[[f64; 3]; 3]>,
    /// Whether the contraction keeps its volume: det G stays as it starts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub isochoric: Option<bool>,
    /// Which part of the contraction velocity there is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spin: Option<Spin>,
    /// The drive Q in time (Pa).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drive: Option<Signal<Rows<Pressure>>>,
    /// The contraction G in time, instead of a drive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prescribed: Option<Signal<Rows<f64>>>,
    /// Drives that answer to what the body feels, one or several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feedback: Option<OneOrMany<Feedback>>,
}

/// Which part of the contraction velocity Ġ G⁻¹ there is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Spin {
    /// All of it.
    #[default]
    Full,
    /// Its symmetric part alone.
    Symmetric,
}

/// A part of the drive that is linear in a measure of the body: gain · measure + bias.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Feedback {
    /// What the body feels.
    pub measure: FeltMeasure,
    /// Rows of the gain in SI units: Pa per unit of the measure.
    pub gain: [[f64; 3]; 3],
    /// Rows of what is added (Pa).
    #[serde(default)]
    pub bias: [[Pressure; 3]; 3],
    /// The least and the largest value that the measure counts as, in SI units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<[f64; 2]>,
}

/// What a body feels of itself.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FeltMeasure {
    /// The smallest distance to a support (m).
    SupportGap,
    /// The same, as older files say it.
    Gap,
    /// The stretch of the body along a direction of its reference shape, which need not be of unit length.
    Stretch([f64; 3]),
    /// The rate of that stretch (1/s).
    Rate([f64; 3]),
}

impl FeltMeasure {
    /// Whether it is the distance to a support, in either word.
    pub fn is_support_gap(&self) -> bool {
        matches!(self, Self::SupportGap | Self::Gap)
    }
}

/// One, or an array of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "OneOrMany{T}")]
#[serde(untagged)]
pub enum OneOrMany<T> {
    /// One.
    One(T),
    /// Any number.
    Many(Vec<T>),
}

impl<T> OneOrMany<T> {
    /// All of them.
    pub fn as_slice(&self) -> &[T] {
        match self {
            Self::One(one) => std::slice::from_ref(one),
            Self::Many(many) => many,
        }
    }
}
