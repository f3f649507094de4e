//! Many runs of one model, each from a start of its own.
//!
//! Runs know nothing of each other: the endings are the same, and in the order of the starts, however many threads share
//! the work. Nothing is recorded but the end of each run.

use crate::events::Event;
use crate::outcome::Outcome;
use crate::plan::RunPlan;
use crate::ports::{RunError, Sink};
use crate::record::Unwatched;
use crate::run::Simulation;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::Statistics;
use gyration_record::RecordError;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How one run of an ensemble ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Ending {
    /// Why it ended.
    pub outcome: Outcome,
    /// The state at its end.
    pub state: State,
    /// The counters of its solver.
    pub statistics: Statistics,
    /// How many events of each kind.
    pub events: [u64; 3],
}

/// Runs a model from each start to its ending, on so many threads; the endings stand in the order of the starts.
///
/// A start outside the model fails alone.
pub fn run_all(model: &Model, plan: RunPlan, starts: &[State], threads: NonZeroUsize) -> Vec<Result<Ending, RunError>> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut endings = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(start) = starts.get(index) else { return endings };
            endings.push((index, run_one(model, plan, start)));
        }
    };
    let mut endings = if threads.get() == 1 {
        work()
    } else {
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads.get().min(starts.len())).map(|_| scope.spawn(work)).collect();
            let join = |worker: std::thread::ScopedJoinHandle<_>| match worker.join() {
                Ok(endings) => endings,
                Err(panic) => std::panic::resume_unwind(panic),
            };
            workers.into_iter().flat_map(join).collect::<Vec<_>>()
        })
    };
    endings.sort_by_key(|(index, _)| *index);
    endings.into_iter().map(|(_, ending)| ending).collect()
}

/// Runs a model from one start to its ending.
///
/// # Errors
/// [`RunError::Start`] if the start is outside the model.
pub fn run_one(model: &Model, plan: RunPlan, start: &State) -> Result<Ending, RunError> {
    let mut simulation = Simulation::new(model, start, plan)?;
    simulation.begin(&mut Nothing)?;
    let outcome = simulation.run(&mut Nothing, &mut Unwatched)?;
    let (statistics, events) = (*simulation.statistics(), simulation.tally().events);
    Ok(Ending { outcome, state: simulation.state(), statistics, events })
}

/// Keeps nothing.
struct Nothing;

impl Sink for Nothing {
    fn row(&mut self, _: f64, _: &[f64]) -> Result<(), RecordError> {
        Ok(())
    }

    fn event(&mut self, _: &Event) -> Result<(), RecordError> {
        Ok(())
    }

    fn step_end(&mut self, _: &dyn Fn() -> Vec<u8>) -> Result<(), RecordError> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Job, Provenance};
    use gyration_scene::Scene;

    #[test]
    fn endings_are_in_order_and_the_same_on_any_number_of_threads() {
        let scene = Scene::open("bounce", &["time.end=0.5".into()]).unwrap();
        let job = Job::of(&scene, &Provenance { version: String::new(), commit: None });
        let starts: Vec<State> = (0..7)
            .map(|k| {
                let mut start = job.start.clone();
                // The fourth begins below the table.
                start.bodies[2] = if k == 3 { -1.0 } else { 0.1 + 0.05 * f64::from(k) };
                start
            })
            .collect();
        let endings = |threads: usize| {
            let endings = run_all(job.model, job.plan, &starts, NonZeroUsize::new(threads).unwrap());
            endings.into_iter().map(Result::ok).collect::<Vec<_>>()
        };
        let alone = endings(1);
        assert_eq!(alone, endings(3));
        assert_eq!(alone.iter().map(Option::is_some).collect::<Vec<_>>(), [true, true, true, false, true, true, true]);
        let last = run_one(job.model, job.plan, &starts[6]).unwrap();
        assert_eq!(alone[6], Some(last));
    }
}
