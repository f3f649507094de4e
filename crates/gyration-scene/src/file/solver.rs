//! `[solver]`: tolerances and method; all optional.

use crate::quantity::{Duration, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Tolerances and method of the solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// Relative tolerance of a step.
    // Below, rounding drowns the error estimate; above, it is no estimate.
    #[schemars(range(min = 1e-14, max = 1e-2))]
    pub rtol: f64,
    /// Absolute tolerance of a step, as a fraction of scale: body size for lengths, one for P, own speed for
    /// velocities.
    // Above, what it lets pass is no error any more.
    #[schemars(range(min = 0, max = 1e-2))]
    pub atol: f64,
    /// How the equations are integrated.
    pub method: Method,
    /// The longest step (s); none by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_step: Option<Positive<Duration>>,
    /// The longest computing time (s); none by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wall_time: Option<Positive<Duration>>,
    /// How many threads share the bodies of a run out; all processors by default if there are more than a few. No
    /// number of a recording depends on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    // Numbers of a scene are read as reals; the structure is checked to hold a whole one.
    #[schemars(with = "Option<u16>", range(min = 1, max = 1024))]
    pub threads: Option<f64>,
}

impl Default for Solver {
    fn default() -> Self {
        Self { rtol: 1e-8, atol: 1e-10, method: Method::Auto, max_step: None, max_wall_time: None, threads: None }
    }
}

/// How the equations are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Explicit or implicit, as the stiffness asks.
    #[default]
    Auto,
    /// An explicit pair of high order.
    Explicit,
    /// An L-stable implicit method.
    Implicit,
}
