//! From the file's types to the mechanics: the model, its first state, and the plan of the run.
//!
//! Everything is in SI units from here on. What is wrong with a body is noted at its keys, and the others go on.

mod affine;
mod body;
mod bond;
mod constraint;
mod contact;
mod context;
mod contractile;
mod fluid;
mod kind;
mod mass;
mod material;
mod orientation;
mod overlap;
mod pair;
mod partners;
mod reach;
mod resolve;
mod salvage;
mod shape;
mod signal;
mod solids;
mod start;
mod support;

pub(crate) use context::SceneContext;
pub use fluid::TRIANGLES;
pub(crate) use salvage::salvage;

use crate::check::{PartialScene, Reporter};
use crate::file::{self, Method, Recorded, Solver, Time};
use crate::quantity::si;
use crate::unknown::UnknownForm;
use body::AssembledBody;
use gyration::load::Spring;
use gyration::model::Model;
use gyration::state::{Start, State};
use gyration::tensor::Vec3;
use gyration_threads::Interruption;
use solids::Solids;
use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::time::Duration;

/// A scene ready to run.
#[derive(Debug, Clone)]
pub struct Built {
    /// Gravity, supports and bodies.
    pub model: Model,
    /// The state at t = 0.
    pub state: State,
    /// How long to run, what to record, how to integrate.
    pub plan: Plan,
    /// What else to record.
    pub record: Record,
}

/// Quantities that are recorded on request.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Record {
    /// Which, each once, in the order of the file.
    pub quantities: Vec<Recorded>,
    /// The point about which total affine momentum is taken \[m\].
    pub origin: Vec3,
}

impl Record {
    fn new(written: &file::Record) -> Self {
        Self { quantities: written.quantities.clone(), origin: si(&written.origin) }
    }
}

/// How long to run, what to record, how to integrate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// The time at which the run ends \[s\].
    pub end: f64,
    /// Spacing of the recorded samples \[s\].
    pub sample: f64,
    /// When to end early.
    pub stop_at_rest: Option<StopAtRest>,
    /// Relative tolerance.
    pub rtol: f64,
    /// Absolute tolerance, a fraction of scale.
    pub atol: f64,
    /// How the equations are integrated.
    pub method: Method,
    /// The longest step \[s\].
    pub max_step: Option<f64>,
    /// The longest computing time \[s\].
    pub max_wall_time: Option<f64>,
    /// How many threads share the bodies out, if that is said.
    pub threads: Option<NonZeroUsize>,
}

impl Plan {
    /// The longest computing time; none where no clock can tell it.
    pub fn wall_time(&self) -> Option<Duration> {
        Duration::try_from_secs_f64(self.max_wall_time?).ok()
    }
}

/// When the bodies count as resting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopAtRest {
    /// Speed below which the fastest material point has to stay \[m/s\].
    pub speed: f64,
    /// For how long \[s\].
    pub hold: f64,
}

impl Plan {
    fn new(time: &Time, solver: &Solver) -> Self {
        let rest = time.stop_at_rest.as_ref();
        Self {
            end: time.end.value(),
            sample: time.sample.value(),
            stop_at_rest: rest.map(|rest| StopAtRest { speed: rest.speed.value(), hold: rest.hold.value() }),
            rtol: solver.rtol,
            atol: solver.atol,
            method: solver.method,
            max_step: solver.max_step.map(|step| step.value()),
            max_wall_time: solver.max_wall_time.map(|time| time.value()),
            threads: solver.threads.and_then(|threads| NonZeroUsize::new(threads as usize)),
        }
    }
}

/// Assembles what a partial scene describes, with the forms that it leaves open; none if anything about it, or before
/// it, was found wrong.
///
/// Fills in what the file leaves to be derived (`resolve`).
pub(crate) fn assemble(
    partial: &mut PartialScene,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<(Built, Vec<UnknownForm>)> {
    let solids = &mut Solids::default();
    // A place for each body of the file: one with an error still counts for names and groups.
    let mut assembled: Vec<Option<AssembledBody>> = vec![None; partial.roll.len()];
    for body in &partial.bodies {
        assembled[body.number] = AssembledBody::new(body, context, solids, reporter);
    }
    let around = partial.fluid.as_ref().map(|written| fluid::fluid(written, context, reporter));
    let supports: Vec<_> = partial.supports.iter().map(|placed| support::support(&placed.value)).collect();
    let (contacts, rules) = contact::attach(partial, &assembled, reporter);
    let anchored = assembled.iter().flatten().flat_map(|body| &body.springs).copied();
    let springs: Vec<Spring> = anchored.chain(bond::bonds(partial, &assembled, reporter)).collect();
    let mut met: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); assembled.len()];
    contacts.iter().for_each(|contact| _ = met[contact.body].insert(contact.support));
    for body in &mut partial.bodies {
        if let Some(assembled_body) = &assembled[body.number] {
            overlap::check(body, assembled_body, &met[body.number], &supports, reporter);
            resolve::resolve(&mut body.value, &assembled_body.start);
        }
    }
    if !reporter.diagnostics.is_empty() {
        return None;
    }
    let plan = Plan::new(partial.time.as_ref()?, &partial.solver);
    let (bodies, starts): (Vec<_>, Vec<Start>) = assembled.into_iter().flatten().map(|s| (s.body, s.start)).unzip();
    let mut model = Model::new(si(&partial.world.gravity), supports.into_iter().collect::<Option<Vec<_>>>()?, bodies);
    if let Some(fluid) = around {
        model = model.in_fluid(fluid?);
    }
    model = model.with_contacts(contacts).with_springs(springs).meeting(rules).asking(|| Interruption::due().is_some());
    let state = State::start(&model, &starts);
    let record = partial.record.as_ref().map(Record::new).unwrap_or_default();
    let forms = partial.bodies.iter().zip(&model.bodies).enumerate();
    let forms = forms.filter_map(|(index, (written, body))| fluid::unknown(&written.value, body, index)).collect();
    Some((Built { model, state, plan, record }, forms))
}
