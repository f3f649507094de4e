//! `[world]`: what acts on all bodies.

use crate::quantity::Acceleration;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What acts on all bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct World {
    /// Acceleration of gravity g (m/s²).
    pub gravity: [Acceleration; 3],
}

impl Default for World {
    fn default() -> Self {
        Self { gravity: [0.0, 0.0, -9.81].map(Acceleration) }
    }
}
