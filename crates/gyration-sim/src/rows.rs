//! What a recording of a model holds: the arrays of a row, their units, and the columns of the CSV.
//!
//! One list of fields serves the layout and the filling of a row, so that the two cannot disagree. Columns stand in
//! the order of the contract: for each body x, P, v, Ṗ, gap, force; then energies, works, residual.

use gyration::Inadmissible;
use gyration::balance::{BodyObservation, energies, observe};
use gyration::model::Model;
use gyration::rates::Workspace;
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::{ArraySpec, Dimension};

/// A quantity recorded for every body.
struct BodyField {
    name: &'static str,
    units: &'static str,
    description: &'static str,
    /// Suffixes of the CSV columns, in row-major order; none: not in the CSV.
    suffixes: &'static [&'static str],
    value: fn(&BodyObservation) -> Value,
}

enum Value {
    Scalar(f64),
    Vector(Vec3),
    Matrix(Mat3),
}

const MATRIX: [&str; 9] = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];

const PLACEMENT: [&str; 9] = ["P_xx", "P_xy", "P_xz", "P_yx", "P_yy", "P_yz", "P_zx", "P_zy", "P_zz"];
const RATE: [&str; 9] =
    ["Pdot_xx", "Pdot_xy", "Pdot_xz", "Pdot_yx", "Pdot_yy", "Pdot_yz", "Pdot_zx", "Pdot_zy", "Pdot_zz"];

/// The fields of every body, in the order of the CSV.
const BODY_FIELDS: [BodyField; 9] = [
    BodyField {
        name: "position",
        units: "m",
        description: "position of the centre of mass",
        suffixes: &["x", "y", "z"],
        value: |body| Value::Vector(body.motion.placement.position),
    },
    BodyField {
        name: "placement_gradient",
        units: "1",
        description: "placement gradient P; a rotation for a rigid body",
        suffixes: &PLACEMENT,
        value: |body| Value::Matrix(body.motion.placement.gradient),
    },
    BodyField {
        name: "velocity",
        units: "m/s",
        description: "velocity of the centre of mass",
        suffixes: &["vx", "vy", "vz"],
        value: |body| Value::Vector(body.motion.velocity.velocity),
    },
    BodyField {
        name: "gradient_rate",
        units: "1/s",
        description: "rate of the placement gradient",
        suffixes: &RATE,
        value: |body| Value::Matrix(body.motion.velocity.gradient_rate),
    },
    BodyField {
        name: "gap",
        units: "m",
        description: "smallest distance to a support",
        suffixes: &["gap"],
        value: |body| Value::Scalar(body.gap),
    },
    BodyField {
        name: "contact_force",
        units: "N",
        description: "force of all contacts",
        suffixes: &["fx", "fy", "fz"],
        value: |body| Value::Vector(body.contact_force),
    },
    BodyField {
        name: "linear_momentum",
        units: "kg m/s",
        description: "linear momentum",
        suffixes: &[],
        value: |body| Value::Vector(body.linear_momentum),
    },
    BodyField {
        name: "angular_momentum",
        units: "kg m2/s",
        description: "angular momentum about the origin",
        suffixes: &[],
        value: |body| Value::Vector(body.angular_momentum),
    },
    BodyField {
        name: "affine_momentum",
        units: "kg m2/s",
        description: "affine momentum K = P J Pdot^T about the centre of mass",
        suffixes: &[],
        value: |body| Value::Matrix(body.affine_momentum),
    },
];

/// The arrays of a recording of this model, and the order of its CSV columns.
pub fn arrays(model: &Model) -> (Vec<ArraySpec>, Vec<String>) {
    let mut arrays: Vec<ArraySpec> = BODY_FIELDS.iter().map(|field| body_array(model, field)).collect();
    let mut order: Vec<String> = Vec::new();
    for index in 0..model.bodies.len() {
        for field in &BODY_FIELDS {
            order.extend(columns(model, field, index).into_iter().filter(|column| !column.is_empty()));
        }
    }
    for (name, column, description) in ledger_entries(model) {
        order.push(column.clone());
        arrays.push(ArraySpec { name, dims: Vec::new(), units: "J".into(), description, columns: vec![column] });
    }
    (arrays, order)
}

fn body_array(model: &Model, field: &BodyField) -> ArraySpec {
    let mut dims = vec![Dimension::new("body", model.bodies.len())];
    match components(field) {
        1 => {}
        3 => dims.push(Dimension::new("row", 3)),
        _ => dims.extend([Dimension::new("row", 3), Dimension::new("col", 3)]),
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

fn components(field: &BodyField) -> usize {
    match (field.suffixes.len(), field.name) {
        (0, "affine_momentum") => MATRIX.len(),
        (0, _) => 3,
        (count, _) => count,
    }
}

/// The CSV columns of a field for one body; empty where the field does not apply to it.
fn columns(model: &Model, field: &BodyField, index: usize) -> Vec<String> {
    let body = &model.bodies[index];
    let applies = match field.name {
        "gap" => body.surface.is_some() && !model.supports.is_empty(),
        "contact_force" => !body.contacts.is_empty(),
        _ => true,
    };
    let name = |suffix: &&str| if applies { format!("{}.{suffix}", body.name) } else { String::new() };
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
    /// Kinetic energy [J].
    pub kinetic: f64,
    /// Σ |works| [J].
    pub exchanged: f64,
    /// (Σ energies) − (Σ energies at 0) − Σ works [J].
    pub residual: f64,
    /// Smallest gap of all bodies [m]; infinite where none applies.
    pub smallest_gap: f64,
}

/// Writes the row of a state, flattened in the order of [`arrays`]; `bodies` is scratch, `initial` Σ energies at t = 0.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn fill(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    initial: Option<f64>,
    (bodies, row): (&mut Vec<BodyObservation>, &mut Vec<f64>),
) -> Result<Audit, Inadmissible> {
    bodies.clear();
    for index in 0..model.bodies.len() {
        bodies.push(observe(model, workspace, state, index)?);
    }
    row.clear();
    for field in &BODY_FIELDS {
        for body in bodies.iter() {
            match (field.value)(body) {
                Value::Scalar(value) => row.push(value),
                Value::Vector(value) => row.extend(value.iter()),
                // nalgebra stores columns; rows are recorded.
                Value::Matrix(value) => row.extend(value.transpose().iter()),
            }
        }
    }
    let ledger = row.len();
    row.resize(ledger + model.energies().len(), 0.0);
    energies(model, workspace, state, &mut row[ledger..])?;
    let (energy, kinetic) = (row[ledger..].iter().sum(), row[ledger]);
    let residual = residual(energy, initial, &state.works);
    row.extend(&state.works);
    row.push(residual);
    Ok(Audit {
        energy,
        kinetic,
        exchanged: state.works.iter().map(|work| work.abs()).sum(),
        residual,
        smallest_gap: bodies.iter().map(|body| body.gap).fold(f64::INFINITY, f64::min),
    })
}

fn residual(energy: f64, initial: Option<f64>, works: &[f64]) -> f64 {
    energy - initial.unwrap_or(energy) - works.iter().sum::<f64>()
}
