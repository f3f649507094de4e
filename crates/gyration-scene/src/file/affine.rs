//! `affine`: a body that deforms homogeneously, what it is made of, and what resists its motion.
//!
//! Matrices of friction are pure numbers in SI units. Rows and columns: 12×12 on (velocity of the centre of mass;
//! velocity gradient L, row by row), 6×6 on sym L in the order xx, yy, zz, yz, xz, xy.

use super::Material;
use crate::quantity::{EulerMoment, NonNegative, Torque, Viscosity};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A body that deforms homogeneously. Without a material it is free and compressible.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Affine {
    /// What it is made of; no elasticity if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<Material>,
    /// Viscosity μ (Pa s): the viscous Kirchhoff stress is μ sym L.
    pub viscosity: NonNegative<Viscosity>,
    /// Internal friction, Newtonian or anisotropic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub internal_friction: Option<InternalFriction>,
    /// Friction linear in the velocity and the velocity gradient.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_friction: Option<LinearFriction>,
    /// Loads linear in the velocity and the velocity gradient that do no work.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gyroscopic: Option<Gyroscopic>,
    /// An affine moment on the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub couple: Option<Couple>,
    /// Kinetic energy of the deformation; ½ tr(Ṗ J Ṗᵀ) if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kinetic: Option<Kinetic>,
}

/// A kinetic energy of W = P⁻¹Ṗ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kinetic {
    /// ½ tr(W J Wᵀ).
    Comoving,
    /// ½ (A tr W² + B (tr W)²).
    Invariant(InvariantKinetic),
}

/// The constants of ½ (A tr W² + B (tr W)²).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InvariantKinetic {
    /// A (kg m²), not zero.
    #[serde(rename = "A")]
    pub square: EulerMoment,
    /// B (kg m²); A + 3B is not zero.
    #[serde(rename = "B")]
    pub trace: EulerMoment,
}

/// Internal friction: `shear` and `bulk`, or a `matrix`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct InternalFriction {
    /// η (Pa s): the Cauchy stress is 2η dev(sym L) + ζ tr(L) I.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear: Option<NonNegative<Viscosity>>,
    /// ζ (Pa s).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bulk: Option<NonNegative<Viscosity>>,
    /// A 6×6 matrix (Pa s) that takes (L_xx, L_yy, L_zz, 2L_yz, 2L_xz, 2L_xy) to the Cauchy stress, in axes that turn
    /// with the body; symmetric, positive semi-definite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[[f64; 6]; 6]>,
}

/// Friction −H (velocity; L row by row).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearFriction {
    /// H, 12×12 in SI units; symmetric, positive semi-definite. An entry in quotes is an expression of x, y, z, P_xx …
    /// P_zz and t.
    pub matrix: [[Entry; 12]; 12],
    /// Factor of H: a number or an expression of x, y, z, P_xx … P_zz and t, never negative.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Entry>,
    /// The axes in which H is constant.
    #[serde(default)]
    pub frame: Frame,
}

/// A number, or an expression in quotes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Entry {
    /// A number.
    Number(f64),
    /// An expression.
    Expression(Box<str>),
}

impl JsonSchema for Entry {
    fn schema_name() -> Cow<'static, str> {
        "Entry".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or a string with an expression.", "type": ["number", "string"],
            "expression": true, "examples": ["1 + x^2"],
        })
    }
}

impl Entry {
    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Expression(_) => None,
        }
    }
}

impl LinearFriction {
    /// H, if it is the same at all places and times.
    pub(crate) fn constant(&self) -> Option<[[f64; 12]; 12]> {
        let scale = self.scale.as_ref().map_or(Some(1.0), Entry::number)?;
        self.numbers().map(|rows| rows.map(|row| row.map(|entry| scale * entry)))
    }

    /// The matrix, if it has numbers alone.
    pub(crate) fn numbers(&self) -> Option<[[f64; 12]; 12]> {
        let mut numbers = [[0.0; 12]; 12];
        for (row, entries) in numbers.iter_mut().zip(&self.matrix) {
            for (number, entry) in row.iter_mut().zip(entries) {
                *number = entry.number()?;
            }
        }
        Some(numbers)
    }
}

/// A load −H (velocity; L row by row) that does no work.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gyroscopic {
    /// H, 12×12 in SI units; skew.
    pub matrix: [[f64; 12]; 12],
    /// The axes in which H is constant.
    #[serde(default)]
    pub frame: Frame,
}

/// The axes in which a matrix is constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Frame {
    /// Axes fixed in space.
    #[default]
    Space,
    /// Axes that turn with the body.
    Body,
}

/// An affine moment N on the body, its power being tr(N L).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Couple {
    /// The same at all times (N m).
    Value([[Torque; 3]; 3]),
    /// A CSV file, relative to the scene: rows of t (s) and the nine entries (N m), row by row; linear between them.
    Table(String),
}
