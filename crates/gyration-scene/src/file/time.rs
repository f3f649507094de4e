//! `[time]`: how long a run lasts and how often it is recorded.

use crate::quantity::{Duration, Positive, Velocity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How long a run lasts and how often it is recorded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// The time at which the run ends (s); it starts at zero.
    pub end: Positive<Duration>,
    /// Spacing of the recorded samples (s); the solver picks its own steps.
    pub sample: Positive<Duration>,
    /// Ends the run early, once all bodies rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stop_at_rest: Option<StopAtRest>,
}

/// When the bodies count as resting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopAtRest {
    /// Speed below which the fastest material point has to stay (m/s).
    pub speed: Positive<Velocity>,
    /// For how long (s).
    pub hold: Positive<Duration>,
}
