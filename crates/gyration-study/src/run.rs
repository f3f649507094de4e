//! One run of a study: from its number to its row, and to the recording that the study may want of it.

use crate::error::StudyError;
use crate::extract::{ColumnPlaces, Extractor};
use crate::file::Recordings;
use crate::study::Study;
use crate::value::{Row, Value};
use gyration::dynamics::Exchange;
use gyration::model::Model;
use gyration_record::{RecordError, RowHash, Writer, remove};
use gyration_scene::{Built, Scene, SceneErrors};
use gyration_sim::events::Event;
use gyration_sim::{
    Job, Monitor, Outcome, Progress, Provenance, Reason, RunError, RunPlan, Simulation, Sink, Verdict, entries,
};
use gyration_threads::Interruption;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The outcome of a run that could not begin.
pub const FAILED: &str = "failed";
/// The outcome of a run that took more than `max_steps`.
pub const STEP_LIMIT: &str = "step_limit";

/// What one thread brings to its runs: where recordings go, and whether it is to stop.
#[derive(Debug, Clone, Default)]
pub struct Worker {
    recordings: Option<PathBuf>,
    stop: Arc<AtomicBool>,
}

impl Worker {
    /// A worker that leaves no recordings.
    pub fn new() -> Self {
        Self::default()
    }

    /// A worker whose recordings, if the study wants any, go into a folder.
    #[must_use]
    pub fn recording_into(mut self, folder: &Path) -> Self {
        self.recordings = Some(folder.to_owned());
        self
    }

    /// A worker that gives up its run once this is true.
    #[must_use]
    pub fn stopped_by(mut self, stop: Arc<AtomicBool>) -> Self {
        self.stop = stop;
        self
    }

    /// What gives up its runs.
    fn interruption(&self) -> Interruption {
        Interruption::in_force().raised_by(self.stop.clone())
    }
}

/// What a run leaves for its row.
struct Ended {
    /// Outcome, reason, time, steps, rejected, evaluations, residual, verdict on the ledger.
    ending: [Value; 8],
    kept: Vec<Value>,
    /// Whether it ended early.
    is_early: bool,
}

impl Study {
    /// The row of a run; `run` < [`Study::runs`]. It depends on nothing else; failures are rows.
    pub fn row(&self, run: u64) -> Row {
        // A worker that nobody stops and that records nothing comes to an end, whatever is in force here.
        let row = Interruption::default().within(|| self.attempt(run, &Worker::new()));
        row.ok().flatten().unwrap_or_default()
    }

    /// The row of a run, with the recording that the study wants of it; none if the worker was stopped before the end.
    ///
    /// # Errors
    /// [`StudyError::Record`] if the recording cannot be written.
    pub fn attempt(&self, run: u64, worker: &Worker) -> Result<Option<Row>, StudyError> {
        let place = self.place(run);
        let values = self.values(place);
        let ended = worker.interruption().within(|| match self.scene_with(&values) {
            Ok(scene) => self.ended(run, &scene, worker),
            Err(errors) if errors.is_interrupted() => Ok(None),
            Err(errors) => Ok(Some(self.failed(first_of(&errors)))),
        })?;
        let Some(ended) = ended else { return Ok(None) };
        let numbers = [place.run, place.point, place.repetition].map(|number| Value::Integer(number as i64));
        let cells = values.into_iter().flat_map(|(_, cells)| cells);
        let values = numbers.into_iter().chain(cells).chain(ended.ending).chain(ended.kept).collect();
        Ok(Some(Row { values }))
    }

    /// Runs a scene, and once more if the recording of a failure is wanted.
    fn ended(&self, run: u64, scene: &Scene, worker: &Worker) -> Result<Option<Ended>, StudyError> {
        let recording = worker.recordings.as_ref().map(|folder| folder.join(format!("run-{run:06}.gyr")));
        let at_once = recording.as_deref().filter(|_| self.recordings() == Recordings::All);
        let ended = self.simulate(scene, at_once)?;
        if let (Some(Ended { is_early: true, .. }), Recordings::Failures, Some(path)) =
            (&ended, self.recordings(), &recording)
            && self.simulate(scene, Some(path))?.is_none()
        {
            return Ok(None);
        }
        Ok(ended)
    }

    fn simulate(&self, scene: &Scene, recording: Option<&Path>) -> Result<Option<Ended>, StudyError> {
        let Built { model, state, .. } = scene.built();
        let mut plan: RunPlan = scene.built().into();
        if recording.is_none() && !self.needs_samples() && !plan.extras.have_intervals() {
            plan.sample = plan.end;
        }
        plan.pairs &= recording.is_some();
        let extractor = match Extractor::new(self.keeps(), model, &ColumnPlaces::new(model, &plan)) {
            Ok(extractor) => extractor,
            Err(message) => return Ok(Some(self.failed(message))),
        };
        let mut simulation = match Simulation::new(model, state, plan) {
            Ok(simulation) => simulation,
            Err(error) => return self.not_begun(error),
        };
        // The commit would make the bytes of recordings depend on where the program was built.
        let provenance = Provenance { version: env!("CARGO_PKG_VERSION").to_owned(), commit: None };
        let wanted = recording.map(|path| (path, Job::of(scene, &provenance)));
        let writer = wanted.as_ref().map(|(path, job)| created(path, job)).transpose()?;
        let mut sink = Tee { model, extractor, writer: writer.map(|writer| (writer, RowHash::default())) };
        if let Err(error) = simulation.begin(&mut sink) {
            return self.not_begun(error);
        }
        let mut limits = RunLimits { most_steps: self.read.max_steps, is_over: false };
        let outcome = simulation.run(&mut sink, &mut limits).map_err(recorded)?;
        if is_interrupted(&outcome) && !limits.is_over {
            return Ok(None);
        }
        if limits.is_over {
            // A run that is interrupted may go on, and has no last row; this one has ended.
            simulation.record_last(&mut sink.extractor).map_err(recorded)?.ok();
        }
        let verdict = Verdict::of(model, &simulation);
        let ending = ending(&simulation, &outcome, limits.is_over, verdict);
        let is_early = matches!(outcome, Outcome::Stopped(_));
        let Tee { extractor, writer, .. } = sink;
        if let Some(((path, job), writer)) = wanted.zip(writer) {
            job.close(path, (&mut simulation, outcome, None), writer).map_err(recorded)?;
        }
        Ok(Some(Ended { ending, kept: extractor.finish(), is_early }))
    }

    /// A start outside the model is a failure of this run; what the disk refuses is one of the study.
    fn not_begun(&self, error: RunError) -> Result<Option<Ended>, StudyError> {
        match error {
            RunError::Start(_) => Ok(Some(self.failed(error.to_string()))),
            RunError::Interrupted(_) => Ok(None),
            other => Err(recorded(other)),
        }
    }

    fn failed(&self, reason: String) -> Ended {
        let mut ending = [const { Value::Null }; 8];
        (ending[0], ending[1]) = (Value::Text(FAILED.into()), Value::Text(reason));
        Ended { ending, kept: vec![Value::Null; self.keeps().len()], is_early: true }
    }
}

/// A new recording; one that a broken run has left is removed.
fn created(path: &Path, job: &Job) -> Result<Writer, StudyError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(StudyError::io("make", folder))?;
    }
    if path.symlink_metadata().is_ok() {
        remove(path)?;
    }
    Ok(Writer::create(path, &job.layout(), job.all_attributes())?)
}

fn recorded(error: RunError) -> StudyError {
    match error {
        RunError::Record(error) => error.into(),
        // A run that has begun fails for no other reason.
        other => StudyError::Run(other.to_string()),
    }
}

fn is_interrupted(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Stopped(stop) if stop.reason == Reason::Interrupted)
}

fn ending(simulation: &Simulation, outcome: &Outcome, is_over: bool, verdict: Verdict) -> [Value; 8] {
    let (statistics, run_state) = (simulation.statistics(), simulation.run_state());
    let (name, reason) = match outcome {
        Outcome::Completed => ("completed".to_owned(), Value::Null),
        Outcome::AtRest { .. } => ("at_rest".to_owned(), Value::Null),
        Outcome::Stopped(_) if is_over => (STEP_LIMIT.to_owned(), Value::Text("more steps than max_steps".into())),
        Outcome::Stopped(stop) => (word(stop.reason), Value::Text(stop.what.clone())),
    };
    let count = |number: u64| Value::Integer(number as i64);
    let residual =
        if run_state.largest_residual == 0.0 { 0.0 } else { run_state.largest_residual / simulation.energy_in_play() };
    [
        Value::Text(name),
        reason,
        Value::Number(simulation.state().time),
        count(statistics.accepted()),
        count(statistics.rejected_error + statistics.rejected_domain + statistics.newton_failures),
        count(statistics.rate_evaluations),
        Value::Number(residual),
        Value::Text(verdict.name().to_owned()),
    ]
}

/// A reason as one word, as recordings have it.
fn word(reason: Reason) -> String {
    match serde_json::to_value(reason) {
        Ok(serde_json::Value::String(word)) => word,
        _ => "stopped".to_owned(),
    }
}

/// The first error of a scene on one line.
fn first_of(errors: &SceneErrors) -> String {
    let Some(error) = errors.as_slice().first() else { return "the scene is not valid".to_owned() };
    let more = match errors.count() {
        0 | 1 => String::new(),
        count => format!(" (and {} more)", count - 1),
    };
    format!("{}: {}{more}", error.key, error.message)
}

/// Stops a run after too many steps.
struct RunLimits {
    most_steps: Option<u64>,
    /// Whether it took too many steps.
    is_over: bool,
}

impl Monitor for RunLimits {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        self.is_over = self.most_steps.is_some_and(|most| progress.statistics.accepted() >= most);
        self.is_over.then_some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        self.most_steps.is_some()
    }
}

/// What is kept, and the recording if there is one.
struct Tee<'a> {
    model: &'a Model,
    extractor: Extractor,
    /// With the hash of its rows.
    writer: Option<(Writer, RowHash)>,
}

impl Sink for Tee<'_> {
    fn exchanges(&mut self, exchanges: &[Exchange]) -> Result<(), RecordError> {
        match &mut self.writer {
            Some((writer, _)) => writer.append_entries(entries(self.model, exchanges, &mut Vec::new())),
            None => Ok(()),
        }
    }

    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        if let Some((writer, hash)) = &mut self.writer {
            writer.append(time, row)?;
            hash.add_row(time, row);
        }
        self.extractor.row(time, row)
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        if let Some((writer, _)) = &mut self.writer {
            let Event { time, kind, body } = *event;
            writer.append_event(gyration_record::Event { time, kind, body: Some(body) })?;
        }
        self.extractor.event(event)
    }

    fn wants_event_rows(&self) -> bool {
        self.extractor.wants_event_rows()
    }

    fn event_row(&mut self, event: &Event, row: &[f64]) -> Result<(), RecordError> {
        self.extractor.event_row(event, row)
    }
}
