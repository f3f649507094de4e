//! A run on several ranks, processes that need not share a memory: each steps a share of the islands that are behind,
//! and then all learn what these have become.
//!
//! What an island does depends on its own bodies alone, so that anybody may step it. Every rank has all islands before
//! and behind a share-out; whatever else a run does, changes of islands, rows and events, each rank does by itself from
//! the same numbers. Shares follow from the islands alone and leave no trace, as threads do not. When to stop is asked
//! of all ranks at once: an interruption on one of them ends the run on all in the same window.

use super::Simulation;
use crate::island::Island;
use crate::outcome::{Reason, Stop};
use crate::plan::RunPlan;
use crate::ports::{Communicator, Monitor, RunError, Sink};
use gyration_threads::Interruption;
use std::cmp::Reverse;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

/// So many islands of a rank are told of at once at most: some megabytes.
const AT_ONCE: usize = 1024;

/// The ranks of a run, as one of them sees them.
pub(crate) struct Ranks {
    communicator: Arc<dyn Communicator>,
    /// When this rank wants the run to stop, which all are asked together.
    interruption: Interruption,
    /// Whether a sink or a monitor of one of them wants windows that are steps.
    by_steps: bool,
}

/// The islands that each rank steps, by their first bodies, in order.
type Shares = Vec<Vec<usize>>;

impl Ranks {
    /// What all ranks say, in their order.
    fn gather(&self, own: Vec<u8>) -> Result<Vec<Vec<u8>>, RunError> {
        let all = self.communicator.all_gather(own).map_err(|error| RunError::Ranks(error.to_string()))?;
        if all.len() == self.communicator.size() { Ok(all) } else { Err(came_apart()) }
    }
}

/// Ranks that do not run the same scene with the same program.
fn came_apart() -> RunError {
    RunError::Ranks("they do not tell of the same islands".into())
}

impl Simulation {
    /// The same run on several ranks, each of which calls this, and then [`Simulation::run`], with the same model,
    /// start and plan. Rows and events are handed to the sinks of all of them.
    #[must_use]
    pub fn on_ranks(mut self, communicator: Arc<dyn Communicator>) -> Self {
        self.ranks = Some(Ranks { communicator, interruption: Interruption::default(), by_steps: false });
        self
    }

    /// Before the first window: notes the interruption in force, and asks whether all ranks are to do the same.
    pub(super) fn meet_ranks(&mut self, sink: &dyn Sink, monitor: &dyn Monitor) -> Result<(), RunError> {
        let by_steps = sink.wants_event_rows() || monitor.counts_steps();
        let mut hasher = DefaultHasher::new();
        format!("{:?}", RunPlan { threads: None, ..self.plan }).hash(&mut hasher);
        let state = self.state();
        state.time.to_bits().hash(&mut hasher);
        state.bodies.iter().for_each(|number| number.to_bits().hash(&mut hasher));
        let Some(ranks) = &mut self.ranks else { return Ok(()) };
        ranks.interruption = Interruption::in_force();
        let own = [u64::from(by_steps), hasher.finish()].map(u64::to_le_bytes);
        let all = ranks.gather(own.as_flattened().to_vec())?;
        if all.iter().any(|other| other.get(8..) != Some(&own[1][..])) {
            return Err(RunError::Ranks("they were given different scenes".into()));
        }
        ranks.by_steps = all.iter().any(|other| other[..8] != [0; 8]);
        Ok(())
    }

    /// Whether windows are to be steps, for somebody who counts them or wants rows at events.
    pub(super) fn is_by_steps(&self, monitor: &dyn Monitor) -> bool {
        monitor.counts_steps() || self.ranks.as_ref().is_some_and(|ranks| ranks.by_steps)
    }

    /// The stop at a time [s], if a monitor, an interruption, or those of another rank ask for it; of several ranks
    /// that of the first.
    pub(super) fn asked(&self, time: f64, monitor: &mut dyn Monitor) -> Result<Option<Stop>, RunError> {
        let due = match &self.ranks {
            Some(ranks) => ranks.interruption.is_due(),
            None => Interruption::due(),
        };
        let mut reason = self.ask(monitor).or(due.map(Reason::from));
        if let Some(ranks) = &self.ranks {
            let all = ranks.gather(serde_json::to_vec(&reason).unwrap_or_default())?;
            let all = all.iter().map(|said| serde_json::from_slice::<Option<Reason>>(said));
            let all = all.collect::<Result<Vec<_>, _>>().map_err(|_| came_apart())?;
            reason = all.into_iter().flatten().next();
        }
        Ok(reason.map(|reason| Stop::by_request(time, reason)))
    }

    /// Which of the islands that are behind a time [s] each rank steps: dealt out in turns, those of many bodies first.
    /// None where they are so few that each rank steps all of them sooner than it learns of them.
    pub(super) fn shares(&self, until: f64) -> Option<Shares> {
        let ranks = self.ranks.as_ref()?;
        let size = ranks.communicator.size();
        let behind = self.partition.islands.iter().filter(|island| island.time() < until);
        let mut behind: Vec<(usize, usize)> =
            behind.map(|island| (island.members().len(), island.first_body())).collect();
        if size < 2 || behind.len() < size * ranks.communicator.least_share() {
            return None;
        }
        behind.sort_by_key(|(bodies, _)| Reverse(*bodies));
        let mut shares = vec![Vec::with_capacity(behind.len() / size + 1); size];
        behind.iter().enumerate().for_each(|(turn, (_, first))| shares[turn % size].push(*first));
        shares.iter_mut().for_each(|share| share.sort_unstable());
        Some(shares)
    }

    /// The number of this rank.
    pub(super) fn rank(&self) -> usize {
        self.ranks.as_ref().map_or(0, |ranks| ranks.communicator.rank())
    }

    /// Tells the other ranks what the islands of its share have become, and learns what theirs have.
    pub(super) fn exchange(&mut self, shares: &Shares) -> Result<(), RunError> {
        let own = self.rank();
        let Self { ranks: Some(ranks), partition, shared, plan, .. } = self else { return Ok(()) };
        let most = shares.iter().map(Vec::len).max().unwrap_or(0);
        for from in (0..most).step_by(AT_ONCE) {
            let piece = |share: &'_ Vec<usize>| share.iter().copied().skip(from).take(AT_ONCE).collect::<Vec<_>>();
            let mut bytes = Vec::new();
            piece(&shares[own]).into_iter().for_each(|first| partition.islands[first].pack(&mut bytes));
            let all = ranks.gather(bytes)?;
            for (_, (share, told)) in shares.iter().zip(&all).enumerate().filter(|(rank, _)| *rank != own) {
                let mut rest = &told[..];
                for first in piece(share) {
                    let island = &mut partition.islands[first];
                    island.unpack(&mut rest, plan).ok_or_else(came_apart)?;
                    shared.with_scratch(std::iter::once(island), Island::read_step_end);
                }
                if !rest.is_empty() {
                    return Err(came_apart());
                }
            }
        }
        Ok(())
    }
}
