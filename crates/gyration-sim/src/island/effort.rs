//! What a window costs, in steps of single bodies: those that stand, and those that were made anew.

use std::ops::AddAssign;

/// Steps of bodies in a window.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Effort {
    /// All that were made.
    pub made: u64,
    /// Those of them that stand.
    pub kept: u64,
}

impl Effort {
    /// Counts a step of an island of so many bodies.
    pub fn count(&mut self, bodies: usize) {
        self.made += bodies as u64;
        self.kept += bodies as u64;
    }

    /// Notes that an island has gone back to where it was before the window.
    pub fn forget(&mut self) {
        self.kept = 0;
    }
}

impl AddAssign for Effort {
    fn add_assign(&mut self, other: Self) {
        self.made += other.made;
        self.kept += other.kept;
    }
}
