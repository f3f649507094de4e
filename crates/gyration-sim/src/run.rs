//! The run loop: step, events, samples, audit, rest; until the end, rest, or a stop.
//!
//! Sampling never changes the steps: rows come from the dense output. Samples are at t = k·sample (multiplied, not
//! accumulated); one within 1e-9·sample of `end` is `end`; the last row is the end or the stop. The mechanics reads no
//! clock; the loop asks its [`Monitor`] whether to go on.

use crate::adapter::ModelSystem;
use crate::events::{self, Event, Signals};
use crate::horizon::horizon;
use crate::outcome::{Outcome, Stop};
use crate::plan::RunPlan;
use crate::ports::{Monitor, Progress, RunError, Sink};
use crate::rows;
use crate::tally::Tally;
use gyration::balance::fastest_speed;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{Direction, Integrator, Statistics, StepReport, find_crossing};

/// On how many parts of a step an event is looked for: it is known to be in there.
const SUBINTERVALS: usize = 4;

/// A run under way.
pub struct Simulation<'a> {
    system: ModelSystem<'a>,
    integrator: Integrator,
    plan: RunPlan,
    tally: Tally,
    row: Vec<f64>,
    sampled: State,
    /// The time of the last row [s].
    recorded: f64,
}

impl<'a> Simulation<'a> {
    /// Prepares a run from its start; nothing is recorded yet.
    ///
    /// # Errors
    /// [`RunError::Start`] if the start is outside the model.
    pub fn new(model: &'a Model, start: &State, plan: RunPlan) -> Result<Self, RunError> {
        let system = ModelSystem::new(model, start, plan.tolerance)
            .map_err(|left| RunError::Start(Stop::by_inadmissible(model, start.time, &left)))?;
        let integrator = Integrator::new(start.time, &start.bodies, &start.works, plan.options);
        Ok(Self {
            system,
            integrator,
            plan,
            tally: Tally::new(model.bodies.len()),
            row: Vec::new(),
            sampled: start.clone(),
            recorded: f64::NEG_INFINITY,
        })
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
        this.recorded = this.sample_time(this.tally.next_sample.saturating_sub(1));
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
        if let Err(stop) = self.record(sink)? {
            return Err(RunError::Start(stop));
        }
        self.tally.next_sample = 1;
        self.tally.signals = self.signals();
        if self.is_slow() {
            self.tally.slow_since = self.integrator.time();
        }
        Ok(())
    }

    /// Steps until the end, rest, or a stop, and records the last row.
    ///
    /// # Errors
    /// [`RunError::Record`] if the recording fails.
    pub fn run(&mut self, sink: &mut dyn Sink, monitor: &mut dyn Monitor) -> Result<Outcome, RunError> {
        let model = self.system.model();
        while self.integrator.time() < self.plan.end {
            let target = self.target();
            let report = match self.integrator.step(&mut self.system, target) {
                Ok(report) => report,
                Err(failure) => return self.stop(Stop::by_failure(model, &failure), sink),
            };
            self.tally.largest_projection = self.tally.largest_projection.max(report.projection);
            self.find_events(&report, sink)?;
            if let Err(stop) = self.sample_step(&report, sink)? {
                return self.stop(stop, sink);
            }
            if self.has_come_to_rest(&report) {
                self.record_last(sink)?.ok();
                return Ok(Outcome::AtRest { time: report.end });
            }
            let (tally, integrator) = (&self.tally, &self.integrator);
            sink.step_end(&|| tally.checkpoint(&integrator.memory()))?;
            let (time, end) = (report.end, self.plan.end);
            let progress = Progress { time, end, step: &report, statistics: integrator.statistics(), model };
            if let Some(reason) = monitor.after_step(&progress)
                && time < end
            {
                return Ok(Outcome::Stopped(Stop::by_request(time, reason)));
            }
        }
        Ok(Outcome::Completed)
    }

    /// Where the next step must end at the latest [s]: the end, the rest that would be long enough, or the first time at
    /// which a support could be reached.
    fn target(&self) -> f64 {
        let time = self.integrator.time();
        let mut end = self.plan.end;
        if let Some(rest) = self.plan.stop_at_rest
            && self.tally.slow_since.is_finite()
        {
            end = end.min((self.tally.slow_since + rest.hold).max(time));
        }
        if end <= time {
            end = self.plan.end;
        }
        let target = time + horizon(self.system.model(), &self.state(), self.system.radii(), end - time);
        // A horizon lost in rounding is no horizon: the domain of the rates then ends the run.
        if target > time { target.min(end) } else { end }
    }

    /// Ends with the last row.
    fn stop(&mut self, stop: Stop, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        self.record_last(sink)?.ok();
        Ok(Outcome::Stopped(stop))
    }

    /// The time of sample k [s]; one within 1e-9·sample of the end is the end.
    fn sample_time(&self, k: u64) -> f64 {
        let time = k as f64 * self.plan.sample;
        if (time - self.plan.end).abs() <= 1e-9 * self.plan.sample { self.plan.end } else { time }
    }

    /// Records the samples that fall into the last step, and the end; a sample outside the model is a stop.
    fn sample_step(&mut self, report: &StepReport, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        while self.sample_time(self.tally.next_sample) <= report.end {
            self.interpolate(self.sample_time(self.tally.next_sample));
            if let Err(stop) = self.record(sink)? {
                return Ok(Err(stop));
            }
            self.tally.next_sample += 1;
        }
        if report.end >= self.plan.end { self.record_last(sink) } else { Ok(Ok(())) }
    }

    /// Records the state after the last step, unless it was just sampled.
    fn record_last(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        if self.recorded >= self.integrator.time() {
            return Ok(Ok(()));
        }
        self.sampled = self.state();
        self.record(sink)
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

    /// Records `sampled` and audits it, unless it is outside the model.
    fn record(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        let (model, time) = (self.system.model(), self.sampled.time);
        let first = self.tally.next_sample == 0;
        let initial = (!first).then_some(self.tally.initial_energy);
        let ledger = match rows::fill(model, self.system.workspace(), &self.sampled, initial, &mut self.row) {
            Ok(ledger) => ledger,
            Err(left) => return Ok(Err(Stop::by_inadmissible(model, time, &left))),
        };
        if !ledger.total().is_finite() {
            return Ok(Err(Stop::by_infinite_energy(time)));
        }
        sink.row(time, &self.row)?;
        self.recorded = time;
        let exchanged = ledger.works.iter().map(|work| work.abs()).sum::<f64>();
        let tally = &mut self.tally;
        if first {
            tally.initial_energy = ledger.total();
        }
        tally.energy_in_play = tally.energy_in_play.max(ledger.energies[0]).max(exchanged);
        tally.largest_residual = tally.largest_residual.max(ledger.residual.abs());
        tally.smallest_gap = tally.smallest_gap.min(rows::smallest_gap(model, &self.row));
        Ok(Ok(()))
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

    fn find_events(&mut self, report: &StepReport, sink: &mut dyn Sink) -> Result<(), RunError> {
        let model = self.system.model();
        let now = self.signals();
        let mut found = Vec::new();
        for (body, after) in now.iter().enumerate() {
            for (kind, after) in after.iter().copied().enumerate().filter(|(_, after)| events::is_significant(*after)) {
                let before = std::mem::replace(&mut self.tally.signals[body][kind], after);
                if events::happened(kind, before, after) {
                    found.push(Event { time: self.locate(report, model, body, kind), kind, body });
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

    /// Whether every body's fastest material point is slower than the speed of rest.
    fn is_slow(&self) -> bool {
        let Some(rest) = self.plan.stop_at_rest else { return false };
        let (model, state) = (self.system.model(), self.state());
        let speed = |(index, body)| fastest_speed(body, &state.motion(model, index));
        model.bodies.iter().enumerate().all(|body| speed(body) < rest.speed)
    }

    /// Whether every body has now been slow for long enough.
    fn has_come_to_rest(&mut self, report: &StepReport) -> bool {
        let slow = self.is_slow();
        if !slow {
            self.tally.slow_since = f64::NAN;
        } else if self.tally.slow_since.is_nan() {
            self.tally.slow_since = report.end;
        }
        // The target of the step was slow_since + hold, whatever the rounding of the difference.
        slow && self.plan.stop_at_rest.is_some_and(|rest| report.end >= self.tally.slow_since + rest.hold)
    }
}
