//! What bodies that meet owe, whatever numbers they are made of: a scene that is refused with a place, or a survey and
//! first steps that come to an end, with rows of finite numbers, open gaps, and a momentum that stays.
//!
//! The bytes are numbers of a scene (`pairs/scene`). A second run goes on from a checkpoint of the first, to the same
//! rows.

#[path = "pairs/numbers.rs"]
mod numbers;
#[path = "pairs/scene.rs"]
mod scene;
#[path = "pairs/shapes.rs"]
mod shapes;

use gyration_scene::Scene;
use gyration_sim::survey::Survey;
use gyration_sim::{Job, MemorySink, Monitor, Outcome, Progress, Provenance, Reason, RunError, RunSummary, Simulation};
use gyration_threads::Interruption;
use scene::Asked;
use std::path::Path;
use std::time::Duration;

/// Windows of a run, each one step of the bodies that have come least far.
const WINDOWS: usize = 12;
/// Evaluations of the rates after which a run is ended too: a step that is refused over and over takes many.
const EVALUATIONS: u64 = 200;
/// For how long an input is followed [s].
const LONGEST: Duration = Duration::from_secs(1);
/// The part of the momentum of all bodies that rounding may take: thousands of sums, and bodies that for a moment are
/// ten times as fast as in any row.
const ROUNDING: f64 = 1e-10;

/// Makes a scene of the bytes, and runs it.
pub fn check(bytes: &[u8]) {
    let asked = scene::scene(bytes, WINDOWS);
    Interruption::default().after(Some(LONGEST)).within(|| follow(&asked));
}

fn follow(asked: &Asked) {
    let scene = match Scene::parse("scene.json", &asked.text, Path::new("/nowhere"), &[]) {
        Ok(scene) => scene,
        Err(errors) => {
            assert!(errors.count() > 0);
            return errors.into_iter().for_each(|error| assert!(error.line > 0 && !error.message.is_empty()));
        }
    };
    if asked.is_surveyed {
        survey(&scene);
    }
    let job = Job::of(&scene, &Provenance { version: "fuzz".into(), commit: None });
    let mut kept = MemorySink::default();
    let whole = Simulation::new(job.model, job.start, job.plan);
    let begun = whole.and_then(|mut whole| whole.begin(&mut kept).map(|()| whole));
    match begun {
        Ok(whole) => run(&job, whole, kept, asked),
        Err(error) => assert!(names_something(&error), "{error}"),
    }
}

fn survey(scene: &Scene) {
    match Survey::of(scene) {
        Ok(survey) => assert!(survey.text(scene).is_ok_and(|text| !text.is_empty())),
        Err(errors) => assert!(errors.count() > 0),
    }
}

/// Whether it is told what cannot be done, and what else to do.
fn names_something(error: &RunError) -> bool {
    match error {
        RunError::Start(stop) | RunError::Interrupted(stop) => !stop.what.is_empty() && !stop.advice.is_empty(),
        RunError::Checkpoint(what) => !what.is_empty(),
        RunError::Flushing | RunError::Record(_) | RunError::Ranks(_) | RunError::OtherScene { .. } => false,
    }
}

/// The first windows, and from one of them on a second run.
fn run(job: &Job, mut whole: Simulation, mut kept: MemorySink, asked: &Asked) {
    let mut outcome = windows(&mut whole, &mut kept, asked.resumed_after);
    if outcome.is_none() {
        let checkpoint = whole.checkpoint();
        let resumed = Simulation::resume(job.model, job.start, job.plan, &checkpoint);
        let mut resumed = resumed.unwrap_or_else(|error| panic!("a checkpoint just written: {error}"));
        assert!(resumed.checkpoint() == checkpoint, "the checkpoint read is not the one written");
        let (mut after, mut again) = (MemorySink::default(), MemorySink::default());
        let left = WINDOWS - asked.resumed_after;
        outcome = windows(&mut whole, &mut after, left);
        let second = windows(&mut resumed, &mut again, left);
        // A clock ends each of them somewhere.
        if Interruption::due().is_none() {
            assert_eq!(outcome, second, "a resumed run ends otherwise");
            // Of rows that hold NaN the texts are compared.
            assert_eq!(format!("{after:?}"), format!("{again:?}"), "a resumed run has other rows and events");
            assert!(whole.checkpoint() == resumed.checkpoint(), "a resumed run leaves another checkpoint");
        }
        kept.rows.append(&mut after.rows);
        kept.events.append(&mut after.events);
    }
    assert!(kept.events.iter().all(|event| event.time.is_finite()));
    assert_rows_are_sound(job, &kept.rows, asked.is_free);
    if let Some(Outcome::Stopped(stop)) = &outcome {
        assert!(stop.time.is_finite() && !stop.what.is_empty() && !stop.advice.is_empty(), "{stop:?}");
    }
    let outcome = outcome.unwrap_or(Outcome::Completed);
    RunSummary::of(job.model, &mut whole, outcome, None);
}

/// So many windows; how the run has ended, if it has.
fn windows(simulation: &mut Simulation, kept: &mut MemorySink, count: usize) -> Option<Outcome> {
    let most = simulation.statistics().rate_evaluations + EVALUATIONS;
    match simulation.run(kept, &mut Bounded { windows: count, most }) {
        Ok(Outcome::Stopped(stop)) if matches!(stop.reason, Reason::Interrupted | Reason::WallTime) => None,
        Ok(outcome) => Some(outcome),
        Err(error) => panic!("{error}"),
    }
}

/// Ends a run after so many windows or evaluations.
struct Bounded {
    windows: usize,
    most: u64,
}

impl Monitor for Bounded {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        self.windows = self.windows.saturating_sub(1);
        let is_over = self.windows == 0 || progress.statistics.rate_evaluations > self.most;
        is_over.then_some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        true
    }
}

/// Asks that all numbers are finite but gaps to nothing, that gaps are positive, and that momentum stays.
fn assert_rows_are_sound(job: &Job, rows: &[(f64, Vec<f64>)], is_free: bool) {
    let is_incompressible: Vec<bool> = job
        .model
        .bodies
        .iter()
        .map(|body| body.affine().is_some_and(|affine| affine.interior.is_incompressible()))
        .collect();
    let (mut first, mut momentum_at_start) = (0, None);
    for array in job.layout().arrays {
        let numbers = first..first + array.row_len();
        first = numbers.end;
        for (time, row) in rows {
            let values = &row[numbers.clone()];
            let is_sound = |(k, value): (usize, &f64)| match array.name.as_str() {
                "gap" => *value > 0.0,
                // Others have none.
                "pressure" if !is_incompressible[k] => true,
                _ => value.is_finite(),
            };
            assert!(values.iter().enumerate().all(is_sound), "{} at {time:e} s: {values:?}", array.name);
            if array.name == "linear_momentum" && is_free {
                let [momentum, size] = sums(values);
                let [before, most] = *momentum_at_start.get_or_insert([momentum, size]);
                let most = [0, 1, 2].map(|i: usize| most[i].max(size[i])).into_iter().fold(0.0, f64::max);
                let is_kept = (0..3).all(|i| (momentum[i] - before[i]).abs() <= ROUNDING * most);
                assert!(is_kept, "momentum {before:?} has become {momentum:?}, of {most:e}");
            }
        }
    }
}

/// The sum of vectors, and that of their absolute values.
fn sums(values: &[f64]) -> [[f64; 3]; 2] {
    let vectors = values.as_chunks::<3>().0;
    let sum = |of: fn(f64) -> f64| [0, 1, 2].map(|i| vectors.iter().map(|vector| of(vector[i])).sum());
    [sum(|x| x), sum(f64::abs)]
}
