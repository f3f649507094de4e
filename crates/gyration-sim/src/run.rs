//! The run loop: windows, events, samples, audit, rest; until the end, rest, or a stop.
//!
//! Each body that nothing joins to another is an island with steps of its own. In a window every island comes to one
//! time or beyond; then what is known of all until the first of them is handed on: events in order of time and body,
//! rows, the verdict on rest, a checkpoint. How wide windows are and how many threads share the islands out leaves no
//! trace in any number.
//!
//! Sampling never changes the steps: rows come from the dense output. Samples are at t = k·sample (multiplied, not
//! accumulated); one within 1e-9·sample of `end` is `end`; the last row is the end or the stop. The mechanics reads no
//! clock; the loop asks its [`Monitor`] whether to go on, and the [`Interruption`] in force.
//!
//! Where one island cannot go on, the run ends at the time to which that one has come: the others go back to the
//! beginning of the window, and come to that time. An interruption ends it in the same way where the island is that has
//! come least far. It may come within a step, where a resistance takes long. What has come of that window is then none
//! of the run ([`Simulation::is_whole`]).

use crate::events::Event;
use crate::island::Island;
use crate::outcome::{Outcome, Reason, Stop};
use crate::plan::RunPlan;
use crate::ports::{Monitor, Progress, RunError, Sink, WindowEnd};
use crate::rows::{Fields, Ledger, RowScratch};
use crate::run_state::{IslandMemory, RunState};
use crate::sum::Sum;
use gyration::Inadmissible;
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::state::{BodyMotion, State};
use gyration_ode::Statistics;
use gyration_threads::{Interruption, in_order};
use std::num::NonZeroUsize;

/// Steps of all islands together in a window: fewer, and windows become wider; more, and they become narrower. So a
/// window takes a part of a second, and to share it out among threads next to nothing.
const STEPS: [u64; 2] = [1 << 12, 1 << 14];
/// Steps of all islands together at most before the monitor is asked again.
const MOST_STEPS: u64 = 1 << 14;
/// A window that takes more than so many times that ends before its time.
const MOST_ROUNDS: u32 = 4;
/// The first window is this part of the run, or of a sample.
const FIRST_WINDOW: f64 = 1e-6;
/// Into how many pieces of work the islands are shared out, for each thread.
const PIECES: usize = 16;

/// A run under way.
pub struct Simulation {
    model: Model,
    pub(crate) plan: RunPlan,
    pub(crate) islands: Vec<Island>,
    /// The island of each body, and its place there.
    homes: Vec<(usize, usize)>,
    state: RunState,
    /// How wide windows may be [s].
    window: f64,
    /// How wide the last one was [s].
    width: f64,
    /// The bodies of all islands at one time.
    joined: State,
    sums: Vec<Sum>,
    /// What the rows hold, and scratch for them.
    fields: Fields,
    rows: RowScratch,
    workspace: Workspace,
    /// The time of the last row [s].
    recorded: f64,
    /// Scratch: the events of a window.
    found: Vec<Event>,
    /// Whether an interruption came within a step.
    is_broken: bool,
}

impl Simulation {
    /// Prepares a run from its start, an island for each body; nothing is recorded yet.
    ///
    /// # Errors
    /// [`RunError::Start`] if the start is outside the model.
    pub fn new(model: &Model, start: &State, plan: RunPlan) -> Result<Self, RunError> {
        Self::of_islands(model, start, plan, (0..model.bodies.len()).map(|body| vec![body]))
    }

    /// The same with all bodies in one island: one step serves all.
    pub fn together(model: &Model, start: &State, plan: RunPlan) -> Result<Self, RunError> {
        Self::of_islands(model, start, plan, [(0..model.bodies.len()).collect()].into_iter())
    }

    fn of_islands(
        model: &Model,
        start: &State,
        plan: RunPlan,
        members: impl Iterator<Item = Vec<usize>>,
    ) -> Result<Self, RunError> {
        let outside = |left: Box<(Model, Inadmissible)>| {
            let (part, left) = *left;
            RunError::at_start(Stop::by_inadmissible(&part, start.time, &left))
        };
        let islands = members.map(|members| Island::new(model, start, &plan, members).map_err(outside));
        let islands = islands.collect::<Result<Vec<_>, _>>()?;
        let mut homes = vec![(0, 0); model.bodies.len()];
        for (index, island) in islands.iter().enumerate() {
            island.members().iter().enumerate().for_each(|(place, body)| homes[*body] = (index, place));
        }
        Ok(Self {
            islands,
            homes,
            state: RunState::new(start.time),
            window: FIRST_WINDOW * plan.sample.min(plan.end),
            width: 0.0,
            joined: State { low: vec![0.0; start.bodies.len()], ..start.clone() },
            sums: Vec::new(),
            fields: Fields::new(model, &plan.extras),
            rows: RowScratch::default(),
            workspace: Workspace::default(),
            recorded: f64::NEG_INFINITY,
            found: Vec::new(),
            is_broken: false,
            model: model.clone(),
            plan,
        })
    }

    /// Goes on from a checkpoint of the same scene; `start` is the scene's start, from which the scales come.
    ///
    /// # Errors
    /// [`RunError::Checkpoint`] if the bytes are not a checkpoint of this scene.
    pub fn resume(model: &Model, start: &State, plan: RunPlan, checkpoint: &[u8]) -> Result<Self, RunError> {
        let mut this = Self::new(model, start, plan)?;
        let unfit =
            || RunError::Checkpoint("its bytes are damaged, or another version of the program wrote them".into());
        let (state, memories) = RunState::restore(checkpoint).ok_or_else(unfit)?;
        if memories.len() != this.islands.len() {
            return Err(unfit());
        }
        let is_before = |memory: &IslandMemory| memory.stepper.time() <= state.time;
        if !(state.time <= plan.end && memories.iter().all(is_before)) {
            return Err(unfit());
        }
        for (island, memory) in this.islands.iter_mut().zip(&memories) {
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
        let first = self.islands.first().map_or_else(Statistics::default, |first| *first.integrator.statistics());
        self.islands.iter().skip(1).fold(first, |sum, island| sum.and(island.integrator.statistics()))
    }

    /// Largest correction by projection after a step.
    pub(crate) fn largest_projection(&self) -> f64 {
        self.islands.iter().map(|island| island.state.largest_projection).fold(0.0, f64::max)
    }

    /// Largest increment over a step of an island of each work that only takes [J]; −∞ before the first.
    pub(crate) fn largest_gains(&self) -> [f64; 2] {
        let gains = self.islands.iter().map(|island| island.state.largest_gains);
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
            return self.joined.clone();
        }
        let (time, mut sums) = (self.state.time, vec![Sum::default(); self.model.works().len()]);
        let mut state = State { time, ..self.joined.clone() };
        for island in &self.islands {
            island.join(&island.state_at(time), &mut state.bodies, &mut state.low, &mut sums);
        }
        state.works = sums.iter().map(Sum::value).collect();
        state
    }

    /// Whether there are islands at different times that have no common one.
    fn is_scattered(&self) -> bool {
        self.is_broken && self.islands.len() > 1
    }

    /// Lets all islands that are beyond the time of the run end a step there.
    pub(crate) fn land(&mut self) {
        if self.islands.len() == 1 {
            return;
        }
        let time = self.state.time;
        self.plan.end = time;
        for island in self.islands.iter_mut().filter(|island| island.time() > time) {
            island.go_back(&self.plan, time);
        }
        self.settle();
    }

    /// A checkpoint at [`Simulation::time`].
    pub fn checkpoint(&self) -> Vec<u8> {
        self.state.checkpoint(self.islands.iter().map(Island::memory))
    }

    /// Records the row t = 0.
    ///
    /// # Errors
    /// [`RunError`] if the start is outside the model or the row cannot be stored.
    pub fn begin(&mut self, sink: &mut dyn Sink) -> Result<(), RunError> {
        self.sample(self.state.time);
        if let Err(stop) = self.record(sink)? {
            return Err(RunError::at_start(stop));
        }
        self.state.next_sample = 1;
        for island in &mut self.islands {
            island.begin(&self.plan);
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
        let asked = self.ask(monitor).map(|reason| Stop::by_request(time, reason));
        let asked = asked.or_else(|| Interruption::due().map(|_| Stop::by_interruption(time)));
        Ok(asked.filter(|_| time < end).map(Outcome::Stopped))
    }

    /// Tells the monitor how far the run is, and which island holds it up: the one whose last step was the shortest.
    pub(crate) fn ask(&self, monitor: &mut dyn Monitor) -> Option<Reason> {
        let length = |island: &&Island| island.report.as_ref().map_or(f64::INFINITY, |step| step.end - step.start);
        let slowest = self.islands.iter().min_by(|a, b| length(a).total_cmp(&length(b)))?;
        let step = slowest.report.as_ref()?;
        let statistics = &self.statistics();
        let model = slowest.model();
        monitor.after_step(&Progress { time: self.state.time, end: self.plan.end, step, statistics, model })
    }

    /// Makes one window and hands on its events.
    pub(crate) fn step(
        &mut self,
        sink: &mut dyn Sink,
        monitor: &mut dyn Monitor,
    ) -> Result<Result<(), Stop>, RunError> {
        let before = self.state.time;
        let mut until = self.window_end(sink.wants_event_rows() || monitor.counts_steps());
        let (mut stop, mut rounds) = (None, 0);
        loop {
            self.reach(until, MOST_STEPS);
            if self.islands.iter().any(|island| island.system.was_interrupted()) {
                self.is_broken = true;
                return Ok(Err(Stop::by_interruption(before)));
            }
            if let Some(found) = self.first_stop() {
                // Those that are behind it may stop earlier still.
                until = found.time;
                stop = Some(found);
            }
            let time = self.least_time();
            if time >= until {
                break;
            }
            let asked = self.ask(monitor).map(|reason| Stop::by_request(time, reason));
            let asked = asked.or_else(|| Interruption::due().map(|_| Stop::by_interruption(time)));
            if asked.is_some() {
                stop = asked;
                break;
            }
            rounds += 1;
            if rounds == MOST_ROUNDS && stop.is_none() {
                break;
            }
        }
        let reached = until.min(self.least_time());
        if stop.is_some() || reached < until {
            self.go_back(reached);
        }
        self.settle();
        self.width = self.state.time - before;
        self.hand_on_events(before, sink)?;
        Ok(stop.map_or(Ok(()), Err))
    }

    /// Up to where the next window goes [s]: to the next sample or the first time of rest at most, so that both lie
    /// within the last steps of all islands. What is known of all must be so at every event where rows are wanted
    /// there: then only the islands that are behind all others make a step.
    fn window_end(&mut self, at_events: bool) -> f64 {
        let time = self.state.time;
        if self.islands.len() == 1 || at_events {
            return time.next_up();
        }
        let steps = self.islands.iter_mut().map(|island| std::mem::take(&mut island.window_steps));
        let steps: u64 = steps.sum();
        if steps < STEPS[0] && self.width >= self.window {
            self.window *= 2.0;
        } else if steps > STEPS[1] {
            self.window = 0.5 * self.window.min(self.width);
        }
        let mut until = (time + self.window).min(self.plan.end).min(self.sample_time(self.state.next_sample));
        if let Some(criterion) = self.plan.stop_at_rest {
            until = until.min(self.rest().unwrap_or(time + criterion.hold));
        }
        if until > time { until } else { time.next_up() }
    }

    /// Lets all islands come to a time, or make so many steps towards it, all together.
    fn reach(&mut self, until: f64, most: u64) {
        let (plan, threads) = (&self.plan, self.plan.threads.unwrap_or(NonZeroUsize::MIN));
        let count = self.islands.iter().filter(|island| island.time() < until).count();
        let most = (most / count.max(1) as u64).max(1);
        let behind = self.islands.iter_mut().filter(|island| island.time() < until);
        let is_step = until == self.state.time.next_up();
        if threads.get() == 1 || count == 1 || is_step {
            behind.for_each(|island| island.reach(until, most, plan));
            return;
        }
        let interruption = Interruption::in_force();
        let mut behind: Vec<&mut Island> = behind.collect();
        let piece = count.div_ceil(PIECES * threads.get()).max(1);
        in_order(behind.chunks_mut(piece), threads, |islands| {
            interruption.within(|| islands.iter_mut().for_each(|island| island.reach(until, most, plan)));
        });
    }

    /// The stop that comes first, if any; of several at one time that of the first body. An interruption is where the
    /// island is that has come least far, unless that one cannot go on.
    fn first_stop(&mut self) -> Option<Stop> {
        let least = self.least_time();
        let (mut first, mut asked): (Option<Stop>, Option<Stop>) = (None, None);
        for stop in self.islands.iter_mut().filter_map(|island| island.stop.take()) {
            if is_asked(&stop) {
                asked = asked.or(Some(stop));
            } else if first.as_ref().is_none_or(|first| stop.time < first.time) {
                first = Some(stop);
            }
        }
        match (first, asked) {
            (Some(first), Some(asked)) if first.time > least => Some(Stop { time: least, ..asked }),
            (None, Some(asked)) => Some(Stop { time: least, ..asked }),
            (first, _) => first,
        }
    }

    /// The time of the island that has come least far [s]; the end if nothing moves.
    fn least_time(&self) -> f64 {
        self.islands.iter().map(Island::time).reduce(f64::min).unwrap_or(self.plan.end)
    }

    /// Undoes what islands have done in this window beyond the step that reaches a time to which all have come.
    fn go_back(&mut self, time: f64) {
        for island in self.islands.iter_mut().filter(|island| island.time() > time) {
            island.go_back(&self.plan, self.state.time);
        }
        // They have been there once.
        Interruption::default().within(|| self.reach(time, u64::MAX));
    }

    /// The time that all islands have come to is that of the run.
    fn settle(&mut self) {
        self.state.time = self.least_time();
        for island in &mut self.islands {
            island.settle(self.state.time);
        }
    }

    /// Hands on the events up to the time of the run, in order of time and body.
    fn hand_on_events(&mut self, before: f64, sink: &mut dyn Sink) -> Result<(), RunError> {
        let mut found = std::mem::take(&mut self.found);
        found.clear();
        let time = self.state.time;
        for island in &mut self.islands {
            let known = island.events.partition_point(|event| event.time <= time);
            found.extend(island.events.drain(..known));
        }
        debug_assert!(found.iter().all(|event| event.time >= before));
        // In place: nothing is allocated.
        found.sort_unstable_by(|a, b| a.time.total_cmp(&b.time).then((a.body, a.kind).cmp(&(b.body, b.kind))));
        for event in &found {
            self.state.events[event.kind] += 1;
            sink.event(event)?;
            if sink.wants_event_rows() && self.fill_row(event.time) {
                sink.event_row(event, &self.rows.row)?;
            }
        }
        self.found = found;
        Ok(())
    }

    /// Fills the row of a time within the last steps; false where that state is outside the model.
    fn fill_row(&mut self, time: f64) -> bool {
        self.sample(time);
        let (model, initial) = (&self.model, Some(self.state.initial_energy));
        self.fields.fill(model, &mut self.workspace, &self.joined, initial, &mut self.rows).is_ok()
    }

    /// Restarts the stepper of the island of a body after a change of its loads or drive.
    pub(crate) fn restart(&mut self, body: usize) -> Result<(), Stop> {
        self.islands[self.homes[body].0].restart()
    }

    /// Changes loads or drive of a body, by its place in a model; what `change` says of it.
    pub(crate) fn change<T>(&mut self, body: usize, mut change: impl FnMut(&mut Model, usize) -> T) -> T {
        let (island, place) = self.homes[body];
        change(self.islands[island].system.model_mut(), place);
        change(&mut self.model, body)
    }

    /// When all bodies will have been slow for long enough [s], as far as is known; none while one of them is not slow.
    fn rest(&self) -> Option<f64> {
        let hold = self.plan.stop_at_rest?.hold;
        let since = self.islands.iter().map(|island| island.state.slow_since);
        // A maximum that is not a number where one of them is none.
        let all = since.reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })?;
        all.is_finite().then_some(all + hold)
    }

    /// Ends with the last row, if there is one.
    fn stop(&mut self, stop: Stop, sink: &mut dyn Sink) -> Result<Outcome, RunError> {
        if self.is_whole() && !is_asked(&stop) {
            self.record_last(sink)?.ok();
        }
        Ok(Outcome::Stopped(stop))
    }

    /// The time of sample k [s]; one within 1e-9·sample of the end is the end.
    fn sample_time(&self, k: u64) -> f64 {
        let time = k as f64 * self.plan.sample;
        if (time - self.plan.end).abs() <= 1e-9 * self.plan.sample { self.plan.end } else { time }
    }

    /// Records the samples up to the time of the run, and the end; a sample outside the model is a stop.
    fn sample_window(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        // Behind the time of rest there are none.
        let last = self.rest().map_or(self.state.time, |rest| rest.min(self.state.time));
        while self.sample_time(self.state.next_sample) <= last {
            self.sample(self.sample_time(self.state.next_sample));
            if let Err(stop) = self.record(sink)? {
                return Ok(Err(stop));
            }
            self.state.next_sample += 1;
        }
        if last >= self.plan.end { self.record_last(sink) } else { Ok(Ok(())) }
    }

    /// Records the state at the time of the run, unless it was just sampled.
    ///
    /// # Errors
    /// [`RunError::Record`] if the row cannot be stored; within, a stop if the state is outside the model.
    pub fn record_last(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        // Of several islands that are broken there is no state at one time.
        if self.recorded >= self.state.time || self.is_scattered() {
            return Ok(Ok(()));
        }
        self.sample(self.state.time);
        self.record(sink)
    }

    /// Samples all bodies at a time within the last steps.
    fn sample(&mut self, time: f64) {
        let Self { islands, joined, sums, .. } = self;
        joined.time = time;
        sums.clear();
        sums.resize(joined.works.len(), Sum::default());
        for island in islands {
            island.sample(time);
            island.join(&island.sampled, &mut joined.bodies, &mut joined.low, sums);
        }
        for (work, sum) in joined.works.iter_mut().zip(sums) {
            *work = sum.value();
        }
    }

    /// The ledger at the time of the run.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub(crate) fn ledger(&mut self) -> Result<Ledger, Stop> {
        self.sample(self.state.time);
        let (model, joined, initial) = (&self.model, &self.joined, Some(self.state.initial_energy));
        let ledger = Ledger::of(model, &mut self.workspace, joined, initial);
        ledger.map_err(|left| Stop::by_inadmissible(model, joined.time, &left))
    }

    /// All that a recording would hold of the time of the run.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub(crate) fn row(&mut self) -> Result<Vec<f64>, Stop> {
        self.sample(self.state.time);
        let Self { model, fields, workspace, joined, rows, state, .. } = self;
        let filled = fields.fill(model, workspace, joined, Some(state.initial_energy), rows);
        filled.map_err(|left| Stop::by_inadmissible(model, joined.time, &left))?;
        Ok(rows.row.clone())
    }

    /// Placement and velocity of a body after the last step of its island.
    pub(crate) fn motion(&self, body: usize) -> &BodyMotion {
        let (island, place) = self.homes[body];
        &self.islands[island].step_ends[place].motion
    }

    /// The shortest step that one of several islands would make [s]; none of one island, which makes it by itself.
    ///
    /// # Errors
    /// [`Stop`] if one of them has no rates.
    pub(crate) fn shortest_step(&mut self) -> Result<Option<f64>, Stop> {
        if self.islands.len() == 1 {
            return Ok(None);
        }
        let steps = self.islands.iter_mut().map(Island::next_size);
        steps.collect::<Result<Vec<_>, _>>().map(|steps| steps.into_iter().reduce(f64::min))
    }

    /// What the rows hold.
    pub(crate) fn fields(&self) -> &Fields {
        &self.fields
    }

    /// Records `joined` and audits it, unless it is outside the model.
    fn record(&mut self, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        let time = self.joined.time;
        let first = self.state.next_sample == 0;
        let initial = (!first).then_some(self.state.initial_energy);
        let viscous = self.islands.iter().map(|island| island.system.viscous_energy()).sum();
        let filled = self.fields.fill(&self.model, &mut self.workspace, &self.joined, initial, &mut self.rows);
        let audit = match filled {
            Ok(audit) => audit,
            Err(left) => {
                self.is_broken |= left.quantity == gyration::Quantity::Interruption;
                return Ok(Err(Stop::by_inadmissible(&self.model, time, &left)));
            }
        };
        if !audit.energy.is_finite() {
            return Ok(Err(Stop::by_infinite_energy(time)));
        }
        sink.row(time, &self.rows.row)?;
        self.recorded = time;
        let state = &mut self.state;
        if first {
            state.initial_energy = audit.energy;
        }
        state.energy_in_play = state.energy_in_play.max(audit.kinetic).max(audit.exchanged).max(viscous);
        state.note_residual(audit.residual);
        state.smallest_gap = state.smallest_gap.min(audit.smallest_gap);
        Ok(Ok(()))
    }
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
