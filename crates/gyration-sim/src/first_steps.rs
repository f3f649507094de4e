//! The first steps of a scene on trial: made twice, with planes found twice, and with the momenta added up.
//!
//! Whatever a step depends on must stand in the checkpoint, or follow from what stands there: after every window the
//! checkpoint is read into a second run, both make the next window, and every byte of what they leave is compared.
//! Planes that are remembered from the beginning of a step and planes found as if nothing were known must push bodies
//! alike. Bodies on which nothing from outside acts keep their momenta.

use crate::outcome::{Outcome, Reason};
use crate::ports::{Monitor, Progress, RunError};
use crate::record::{Job, MemorySink};
use crate::run::Simulation;
use gyration::Inadmissible;
use gyration::acting::Load;
use gyration::balance::{fastest_speed, observe};
use gyration::dynamics::{Workspace, each_push};
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_threads::Interruption;

/// What the first steps of a scene have shown.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FirstSteps {
    /// The windows that were made, each one step of the bodies that have come least far.
    pub windows: usize,
    /// After which of them a run that is resumed leaves something else, and what; none if it never does.
    pub difference: Option<String>,
    /// The largest difference of a force between bodies by the planes remembered and those found from nothing, over the
    /// largest force of the moment.
    pub planes: f64,
    /// How far the total momenta have changed; none where something from outside acts.
    pub momenta: Option<MomentumChange>,
}

/// The largest change of the momenta of all bodies together, over the sums of the sizes of their terms.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct MomentumChange {
    /// Of the momentum, over Σ m |v|, |v| that of the fastest material point.
    pub momentum: f64,
    /// Of the angular momentum; none in a lattice, whose cells may be one another's neighbours round a ring.
    pub angular_momentum: Option<f64>,
}

impl MomentumChange {
    /// The larger of each.
    fn or_more(&self, other: &Self) -> Self {
        let angular = self.angular_momentum.zip(other.angular_momentum);
        let momentum = self.momentum.max(other.momentum);
        Self { momentum, angular_momentum: angular.map(|(one, two)| one.max(two)) }
    }
}

impl FirstSteps {
    /// Makes at most so many windows.
    ///
    /// # Errors
    /// [`RunError`] if the run cannot begin, or not go on from one of its checkpoints.
    pub fn of(job: &Job, most: usize) -> Result<Self, RunError> {
        let mut whole = Simulation::new(job.model, job.start, job.plan)?;
        whole.begin(&mut MemorySink::default())?;
        let mut this = Self::default();
        let start = Momenta::of(job.model, job.start);
        while this.windows < most {
            let (before, checkpoint) = (whole.state(), whole.checkpoint());
            let mut resumed = Simulation::resume(job.model, job.start, job.plan, &checkpoint)?;
            let told = |what: &str| Some(format!("after {} windows, at t = {:e} s, {what}", this.windows, before.time));
            if resumed.checkpoint() != checkpoint {
                this.difference = told("the checkpoint read is not the one written");
                break;
            }
            let mut kept = [MemorySink::default(), MemorySink::default()];
            let outcomes = [window(&mut whole, &mut kept[0])?, window(&mut resumed, &mut kept[1])?];
            // Where a run is given up the clock decides.
            if Interruption::due().is_some() {
                break;
            }
            if let Some(what) = difference((&whole, &resumed), &kept, &outcomes) {
                this.difference = told(&format!("the resumed run has another {what}"));
                break;
            }
            this.windows += 1;
            let after = whole.state();
            this.planes = this.planes.max(planes(job.model, &before, &after).unwrap_or(0.0));
            if let Some(start) = &start {
                let moved = Momenta::of(job.model, &after).map(|now| now.since(start));
                this.momenta = moved.map(|moved| this.momenta.map_or(moved, |most| moved.or_more(&most)));
            }
            if outcomes[0].is_some() {
                break;
            }
        }
        Ok(this)
    }
}

/// Ends a run after a window. It counts steps, so that a window is one step of the islands that have come least far,
/// however wide the windows before it were.
struct OneWindow;

impl Monitor for OneWindow {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        Some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        true
    }
}

/// One window: how the run has ended, if it has.
fn window(simulation: &mut Simulation, kept: &mut MemorySink) -> Result<Option<Outcome>, RunError> {
    Ok(match simulation.run(kept, &mut OneWindow)? {
        Outcome::Stopped(stop) if stop.reason == Reason::Interrupted && simulation.is_whole() => None,
        outcome => Some(outcome),
    })
}

/// In what two runs differ behind the same window.
fn difference(
    (whole, resumed): (&Simulation, &Simulation),
    [after, again]: &[MemorySink; 2],
    outcomes: &[Option<Outcome>; 2],
) -> Option<&'static str> {
    let differs = [
        ("outcome", outcomes[0] != outcomes[1]),
        ("row", format!("{:?}", after.rows) != format!("{:?}", again.rows)),
        ("event", after.events != again.events),
        ("pair", after.exchanges != again.exchanges),
        ("state", whole.state() != resumed.state()),
        ("count of steps", whole.statistics() != resumed.statistics()),
        ("checkpoint", whole.checkpoint() != resumed.checkpoint()),
    ];
    differs.into_iter().find(|(_, differs)| *differs).map(|(what, _)| what)
}

/// The largest difference of a force at a state by the planes remembered from an earlier one and by those found from
/// nothing, over the largest force.
fn planes(model: &Model, before: &State, after: &State) -> Result<f64, Inadmissible> {
    if model.rules().is_empty() {
        return Ok(0.0);
    }
    let mut remembering = Workspace::default();
    remembering.remember_pairs(model, before.time, before.numbers())?;
    let found = [pushes(model, remembering, after)?, pushes(model, Workspace::default(), after)?];
    let off = found[0].iter().zip(&found[1]).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
    let largest = found[1].iter().copied().fold(0.0, f64::max);
    Ok(if off > 0.0 { off / largest } else { 0.0 })
}

/// The forces on all bodies one by one [N].
fn pushes(model: &Model, mut workspace: Workspace, state: &State) -> Result<Vec<f64>, Inadmissible> {
    let (instant, scratch) = workspace.read(model, state)?;
    let mut forces = Vec::new();
    for index in 0..model.bodies.len() {
        each_push(&instant.at(index), scratch, |push| forces.push(push.force))?;
    }
    Ok(forces)
}

/// The momenta of all bodies together.
struct Momenta {
    linear: Vec3,
    angular: Vec3,
    /// Σ of the sizes of what they are sums of.
    terms: [f64; 2],
    /// Whether space has no direction of its own, as that of a lattice has.
    turns: bool,
}

impl Momenta {
    /// Of a state; none where something acts from outside.
    fn of(model: &Model, state: &State) -> Option<Self> {
        let is_isolated = model.gravity == Vec3::zeros() && (0..model.bodies.len()).all(|body| is_alone(model, body));
        if !is_isolated {
            return None;
        }
        let mut workspace = Workspace::default();
        let turns = model.lattice.vectors().is_empty();
        let mut sum = Self { linear: Vec3::zeros(), angular: Vec3::zeros(), terms: [0.0; 2], turns };
        for (index, body) in model.bodies.iter().enumerate() {
            let seen = observe(model, &mut workspace, state, index).ok()?;
            sum.linear += seen.linear_momentum;
            sum.angular += seen.angular_momentum;
            let fast = body.solid.mass.mass * fastest_speed(body, &seen.motion);
            sum.terms[0] += fast;
            sum.terms[1] += fast * (seen.motion.placement.position.norm() + body.size);
        }
        Some(sum)
    }

    /// How far they have moved since then, over the larger of the sums of terms.
    fn since(&self, start: &Self) -> MomentumChange {
        let part = |k: usize, moved: Vec3| match moved.norm() {
            0.0 => 0.0,
            moved => moved / self.terms[k].max(start.terms[k]),
        };
        let angular_momentum = self.turns.then(|| part(1, self.angular - start.angular));
        MomentumChange { momentum: part(0, self.linear - start.linear), angular_momentum }
    }
}

/// Whether nothing but other bodies acts on a body, and it is held nowhere.
fn is_alone(model: &Model, index: usize) -> bool {
    let between = |load: Load| match load {
        Load::Spring(end) if end.other().body().is_some() => Ok(()),
        Load::Bond(_) => Ok(()),
        Load::Joint(end) if end.other().body().is_some() => Ok(()),
        _ => Err(()),
    };
    let body = &model.bodies[index];
    body.pin.is_none() && body.guide.is_none() && body.has_inertia() && model.try_each_load(index, between).is_ok()
}
