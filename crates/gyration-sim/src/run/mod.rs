//! The run loop: windows, events, samples, audit, rest; until the end, rest, or a stop.
//!
//! Bodies that springs join, through any chain, are an island with steps of its own, and so is each other body. In a
//! window every island comes to one time or beyond; then what is known of all until the first of them is handed on:
//! events in order of time and body, rows, the verdict on rest, a checkpoint. How wide windows are and how many threads
//! share the islands out leaves no trace in any number.
//!
//! Sampling never changes the steps: rows come from the dense output. Samples are at t = k·sample (multiplied, not
//! accumulated); one within 1e-9·sample of `end` is `end`; the last row is the end or the stop. The mechanics reads no
//! clock; the loop asks its [`Monitor`] whether to go on, and the [`Interruption`] in force.
//!
//! Where one island cannot go on, the run ends at the time to which that one has come: the others go back to the
//! beginning of the window, and come to that time. An interruption ends it in the same way where the island is that has
//! come least far. It may come within a step, where a resistance takes long. What has come of that window is then none
//! of the run ([`Simulation::is_whole`]).

mod assembled;
mod control;
mod islands;
mod meeting;
mod partition;
mod ranks;
mod samples;
mod window;

use crate::adapter::first_rates;
use crate::events::FoundEvent;
use crate::in_play::InPlay;
use crate::island::pool::ScratchPool;
use crate::island::{Island, Setting};
use crate::outcome::{Outcome, Reason, Stop};
use crate::plan::RunPlan;
use crate::ports::{Monitor, RunError, Sink, WindowEnd};
use crate::resistance::check_resistances;
use crate::rows::{Fields, RowScratch};
use crate::run_state::{IslandMemory, RunState};
use crate::scales::speed_scales;
use assembled::Assembled;
use gyration::Inadmissible;
use gyration::dynamics::{Exchange, Workspace};
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::Statistics;
use gyration_threads::Interruption;
use partition::{Partition, always_coupled, may_be_islands};
use ranks::Ranks;
use window::WindowWidth;

/// A run under way.
pub struct Simulation {
    model: Model,
    pub(crate) plan: RunPlan,
    pub(crate) partition: Partition,
    /// From which the scales of islands come that are yet to be.
    start: State,
    /// The speed scales of all bodies [m/s].
    speeds: Vec<f64>,
    state: RunState,
    width: WindowWidth,
    assembled: Assembled,
    /// What the rows hold, and scratch for them.
    fields: Fields,
    rows: RowScratch,
    /// What acts between two at the last sample, where that is asked for.
    exchanges: Vec<Exchange>,
    workspace: Workspace,
    /// Scratch of the islands, where there are several.
    shared: ScratchPool,
    /// The time of the last row [s].
    recorded: f64,
    /// Up to where a window goes at most [s], lest its rows take long.
    portion: f64,
    /// Scratch: the events of a window.
    found: Vec<FoundEvent>,
    /// Whether an interruption came within a step.
    is_broken: bool,
    /// The processes that share it out, if there are several.
    ranks: Option<Ranks>,
}

impl Simulation {
    /// Prepares a run from its start, an island for each body or set of bodies that springs join; nothing is recorded
    /// yet.
    ///
    /// # Errors
    /// [`RunError::Start`] if the start is outside the model.
    pub fn new(model: &Model, start: &State, plan: RunPlan) -> Result<Self, RunError> {
        Self::of_islands(model, start, plan, always_coupled(model), model.has_cutoffs())
    }

    /// The same with all bodies in one island: one step serves all.
    pub fn together(model: &Model, start: &State, plan: RunPlan) -> Result<Self, RunError> {
        Self::of_islands(model, start, plan, vec![(0..model.bodies.len()).collect()], false)
    }

    fn of_islands(
        model: &Model,
        start: &State,
        plan: RunPlan,
        members: Vec<Vec<usize>>,
        changes: bool,
    ) -> Result<Self, RunError> {
        let outside = |left: Inadmissible| RunError::at_start(Stop::by_inadmissible(model, start.time, &left));
        check_resistances(model).map_err(outside)?;
        let speeds = first_rates(model, start).and_then(|slopes| speed_scales(model, start, &slopes));
        let speeds = speeds.map_err(outside)?;
        let model = &model.clone().neglecting_far_supports(&speeds);
        let setting = Setting { model, start, speeds: &speeds, plan: &plan };
        let islands = members.into_iter().map(|members| Island::new(setting, members, !changes).map(Box::new));
        let islands = islands.collect::<Result<Vec<_>, _>>().map_err(RunError::at_start)?;
        Ok(Self {
            partition: Partition::new(model.bodies.len(), islands, changes),
            start: start.clone(),
            speeds,
            state: RunState::new(start.time),
            width: WindowWidth::new(plan.sample.min(plan.end)),
            assembled: Assembled::new(model, start, &plan),
            fields: Fields::new(model, &plan.extras),
            rows: RowScratch::default(),
            exchanges: Vec::new(),
            workspace: Workspace::default(),
            shared: ScratchPool::default(),
            recorded: f64::NEG_INFINITY,
            portion: f64::INFINITY,
            found: Vec::new(),
            is_broken: false,
            ranks: None,
            model: model.clone(),
            plan,
        })
    }

    /// Goes on from a checkpoint of the same scene; `start` is the scene's start, from which the scales come.
    ///
    /// # Errors
    /// [`RunError::Checkpoint`] if the bytes are not a checkpoint of this scene.
    pub fn resume(model: &Model, start: &State, plan: RunPlan, checkpoint: &[u8]) -> Result<Self, RunError> {
        Self::resume_changed(model, start, plan, checkpoint, |_| {})
    }

    /// The same after changes of loads and drives, which the scales do not know of.
    pub(crate) fn resume_changed(
        model: &Model,
        start: &State,
        plan: RunPlan,
        checkpoint: &[u8],
        change: impl FnOnce(&mut Self),
    ) -> Result<Self, RunError> {
        if flushes() {
            return Err(RunError::Flushing);
        }
        let unfit = || RunError::unfit_checkpoint(checkpoint);
        let (state, memories) = RunState::restore(checkpoint).ok_or_else(unfit)?;
        let members: Vec<Vec<usize>> = memories.iter().map(|memory| memory.members.clone()).collect();
        if !may_be_islands(model, &members) {
            return Err(unfit());
        }
        let mut this = Self::of_islands(model, start, plan, members, model.has_cutoffs())?;
        let is_before = |memory: &IslandMemory| memory.stepper.time() <= state.time;
        if !(state.time <= plan.end && memories.iter().all(is_before)) {
            return Err(unfit());
        }
        change(&mut this);
        for (island, memory) in this.partition.islands.iter_mut().zip(&memories) {
            island.resume(memory, &plan, state.time)?;
        }
        this.state = state;
        this.recorded = this.sample_time(this.state.next_sample.saturating_sub(1));
        Ok(this)
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Next sample, audit and events so far.
    pub fn run_state(&self) -> &RunState {
        &self.state
    }

    /// What the run was asked for.
    pub fn plan(&self) -> &RunPlan {
        &self.plan
    }

    /// Whether state, rows and events are those at the end of a step: false if an interruption came within one.
    pub fn is_whole(&self) -> bool {
        !self.is_broken
    }

    /// The counters of all islands so far.
    pub fn statistics(&self) -> Statistics {
        let settled = self.state.settled.statistics;
        self.partition.islands.iter().fold(settled, |sum, island| sum.and(island.integrator.statistics()))
    }

    /// The energy in play at the ends of all steps [J].
    pub fn energy_in_play(&self) -> f64 {
        let viscous = self.partition.islands.iter().map(|island| island.system.viscous_energy()).sum();
        InPlay::of_all(self.partition.islands.iter().map(|island| island.state.in_play)).max(viscous)
    }

    /// Largest correction by projection after a step.
    pub(crate) fn largest_projection(&self) -> f64 {
        self.partition.islands.iter().map(|island| island.state.largest_projection).fold(0.0, f64::max)
    }

    /// Largest increment over a step of an island of each work that only takes [J]; −∞ before the first.
    pub(crate) fn largest_gains(&self) -> [f64; 2] {
        let gains = self.partition.islands.iter().map(|island| island.state.largest_gains);
        gains.fold([f64::NEG_INFINITY; 2], |most, gains| [most[0].max(gains[0]), most[1].max(gains[1])])
    }

    /// The time that all bodies have come to [s].
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// The state at [`Simulation::time`]; the last one that was sampled, where an interruption came within a step of
    /// one of several islands.
    pub fn state(&self) -> State {
        if self.is_scattered() {
            return self.assembled.state.clone();
        }
        let mut assembled = self.assembled.clone();
        assembled.begin(self.state.time, &self.state.settled);
        self.partition.islands.iter().for_each(|island| assembled.add(island, &island.state_at(self.state.time)));
        assembled.end();
        assembled.state
    }

    /// Whether there are islands at different times that have no common one.
    fn is_scattered(&self) -> bool {
        self.is_broken && self.partition.islands.len() > 1
    }

    /// A checkpoint at [`Simulation::time`].
    pub fn checkpoint(&self) -> Vec<u8> {
        self.state.checkpoint(self.partition.islands.iter().map(|island| island.memory()))
    }

    /// Records the row t = 0.
    ///
    /// # Errors
    /// [`RunError`] if the start is outside the model, the row cannot be stored, or the thread flushes numbers to zero.
    pub fn begin(&mut self, sink: &mut dyn Sink) -> Result<(), RunError> {
        if flushes() {
            return Err(RunError::Flushing);
        }
        self.sample(self.state.time);
        if let Err(stop) = self.record(sink)? {
            return Err(RunError::at_start(stop));
        }
        self.state.next_sample = 1;
        self.shared.with_scratch(self.partition.islands.iter_mut(), |island| island.begin(&self.plan));
        match self.partition.islands.iter_mut().any(|island| island.system.may_be_given_up()) {
            true => Err(RunError::at_start(Stop::by_interruption(self.state.time))),
            false => Ok(()),
        }
    }

    /// Steps until the end, rest, or a stop, and records the last row.
    ///
    /// # Errors
    /// [`RunError::Record`] if the recording fails; [`RunError::Ranks`] if there are several ranks and they come apart.
    pub fn run(&mut self, sink: &mut dyn Sink, monitor: &mut dyn Monitor) -> Result<Outcome, RunError> {
        if self.ranks.is_none() {
            return self.run_to_end(sink, monitor);
        }
        self.meet_ranks(sink, monitor)?;
        // None stops by itself: all of them are asked.
        Interruption::default().within(|| self.run_to_end(sink, monitor))
    }

    fn run_to_end(&mut self, sink: &mut dyn Sink, monitor: &mut dyn Monitor) -> Result<Outcome, RunError> {
        loop {
            // Whoever counts steps is asked behind whole ones.
            if !self.is_by_steps(monitor) {
                self.portion();
            }
            if let Some(outcome) = self.advance(sink, monitor)? {
                return Ok(outcome);
            }
        }
    }

    /// Makes one window, with its events and samples; how the run has ended, if it has. Of one island a window is a
    /// step.
    ///
    /// # Errors
    /// [`RunError::Record`] if the recording fails.
    pub(crate) fn advance(
        &mut self,
        sink: &mut dyn Sink,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Outcome>, RunError> {
        let end = self.plan.end;
        if self.state.time >= end {
            return Ok(Some(Outcome::Completed));
        }
        let stopped = self.step(sink, monitor)?;
        if let Err(stop) = stopped {
            return self.stop(stop, sink).map(Some);
        }
        if let Err(stop) = self.sample_window(sink)? {
            return self.stop(stop, sink).map(Some);
        }
        if let Some(time) = self.rest().filter(|time| *time <= self.state.time) {
            self.state.time = time;
            self.record_last(sink)?.ok();
            return Ok(Some(Outcome::AtRest { time }));
        }
        sink.window_end(&*self)?;
        let time = self.state.time;
        let asked = self.asked(time, monitor)?;
        Ok(asked.filter(|_| time < end).map(Outcome::Stopped))
    }

    /// When all bodies will have been slow for long enough [s], as far as is known; none while one of them is not slow.
    fn rest(&self) -> Option<f64> {
        let hold = self.plan.stop_at_rest?.hold;
        let since = self.partition.islands.iter().map(|island| island.state.slow_since);
        // A maximum that is not a number where one of them is none.
        let all = since.reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })?;
        all.is_finite().then_some(all + hold)
    }

    /// Until when the run is known, and goes on [s]: behind the time of rest there are neither samples nor events.
    fn last_time(&self) -> f64 {
        self.rest().map_or(self.state.time, |rest| rest.min(self.state.time))
    }

    /// Ends with the last row, if there is one.
    fn stop(&mut self, stop: Stop, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        if self.is_whole() && !is_asked(&stop) {
            self.record_last(sink)?.ok();
        }
        Ok(Outcome::Stopped(stop))
    }
}

/// Whether this thread rounds what is below the normal numbers to zero.
fn flushes() -> bool {
    std::hint::black_box(f64::MIN_POSITIVE) * std::hint::black_box(0.5) == 0.0
}

/// Whether somebody wanted the stop, who may let the run go on.
fn is_asked(stop: &Stop) -> bool {
    matches!(stop.reason, Reason::Interrupted | Reason::WallTime)
}

impl WindowEnd for Simulation {
    fn checkpoint(&self) -> Vec<u8> {
        Self::checkpoint(self)
    }

    fn state(&self) -> State {
        Self::state(self)
    }
}
