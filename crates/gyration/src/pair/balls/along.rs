//! What acts between two balls along the line of their centres.

use super::Repelled;
use crate::pair::placed::Switch;

/// What acts along the line of centres, and how it changes with the slab.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Along {
    /// F, apart positive [N].
    pub force: f64,
    /// dF/dg [N/m].
    pub force_by_gap: f64,
    /// The force times the lever of each ball [N m].
    pub moments: [f64; 2],
    /// How these change with g [N].
    pub moments_by_gap: [f64; 2],
}

impl Along {
    /// The repulsion, without derivatives.
    pub fn of_repulsion(repelled: &Repelled, switch: &Switch) -> Self {
        let force = switch.slope * repelled.force;
        let moments = repelled.balls.each_ref().map(|ball| force * ball.lever());
        Self { force, moments, ..Self::default() }
    }

    /// Both together.
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            force: self.force + other.force,
            force_by_gap: self.force_by_gap + other.force_by_gap,
            moments: [0, 1].map(|i| self.moments[i] + other.moments[i]),
            moments_by_gap: [0, 1].map(|i| self.moments_by_gap[i] + other.moments_by_gap[i]),
        }
    }
}
