//! `[world]`: what acts on all bodies.

use crate::defaults::GRAVITY;
use crate::quantity::{Acceleration, GravitationalConstant, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What acts on all bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct World {
    /// Acceleration of gravity g (m/s²).
    pub gravity: [Acceleration; 3],
    /// The gravity of each body that deforms on itself, a sphere or an ellipsoid; none if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub self_gravity: Option<SelfGravity>,
}

/// The gravity of bodies on themselves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SelfGravity {
    /// Constant of gravitation G (N m²/kg²).
    pub constant: Positive<GravitationalConstant>,
}

impl Default for World {
    fn default() -> Self {
        Self { gravity: GRAVITY.map(Acceleration), self_gravity: None }
    }
}
