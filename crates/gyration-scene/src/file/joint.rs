//! `[[joint]]`: exact constraints between two bodies, or a body and space.

use crate::quantity::Length;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A joint: an exact constraint between two bodies, or a body and space, whose force does no work.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name, by which it is recorded.
    pub name: String,
    /// Names of the two bodies, or of one and "space".
    pub between: [String; 2],
    /// How it joins them.
    pub kind: JointWord,
    /// A point of each, relative to its centre of mass in its axes; of space, a place (m).
    #[serde(default)]
    pub points: [[Length; 3]; 2],
    /// Axis of a hinge or slider, in the axes of the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
}

/// How a joint joins two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointWord {
    /// The points stay together.
    Ball,
    /// The points stay together, and the second turns about the axis alone.
    Hinge,
    /// The second moves along the axis alone, without turning.
    Slider,
    /// The second does not move beside the first.
    Weld,
    /// The points stay at the distance of the start.
    Distance,
}
