//! An island that is begun again from its anchor.

use crate::anchor::Anchor;
use crate::island::Island;
use crate::plan::RunPlan;

impl Island {
    /// Keeps an anchor where it stands, or the one that it has; or none.
    pub fn anchored(&mut self, is_anchored: bool) {
        match (is_anchored, self.anchor.is_some()) {
            (true, false) => self.anchor = Some(Anchor::new(self.memory())),
            (false, true) => self.anchor = None,
            (true, true) | (false, false) => {}
        }
    }

    /// Forgets what was done since the run was at a time.
    pub fn go_back(&mut self, plan: &RunPlan, time: f64) {
        let Some(anchor) = &self.anchor else { return };
        let kept = anchor.kept().clone();
        let resumed = self.resume(&kept, plan, time);
        debug_assert!(resumed.is_ok(), "an island remembers itself");
    }
}
