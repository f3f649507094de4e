//! What a recording of a model holds: the arrays of a row, their units, and the columns of the CSV.
//!
//! Columns stand in the order of the contract: for each body x, P, v, Ṗ, G, pressure, gap, force; those of each joint;
//! then energies, works, residual.

mod extra_fields;
mod extras;
mod fields;
mod joint_fields;

pub use extras::Extras;

use extra_fields::Source;
use fields::{
    BODY_FIELDS, BodyContext, BodyField, CONTACT_FORCE, CONTRACTION, CONTRACTION_VELOCITY, DRIVE, FieldValue, GAP,
    IMMERSED_FIELDS, IMPULSE, PEAK_FORCE, PRESSURE, Rank, Reaction,
};
use gyration::Inadmissible;
use gyration::balance::{BodyObservation, energies, energies_at, observe_at};
use gyration::body::Body;
use gyration::dynamics::{
    ContactParts, JointObservation, LoadsByKind, Workspace, acting, contact_parts, loads_by_kind, reaction,
};
use gyration::homogeneous::{HomogeneousObservation, observe_homogeneous};
use gyration::immersion::{ImmersionObservation, observe_immersion};
use gyration::load::Loads;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_record::{ArraySpec, Dimension};

/// What the rows of a run hold.
#[derive(Clone)]
pub struct Fields {
    fields: Vec<&'static BodyField>,
    /// The origin of total affine momentum, where quantities of homogeneous strain are asked for.
    origin: Option<Vec3>,
    /// Whether contact forces are asked for by their parts.
    by_parts: bool,
    /// Whether loads are asked for kind by kind.
    by_kind: bool,
    /// Whether displacements are asked for.
    displacements: bool,
    /// Whether the force of guides is asked for.
    reactions: bool,
    /// Whether a body is immersed in a fluid.
    immersed: bool,
}

/// Scratch for rows.
#[derive(Debug, Clone, Default)]
pub struct RowScratch {
    bodies: Vec<BodyObservation>,
    homogeneous: Vec<HomogeneousObservation>,
    contacts: Vec<ContactParts>,
    loads: Vec<LoadsByKind>,
    reactions: Vec<Option<Reaction>>,
    immersed: Vec<Option<ImmersionObservation>>,
    joints: Vec<JointObservation>,
    /// What has come of the interval that ends with the row, for whoever fills it to tell.
    pub interval: Interval,
    /// The row last filled, flattened in the order of [`Fields::arrays`].
    pub row: Vec<f64>,
}

/// What has come of an interval that ends with a row, where it is asked for: else empty.
#[derive(Debug, Clone, Default)]
pub struct Interval {
    /// ∫ f dt of the contacts of each body [N s], one behind the other.
    pub impulses: Vec<f64>,
    /// The largest |f| of the contacts of each body [N].
    pub peak_forces: Vec<f64>,
}

impl Fields {
    /// The fields of a model, with those asked for.
    pub fn new(model: &Model, extras: &Extras) -> Self {
        let any = |field: &&BodyField| model.bodies.iter().any(|body| applies(field.name, body));
        let usual = BODY_FIELDS.iter().filter(any);
        let immersed = model.fluid.is_some() && model.bodies.iter().any(|body| body.inclusion.is_some());
        let in_fluid = IMMERSED_FIELDS.iter().filter(|_| immersed);
        let fields = usual.chain(in_fluid).chain(extras.fields()).collect();
        let origin = extras.need(Source::Strain).then_some(extras.origin);
        let [by_parts, by_kind, displacements, reactions] =
            [Source::Contacts, Source::Loads, Source::Rest, Source::Guide].map(|source| extras.need(source));
        Self { fields, origin, by_parts, by_kind, displacements, reactions, immersed }
    }

    /// The arrays of a recording of this model, and the order of its CSV columns.
    pub fn arrays(&self, model: &Model) -> (Vec<ArraySpec>, Vec<String>) {
        let mut arrays: Vec<ArraySpec> = self.fields.iter().map(|field| body_array(model, field)).collect();
        let mut order: Vec<String> = Vec::new();
        for index in 0..model.bodies.len() {
            for field in &self.fields {
                order.extend(columns(model, field, index).into_iter().filter(|column| !column.is_empty()));
            }
        }
        arrays.extend(joint_fields::arrays(model));
        order.extend(joint_fields::columns(model));
        for (name, column, description) in ledger_entries(model) {
            order.push(column.clone());
            arrays.push(ArraySpec { name, dims: Vec::new(), units: "J".into(), description, columns: vec![column] });
        }
        (arrays, order)
    }

    /// Fills the row of a state; `initial` is Σ energies at t = 0.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn fill(
        &self,
        model: &Model,
        workspace: &mut Workspace,
        state: &State,
        initial: Option<f64>,
        scratch: &mut RowScratch,
    ) -> Result<Audit, Inadmissible> {
        let RowScratch { bodies, homogeneous, contacts, loads, reactions, immersed, joints, interval, row } = scratch;
        bodies.clear();
        homogeneous.clear();
        contacts.clear();
        loads.clear();
        reactions.clear();
        immersed.clear();
        row.clear();
        let (instant, scratch) = workspace.read(model, state)?;
        for index in 0..model.bodies.len() {
            let at = instant.at(index);
            let acting = acting(&at, scratch)?;
            bodies.push(observe_at(&at, &acting, scratch)?);
            if let Some(origin) = &self.origin {
                homogeneous.push(observe_homogeneous(&at, &acting, scratch, origin)?);
            }
            if self.by_parts {
                contacts.push(contact_parts(&at, scratch)?);
            }
            if self.by_kind {
                loads.push(loads_by_kind(&at, scratch)?);
            }
            if self.reactions {
                let gradient = at.motion.placement.gradient;
                let told = |Loads { force, moment }| Reaction { force, moment: gradient * moment.transpose() };
                reactions.push(reaction(&at, &acting, scratch)?.map(told));
            }
            if self.immersed {
                immersed.push(observe_immersion(&at, scratch)?);
            }
        }
        // In the cell of the body no digits are lost to its distance.
        let displacement = |index| Some(state.motion(model, index).placement.position - model.rest_place(index)?);
        for field in &self.fields {
            for (index, body) in bodies.iter().enumerate() {
                match (field.value)(&BodyContext {
                    body,
                    homogeneous: homogeneous.get(index),
                    contacts: contacts.get(index),
                    loads: loads.get(index),
                    reaction: reactions.get(index).and_then(Option::as_ref),
                    displacement: self.displacements.then(|| displacement(index)).flatten(),
                    impulse: interval.impulses.as_chunks().0.get(index).map(|impulse: &[f64; 3]| Vec3::from(*impulse)),
                    peak_force: interval.peak_forces.get(index).copied(),
                    immersed: immersed.get(index).and_then(Option::as_ref),
                }) {
                    FieldValue::Scalar(value) => row.push(value),
                    FieldValue::Vector(value) => row.extend(value.iter()),
                    // nalgebra stores columns; rows are recorded.
                    FieldValue::Matrix(value) => row.extend(value.transpose().iter()),
                }
            }
        }
        joint_fields::fill(&instant, scratch, joints, row);
        let ledger = row.len();
        row.resize(ledger + model.energies().len(), 0.0);
        energies_at(&instant, scratch, &mut row[ledger..])?;
        let energy = row[ledger..].iter().sum();
        let residual = residual(energy, initial, &state.works);
        row.extend(&state.works);
        row.push(residual);
        Ok(Audit { energy, residual, smallest_gap: bodies.iter().map(|body| body.gap).fold(f64::INFINITY, f64::min) })
    }
}

/// Whether a field is of a kind that the body has.
fn applies(field: &str, body: &Body) -> bool {
    match field {
        PRESSURE => body.affine().is_some_and(|affine| affine.interior.is_incompressible()),
        CONTRACTION | CONTRACTION_VELOCITY | DRIVE => body.contraction().is_some(),
        _ => true,
    }
}

fn body_array(model: &Model, field: &BodyField) -> ArraySpec {
    let mut dims = vec![Dimension::new("body", model.bodies.len())];
    match field.rank {
        Rank::Scalar => {}
        Rank::Vector => dims.push(Dimension::new("row", 3)),
        Rank::Matrix => dims.extend([Dimension::new("row", 3), Dimension::new("col", 3)]),
    }
    let columns = if field.suffixes.is_empty() {
        Vec::new()
    } else {
        (0..model.bodies.len()).flat_map(|body| columns(model, field, body)).collect()
    };
    ArraySpec {
        name: field.name.into(),
        dims,
        units: field.units.into(),
        description: field.description.into(),
        columns,
    }
}

/// The CSV columns of a field for one body; empty where the field does not apply to it.
fn columns(model: &Model, field: &BodyField, index: usize) -> Vec<String> {
    let body = &model.bodies[index];
    let applies = match field.name {
        GAP => body.solid.surface.is_some() && model.has_contact(index),
        CONTACT_FORCE | IMPULSE | PEAK_FORCE => model.has_contact(index),
        name => applies(name, body),
    };
    let name = |suffix: &&str| if applies { format!("{}.{suffix}", model.name(index)) } else { String::new() };
    field.suffixes.iter().map(name).collect()
}

/// Array name, column and description of every entry of the ledger, in order.
fn ledger_entries(model: &Model) -> Vec<(String, String, String)> {
    let entry =
        |kind: &str, name: &str, description: String| (format!("{kind}_{name}"), format!("{kind}.{name}"), description);
    let energies = model.energies().iter().map(|e| entry("energy", e.name(), format!("{} energy", e.name())));
    let works = model.works().iter().map(|w| entry("work", w.name(), format!("work of {} since t = 0", w.name())));
    let residual = entry("energy", "residual", "sum of energies, less their sum at 0, less all works".into());
    energies.chain(works).chain([residual]).collect()
}

/// The ledger of one state.
#[derive(Debug, Clone, PartialEq)]
pub struct Ledger {
    /// Energies [J], in the order of `Model::energies`.
    pub energies: Vec<f64>,
    /// Works since t = 0 [J], in the order of `Model::works`.
    pub works: Vec<f64>,
    /// (Σ energies) − (Σ energies at 0) − Σ works [J].
    pub residual: f64,
}

impl Ledger {
    /// The ledger of a state; `initial` is the sum of the energies at t = 0.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn of(
        model: &Model,
        workspace: &mut Workspace,
        state: &State,
        initial: Option<f64>,
    ) -> Result<Self, Inadmissible> {
        let mut values = vec![0.0; model.energies().len()];
        energies(model, workspace, state, &mut values)?;
        let residual = residual(values.iter().sum(), initial, &state.works);
        Ok(Self { energies: values, works: state.works.clone(), residual })
    }

    /// Σ energies [J].
    pub fn total(&self) -> f64 {
        self.energies.iter().sum()
    }
}

/// What a row tells of the ledger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Audit {
    /// Σ energies [J].
    pub energy: f64,
    /// (Σ energies) − (Σ energies at 0) − Σ works [J].
    pub residual: f64,
    /// Smallest gap of all bodies [m]; infinite where none applies.
    pub smallest_gap: f64,
}

fn residual(energy: f64, initial: Option<f64>, works: &[f64]) -> f64 {
    energy - initial.unwrap_or(energy) - works.iter().sum::<f64>()
}
