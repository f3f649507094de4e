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
}

impl Default for Solver {
    fn default() -> Self {
        Self { rtol: 1e-8, atol: 1e-10, method: Method::Auto, max_step: None, max_wall_time: None }
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
