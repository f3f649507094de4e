//! A job on several ranks: the first one records, the others step their shares and write nothing.

use super::{Job, RecordingEnd};
use crate::ports::{Communicator, Monitor, RunError, Sink};
use crate::run::Simulation;
use crate::summary::RunSummary;
use gyration_record::Attributes;
use std::sync::Arc;

/// Keeps nothing.
pub(super) struct Nowhere;

impl Sink for Nowhere {}

impl Job<'_> {
    /// The same job on several ranks, each of which has opened the same scene: the first one records, the others step
    /// their shares. What the first one cannot do, as to write where it is to, the others are not told: whoever runs
    /// them ends all.
    #[must_use]
    pub fn on_ranks(self, ranks: Arc<dyn Communicator>) -> Self {
        Self { ranks: Some(ranks), ..self }
    }

    /// A run of this job, on its ranks if it has some.
    pub(super) fn shared_out(&self, simulation: Simulation) -> Simulation {
        match &self.ranks {
            Some(ranks) => simulation.on_ranks(ranks.clone()),
            None => simulation,
        }
    }

    /// Whether another rank records.
    pub(super) fn follows(&self) -> bool {
        self.ranks.as_ref().is_some_and(|ranks| ranks.rank() > 0)
    }

    /// Runs along with the rank that records.
    pub(super) fn follow(&self, mut simulation: Simulation, watch: &mut dyn Monitor) -> Result<RecordingEnd, RunError> {
        let outcome = simulation.run(&mut Nowhere, watch)?;
        Ok(RecordingEnd::Ran(Box::new(RunSummary::of(self.model, &mut simulation, outcome, None))))
    }

    /// The same from the checkpoint that this one tells of; none is told where there is nothing to resume.
    pub(super) fn follow_from_checkpoint(&self, watch: &mut dyn Monitor) -> Result<RecordingEnd, RunError> {
        let checkpoint = self.tell_checkpoint(&[])?;
        if checkpoint.is_empty() {
            return Ok(RecordingEnd::AlreadyFinished(Attributes::new()));
        }
        self.interruption().within(|| {
            let simulation = Simulation::resume(self.model, self.start, self.plan, &checkpoint)?;
            self.follow(self.shared_out(simulation), watch)
        })
    }

    /// Tells all ranks the checkpoint of the first one; that of the first one, empty without ranks.
    pub(super) fn tell_checkpoint(&self, own: &[u8]) -> Result<Vec<u8>, RunError> {
        let Some(ranks) = &self.ranks else { return Ok(Vec::new()) };
        let all = ranks.all_gather(own.to_vec()).map_err(|error| RunError::Ranks(error.to_string()))?;
        Ok(all.into_iter().next().unwrap_or_default())
    }
}
