//! The threads that run a scene again and again, as pages ask for it: one looks whether a run can begin with the
//! numbers asked for, the other runs. A number that is refused stops nothing.

use super::shared::LiveState;
use gyration::dynamics::Exchange;
use gyration_page::{NetworkTeller, WatchedRun, finish, progress};
use gyration_record::RecordError;
use gyration_scene::Scene;
use gyration_sim::events::Event;
use gyration_sim::{MemorySink, Monitor, Outcome, Progress, Provenance, Reason, RunError, Sink, WindowEnd};
use serde_json::json;
use std::time::{Duration, Instant};

/// Between two calls of the pages.
const NEWS_EVERY: Duration = Duration::from_millis(30);
/// Between two words on progress.
const PROGRESS_EVERY: Duration = Duration::from_millis(150);

/// Which scene, and which program runs it.
#[derive(Debug, Clone)]
pub(super) struct Subject {
    pub(super) scene: String,
    pub(super) provenance: Provenance,
}

/// Looks at what is asked for, for ever: what the scene takes is run, the rest refused in words.
pub(super) fn look(shared: &LiveState, subject: &Subject) {
    let mut given_up = None;
    loop {
        let overrides = shared.next_asked();
        let interruption = shared.until_overtaken();
        match interruption.within(|| accepted(subject, &overrides)) {
            Ok(scene) => {
                given_up = None;
                shared.supersede(scene);
            }
            // What was given up for other numbers is asked for again if those are refused.
            Err(_) if interruption.is_due().is_some() => given_up = Some(overrides),
            Err(problem) => {
                shared.store().problem(json!({ "message": problem, "set": overrides }));
                shared.announce();
                if let Some(before) = given_up.take() {
                    shared.ask_again(before);
                }
            }
        }
    }
}

/// The scene with these overrides, if a run of it can begin.
fn accepted(subject: &Subject, overrides: &[String]) -> Result<Scene, String> {
    let scene = gyration_sim::open(&subject.scene, overrides).map_err(|error| error.to_string())?;
    WatchedRun::of(&scene, &subject.provenance).begun(&mut MemorySink::default())?;
    Ok(scene)
}

/// Runs what is wanted, for ever.
pub(super) fn run(shared: &LiveState, subject: &Subject) {
    loop {
        let scene = shared.next_wanted();
        let interruption = shared.until_superseded();
        let ran = interruption.within(|| run_once(shared, subject, &scene));
        // What was given up for another run is nobody's problem.
        if let Err(problem) = ran
            && interruption.is_due().is_none()
        {
            shared.store().problem(json!({ "message": problem }));
        }
        shared.announce();
    }
}

/// Runs the scene once, or says in words why not.
fn run_once(shared: &LiveState, subject: &Subject, scene: &Scene) -> Result<(), String> {
    let watched = WatchedRun::of(scene, &subject.provenance);
    let mut first = MemorySink::default();
    let mut simulation = watched.begun(&mut first)?;
    shared.begin(|store| watched.publish(store));
    let mut sink = Publisher { shared, network: watched.network(), told: Instant::now() };
    let told = first.hand_on(&mut sink);
    let began = Instant::now();
    let mut watch = LiveMonitor { shared, told: Instant::now() };
    let outcome = told.map_err(RunError::from).and_then(|()| simulation.run(&mut sink, &mut watch));
    let outcome = outcome.map_err(|error| error.to_string())?;
    if !is_superseded(&outcome) {
        finish(&mut shared.store(), &mut simulation, outcome, (Some(began.elapsed()), None));
    }
    Ok(())
}

/// Whether the run was left for another.
fn is_superseded(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Stopped(stop) if stop.reason == Reason::Interrupted)
}

/// Publishes rows and events.
struct Publisher<'a> {
    shared: &'a LiveState,
    network: Option<NetworkTeller>,
    told: Instant,
}

impl Sink for Publisher<'_> {
    fn exchanges(&mut self, exchanges: &[Exchange]) -> Result<(), RecordError> {
        if let Some(network) = &self.network {
            network.tell(&mut self.shared.store(), exchanges);
        }
        Ok(())
    }

    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        self.shared.store().row(time, row);
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        let Event { time, kind, body } = *event;
        self.shared.store().event(gyration_record::Event { time, kind, body: Some(body) });
        Ok(())
    }

    fn window_end(&mut self, _: &dyn WindowEnd) -> Result<(), RecordError> {
        if self.told.elapsed() >= NEWS_EVERY {
            self.told = Instant::now();
            self.shared.announce();
        }
        Ok(())
    }
}

/// Halts the run while it is paused, ends it for another, and says how far it is.
struct LiveMonitor<'a> {
    shared: &'a LiveState,
    told: Instant,
}

impl Monitor for LiveMonitor<'_> {
    fn after_step(&mut self, now: &Progress) -> Option<Reason> {
        if self.told.elapsed() >= PROGRESS_EVERY {
            self.told = Instant::now();
            self.shared.store().progress(progress(now));
        }
        self.shared.is_superseded().then_some(Reason::Interrupted)
    }
}
