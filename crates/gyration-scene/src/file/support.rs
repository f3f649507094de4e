//! `[[support]]`: planes and solids that bodies can touch, fixed or moving.

use super::{OneOrMany, Orientation, Shape};
use crate::quantity::{Angle, AngularVelocity, Frequency, Length, NonNegative, Velocity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A plane, or a solid, that bodies can touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// Its name, `[A-Za-z0-9_-]+`.
    pub name: String,
    /// The plane; bodies are on the side to which the normal points. Or a `shape`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<Plane>,
    /// Its shape, a convex one or a union of such; instead of a `plane`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Shape>,
    /// Where the centre of mass of its shape is before any motion (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<[Length; 3]>,
    /// How its shape is turned before any motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Orientation>,
    /// How it moves, or a list of motions that add up; fixed if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<OneOrMany<Motion>>,
}

/// A plane: gap of a point p is (p − origin)·normal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plane {
    /// A point of the plane (m).
    pub origin: [Length; 3],
    /// Direction to the side of the bodies; need not be of unit length.
    pub normal: [f64; 3],
}

impl Default for Plane {
    fn default() -> Self {
        Self { origin: Default::default(), normal: [0.0, 0.0, 1.0] }
    }
}

/// The prescribed motion of a support.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// A sinusoidal displacement.
    Oscillate(Oscillation),
    /// A constant velocity (m/s).
    Velocity([Velocity; 3]),
    /// A turn at a constant rate.
    Rotate(Rotation),
}

/// A turn about an axis, by the right-hand rule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rotation {
    /// Axis; need not be of unit length.
    pub axis: [f64; 3],
    /// A point of the axis before any motion (m).
    #[serde(default)]
    pub point: [Length; 3],
    /// Angular velocity about it (rad/s).
    pub rate: AngularVelocity,
}

/// The displacement direction · amplitude · sin(2π·frequency·t + phase).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Oscillation {
    /// Direction; need not be of unit length.
    pub direction: [f64; 3],
    /// Amplitude (m).
    pub amplitude: Length,
    /// Frequency (Hz).
    pub frequency: NonNegative<Frequency>,
    /// Phase (rad).
    #[serde(default)]
    pub phase: Angle,
}
