//! Values in time: the drive of a contractile body, a contraction that is prescribed, the flow, and what drives a
//! joint.
//!
//! `V` is the value: the rows of a tensor (pressures of a drive Q, pure numbers of a contraction G, rates of a flow), a
//! velocity, or the torque or force of a joint. A travelling pattern is a sum of sines of one frequency with different
//! phases.

use crate::quantity::{Angle, Duration, Frequency, NonNegative, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The rows of a tensor.
pub type Rows<T> = [[T; 3]; 3];

/// A value in time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "SignalOf{V}")]
#[serde(rename_all = "snake_case")]
pub enum Signal<V> {
    /// The same at all times.
    Constant(Constant<V>),
    /// amplitude · sin(2π·frequency·t + phase).
    Sine(Wave<V>),
    /// amplitude where that sine is above zero, −amplitude where it is below.
    Square(Wave<V>),
    /// Linear in time from one value to another, which then stays.
    Ramp(Ramp<V>),
    /// Read from a file.
    Table(Table),
    /// All of these added.
    Sum(#[schemars(length(min = 1))] Vec<Signal<V>>),
}

/// A value that does not change.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "ConstantOf{V}")]
#[serde(deny_unknown_fields)]
pub struct Constant<V> {
    /// It; of a tensor its rows.
    pub value: V,
}

/// A value that repeats itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "WaveOf{V}")]
#[serde(deny_unknown_fields)]
pub struct Wave<V> {
    /// The value at the highest; of a tensor its rows.
    pub amplitude: V,
    /// Frequency (Hz).
    pub frequency: NonNegative<Frequency>,
    /// Phase (rad).
    #[serde(default)]
    pub phase: Angle,
}

/// A value that changes steadily for a while, from t = 0 on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "RampOf{V}")]
#[serde(deny_unknown_fields)]
pub struct Ramp<V> {
    /// The value at t = 0, of a tensor its rows; at rest if absent: the identity of a contraction, else zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<V>,
    /// The value from t = duration on; of a tensor its rows.
    pub to: V,
    /// How long it takes (s).
    pub duration: Positive<Duration>,
}

/// A value given at times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// A CSV file, relative to the scene: rows of t (s) and the value in SI units, of a tensor nine entries, row by
    /// row, from 0 to the end of the run.
    pub file: String,
    /// What it does between its times.
    #[serde(default)]
    pub interpolation: Interpolation,
}

/// What a table does between its times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// Straight lines.
    #[default]
    Linear,
    /// The natural cubic spline, twice differentiable.
    Cubic,
}
