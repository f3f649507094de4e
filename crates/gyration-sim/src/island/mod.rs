//! An island: bodies on which no others act, with an integrator of their own.
//!
//! What an island does depends on its own bodies alone: its steps, the errors that they are allowed, its works and its
//! events are what they would be if there were no others. A run asks it to come to a time, and it does so by whole
//! steps: the last one ends there or beyond, and its interpolant says what lies between. How often it is asked leaves
//! no trace in any number.

mod approach;
mod carried;
mod detection;
mod effort;
mod half_turns;
pub(crate) mod horizon;
mod linkages;
mod merging;
mod noting;
mod pack;
mod pair_approach;
mod passing;
mod path_bound;
mod paths;
mod peak_forces;
mod plane_approach;
pub(crate) mod pool;
mod presses;
mod restart_point;
mod rollback;
pub(crate) mod step_end;
mod within;

use crate::adapter::ModelSystem;
use crate::events::{FoundEvent, Signals};
use crate::outcome::Stop;
use crate::peaks::Peaks;
use crate::plan::RunPlan;
use crate::run_state::{IslandMemory, IslandState};
pub(crate) use effort::Effort;
use gyration::Team;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_ode::{Integrator, Memory, MemoryError, StepReport};
use gyration_threads::{Interruption, with_threads_at_hand};
use horizon::horizon;
pub(crate) use path_bound::PathBound;
pub(crate) use paths::Paths;
use restart_point::RestartPoint;
use std::ops::Range;
use step_end::StepEnd;

/// So many bodies that meet others or supports are 1.2 times as fast on two threads as on one, more gain more
/// (`bench/2026-11-28-crowds.md`). Rigid balls, which have closed forms, do not count.
const WORTH_A_TEAM: usize = 12;

/// What islands of a run begin from.
#[derive(Clone, Copy)]
pub(crate) struct Setting<'a> {
    /// All bodies of the run.
    pub model: &'a Model,
    /// The first state, from which the scales come.
    pub start: &'a State,
    /// The speed scales of all bodies [m/s].
    pub speeds: &'a [f64],
    pub plan: &'a RunPlan,
}

/// Bodies with an integrator of their own.
pub(crate) struct Island {
    /// Which bodies of the run, in order.
    members: Vec<usize>,
    /// Where the numbers of each body stand among those of the run.
    places: Vec<Range<usize>>,
    /// Which of the quadratures of the run each of its own is: works and, where they are asked for, impulses.
    works: Vec<usize>,
    pub system: ModelSystem,
    pub integrator: Integrator,
    /// Beside the state, what its steps change.
    pub state: IslandState,
    /// The bodies at the end of the last step.
    pub step_ends: Vec<StepEnd>,
    /// A state within the last step; scratch between samples.
    pub sampled: State,
    /// |f| of the contacts of each body after the last step [N].
    pub forces: Vec<f64>,
    /// Events that are not handed on yet, in order of time.
    pub events: Vec<FoundEvent>,
    /// Scratch: the signals of each body at a time within the step.
    pub signals: Vec<Signals>,
    /// Scratch: since when each signal of each body is known within the step [s].
    pub since: Vec<[f64; 3]>,
    /// Scratch: the bodies that are pushed at both ends of the step, and changes of their velocities within [m/s].
    pushed: Vec<usize>,
    changes: Vec<Vec3>,
    /// The largest contact forces before the last step; those behind it stand in the state.
    pub peaks_before: Peaks,
    /// From when to when its interpolant is known [s]; none before the first step.
    pub last_step: Option<(f64, f64)>,
    /// The last step.
    pub report: Option<StepReport>,
    /// The steps of this window.
    pub effort: Effort,
    /// Why it came no further.
    pub stop: Option<Stop>,
    /// Those of its bodies since the time of the run, where bodies may meet others.
    pub paths: Option<Paths>,
    /// From where it can be begun again; none where nobody will ask for that.
    pub restart_point: Option<RestartPoint>,
}

impl Island {
    /// Bodies of a run before its first step. One island that is the whole run and stays so needs no restart point.
    ///
    /// # Errors
    /// [`Stop`] if the start is outside the model.
    pub fn new(setting: Setting, members: Vec<usize>, stays: bool) -> Result<Self, Stop> {
        let Setting { model, start, speeds, plan } = setting;
        let is_whole = members.len() == model.bodies.len();
        let part = if is_whole { model.clone() } else { model.part(&members) };
        let places: Vec<Range<usize>> = members.iter().map(|body| model.blocks()[*body].clone()).collect();
        let of_part = |all: &[f64]| places.iter().flat_map(|place| all.get(place.clone())).flatten().copied().collect();
        let place = |work| model.works().iter().position(|other| *other == work);
        let first = model.works().len();
        let axes = members.iter().flat_map(|body| (0..3).map(move |axis| first + 3 * body + axis));
        let impulses = axes.filter(|_| plan.extras.impulses());
        let works: Vec<usize> = part.works().iter().filter_map(|work| place(*work)).chain(impulses).collect();
        let own = State {
            time: start.time,
            bodies: of_part(&start.bodies),
            low: of_part(&start.low),
            works: works.iter().map(|work| start.works.get(*work).copied().unwrap_or(0.0)).collect(),
        };
        let speeds = members.iter().map(|body| speeds[*body]).collect();
        let system = ModelSystem::of_run(part.clone(), &own, plan.tolerance, speeds);
        let system = system.map_err(|left| Stop::by_inadmissible(&part, start.time, &left))?;
        let system = system.with_impulses(plan.extras.impulses());
        let integrator = Integrator::new(own.time, &own.bodies, &own.works, plan.options);
        let mut state = IslandState::new(members.len());
        if plan.extras.peak_forces() {
            state.peaks = Peaks { sample: plan.next_sample(start.time), forces: vec![0.0; members.len()] };
        }
        let paths = (!stays).then(|| Paths::of(members.len()));
        let mut this = Self {
            members,
            places,
            works,
            system,
            integrator,
            state,
            step_ends: Vec::new(),
            sampled: State { low: vec![0.0; own.bodies.len()], ..own },
            forces: Vec::new(),
            events: Vec::new(),
            signals: Vec::new(),
            since: Vec::new(),
            pushed: Vec::new(),
            changes: Vec::new(),
            peaks_before: Peaks::default(),
            last_step: None,
            report: None,
            effort: Effort::default(),
            stop: None,
            paths,
            restart_point: None,
        };
        this.read_step_end();
        if this.system.may_be_given_up() {
            return Err(Stop::by_interruption(start.time));
        }
        this.note_in_play();
        if !(is_whole && stays) {
            this.restart_point = Some(RestartPoint::new(this.memory()));
        }
        if pool::borrows_scratch(&this) {
            this.system.forget_workspace();
        }
        Ok(this)
    }

    /// Learns what there is to know of the start.
    pub fn begin(&mut self, plan: &RunPlan) {
        self.find_forces();
        for body in 0..self.step_ends.len() {
            self.state.signals[body] = self.signals(body);
        }
        if self.is_slow(plan) {
            self.state.slow_since = self.time();
        }
        if let Some(restart_point) = &mut self.restart_point {
            restart_point.drop_at(&self.state, &self.integrator);
        }
    }

    /// Which bodies of the run, in order.
    pub fn members(&self) -> &[usize] {
        &self.members
    }

    /// The first of its bodies, by which it is known.
    pub fn first_body(&self) -> usize {
        self.members[0]
    }

    /// The model of its bodies.
    pub fn model(&self) -> &Model {
        self.system.model()
    }

    /// The time that it has come to [s].
    pub fn time(&self) -> f64 {
        self.integrator.time()
    }

    /// What it goes on from after a checkpoint: the same bytes follow.
    pub fn memory(&self) -> IslandMemory {
        match &self.restart_point {
            Some(restart_point) => restart_point.kept().clone(),
            None => self.memory_now(),
        }
    }

    /// Its memory where it stands.
    fn memory_now(&self) -> IslandMemory {
        let (members, state) = (self.members.clone(), self.state.clone());
        IslandMemory { members, state, stepper: self.integrator.memory() }
    }

    /// Goes on from a memory, up to the time that the run had come to; its events until then are known.
    ///
    /// # Errors
    /// [`MemoryError`] if it is not one of this island.
    pub fn resume(&mut self, memory: &IslandMemory, plan: &RunPlan, time: f64) -> Result<(), MemoryError> {
        // What has been done once is not given up.
        Interruption::default().within(|| {
            self.restore(memory, plan)?;
            if self.restart_point.is_none() && self.time() < time {
                self.restart_point = Some(RestartPoint::new(memory.clone()));
            }
            // The step behind the memory reaches over the time.
            if self.time() < time && !self.state.is_parting && self.step(plan).is_ok() && self.time() < time {
                return Err(MemoryError::Number { what: "a time" });
            }
            self.events.retain(|found| found.event.time > time);
            Ok(())
        })
    }

    /// Is again what a memory holds.
    ///
    /// # Errors
    /// [`MemoryError`] if it is not one of this island.
    pub fn restore(&mut self, memory: &IslandMemory, plan: &RunPlan) -> Result<(), MemoryError> {
        self.integrator = self.integrator_of(memory, &[], plan)?;
        self.state.clone_from(&memory.state);
        self.last_step = None;
        self.effort.forget();
        if let Some(restart_point) = &mut self.restart_point {
            restart_point.drop_at(&self.state, &self.integrator);
        }
        self.events.retain(|found| found.event.time <= memory.stepper.time());
        self.paths.iter_mut().for_each(Paths::clear);
        self.stop = None;
        self.read_step_end();
        Ok(())
    }

    /// The integrator of a memory, with the last step of which these are the numbers.
    fn integrator_of(
        &self,
        memory: &IslandMemory,
        last_step: &[f64],
        plan: &RunPlan,
    ) -> Result<Integrator, MemoryError> {
        let (numbers, works) = (self.integrator.state().len(), self.integrator.quadratures().len());
        let integrator = Integrator::resume_within(&memory.stepper, last_step, plan.options)?;
        let fits = integrator.state().len() == numbers && integrator.quadratures().len() == works;
        if !fits || memory.state.signals.len() != self.members.len() {
            let Memory { integers, reals } = &memory.stepper;
            return Err(MemoryError::Length { integers: integers.len(), reals: reals.len() });
        }
        Ok(integrator)
    }

    /// Whether threads that share out its pairs and bodies among them have enough to do.
    pub fn is_worth_a_team(&self) -> bool {
        let model = self.model();
        let costs = |body: &usize| !model.bodies[*body].is_rigid_ball() && model.has_contact(*body);
        (0..model.bodies.len()).filter(costs).nth(WORTH_A_TEAM - 1).is_some()
    }

    /// The same as [`Island::reach`], with a team if it is worth one.
    pub fn reach_with(&mut self, team: Option<Team>, until: f64, most: u64, plan: &RunPlan) {
        let Some(team) = team.filter(|_| self.is_worth_a_team() && self.time() < until) else {
            return self.reach(until, most, plan);
        };
        with_threads_at_hand(team.threads, || {
            self.system.observed().1.work_with(Some(team));
            self.reach(until, most, plan);
            self.system.observed().1.work_with(None);
        });
    }

    /// Steps until a time is reached, or so many steps are made; the reason is in `stop` if it cannot go on. An
    /// interruption in force is heeded between two steps.
    pub fn reach(&mut self, until: f64, most: u64, plan: &RunPlan) {
        self.stop = None;
        for step in 0..most {
            if self.time() >= until || self.state.is_parting {
                return;
            }
            if step > 0 && Interruption::due().is_some() {
                self.stop = Some(Stop::by_interruption(self.time()));
                return;
            }
            if let Some(restart_point) = &mut self.restart_point {
                restart_point.before_step(&self.state, &self.integrator, until);
            }
            match self.step(plan) {
                Ok(report) => self.report = Some(report),
                Err(stop) => {
                    self.stop = Some(stop);
                    return;
                }
            }
        }
    }

    /// Keeps what was done until a time that all islands have come to: none will go back behind it.
    pub fn commit(&mut self, time: f64) {
        if let Some(restart_point) = &mut self.restart_point {
            restart_point.commit(&self.state, &self.integrator, time);
        }
        self.paths.iter_mut().for_each(|paths| paths.forget(time));
    }

    /// Makes one step and finds its events.
    pub fn step(&mut self, plan: &RunPlan) -> Result<StepReport, Stop> {
        self.step_towards(self.target(plan), plan)
    }

    /// The same no farther than to a time.
    pub fn step_towards(&mut self, target: f64, plan: &RunPlan) -> Result<StepReport, Stop> {
        self.touch().map_or(Ok(()), Err)?;
        let (before, time) = (self.dissipation(), self.time());
        let made = self.integrator.step(&mut self.system, target);
        if self.system.was_interrupted() {
            // A shorter step that has gone well is another one than the run would have made.
            return Err(Stop::by_interruption(time));
        }
        let outside = |failure| Stop::by_failure(self.system.model(), &failure, self.integrator.state());
        let report = made.map_err(outside)?;
        self.effort.count(self.members.len());
        self.read_step_end();
        self.state.largest_projection = self.state.largest_projection.max(report.projection);
        self.state.note_dissipation(before, self.dissipation());
        self.note_in_play();
        self.find_events(&report);
        self.note_peaks(report.start, report.end, plan);
        self.note_path_bounds(&report);
        self.note_parting();
        self.note_rest(plan, &report);
        self.check_frictions(report.end)?;
        self.check_half_turns(&report)?;
        self.check_linkages(&report)?;
        self.check_presses(&report, plan.end)?;
        if self.system.may_be_given_up() {
            // Gaps and forces at its end are not all known.
            return Err(Stop::by_interruption(time));
        }
        Ok(report)
    }

    /// Tests the frictions that change with the place at the end of the last step [s].
    fn check_frictions(&mut self, time: f64) -> Result<(), Stop> {
        let (model, workspace) = self.system.observed();
        for (index, (body, end)) in model.bodies.iter().zip(&self.step_ends).enumerate() {
            if body.own.frictions.is_empty() {
                continue;
            }
            let checked = workspace.check_frictions(body, &end.motion.placement, time);
            checked.map_err(|fault| Stop::by_friction(model.name(index), time, &fault))?;
        }
        Ok(())
    }

    /// Restarts the stepper after a change of the model.
    ///
    /// # Errors
    /// [`Stop`] if the system has no rates.
    pub fn restart(&mut self) -> Result<(), Stop> {
        let restarted = self.integrator.restart(&mut self.system);
        let outside = |failure| Stop::by_failure(self.system.model(), &failure, self.integrator.state());
        restarted.map_err(outside)?;
        self.last_step = None;
        // Before the first step the rates at the start stand in the system.
        let (rates, _) = self.integrator.rates();
        step_end::read(&mut self.step_ends, self.system.model(), self.integrator.state(), rates);
        self.find_gaps();
        if let Some(restart_point) = &mut self.restart_point {
            restart_point.drop_at(&self.state, &self.integrator);
        }
        Ok(())
    }

    /// The size that its next step is tried with [s].
    ///
    /// # Errors
    /// [`Stop`] if it has no rates.
    pub fn next_size(&mut self) -> Result<f64, Stop> {
        if self.integrator.next_size() == 0.0 {
            self.restart()?;
        }
        Ok(self.integrator.next_size())
    }

    /// Where the next step must end at the latest [s]: the end, the rest that would be long enough, the first time at
    /// which a support could be reached, or a sample of what loads between two steps would not show.
    pub fn target(&self, plan: &RunPlan) -> f64 {
        let time = self.time();
        let mut end = plan.end;
        if let Some(rest) = plan.stop_at_rest
            && self.state.slow_since.is_finite()
        {
            end = end.min((self.state.slow_since + rest.hold).max(time));
        }
        if end <= time {
            end = plan.end;
        }
        if remembers_changes(self.model()) {
            end = end.min(plan.sample_time(plan.next_sample(time)));
        }
        let (ends, lengths) =
            ((&self.step_ends[..], self.system.step_end_gaps()), (self.integrator.next_size(), end - time));
        let horizon = horizon(self.model(), time, ends, self.system.radii(), lengths);
        let target = time + horizon;
        // A horizon lost in rounding is no horizon: the domain of the rates then ends the run.
        if target > time { target.min(end) } else { end }
    }

    /// Reads the bodies at the end of the last step, or at the start.
    pub fn read_step_end(&mut self) {
        let started = self.integrator.next_size() != 0.0;
        let rates = if started { self.integrator.rates().0 } else { self.system.first_rates() };
        step_end::read(&mut self.step_ends, self.system.model(), self.integrator.state(), rates);
        self.find_gaps();
    }

    /// Where the numbers of each of its bodies stand among its own, and among those of the run.
    pub fn places(&self) -> impl Iterator<Item = (&Range<usize>, &Range<usize>)> {
        self.model().blocks().iter().zip(&self.places)
    }

    /// Which of the quadratures of the run each of its own is.
    pub fn works(&self) -> &[usize] {
        &self.works
    }

    /// Its works since it began [J].
    pub fn done(&self) -> &[f64] {
        &self.integrator.quadratures()[..self.model().works().len()]
    }
}

/// Whether a fluid that changes in time remembers a body. The modes of its history that have nearly come to rest weigh
/// a million: between two steps they are interpolated, the flow is as it is, and loads have the difference.
fn remembers_changes(model: &Model) -> bool {
    let changes = model.fluid.as_ref().is_some_and(|fluid| fluid.signals().iter().any(|signal| !signal.is_steady()));
    changes && model.bodies.iter().any(|body| body.history().is_some())
}
