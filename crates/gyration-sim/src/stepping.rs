//! Stepping: a run with a controller in the loop, which reads the state after a step and changes loads and drives.
//!
//!   m p̈₀ = m g + f + F,   P̈ J = M + M_a + ½ [τ]× P⁻ᵀ − V S,   Q = Q_applied + feedback
//!
//! Applied values are held from one change to the next (zero-order hold); they belong to the stepper and not to the
//! scene. Their work is `work.load`, that of a changed drive `work.drive`, so that the ledger still closes. After a
//! change the rates are evaluated anew and the error history is forgotten, the size of the step is not. The run does
//! not end by itself: neither at the scene's end nor at rest. It can be begun anew elsewhere (`begun_anew`), goes on
//! from a checkpoint (`checkpoint`), and is recorded where somebody asks for it (`recorder`).

mod begun_anew;
mod checkpoint;
mod recorder;

pub use self::begun_anew::BodyStart;
use crate::events::Event;
use crate::outcome::Stop;
use crate::plan::RunPlan;
use crate::ports::{Monitor, RunError, Sink};
use crate::record::{MemorySink, Unwatched};
use crate::rows::Ledger;
use crate::run::Simulation;
use gyration::balance::gaps;
use gyration::body::BodyKind;
use gyration::contractile::ContractionSource;
use gyration::dynamics::{Workspace, acting};
use gyration::load::{Applied, Loads};
use gyration::model::Model;
use gyration::signal::Signal;
use gyration::state::{BodyMotion, State};
use gyration::tensor::Mat3;
use gyration_ode::Statistics;
use gyration_scene::Built;
use recorder::Kept;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A run that its caller steps.
pub struct SteppedRun {
    simulation: Simulation,
    /// The model as the scene gives it, to which nothing is applied.
    scene: Model,
    /// As the scene asks for it, without samples.
    plan: RunPlan,
    /// The bodies whose loads or drives have changed since the last step.
    changed: BTreeSet<usize>,
    /// The drives that are held in the place of those of the scene.
    drives: BTreeMap<usize, Mat3>,
    kept: Kept,
}

/// Why a change was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// The scene has no such body.
    #[error("there is no body number {index}: the scene has {count}")]
    Body {
        /// What was asked for, from zero.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A number is not finite.
    #[error("body {body:?} is given a number that is not finite: look at what computed it")]
    NotFinite {
        /// The body.
        body: String,
    },
    /// Times near to one that is asked for cannot be told apart.
    #[error(
        "at t = {time:e} s the {span} s of the scene have less than three digits: begin at an earlier time, and shift \
         what depends on it"
    )]
    Time {
        /// What was asked for \[s\].
        time: f64,
        /// The end of the scene \[s\].
        span: f64,
    },
    /// The body has no drive.
    #[error(
        "body {body:?} has no drive to change: only a contractile body whose contraction is driven has; give it a \
         `contractile` with a `drive` (of zeros, if all of it comes from here)"
    )]
    NoDrive {
        /// The body.
        body: String,
    },
    /// A body cannot move like that.
    #[error(
        "body {body:?} cannot have this {quantity}: what it is and what it is kept to leave out {off:.1e} of it; give \
         a rigid body a rotation P with Pdot = [omega]x P, a body that keeps its volume det P = det G, and what joints, \
         pins and prescribed contractions allow"
    )]
    Impossible {
        /// The body.
        body: String,
        /// `position`, `P`, `velocity`, `Pdot` or `G`.
        quantity: &'static str,
        /// What is left of it, in its unit.
        off: f64,
    },
}

impl SteppedRun {
    /// Prepares a run from the start of a scene.
    ///
    /// # Errors
    /// [`RunError::Start`] if the start is outside the model.
    pub fn new(built: &Built) -> Result<Self, RunError> {
        let model = built.model.clone().under_control();
        let start = State { works: vec![0.0; model.works().len()], ..built.state.clone() };
        let plan = stepped_plan(built);
        let simulation = begun(&model, &start, plan)?;
        let (changed, drives) = (BTreeSet::new(), BTreeMap::new());
        Ok(Self { simulation, scene: model, plan, changed, drives, kept: Kept::default() })
    }

    /// The model as it is now.
    pub fn model(&self) -> &Model {
        self.simulation.model()
    }

    /// The time reached [s].
    pub fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// The counters so far.
    pub fn statistics(&self) -> Statistics {
        self.simulation.statistics()
    }

    /// The state reached.
    pub fn state(&self) -> State {
        self.simulation.state()
    }

    /// The events of all steps so far.
    pub fn events(&self) -> &[Event] {
        &self.kept.events
    }

    /// Placement and velocity of a body.
    pub fn motion(&self, body: usize) -> &BodyMotion {
        self.simulation.motion(body)
    }

    /// The smallest gap of each body to anything that it has a contact with [m], as rows have it; infinite without
    /// contact or surface.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub fn gaps(&self) -> Result<Vec<f64>, Stop> {
        let model = self.model();
        gaps(model, &mut Workspace::default(), &self.state())
            .map_err(|left| Stop::by_inadmissible(model, self.time(), &left))
    }

    /// f and M of the contacts of a body.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub fn contact_loads(&self, body: usize) -> Result<Loads, Stop> {
        let (state, mut workspace) = (self.state(), Workspace::default());
        let model = self.model();
        let read = workspace.read(model, &state);
        let loads = read.and_then(|(instant, scratch)| acting(&instant.at(body), scratch));
        let loads = loads.map_err(|left| Stop::by_inadmissible(model, self.time(), &left))?;
        Ok(loads.contact)
    }

    /// Energies, works and residual.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub fn ledger(&mut self) -> Result<Ledger, Stop> {
        self.simulation.ledger()
    }

    /// The names of the columns, in the order of the CSV, each with its place in the [`row`](Self::row).
    pub fn columns(&self) -> Vec<(String, usize)> {
        let (arrays, order) = self.simulation.fields().arrays(self.model());
        let mut places = std::collections::HashMap::new();
        let mut at = 0;
        for array in arrays {
            places.extend(array.columns.iter().cloned().zip(at..));
            at += array.row_len();
        }
        order.into_iter().filter_map(|name| places.get(&name).map(|place| (name.clone(), *place))).collect()
    }

    /// All that a recording would hold of the state reached.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not.
    pub fn row(&mut self) -> Result<Vec<f64>, Stop> {
        self.simulation.row()
    }

    /// Applies a load to a body until another is applied to it.
    ///
    /// # Errors
    /// [`Refusal`] if there is no such body, or a number is not finite.
    pub fn apply(&mut self, body: usize, load: Applied) -> Result<(), Refusal> {
        let name = self.named(body)?;
        if !load.is_finite() {
            return Err(Refusal::NotFinite { body: name });
        }
        if self.model().applied(body) != Some(&load) && self.simulation.change(body, |model, at| model.apply(at, load))
        {
            self.changed.insert(body);
        }
        Ok(())
    }

    /// Puts a constant Q [Pa] in the place of the part of a body's drive that is given in time; what answers to the
    /// body stays.
    ///
    /// # Errors
    /// [`Refusal`] if there is no such body, its contraction is not driven, or a number is not finite.
    pub fn set_drive(&mut self, body: usize, value: Mat3) -> Result<(), Refusal> {
        let name = self.named(body)?;
        if !value.iter().all(|number| number.is_finite()) {
            return Err(Refusal::NotFinite { body: name });
        }
        match change_drive(&mut self.simulation, body, value) {
            None => Err(Refusal::NoDrive { body: name }),
            Some(changed) => {
                self.changed.extend(changed.then_some(body));
                self.drives.insert(body, value);
                Ok(())
            }
        }
    }

    /// Makes one step; past the scene's end it goes on. Of several bodies it is the shortest that one of them would
    /// make, and all end there.
    ///
    /// # Errors
    /// [`Stop`] if the run cannot go on; the state stays the last one.
    pub fn step(&mut self) -> Result<(), Stop> {
        let time = self.time();
        let end = if time < self.plan.end { self.plan.end } else { time + self.plan.end };
        self.restart_changed()?;
        match self.simulation.shortest_step()? {
            None => self.step_towards(end, &mut Unwatched),
            Some(step) => self.advance((time + step).min(end), &mut Unwatched),
        }
    }

    /// Steps to a time, and ends a step there; a time that is not ahead does nothing.
    ///
    /// # Errors
    /// [`Stop`] if the run cannot go on, or the monitor asks to stop; the state stays the last one.
    pub fn advance(&mut self, until: f64, monitor: &mut dyn Monitor) -> Result<(), Stop> {
        while self.time() < until {
            self.step_towards(until, monitor)?;
        }
        Ok(())
    }

    /// Goes on towards a time on which all bodies end a step; where it stops before, they are at one time too.
    fn step_towards(&mut self, end: f64, monitor: &mut dyn Monitor) -> Result<(), Stop> {
        self.restart_changed()?;
        self.simulation.plan.end = end;
        self.window(monitor).inspect_err(|_| self.simulation.land())
    }

    fn window(&mut self, monitor: &mut dyn Monitor) -> Result<(), Stop> {
        let end = self.simulation.plan.end;
        let stepped = self.simulation.step(&mut self.kept, monitor);
        let time = self.time();
        let sampled = match self.simulation.plan.sample.is_finite() {
            true => self.simulation.sample_until(time, &mut self.kept),
            // Of no samples the first is none.
            false => Ok(Ok(())),
        };
        let flushed = self.kept.window_end(&self.simulation);
        match stepped.and_then(|stepped| Ok((stepped.and(sampled?), flushed?).0)) {
            Ok(stepped) => stepped?,
            Err(error) => unreachable!("whoever keeps rows and events notes what fails: {error}"),
        }
        match self.simulation.ask(monitor).filter(|_| time < end) {
            Some(reason) => Err(Stop::by_request(time, reason)),
            None => Ok(()),
        }
    }

    fn restart_changed(&mut self) -> Result<(), Stop> {
        while let Some(body) = self.changed.first().copied() {
            self.simulation.restart(body)?;
            self.changed.remove(&body);
        }
        Ok(())
    }

    /// The name of a body.
    fn named(&self, index: usize) -> Result<String, Refusal> {
        let mut names = self.model().names();
        let count = names.len();
        names.nth(index).map(str::to_owned).ok_or(Refusal::Body { index, count })
    }
}

/// As a scene asks for it; without samples, for which a window would have to end.
fn stepped_plan(built: &Built) -> RunPlan {
    RunPlan { stop_at_rest: None, sample: f64::INFINITY, ..RunPlan::from(built) }
}

/// A run at its first state.
fn begun(model: &Model, start: &State, plan: RunPlan) -> Result<Simulation, RunError> {
    let mut simulation = Simulation::new(model, start, plan)?;
    simulation.begin(&mut MemorySink::default())?;
    Ok(simulation)
}

/// Puts a constant drive in the place of that of a body: whether it is another one; none where the body has no drive.
fn change_drive(simulation: &mut Simulation, body: usize, value: Mat3) -> Option<bool> {
    let constant = Signal::Constant(value);
    let set = |model: &mut Model, at: usize| match &mut Arc::make_mut(&mut model.bodies[at]).kind {
        BodyKind::Contractile(contractile) => match &mut contractile.contraction.source {
            ContractionSource::Driven { drive, .. } => Some(std::mem::replace(drive, constant.clone()) != constant),
            ContractionSource::Prescribed(_) => None,
        },
        BodyKind::Rigid(_) | BodyKind::Affine(_) => None,
    };
    simulation.change(body, set)
}
