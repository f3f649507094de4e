//! Tensors in time: the drive of a contractile body, and a contraction that is prescribed.
//!
//! `T` is what an entry of the tensor is: a pressure of a drive Q, a pure number of a contraction G. A travelling
//! pattern is a sum of sines of one frequency with different phases.

use crate::quantity::{Angle, Duration, Frequency, NonNegative, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A 3×3 tensor in time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "SignalOf{T}")]
#[serde(rename_all = "snake_case")]
pub enum Signal<T> {
    /// The same at all times.
    Constant(Constant<T>),
    /// amplitude · sin(2π·frequency·t + phase).
    Sine(Wave<T>),
    /// amplitude where that sine is above zero, −amplitude where it is below.
    Square(Wave<T>),
    /// Linear in time from one value to another, which then stays.
    Ramp(Ramp<T>),
    /// Read from a file.
    Table(Table),
    /// All of these added.
    Sum(#[schemars(length(min = 1))] Vec<Signal<T>>),
}

/// A tensor that does not change.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "ConstantOf{T}")]
#[serde(deny_unknown_fields)]
pub struct Constant<T> {
    /// Its rows.
    pub value: [[T; 3]; 3],
}

/// A tensor that repeats itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "WaveOf{T}")]
#[serde(deny_unknown_fields)]
pub struct Wave<T> {
    /// Its rows at the highest.
    pub amplitude: [[T; 3]; 3],
    /// Frequency (Hz).
    pub frequency: NonNegative<Frequency>,
    /// Phase (rad).
    #[serde(default)]
    pub phase: Angle,
}

/// A tensor that changes steadily for a while, from t = 0 on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "RampOf{T}")]
#[serde(deny_unknown_fields)]
pub struct Ramp<T> {
    /// Its rows at t = 0; at rest if absent: zero of a drive, the identity of a contraction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<[[T; 3]; 3]>,
    /// Its rows from t = duration on.
    pub to: [[T; 3]; 3],
    /// How long it takes (s).
    pub duration: Positive<Duration>,
}

/// A tensor given at times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// A CSV file, relative to the scene: rows of t (s) and the nine entries in SI units, row by row, from 0 to the end
    /// of the run.
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
