//! `[[joint]]`: exact constraints between two bodies, or a body and a support or space.

use super::affine::Entry;
use super::signal::Signal;
use crate::quantity::{AnyQuantity, Length, NonNegative, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A joint: an exact constraint between two bodies, or a body and space, whose force does no work.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name, by which it is recorded.
    pub name: String,
    /// Names of the two bodies, or of one and a support or "space".
    pub between: [String; 2],
    /// How it joins them.
    pub kind: JointWord,
    /// A point of each, relative to its centre of mass in its axes; of space, a place (m).
    #[serde(default)]
    pub points: [[Length; 3]; 2],
    /// Axis of a hinge or slider, in the axes of the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// Least and largest angle of a hinge (rad), or way of a slider along its axis (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<[AnyQuantity; 2]>,
    /// The field that keeps it within its limits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stop: Option<JointStop>,
    /// What drives a hinge or slider.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drive: Option<JointDrive>,
}

/// Repulsion and damping at the limits of a joint, by the distance to each.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointStop {
    /// Pushes back, α (d/d₀)^−ν.
    pub repulsion: StopRepulsion,
    /// Resists, β (d/d₀)^−ν times the rate; none if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<StopDamping>,
}

/// Torque or force α (d/d₀)^−ν at a limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopRepulsion {
    /// Strength α: of a hinge (N m), of a slider (N).
    pub alpha: NonNegative<AnyQuantity>,
    /// Exponent ν ≥ 1.
    pub nu: Positive<f64>,
    /// Reference distance d₀: of a hinge (rad), of a slider (m); one of these if absent.
    #[serde(default = "one")]
    pub d0: Positive<AnyQuantity>,
}

fn one() -> Positive<AnyQuantity> {
    Positive(AnyQuantity(1.0))
}

/// Torque or force β (d/d₀)^−ν per rate at a limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopDamping {
    /// Strength β: of a hinge (N m s), of a slider (N s/m).
    pub beta: NonNegative<AnyQuantity>,
    /// Exponent ν > 0.
    pub nu: Positive<f64>,
    /// Reference distance d₀: of a hinge (rad), of a slider (m); one of these if absent.
    #[serde(default = "one")]
    pub d0: Positive<AnyQuantity>,
}

/// What drives a hinge or slider.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointDrive {
    /// Torque on the second about the axis of a hinge (N m), of angle (rad), rate (rad/s) and t (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torque: Option<DriveLaw>,
    /// Force on the second along the axis of a slider (N), of distance (m), rate (m/s) and t (s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<DriveLaw>,
    /// Constants of its expression, before those of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constants: Option<BTreeMap<String, AnyQuantity>>,
}

/// A number, an expression of the coordinate, its rate and time, or a signal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum DriveLaw {
    /// A number, or an expression.
    Feedback(Entry),
    /// A torque (N m) or force (N) in time.
    Signal(Signal<AnyQuantity>),
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
