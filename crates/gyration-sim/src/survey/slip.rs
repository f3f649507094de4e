//! What friction does to a body that rests on a support, as numbers; `slipping` finds them.

use serde::Serialize;

/// What friction does to a body on a support.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Slip {
    /// W/c_t: the speed at which viscous friction is as strong as the weight that presses [m/s].
    pub weight_speed: f64,
    /// Σ μN/W: the part of the weight that friction holds at most; none of viscous friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound: Option<f64>,
    /// Time in which slow rolling falls to 1/e [s]; none of what does not roll.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rolling_time: Option<f64>,
}

impl Slip {
    /// μ/c: what creeps under 1/√2 of the bound has that speed [m/s].
    pub fn creep(&self) -> Option<f64> {
        self.bound.map(|bound| bound * self.weight_speed)
    }
}
