//! From where an island can be begun again: its memory before the last step that went past what was asked for.
//!
//! From there it goes on to the same bytes: after a kill, or when all that was done since must be forgotten because
//! another island cannot go on.

use crate::run_state::{IslandMemory, IslandState};
use gyration_ode::Integrator;

/// A step longer than this part of what is left to a time may go past it: the end of a run is reached by a step that is
/// a little longer than the one wanted.
const MAY_PASS: f64 = 0.5;

/// Memories of an island.
pub(crate) struct RestartPoint {
    /// That from which it would be begun again.
    kept: IslandMemory,
    /// Before the last step that went past what was asked for last, or may have; none yet if it is not newer.
    latest: IslandMemory,
    is_newer: bool,
}

impl RestartPoint {
    /// At the start.
    pub fn new(start: IslandMemory) -> Self {
        Self { latest: start.clone(), kept: start, is_newer: false }
    }

    /// That from which the island would be begun again.
    pub fn kept(&self) -> &IslandMemory {
        &self.kept
    }

    /// That of a commit to come, if it is not the one that is kept.
    pub fn latest(&self) -> Option<&IslandMemory> {
        self.is_newer.then_some(&self.latest)
    }

    /// Puts a memory in its place.
    pub fn put_latest(&mut self, latest: IslandMemory) {
        (self.latest, self.is_newer) = (latest, true);
    }

    /// Before a step towards a time.
    pub fn before_step(&mut self, state: &IslandState, integrator: &Integrator, until: f64) {
        if integrator.next_size() >= MAY_PASS * (until - integrator.time()) {
            self.latest.remember(state, integrator);
            self.is_newer = true;
        }
    }

    /// Once all islands have come to a time, behind which none will go back.
    pub fn commit(&mut self, state: &IslandState, integrator: &Integrator, time: f64) {
        if integrator.time() == time {
            return self.drop_at(state, integrator);
        }
        if std::mem::take(&mut self.is_newer) {
            std::mem::swap(&mut self.kept, &mut self.latest);
        }
    }

    /// Where the island is now.
    pub fn drop_at(&mut self, state: &IslandState, integrator: &Integrator) {
        self.kept.remember(state, integrator);
        self.is_newer = false;
    }
}
