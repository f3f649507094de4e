//! An island that is begun again from its restart point.

use crate::island::Island;
use crate::island::restart_point::RestartPoint;
use crate::plan::RunPlan;

impl Island {
    /// Keeps a restart point where it stands, or the one that it has; or none.
    pub fn keep_restart_point(&mut self, keeps: bool) {
        match (keeps, self.restart_point.is_some()) {
            (true, false) => self.restart_point = Some(RestartPoint::new(self.memory())),
            (false, true) => self.restart_point = None,
            (true, true) | (false, false) => {}
        }
    }

    /// Forgets what was done since the run was at a time.
    pub fn go_back(&mut self, plan: &RunPlan, time: f64) {
        let Some(restart_point) = &self.restart_point else { return };
        let kept = restart_point.kept().clone();
        let resumed = self.resume(&kept, plan, time);
        debug_assert!(resumed.is_ok(), "an island remembers itself");
    }
}
