//! `[[spring]]`: springs between bodies.

use super::lattice::CellOffset;
use crate::quantity::{Length, NonNegative, SpringDamping, Stiffness};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A spring and dashpot between points of two bodies, or of any two of groups.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpringBetween {
    /// Names of the two bodies, or of groups: any two different ones; in a lattice they may be one, and its image in
    /// another cell.
    pub between: [String; 2],
    /// In a lattice the cell of the second, as seen from that of the first; the same if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cell: Option<[CellOffset; 3]>,
    /// A point of each, relative to its centre of mass in its axes (m).
    #[serde(default)]
    pub points: [[Length; 3]; 2],
    /// Stiffness (N/m).
    pub stiffness: NonNegative<Stiffness>,
    /// Length without force (m).
    #[serde(default)]
    pub rest_length: NonNegative<Length>,
    /// Damping along the spring (N s/m).
    #[serde(default)]
    pub damping: NonNegative<SpringDamping>,
}
