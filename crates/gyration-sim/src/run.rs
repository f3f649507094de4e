//! The run loop: step, events, samples, audit, rest; until the end, rest, or a stop.
//!
//! Sampling never changes the steps: rows come from the dense output. Samples are at t = k·sample (multiplied, not
//! accumulated); one within 1e-9·sample of `end` is `end`; the last row is the end or the stop. The mechanics reads no
//! clock; the loop asks its [`Monitor`] whether to go on, and the [`Interruption`] in force.
//!
//! An interruption may come within a step, where a resistance takes long. What has come of that step is then none of
//! the run ([`Simulation::is_whole`]).

use crate::adapter::ModelSystem;
use crate::events::Event;
use crate::horizon::horizon;
use crate::outcome::{Outcome, Stop};
use crate::plan::RunPlan;
use crate::ports::{Monitor, Progress, RunError, Sink};
use crate::rows::{Fields, RowScratch};
use crate::run_state::{DISSIPATION, RunState};
use crate::step_end::{self, StepEnd};
use gyration::balance::fastest_speed;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{ExtendedMut, Integrator, Statistics, StepReport, System as _};
use gyration_threads::Interruption;

/// A run under way: a model as its stepper sees it, and the run.
pub struct Simulation<'a> {
    pub(crate) system: ModelSystem<'a>,
    pub(crate) run: Run,
}

/// A run without its model.
pub(crate) struct Run {
    pub integrator: Integrator,
    pub plan: RunPlan,
    pub state: RunState,
    /// The bodies at the end of the last step.
    pub step_ends: Vec<StepEnd>,
    /// A state within the last step; scratch between samples.
    pub sampled: State,
    /// |f| of the contacts of each body after the last step [N].
    pub forces: Vec<f64>,
    /// Scratch: the events of a step.
    pub found: Vec<Event>,
    /// Since when each signal of each body is known within the step [s].
    pub since: Vec<[f64; 3]>,
    /// What the rows hold, and scratch for them.
    pub fields: Fields,
    pub rows: RowScratch,
    /// The time of the last row [s].
    pub recorded: f64,
}

impl<'a> Simulation<'a> {
    /// Prepares a run from its start; nothing is recorded yet.
    ///
    /// # Errors
    /// [`RunError::Start`] if the start is outside the model.
    pub fn new(model: &'a Model, start: &State, plan: RunPlan) -> Result<Self, RunError> {
        let system = ModelSystem::new(model, start, plan.tolerance)
            .map_err(|left| RunError::at_start(Stop::by_inadmissible(model, start.time, &left)))?;
        let run = Run {
            integrator: Integrator::new(start.time, &start.bodies, &start.works, plan.options),
            plan,
            state: RunState::new(model.bodies.len()),
            step_ends: Vec::new(),
            sampled: State { low: vec![0.0; start.bodies.len()], ..start.clone() },
            forces: Vec::new(),
            found: Vec::new(),
            since: Vec::new(),
            fields: Fields::new(model, &plan.extras),
            rows: RowScratch::default(),
            recorded: f64::NEG_INFINITY,
        };
        let mut this = Self { system, run };
        this.read_step_end();
        Ok(this)
    }

    /// Goes on from a checkpoint of the same scene; `start` is the scene's start, from which the scales come.
    ///
    /// # Errors
    /// [`RunError::Checkpoint`] if the bytes are not a checkpoint of this scene.
    pub fn resume(model: &'a Model, start: &State, plan: RunPlan, checkpoint: &[u8]) -> Result<Self, RunError> {
        let mut this = Self::new(model, start, plan)?;
        let (state, memory) = RunState::restore(checkpoint).ok_or_else(|| {
            RunError::Checkpoint("its bytes are damaged, or another version of the program wrote them".into())
        })?;
        this.run.integrator = Integrator::resume(&memory, plan.options)?;
        this.run.state = state;
        this.run.recorded = this.sample_time(this.run.state.next_sample.saturating_sub(1));
        this.read_step_end();
        Ok(this)
    }

    /// Next sample, audit and events so far.
    pub fn run_state(&self) -> &RunState {
        &self.run.state
    }

    /// What the run was asked for.
    pub fn plan(&self) -> &RunPlan {
        &self.run.plan
    }

    /// Whether state, rows and events are those at the end of a step: false if an interruption came within one.
    pub fn is_whole(&self) -> bool {
        !self.system.was_interrupted()
    }

    /// The counters so far.
    pub fn statistics(&self) -> &Statistics {
        self.run.integrator.statistics()
    }

    /// The state after the last step.
    pub fn state(&self) -> State {
        State {
            time: self.run.integrator.time(),
            bodies: self.run.integrator.state().to_vec(),
            low: self.run.integrator.state_low().to_vec(),
            works: self.run.integrator.quadratures().to_vec(),
        }
    }

    /// A checkpoint after the last step.
    pub fn checkpoint(&self) -> Vec<u8> {
        self.run.state.checkpoint(&self.run.integrator.memory())
    }

    /// Records the row t = 0.
    ///
    /// # Errors
    /// [`RunError`] if the start is outside the model or the row cannot be stored.
    pub fn begin(&mut self, sink: &mut dyn Sink) -> Result<(), RunError> {
        self.sample_end();
        if let Err(stop) = self.record(sink)? {
            return Err(RunError::at_start(stop));
        }
        self.run.state.next_sample = 1;
        self.find_forces();
        for body in 0..self.run.step_ends.len() {
            self.run.state.signals[body] = self.signals(body);
        }
        if self.is_slow() {
            self.run.state.slow_since = self.run.integrator.time();
        }
        Ok(())
    }

    /// Steps until the end, rest, or a stop, and records the last row.
    ///
    /// # Errors
    /// [`RunError::Record`] if the recording fails.
    pub fn run(&mut self, sink: &mut dyn Sink, monitor: &mut dyn Monitor) -> Result<Outcome, RunError> {
        loop {
            if let Some(outcome) = self.advance(sink, monitor)? {
                return Ok(outcome);
            }
        }
    }

    /// Makes one step, with its events and samples; how the run has ended, if it has.
    ///
    /// # Errors
    /// [`RunError::Record`] if the recording fails.
    pub(crate) fn advance(
        &mut self,
        sink: &mut dyn Sink,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Outcome>, RunError> {
        let model = self.system.model();
        if self.run.integrator.time() >= self.run.plan.end {
            return Ok(Some(Outcome::Completed));
        }
        let report = match self.step(sink)? {
            Ok(report) => report,
            Err(stop) => return self.stop(stop, sink).map(Some),
        };
        if let Err(stop) = self.sample_step(&report, sink)? {
            return self.stop(stop, sink).map(Some);
        }
        if self.has_come_to_rest(&report) {
            self.record_last(sink)?.ok();
            return Ok(Some(Outcome::AtRest { time: report.end }));
        }
        let (state, integrator) = (&self.run.state, &self.run.integrator);
        sink.step_end(&|| state.checkpoint(&integrator.memory()))?;
        let (time, end) = (report.end, self.run.plan.end);
        let progress = Progress { time, end, step: &report, statistics: integrator.statistics(), model };
        let asked = monitor.after_step(&progress).map(|reason| Stop::by_request(time, reason));
        let asked = asked.or_else(|| Interruption::due().map(|_| Stop::by_interruption(time)));
        Ok(asked.filter(|_| time < end).map(Outcome::Stopped))
    }

    /// Makes one step and finds its events.
    pub(crate) fn step(&mut self, sink: &mut dyn Sink) -> Result<Result<StepReport, Stop>, RunError> {
        let (target, before, time) = (self.target(), self.dissipation(), self.run.integrator.time());
        let made = self.run.integrator.step(&mut self.system, target);
        if !self.is_whole() {
            // A shorter step that has gone well is another one than the run would have made.
            return Ok(Err(Stop::by_interruption(time)));
        }
        let report = match made {
            Ok(report) => report,
            Err(failure) => return Ok(Err(Stop::by_failure(self.system.model(), &failure))),
        };
        self.read_step_end();
        self.run.state.largest_projection = self.run.state.largest_projection.max(report.projection);
        self.run.state.note_dissipation(before, self.dissipation());
        self.find_events(&report, sink)?;
        Ok(Ok(report))
    }

    /// Restarts the stepper after a change of the model.
    pub(crate) fn restart(&mut self) -> Result<(), Stop> {
        let model = self.system.model();
        self.run.integrator.restart(&mut self.system).map_err(|failure| Stop::by_failure(model, &failure))?;
        // Before the first step the rates at the start stand in the system.
        let (rates, _) = self.run.integrator.rates();
        step_end::read(&mut self.run.step_ends, model, self.run.integrator.state(), rates);
        Ok(())
    }

    /// Where the next step must end at the latest [s]: the end, the rest that would be long enough, or the first time
    /// at which a support could be reached.
    fn target(&self) -> f64 {
        let time = self.run.integrator.time();
        let mut end = self.run.plan.end;
        if let Some(rest) = self.run.plan.stop_at_rest
            && self.run.state.slow_since.is_finite()
        {
            end = end.min((self.run.state.slow_since + rest.hold).max(time));
        }
        if end <= time {
            end = self.run.plan.end;
        }
        let horizon = horizon(self.system.model(), time, &self.run.step_ends, self.system.radii(), end - time);
        let target = time + horizon;
        // A horizon lost in rounding is no horizon: the domain of the rates then ends the run.
        if target > time { target.min(end) } else { end }
    }

    /// Ends with the last row, if there is one.
    fn stop(&mut self, stop: Stop, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        if self.is_whole() {
            self.record_last(sink)?.ok();
        }
        Ok(Outcome::Stopped(stop))
    }

    /// The time of sample k [s]; one within 1e-9·sample of the end is the end.
    fn sample_time(&self, k: u64) -> f64 {
        let time = k as f64 * self.run.plan.sample;
        if (time - self.run.plan.end).abs() <= 1e-9 * self.run.plan.sample { self.run.plan.end } else { time }
    }

    /// Records the samples that fall into the last step, and the end; a sample outside the model is a stop.
    fn sample_step(&mut self, report: &StepReport, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        while self.sample_time(self.run.state.next_sample) <= report.end {
            self.interpolate(self.sample_time(self.run.state.next_sample));
            if let Err(stop) = self.record(sink)? {
                return Ok(Err(stop));
            }
            self.run.state.next_sample += 1;
        }
        if report.end >= self.run.plan.end { self.record_last(sink) } else { Ok(Ok(())) }
    }

    /// Records the state after the last step, unless it was just sampled.
    ///
    /// # Errors
    /// [`RunError::Record`] if the row cannot be stored; within, a stop if the state is outside the model.
    pub fn record_last(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        if self.run.recorded >= self.run.integrator.time() {
            return Ok(Ok(()));
        }
        self.sample_end();
        self.record(sink)
    }

    /// Reads the bodies at the end of the last step, or at the start.
    pub(crate) fn read_step_end(&mut self) {
        let started = self.run.integrator.statistics().accepted() > 0;
        let rates = if started { self.run.integrator.rates().0 } else { self.system.first_rates() };
        step_end::read(&mut self.run.step_ends, self.system.model(), self.run.integrator.state(), rates);
    }

    /// The works of [`DISSIPATION`] after the last step [J]; zero where the ledger has none.
    fn dissipation(&self) -> [f64; 2] {
        let entries = self.system.model().works().iter().zip(self.run.integrator.quadratures());
        DISSIPATION.map(|work| entries.clone().find(|(entry, _)| **entry == work).map_or(0.0, |(_, value)| *value))
    }

    /// Samples the state after the last step.
    pub(crate) fn sample_end(&mut self) {
        self.run.sampled.time = self.run.integrator.time();
        self.run.sampled.bodies.copy_from_slice(self.run.integrator.state());
        self.run.sampled.low.copy_from_slice(self.run.integrator.state_low());
        self.run.sampled.works.copy_from_slice(self.run.integrator.quadratures());
    }

    /// The state at a time within the last step.
    pub(crate) fn interpolate(&mut self, time: f64) {
        if time >= self.run.integrator.time() {
            return self.sample_end();
        }
        self.run.sampled.time = time;
        let State { bodies, low, works, .. } = &mut self.run.sampled;
        self.run.integrator.interpolate_extended(time, bodies, works, Some(low));
        // Between the ends of a step the interpolant is off its manifold by its error.
        self.system.extended_project(time, ExtendedMut { high: bodies, low }, works);
    }

    /// Records `sampled` and audits it, unless it is outside the model.
    fn record(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        let (model, time) = (self.system.model(), self.run.sampled.time);
        let first = self.run.state.next_sample == 0;
        let initial = (!first).then_some(self.run.state.initial_energy);
        let viscous = self.system.viscous_energy();
        let workspace = self.system.workspace();
        let filled = self.run.fields.fill(model, workspace, &self.run.sampled, initial, &mut self.run.rows);
        let audit = match self.system.noted(filled) {
            Ok(audit) => audit,
            Err(left) => return Ok(Err(Stop::by_inadmissible(model, time, &left))),
        };
        if !audit.energy.is_finite() {
            return Ok(Err(Stop::by_infinite_energy(time)));
        }
        sink.row(time, &self.run.rows.row)?;
        self.run.recorded = time;
        let state = &mut self.run.state;
        if first {
            state.initial_energy = audit.energy;
        }
        state.energy_in_play = state.energy_in_play.max(audit.kinetic).max(audit.exchanged).max(viscous);
        state.note_residual(audit.residual);
        state.smallest_gap = state.smallest_gap.min(audit.smallest_gap);
        Ok(Ok(()))
    }

    /// Whether every body's fastest material point is slower than the speed of rest.
    fn is_slow(&self) -> bool {
        let Some(rest) = self.run.plan.stop_at_rest else { return false };
        let bodies = &self.system.model().bodies;
        // The centre is never the fastest: looked at first, it spares the search in a body that moves.
        let speed = |end: &StepEnd| end.motion.velocity.velocity.norm();
        self.run.step_ends.iter().all(|view| speed(view) < rest.speed)
            && bodies.iter().zip(&self.run.step_ends).all(|(body, end)| fastest_speed(body, &end.motion) < rest.speed)
    }

    /// Whether every body has now been slow for long enough.
    fn has_come_to_rest(&mut self, report: &StepReport) -> bool {
        let slow = self.is_slow();
        if !slow {
            self.run.state.slow_since = f64::NAN;
        } else if self.run.state.slow_since.is_nan() {
            self.run.state.slow_since = report.end;
        }
        // The target of the step was slow_since + hold, whatever the rounding of the difference.
        slow && self.run.plan.stop_at_rest.is_some_and(|rest| report.end >= self.run.state.slow_since + rest.hold)
    }
}
