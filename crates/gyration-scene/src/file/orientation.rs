//! How a body or a part of it is turned: the rotation R from its own axes to those of space.

use crate::quantity::Angle;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rotation, in one of three ways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Orientation {
    /// A turn about an axis.
    AxisAngle(AxisAngle),
    /// A quaternion [w, x, y, z]; need not be of unit length.
    Quaternion([f64; 4]),
    /// Turns about the fixed axes x, then y, then z: R = Rz·Ry·Rx.
    EulerXyz([Angle; 3]),
}

/// A turn about an axis, by the right-hand rule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisAngle {
    /// Axis; need not be of unit length.
    pub axis: [f64; 3],
    /// Angle (rad).
    pub angle: Angle,
}

/// Not turned.
impl Default for Orientation {
    fn default() -> Self {
        Self::Quaternion([1.0, 0.0, 0.0, 0.0])
    }
}
