//! The forces that a scene writes for one body, as formulas of its place and of time.

use super::Potential;

/// Forces of a body's own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OwnForces {
    /// V(p₀, P, t).
    pub potential: Option<Box<Potential>>,
}

impl OwnForces {
    /// Whether one of them may hold the body at a place.
    pub fn hold(&self) -> bool {
        self.potential.as_ref().is_some_and(|potential| potential.acts())
    }
}
