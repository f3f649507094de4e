//! The run loop: step, events, samples, audit, rest; until the end, rest, or a stop.
//!
//! Sampling never changes the steps: rows come from the dense output. Samples are at t = k·sample (multiplied, not
//! accumulated); one within 1e-9·sample of `end` is `end`; the last row is the end or the stop. The mechanics reads no
//! clock; the loop asks its [`Monitor`] whether to go on.

use crate::adapter::{ModelSystem, Tolerance};
use crate::events::{self, Event, Signals};
use crate::outcome::{Outcome, Reason, Stop};
use crate::rows;
use crate::tally::Tally;
use gyration::Inadmissible;
use gyration::balance::fastest_speed;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{Direction, Integrator, Limit, MemoryError, Method, Options, Statistics, StepReport, find_crossing};
use gyration_record::RecordError;
use gyration_scene::Plan;
use std::path::PathBuf;

/// How long to run, how finely to sample, how precisely to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunPlan {
    /// The end [s].
    pub end: f64,
    /// Spacing of recorded samples [s].
    pub sample: f64,
    /// When to end early, at rest.
    pub stop_at_rest: Option<RestCriterion>,
    /// Errors allowed per step.
    pub tolerance: Tolerance,
    /// Stepper and longest step.
    pub options: Options,
}

/// Rest: every body's fastest material point slower than `speed` for `hold`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestCriterion {
    /// Speed of the fastest material point [m/s].
    pub speed: f64,
    /// For how long [s].
    pub hold: f64,
}

/// On how many parts of a step an event is looked for: it is known to be in there.
const SUBINTERVALS: usize = 4;

impl From<&Plan> for RunPlan {
    fn from(plan: &Plan) -> Self {
        let method = match plan.method {
            gyration_scene::Method::Auto => Method::Auto,
            gyration_scene::Method::Explicit => Method::Explicit,
            gyration_scene::Method::Implicit => Method::Implicit,
        };
        let max_step = plan.max_step.unwrap_or(f64::INFINITY);
        Self {
            end: plan.end,
            sample: plan.sample,
            stop_at_rest: plan.stop_at_rest.map(|rest| RestCriterion { speed: rest.speed, hold: rest.hold }),
            tolerance: Tolerance { rtol: plan.rtol, atol: plan.atol },
            options: Options { method, max_step, initial_step: None },
        }
    }
}

/// Where rows, events and checkpoints go.
pub trait Sink {
    /// One sample, flattened in the order of [`rows::arrays`].
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError>;

    /// One event.
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn event(&mut self, event: &Event) -> Result<(), RecordError>;

    /// The end of a step, when a checkpoint may be taken.
    ///
    /// # Errors
    /// Whatever keeps it from being stored.
    fn step_end(&mut self, checkpoint: &dyn Fn() -> Vec<u8>) -> Result<(), RecordError>;
}

/// What the run says of itself after each step, and whether it is to go on.
pub trait Monitor {
    /// Called after each step; a reason to stop ends the run.
    fn after_step(&mut self, progress: &Progress) -> Option<Reason>;
}

/// Where a run stands.
#[derive(Debug, Clone, Copy)]
pub struct Progress<'a> {
    /// Simulated time [s].
    pub time: f64,
    /// The end [s].
    pub end: f64,
    /// The step just made.
    pub step: &'a StepReport,
    /// Counters.
    pub statistics: &'a Statistics,
    /// The model, for names.
    pub model: &'a Model,
}

/// Why a run could not begin, or its recording not go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The start is outside the model.
    #[error("the start is outside the model: {0}")]
    Start(Inadmissible),
    /// The recording failed.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The recording to be resumed is of another scene.
    #[error("{} is a recording of another scene: give another -o, or --force to overwrite it", path.display())]
    OtherScene {
        /// The recording.
        path: PathBuf,
    },
    /// The checkpoint is not one of this program.
    #[error("the checkpoint cannot be used: {0}; run the scene anew with --force")]
    Checkpoint(String),
}

impl From<MemoryError> for RunError {
    fn from(error: MemoryError) -> Self {
        Self::Checkpoint(error.to_string())
    }
}

/// A run under way.
pub struct Simulation<'a> {
    system: ModelSystem<'a>,
    integrator: Integrator,
    plan: RunPlan,
    tally: Tally,
    row: Vec<f64>,
    sampled: State,
}

impl<'a> Simulation<'a> {
    /// Prepares a run from its start; nothing is recorded yet.
    ///
    /// # Errors
    /// [`RunError::Start`] if the start is outside the model.
    pub fn new(model: &'a Model, start: &State, plan: RunPlan) -> Result<Self, RunError> {
        let system = ModelSystem::new(model, start, plan.tolerance).map_err(RunError::Start)?;
        let integrator = Integrator::new(start.time, &start.bodies, &start.works, plan.options);
        Ok(Self { system, integrator, plan, tally: Tally::new(), row: Vec::new(), sampled: start.clone() })
    }

    /// Goes on from a checkpoint of the same scene; `start` is the scene's start, from which the scales come.
    ///
    /// # Errors
    /// [`RunError::Checkpoint`] if the bytes are not a checkpoint of this scene.
    pub fn resume(model: &'a Model, start: &State, plan: RunPlan, checkpoint: &[u8]) -> Result<Self, RunError> {
        let mut this = Self::new(model, start, plan)?;
        let (tally, memory) =
            Tally::restore(checkpoint).ok_or_else(|| RunError::Checkpoint("its bytes are damaged".into()))?;
        this.integrator = Integrator::resume(&memory, plan.options)?;
        this.tally = tally;
        // The last row: whether it is that of the last step decides if the end must still be recorded.
        this.sampled.time = this.sample_time(this.tally.next_sample.saturating_sub(1));
        Ok(this)
    }

    /// The audit so far.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// The counters so far.
    pub fn statistics(&self) -> &Statistics {
        self.integrator.statistics()
    }

    /// The state after the last step.
    pub fn state(&self) -> State {
        State {
            time: self.integrator.time(),
            bodies: self.integrator.state().to_vec(),
            works: self.integrator.quadratures().to_vec(),
        }
    }

    /// A checkpoint after the last step.
    pub fn checkpoint(&self) -> Vec<u8> {
        self.tally.checkpoint(&self.integrator.memory())
    }

    /// Records the row t = 0.
    ///
    /// # Errors
    /// [`RunError`] if the start is outside the model or the row cannot be stored.
    pub fn begin(&mut self, sink: &mut dyn Sink) -> Result<(), RunError> {
        self.sampled = self.state();
        let ledger = self.record(sink)?;
        self.tally.initial_energy = ledger;
        self.tally.next_sample = 1;
        Ok(())
    }

    /// Steps until the end, rest, or a stop, and records the last row.
    ///
    /// # Errors
    /// [`RunError::Record`] if the recording fails.
    pub fn run(&mut self, sink: &mut dyn Sink, monitor: &mut dyn Monitor) -> Result<Outcome, RunError> {
        let mut before = self.signals();
        loop {
            if self.integrator.time() >= self.plan.end {
                return Ok(Outcome::Completed);
            }
            let report = match self.integrator.step(&mut self.system, self.plan.end) {
                Ok(report) => report,
                Err(failure) => {
                    let stop = Stop::by_failure(self.system.model(), &failure);
                    self.record_last(sink)?;
                    return Ok(Outcome::Stopped(stop));
                }
            };
            self.tally.largest_projection = self.tally.largest_projection.max(report.projection);
            let after = self.signals();
            self.find_events(&report, &before, &after, sink)?;
            before = after;
            self.sample_step(&report, sink)?;
            if self.has_come_to_rest(&report) {
                self.record_last(sink)?;
                return Ok(Outcome::AtRest { time: report.end });
            }
            let (tally, integrator) = (&self.tally, &self.integrator);
            sink.step_end(&|| tally.checkpoint(&integrator.memory()))?;
            let statistics = integrator.statistics();
            let (time, end, model) = (report.end, self.plan.end, self.system.model());
            let progress = Progress { time, end, step: &report, statistics, model };
            if let Some(reason) = monitor.after_step(&progress)
                && time < end
            {
                return Ok(Outcome::Stopped(Stop::by_request(time, reason)));
            }
        }
    }

    /// The time of sample k [s]; one within 1e-9·sample of the end is the end.
    fn sample_time(&self, k: u64) -> f64 {
        let time = k as f64 * self.plan.sample;
        if (time - self.plan.end).abs() <= 1e-9 * self.plan.sample { self.plan.end } else { time }
    }

    /// Records the samples that fall into the last step, and the end.
    fn sample_step(&mut self, report: &StepReport, sink: &mut dyn Sink) -> Result<(), RunError> {
        while self.sample_time(self.tally.next_sample) <= report.end {
            self.interpolate(self.sample_time(self.tally.next_sample));
            self.record(sink)?;
            self.tally.next_sample += 1;
        }
        if report.end >= self.plan.end && self.sampled.time < report.end {
            self.record_last(sink)?;
        }
        Ok(())
    }

    /// Records the state after the last step, unless it was just sampled.
    fn record_last(&mut self, sink: &mut dyn Sink) -> Result<(), RunError> {
        if self.sampled.time < self.integrator.time() {
            self.sampled = self.state();
            self.record(sink)?;
        }
        Ok(())
    }

    /// The state at a time within the last step.
    fn interpolate(&mut self, time: f64) {
        if time >= self.integrator.time() {
            self.sampled = self.state();
            return;
        }
        self.integrator.prepare_dense(&mut self.system);
        self.sampled.time = time;
        self.integrator.interpolate(time, &mut self.sampled.bodies, &mut self.sampled.works);
    }

    /// Records `sampled` and audits it; returns the sum of its energies.
    fn record(&mut self, sink: &mut dyn Sink) -> Result<f64, RunError> {
        let model = self.system.model();
        let initial = (self.tally.next_sample > 0).then_some(self.tally.initial_energy);
        let ledger = rows::fill(model, self.system.workspace(), &self.sampled, initial, &mut self.row)
            .map_err(RunError::Start)?;
        sink.row(self.sampled.time, &self.row)?;
        let exchanged = ledger.works.iter().map(|work| work.abs()).sum::<f64>();
        let tally = &mut self.tally;
        tally.energy_in_play = tally.energy_in_play.max(ledger.energies[0]).max(exchanged);
        tally.largest_residual = tally.largest_residual.max(ledger.residual.abs());
        tally.smallest_gap = tally.smallest_gap.min(rows::smallest_gap(model, &self.row));
        Ok(ledger.total())
    }

    /// The signals of every body after the last step.
    fn signals(&mut self) -> Vec<Signals> {
        let (model, state) = (self.system.model(), self.state());
        (0..model.bodies.len())
            .map(|body| {
                let speed = self.system.speed_scale(body);
                events::signals(model, self.system.workspace(), &state, body, speed)
            })
            .collect()
    }

    fn find_events(
        &mut self,
        report: &StepReport,
        before: &[Signals],
        after: &[Signals],
        sink: &mut dyn Sink,
    ) -> Result<(), RunError> {
        let model = self.system.model();
        let mut found = Vec::new();
        for (body, (before, after)) in before.iter().zip(after).enumerate() {
            for kind in 0..events::EVENT_KINDS.len() {
                if events::happened(kind, before[kind], after[kind]) {
                    let time = self.locate(report, model, body, kind);
                    found.push(Event { time, kind, body });
                }
            }
        }
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        for event in found {
            self.tally.events[event.kind] += 1;
            sink.event(&event)?;
        }
        Ok(())
    }

    /// The time of an event within the last step [s].
    fn locate(&mut self, report: &StepReport, model: &Model, body: usize, kind: usize) -> f64 {
        self.integrator.prepare_dense(&mut self.system);
        let speed = self.system.speed_scale(body);
        let mut state = self.state();
        let workspace = self.system.workspace();
        let signal = |time: f64, bodies: &[f64], _: &[f64]| {
            state.time = time;
            state.bodies.copy_from_slice(bodies);
            events::signals(model, workspace, &state, body, speed)[kind]
        };
        let direction = if events::rises(kind) { Direction::Rising } else { Direction::Falling };
        find_crossing(&mut self.integrator, signal, direction, SUBINTERVALS).unwrap_or(report.end)
    }

    /// Whether every body has now been slow for long enough.
    fn has_come_to_rest(&mut self, report: &StepReport) -> bool {
        let Some(rest) = self.plan.stop_at_rest else { return false };
        let model = self.system.model();
        let state = self.state();
        let slow = model
            .bodies
            .iter()
            .enumerate()
            .all(|(index, body)| fastest_speed(body, &state.motion(model, index)) < rest.speed);
        if !slow {
            self.tally.slow_since = f64::NAN;
        } else if self.tally.slow_since.is_nan() {
            self.tally.slow_since = report.end;
        }
        slow && report.end - self.tally.slow_since >= rest.hold
    }
}

/// What limits a step, in words.
pub fn limit_in_words(model: &Model, limit: &Limit) -> String {
    match limit {
        Limit::Error { component } => match model.blocks().iter().position(|block| block.contains(component)) {
            Some(body) => format!("accuracy of {:?}", model.bodies[body].name),
            None => "accuracy of the ledger".into(),
        },
        Limit::Stability => "stiffness".into(),
        Limit::Domain => "a closing gap".into(),
        Limit::Newton => "the implicit equations".into(),
        Limit::MaxStep => "solver.max_step".into(),
        Limit::End => "the end".into(),
    }
}
