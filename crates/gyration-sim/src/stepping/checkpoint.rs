//! All that the rest of a stepped run depends on, as bytes.
//!
//! The checkpoint of a run, and before it what a scene does not tell: the start from which the scales come, what is
//! applied, which drives are held, for which bodies that is new; and the events so far. Plain little-endian numbers,
//! each list behind its length, as in a [`RunState`](crate::run_state::RunState). From there the run goes on to the
//! same bytes.

use super::recorder::Kept;
use super::{SteppedRun, change_drive, stepped_plan};
use crate::events::{EVENT_KINDS, Event};
use crate::plan::RunPlan;
use crate::ports::RunError;
use crate::run::Simulation;
use crate::run_state::{list, put_list};
use gyration::load::Applied;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Built;
use std::collections::{BTreeMap, BTreeSet};

/// What is held from one change to the next.
#[derive(Clone, Default)]
pub(super) struct Held {
    pub applied: BTreeMap<usize, Applied>,
    pub drives: BTreeMap<usize, Mat3>,
}

impl Held {
    /// Puts it on the bodies of a run.
    pub fn put_on(&self, simulation: &mut Simulation) {
        for (body, load) in &self.applied {
            let _is_controlled = simulation.change(*body, |model, at| model.apply(at, *load));
        }
        for (body, drive) in &self.drives {
            change_drive(simulation, *body, *drive);
        }
    }
}

impl SteppedRun {
    /// What is held now.
    pub(super) fn held(&self) -> Held {
        let model = self.simulation.model();
        let applied = |body| model.applied(body).filter(|load| **load != Applied::default()).map(|load| (body, *load));
        Held { applied: (0..model.bodies.len()).filter_map(applied).collect(), drives: self.drives.clone() }
    }

    /// The run as bytes: [`restored`](Self::restored) goes on from there to the same bytes.
    pub fn checkpoint(&self) -> Vec<u8> {
        let (mut bytes, start, held) = (Vec::new(), self.simulation.start(), self.held());
        let mut integers = |list: &mut dyn ExactSizeIterator<Item = usize>| {
            put_list(&mut bytes, &mut list.map(|number| number as u64));
        };
        integers(&mut self.changed.iter().copied());
        integers(&mut held.applied.keys().copied());
        integers(&mut held.drives.keys().copied());
        let mut reals = |list: &[f64]| put_list(&mut bytes, &mut list.iter().map(|number| number.to_bits()));
        reals(held.applied.values().map(numbers).collect::<Vec<_>>().as_flattened());
        reals(&held.drives.values().flatten().copied().collect::<Vec<f64>>());
        reals(&[self.time(), start.time]);
        reals(&start.bodies);
        reals(&start.low);
        let events: Vec<[u64; 3]> =
            self.kept.events.iter().map(|event| [event.time.to_bits(), event.kind as u64, event.body as u64]).collect();
        put_list(&mut bytes, &mut events.as_flattened().iter().copied());
        bytes.extend(self.simulation.checkpoint());
        bytes
    }

    /// Another run that stands where this one does; nobody records it.
    ///
    /// # Errors
    /// As for [`restored`](Self::restored), of which there are none.
    pub fn copy(&self) -> Result<Self, RunError> {
        self.restored(&self.checkpoint())
    }

    /// A run of the same scene from a checkpoint of it.
    ///
    /// # Errors
    /// [`RunError::Checkpoint`] if the bytes are not such a checkpoint.
    pub fn restored(&self, checkpoint: &[u8]) -> Result<Self, RunError> {
        Self::of_checkpoint(self.scene.clone(), self.plan, checkpoint)
    }

    /// A run of a scene from a checkpoint of it.
    ///
    /// # Errors
    /// [`RunError::Checkpoint`] if the bytes are not such a checkpoint.
    pub fn resume(built: &Built, checkpoint: &[u8]) -> Result<Self, RunError> {
        Self::of_checkpoint(built.model.clone().under_control(), stepped_plan(built), checkpoint)
    }

    fn of_checkpoint(scene: Model, plan: RunPlan, checkpoint: &[u8]) -> Result<Self, RunError> {
        let mut rest = checkpoint;
        let Read { changed, held, time, start, events } =
            Read::of(&mut rest, &scene).ok_or_else(|| RunError::unfit_checkpoint(checkpoint))?;
        let reaching = RunPlan { end: plan.end.max(time), ..plan };
        let simulation = Simulation::resume_changed(&scene, &start, reaching, rest, |run| held.put_on(run))?;
        Ok(Self { simulation, scene, plan, changed, drives: held.drives, kept: Kept::of(events) })
    }
}

/// What stands before the checkpoint of the run.
struct Read {
    changed: BTreeSet<usize>,
    held: Held,
    /// The time reached [s].
    time: f64,
    start: State,
    events: Vec<Event>,
}

impl Read {
    /// None if it is not that of a run of this model.
    fn of(rest: &mut &[u8], model: &Model) -> Option<Self> {
        let count = model.bodies.len();
        let changed = bodies(rest, count)?;
        let (loaded, driven) = (bodies(rest, count)?, bodies(rest, count)?);
        let (loads, drives) = (reals(rest)?, reals(rest)?);
        let applied = per_body::<15, _>(&loaded, &loads, load)?;
        let drives = per_body::<9, _>(&driven, &drives, |numbers| Mat3::from_column_slice(numbers))?;
        let times = reals(rest)?;
        let &[time, start_time] = times.as_slice() else { return None };
        let (numbers, low) = (reals(rest)?, reals(rest)?);
        let fits = numbers.len() == model.dimension() && (low.is_empty() || low.len() == numbers.len());
        let events = list(rest)?;
        let (events, others) = events.as_chunks::<3>();
        if !(fits && start_time.is_finite() && others.is_empty()) {
            return None;
        }
        let works = vec![0.0; model.works().len()];
        let start = State { time: start_time, bodies: numbers, low, works };
        let event = |[time, kind, body]: &[u64; 3]| {
            let (kind, body) = (usize::try_from(*kind).ok()?, usize::try_from(*body).ok()?);
            let is_known = kind < EVENT_KINDS.len() && body < count;
            is_known.then(|| Event { time: f64::from_bits(*time), kind, body })
        };
        let events = events.iter().map(event).collect::<Option<_>>()?;
        Some(Self { changed, held: Held { applied, drives }, time, start, events })
    }
}

/// Bodies in ascending order.
fn bodies(rest: &mut &[u8], count: usize) -> Option<BTreeSet<usize>> {
    let body = |number: u64| usize::try_from(number).ok().filter(|body| *body < count);
    list(rest)?.into_iter().map(body).collect()
}

fn reals(rest: &mut &[u8]) -> Option<Vec<f64>> {
    Some(list(rest)?.into_iter().map(f64::from_bits).collect())
}

/// What so many finite numbers a body stand for.
fn per_body<const N: usize, T>(
    bodies: &BTreeSet<usize>,
    numbers: &[f64],
    of: impl Fn(&[f64; N]) -> T,
) -> Option<BTreeMap<usize, T>> {
    let (chunks, others) = numbers.as_chunks::<N>();
    let fits = others.is_empty() && chunks.len() == bodies.len() && numbers.iter().all(|number| number.is_finite());
    fits.then(|| bodies.iter().copied().zip(chunks.iter().map(of)).collect())
}

/// Force, moment column by column, torque.
fn numbers(load: &Applied) -> [f64; 15] {
    let all: Vec<f64> = load.force.iter().chain(&load.moment).chain(&load.torque).copied().collect();
    std::array::from_fn(|place| all[place])
}

fn load(numbers: &[f64; 15]) -> Applied {
    Applied {
        force: Vec3::from_column_slice(&numbers[..3]),
        moment: Mat3::from_column_slice(&numbers[3..12]),
        torque: Vec3::from_column_slice(&numbers[12..]),
    }
}
