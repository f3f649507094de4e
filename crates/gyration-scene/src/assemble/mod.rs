//! From the file's types to the mechanics: the model, its first state, and the plan of the run.
//!
//! Everything is in SI units from here on. What is wrong with a body is noted at its keys, and the others go on.

mod absorb;
mod affine;
mod behaviour;
mod body;
mod bond;
mod constraint;
mod contact;
mod context;
mod contractile;
mod convex;
mod copies;
mod fluid;
mod guide;
mod images;
mod joint;
mod joint_start;
mod kind;
mod kinetic;
mod lattice;
mod mass;
mod material;
mod moduli;
mod motor;
mod orientation;
mod overlap;
mod own;
mod pair;
mod partners;
mod random;
mod reach;
mod resolve;
mod salvage;
mod self_gravity;
mod shape;
mod signal;
mod solids;
mod spring;
mod start;
mod support;
mod unit;
mod wave;

pub(crate) use context::SceneContext;
pub use fluid::TRIANGLES;
pub use images::ENDLESS_CELLS;
pub(crate) use salvage::salvage;
pub use wave::{Packet, StartingWave, WaveRun, WaveStart};

use crate::check::{PartialScene, Reporter};
use crate::file::{self, Method, Recorded, Solver, Time};
use crate::key::Key;
use crate::quantity::si;
use crate::unknown::UnknownForm;
use body::AssembledBody;
use copies::AssembledBodies;
use gyration::body::Body;
use gyration::contact::Contact;
use gyration::fluid::{Fluid, Form};
use gyration::joint::Joint;
use gyration::kinematics::Placement;
use gyration::lattice::Lattice;
use gyration::load::{Bond, Interaction, Party, Spring};
use gyration::model::Model;
use gyration::neighbours::{ImagePairs, PairRule};
use gyration::solid_support::SolidSupport;
use gyration::state::{Start, State};
use gyration::support::Support;
use gyration::tensor::{Mat3, Vec3};
use gyration_threads::Interruption;
pub use lattice::CellLoad;
use lattice::Cells;
use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::time::Duration;
use support::AssembledSupports;
use wave::WrittenWaves;

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
    /// What bands are of, where there is a lattice.
    pub cell: Option<UnitCell>,
    /// The cells of the run, where there is a lattice.
    pub block: Option<CellBlock>,
    /// The waves with which it starts, until the scene is completed.
    pub waves: Option<WaveStart>,
    /// The number of the `[[body]]` that each body of the model comes from.
    pub written: Vec<usize>,
}

impl Built {
    /// The vectors by which the bodies of a run follow one another without end \[m\]; none where nothing is periodic.
    pub fn periods(&self) -> Vec<Vec3> {
        let Some(block) = self.block else { return Vec::new() };
        let along = self.model.lattice.vectors().iter().zip(block.repeat).zip(block.periodic);
        along.filter(|(_, periodic)| *periodic).map(|((vector, count), _)| f64::from(count) * vector).collect()
    }

    /// Gives a body of the model, and its images in the cells of which bands and waves are, the form that was not
    /// known. In a lattice no body has copies.
    pub(crate) fn give_form(&mut self, body: usize, form: &Form) {
        let number = self.written[body];
        let written = self.written.last().map_or(0, |last| last + 1);
        give_form(&mut self.model.bodies[body], form);
        let cells = self.cell.iter_mut().chain(self.waves.as_mut().map(|waves| &mut waves.cell));
        for cell in cells {
            let copies = cell.model.bodies.len() / written;
            let own = &mut cell.model.bodies[number * copies..(number + 1) * copies];
            own.iter_mut().for_each(|body| give_form(body, form));
        }
    }
}

fn give_form(body: &mut Arc<Body>, form: &Form) {
    if let Some(inclusion) = &mut Arc::make_mut(body).inclusion {
        inclusion.form = form.clone();
    }
}

/// The cell of a lattice of which bands are: one cell along what is periodic, all beside it.
#[derive(Debug, Clone)]
pub struct UnitCell {
    /// What it holds.
    pub model: Model,
    /// How it starts.
    pub state: State,
    /// How many of the cells that are written it holds along each direction: one along what is periodic.
    pub repeat: [u32; 3],
    /// Which directions are periodic.
    pub periodic: Vec<bool>,
    /// Whether its bodies seek their rest before bands are computed.
    pub relaxes: bool,
    /// Under which load its vectors seek theirs too, if they do.
    pub load: Option<CellLoad>,
}

impl UnitCell {
    /// The cell whose vectors rest at F̄: its bodies move along.
    pub(crate) fn at_rest(&self, strain: &Mat3) -> Self {
        let (model, state) = self.state.carried(&self.model, strain, self.model.lattice.deformed(strain));
        Self { model, state, load: None, ..self.clone() }
    }
}

/// The cells of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CellBlock {
    /// How many there are along each vector.
    pub repeat: [u32; 3],
    /// Whether the last is beside the first.
    pub periodic: [bool; 3],
}

/// Quantities that are recorded on request.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Record {
    /// Which, each once, in the order of the file.
    pub quantities: Vec<Recorded>,
    /// The point about which total affine momentum is taken \[m\].
    pub origin: Vec3,
    /// Whether what acts between two is recorded.
    pub pairs: bool,
}

impl Record {
    fn new(written: &file::Record) -> Self {
        Self { quantities: written.quantities.clone(), origin: si(&written.origin), pairs: written.pairs }
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
    material::resolve_names(partial);
    let supports = AssembledSupports::of(partial, context.files, reporter);
    let AssembledBodies { all: mut assembled, starts } = AssembledBodies::of(partial, &supports, context, reporter);
    let around = partial.fluid.as_ref().map(|written| fluid::fluid(written, context, reporter));
    behaviour::resolve(partial, &assembled, reporter);
    let (contacts, rules, rule_keys) = contact::attach(partial, &supports, &assembled, reporter);
    let anchored = assembled.iter().flatten().flat_map(|body| &body.springs).cloned();
    let cells = partial.lattice.as_ref().map(|written| Cells::of(written, reporter));
    let of_cell = cells.as_ref().and_then(Option::as_ref);
    let springs: Vec<Spring> = anchored.chain(spring::springs(partial, &assembled, of_cell, reporter)).collect();
    let bonds = bond::bonds(partial, &assembled, of_cell, context, reporter);
    partial.joints.iter_mut().for_each(|joint| resolve::resolve_drive(&mut joint.value));
    let joints = joint::joints(partial, (&assembled, &supports), context, reporter);
    let mut met: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); assembled.len()];
    contacts.iter().for_each(|contact| _ = met[contact.body].insert(contact.support));
    for body in &mut partial.bodies {
        // Of copies the first is told that reaches a support.
        let mut own = partial.numbers.range(body.number).filter_map(|index| Some((index, assembled[index].as_ref()?)));
        own.all(|(index, own)| overlap::check(body, own, &met[index], &supports.planes, reporter));
        if let Some(start) = &starts[body.number] {
            resolve::resolve(&mut body.value, start);
        }
    }
    joint::give_sizes(&mut assembled, &joints);
    give_sizes(&mut assembled, (&springs, &bonds), of_cell);
    let mut waves = None;
    if let Some(cells) = of_cell {
        let planes: Vec<_> = supports.planes.iter().flatten().cloned().collect();
        let fluid = around.as_ref().and_then(Option::as_ref);
        support::refuse_solids(partial, reporter);
        cells.check_alike(&planes, &contacts, fluid, &assembled, reporter);
        let bodies: Vec<AssembledBody> = assembled.iter().flatten().cloned().collect();
        waves = partial.lattice.as_ref().and_then(|written| wave::waves(written, cells, reporter));
        lattice::check_held(&si(&partial.world.gravity), &contacts, &bodies, reporter);
        // Of a cell with an error the indices of bodies do not hold.
        if bodies.len() == assembled.len() {
            images::images(&cells.unit(), (&rules, &rule_keys), &bodies, reporter);
        }
    }
    if !reporter.diagnostics.is_empty() {
        return None;
    }
    let plan = Plan::new(partial.time.as_ref()?, &partial.solver);
    let bodies: Vec<AssembledBody> = assembled.into_iter().flatten().collect();
    let parts = Parts {
        gravity: si(&partial.world.gravity),
        supports: supports.planes.into_iter().collect::<Option<Vec<_>>>()?,
        solid_supports: supports.solids.into_iter().collect::<Option<Vec<_>>>()?,
        bodies,
        fluid: around.map(|fluid| fluid.map(Arc::new)),
        contacts,
        springs,
        bonds,
        joints: joints.iter().map(|placed| placed.joint.clone()).collect(),
        rules,
        images: None,
        lattice: Lattice::default(),
        origins: Vec::new(),
    };
    let cells = cells.map(|cells| cells.ok_or(())).transpose().ok()?;
    let mut unit = |unit: &Cells| {
        let (model, state) = parts.clone().repeated(unit, &rule_keys, reporter).built()?;
        let (repeat, periodic) = (unit.repeat(), unit.periodic());
        Some(UnitCell { model, state, repeat, periodic, relaxes: unit.relaxes, load: unit.load })
    };
    let cell = cells.as_ref().map(|cells| unit(&cells.unit()).ok_or(())).transpose().ok()?;
    let waves = match (&cells, waves) {
        (Some(cells), Some(WrittenWaves { waves, endless })) => {
            let own = cells.endless(endless);
            Some(WaveStart { cell: unit(&own)?, unit: own.repeat(), repeat: cells.repeat(), ring: cells.ring(), waves })
        }
        _ => None,
    };
    let (model, mut state) = match &cells {
        None => parts.built()?,
        Some(cells) => parts.repeated(cells, &rule_keys, reporter).built()?,
    };
    if !joints.is_empty() {
        joint_start::check_start(&model, &mut state, &joints, reporter);
        if !reporter.diagnostics.is_empty() {
            return None;
        }
    }
    let record = partial.record.as_ref().map(Record::new).unwrap_or_default();
    let block = cells.as_ref().map(|cells| CellBlock { repeat: cells.repeat(), periodic: cells.ring() });
    let cells = cells.as_ref().map_or(1, Cells::count);
    let written: Vec<usize> =
        partial.numbers.written().into_iter().flat_map(|number| std::iter::repeat_n(number, cells)).collect();
    let forms = model.bodies.iter().zip(&written).enumerate();
    let form = |(index, (body, number)): (usize, (&Arc<Body>, &usize))| {
        fluid::unknown(&partial.bodies[*number].value, body, index)
    };
    let forms = forms.filter_map(form).collect();
    Some((Built { model, state, plan, record, cell, block, waves, written }, forms))
}

/// Gives mass points a size, by which tolerances are judged: the length of their shortest spring or bond, else of the
/// shortest cell vector, else a metre.
fn give_sizes(assembled: &mut [Option<AssembledBody>], (springs, bonds): (&[Spring], &[Bond]), cells: Option<&Cells>) {
    let lattice = cells.map(|cells| cells.lattice.clone()).unwrap_or_default();
    let places: Vec<_> = assembled.iter().map(|body| body.as_ref().map(|body| start::placement(&body.start))).collect();
    let nowhere = Placement { position: Vec3::zeros(), gradient: Mat3::identity() };
    let length = |spring: &Spring| {
        let length = spring.length(&lattice, |body| places[body].unwrap_or(nowhere));
        if spring.law.rest_length > 0.0 { length.max(spring.law.rest_length) } else { length }
    };
    let distance = |bond: &Bond| {
        let ends = [0, 1].map(|end| places[bond.bodies[end]].unwrap_or(nowhere).place(&bond.points[end]));
        (ends[1] + lattice.place(bond.cell) - ends[0]).norm()
    };
    let cell = lattice.vectors().iter().map(Vec3::norm).fold(f64::INFINITY, f64::min);
    for (index, body) in assembled.iter_mut().enumerate() {
        let Some(body) = body.as_mut().filter(|body| body.body.size == 0.0) else { continue };
        let is_own = |spring: &&Spring| spring.parties().contains(&Party::Body(index));
        let bonds = bonds.iter().filter(|bond| bond.bodies.contains(&index)).map(distance);
        let lengths = springs.iter().filter(is_own).map(length).chain(bonds);
        // Points that coincide but for digits are at no distance.
        let digits = 8.0 * f64::EPSILON * places[index].map_or(0.0, |place| place.position.norm());
        let shortest = lengths.filter(|length| *length > digits).fold(cell, f64::min);
        Arc::make_mut(&mut body.body).size = if shortest.is_finite() { shortest } else { 1.0 };
    }
}

/// What a model is made of.
#[derive(Debug, Clone)]
struct Parts {
    gravity: Vec3,
    supports: Vec<Support>,
    solid_supports: Vec<SolidSupport>,
    bodies: Vec<AssembledBody>,
    /// None inside if it has an error.
    fluid: Option<Option<Arc<Fluid>>>,
    contacts: Vec<Contact>,
    springs: Vec<Spring>,
    bonds: Vec<Bond>,
    joints: Vec<Joint>,
    rules: Vec<PairRule>,
    images: Option<ImagePairs>,
    lattice: Lattice,
    origins: Vec<Vec3>,
}

impl Parts {
    /// Those of all of these cells.
    fn repeated(self, cells: &Cells, keys: &[Key], reporter: &mut Reporter<'_>) -> Self {
        Self {
            contacts: cells.contacts(&self.contacts),
            springs: cells.springs(&self.springs),
            bonds: cells.bonds(&self.bonds),
            images: images::images(cells, (&self.rules, keys), &self.bodies, reporter),
            rules: cells.rules(&self.rules),
            origins: cells.origins(self.bodies.len()),
            bodies: cells.bodies(&self.bodies),
            lattice: cells.lattice.clone(),
            ..self
        }
    }

    /// The model and its first state.
    fn built(self) -> Option<(Model, State)> {
        let names: Vec<String> = self.bodies.iter().map(|it| it.name.clone()).collect();
        let (bodies, starts): (Vec<_>, Vec<Start>) = self.bodies.into_iter().map(|it| (it.body, it.start)).unzip();
        let mut model = Model::new(self.gravity, self.supports, bodies)
            .with_solid_supports(self.solid_supports)
            .named(names)
            .in_lattice(self.lattice)
            .beginning_at(self.origins);
        if let Some(fluid) = self.fluid {
            model = model.in_fluid(fluid?);
        }
        let model = model.with_contacts(self.contacts).with_springs(self.springs).with_bonds(self.bonds);
        let model = if self.joints.is_empty() { model } else { model.with_joints(self.joints) };
        let model = match self.images {
            None => model.meeting(self.rules),
            Some(images) => model.meeting_images(self.rules, images),
        };
        let model = model.asking(|| Interruption::due().is_some());
        let state = State::start(&model, &starts);
        let places: Vec<Vec3> = (0..starts.len()).map(|body| state.motion(&model, body).placement.position).collect();
        Some((model.resting_at(places), state))
    }
}
