//! `[[bond]]`: potentials and dashpots between two bodies, or one and its image in another cell.

use super::contractile::OneOrMany;
use super::lattice::CellOffset;
use crate::quantity::{AnyQuantity, Length, NonNegative, SpringDamping};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A bond between points of two bodies: one of `law`, `potential` and `stiffness`, or `damping` alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bond {
    /// Names of the two bodies; in a lattice they may be one, and its image in another cell.
    pub between: [String; 2],
    /// In a lattice the cell of the second, as seen from that of the first; the same if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cell: Option<[CellOffset; 3]>,
    /// A point of each, relative to its centre of mass in its axes (m).
    #[serde(default)]
    pub points: [[Length; 3]; 2],
    /// V (J), an expression of l (m), the distance of the points, and t (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub law: Option<String>,
    /// V (J), an expression of d_x d_y d_z, H_xx …, C_xx …, D_xx … and t (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub potential: Option<String>,
    /// Stiffness along the axis and across it (N/m), of torsion and bending (N m): six numbers, or rows of 6×6.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<OneOrMany<[AnyQuantity; 6]>>,
    /// The axis of the stiffness, and the first direction across it; from centre to centre if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axes: Option<[[f64; 3]; 2]>,
    /// Damping on the relative velocity of the points (N s/m), or rows of 6×6 in the axes of the stiffness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<BondDamping>,
    /// Constants of its expressions, before those of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constants: Option<BTreeMap<String, AnyQuantity>>,
}

/// A number, or rows of 6×6.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum BondDamping {
    /// Rows (N s/m, N m s).
    Matrix(Box<[[AnyQuantity; 6]; 6]>),
    /// On the relative velocity of the points (N s/m).
    Number(NonNegative<SpringDamping>),
}
