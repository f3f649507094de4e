//! `keep` of a body: what its motion is kept to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the motion of a body is kept to, one of these; a reaction that takes no power does it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Keep {
    /// The plane through its centre of mass with this normal: it moves as its own mirror image does.
    Plane([f64; 3]),
    /// It turns about this axis of space only; its centre is free. Of a rigid body.
    Axis([f64; 3]),
    /// Its centre of mass moves along this line only; it turns and deforms freely.
    Line([f64; 3]),
    /// `true`: it strains without rotation; a rigid body does not turn.
    StretchOnly(bool),
}
