//! Bands of a lattice, in a form to print.

use super::cell::{unit_cell, waves_of};
use super::modes::{Named, RestPlace, left_out};
use super::remarks::endless;
use super::varied_bands::{BandNumber, VariedBands};
use crate::modes::PARTS;
use crate::modes::bands::{
    BandPath, BandRow, BandShape, FreeEdges, LatticeWaves, MOST_POINTS, NoBands, RowRequest, Sound, StrainPath, Zone,
};
use crate::waves::PassingWaves;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::{Scene, UnitCell};
use serde::Serialize;

/// An error of the derivatives of matrices from which on it is told, as a part of their largest entries: usual is 1e-9.
const UNSURE: f64 = 1e-7;

/// The bands of a lattice along a path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BandSurvey {
    /// κ of each row.
    pub kappa: Vec<[f64; 3]>,
    /// k of each row [1/m].
    pub k: Vec<[f64; 3]>,
    /// ω of each branch, ascending [rad/s].
    pub omega: Vec<Vec<f64>>,
    /// δ of each branch [1/s].
    pub decay: Vec<Vec<f64>>,
    /// Every root λ = −δ − iω, real and imaginary part [1/s].
    pub lambda: Vec<Vec<[f64; 2]>>,
    /// ∂ω/∂k of each branch [m/s]; none where ω has no derivative.
    pub velocity: Vec<Vec<Option<[f64; 3]>>>,
    /// Shares of translation, rotation, shear, stretch and breathing in the kinetic energy of each branch.
    pub participation: Vec<Vec<[f64; PARTS]>>,
    /// Shares of the kinetic energy at the edges of a ribbon; none where nothing ends.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edges: Vec<EdgeShares>,
    /// The shape of each branch, of each body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shapes: Option<Vec<Vec<Named<BandShape>>>>,
    /// ∂ω of each branch by numbers of the scene; none where that was not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivatives: Option<BandDerivatives>,
    /// By how much ω of each branch may be off [rad/s]; none where that was not asked for, or is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound: Option<Vec<Vec<Option<f64>>>>,
    /// The vertices with names: the number of the row, and the name.
    pub labels: Vec<(usize, String)>,
    /// The rows at which there are vertices.
    #[serde(skip)]
    pub vertices: Vec<usize>,
    /// The rows at which the path begins anew.
    pub begins: Vec<usize>,
    /// The speeds of long waves along each periodic direction; none where something resists or drives.
    pub sound: Vec<Sound>,
    /// Where the cell is looked at.
    pub rest: CellRestSurvey,
    /// What a mesh over the zone tells.
    #[serde(flatten)]
    pub zone: Option<Zone>,
    /// What must be told besides.
    pub warnings: Vec<String>,
}

/// How much of each branch runs at the two edges of a direction along which the cells end.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EdgeShares {
    /// The direction, from 1.
    pub direction: usize,
    /// How many cells deep each edge is.
    pub cells: u32,
    /// Shares of the kinetic energy of each branch in each row: where the cells begin, where they end.
    pub shares: Vec<Vec<[f64; 2]>>,
}

/// ∂ω by numbers of a scene [rad/s per unit of each].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct BandDerivatives {
    /// By the key of each number: a row a wave vector, an entry a branch; none where ω has no derivative.
    pub by_key: Named<Vec<Vec<Option<f64>>>>,
    /// The numbers, in the same order.
    #[serde(skip)]
    pub numbers: Vec<f64>,
}

/// Where the cell is looked at.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CellRestSurvey {
    /// The force of each cell vector [N].
    pub force: Vec<[f64; 3]>,
    /// The stress [Pa; of a sheet N/m, of a chain N].
    pub stress: [[f64; 3]; 3],
    /// The cell vectors [m].
    pub cell: Vec<[f64; 3]>,
    /// Where each body rests.
    pub bodies: Named<RestPlace>,
}

/// What is asked of bands.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BandOptions {
    /// Wave vectors a segment of the path.
    pub points: usize,
    /// Wave vectors of a mesh along each direction, if one is wanted.
    pub mesh: Option<usize>,
    /// Whether shapes are wanted.
    pub shapes: bool,
    /// How the cell is deformed at first, if it is: its bodies then seek their rest; of a path its beginning counts.
    pub strain: Option<StrainPath>,
    /// The dotted keys of numbers by which ω is differentiated.
    pub derivatives: Vec<String>,
    /// Whether it is wanted by how much ω may be off.
    pub bound: bool,
}

/// A path as it is written, or the usual one of a cell.
pub(super) fn path_of(cell: &UnitCell, path: Option<&str>, points: usize) -> Result<BandPath, String> {
    let usual = BandPath::usual(&cell.periodic);
    BandPath::parse(path.unwrap_or(&usual), points, &cell.periodic).map_err(|error| error.to_string())
}

/// Refuses a mesh of more wave vectors than are worth it.
pub(super) fn check_mesh(mesh: usize, periodic: &[bool]) -> Result<(), String> {
    let directions = periodic.iter().filter(|periodic| **periodic).count() as u32;
    match mesh.checked_pow(directions).filter(|many| *many <= MOST_POINTS) {
        Some(_) => Ok(()),
        None => {
            Err(format!("a mesh of {mesh} along each direction has more than {MOST_POINTS} wave vectors: take fewer"))
        }
    }
}

impl BandSurvey {
    /// Along a path as it is written, or the usual one.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn of(scene: &Scene, path: Option<&str>, options: BandOptions) -> Result<Self, String> {
        let cell = unit_cell(scene)?;
        let path = path_of(cell, path, options.points)?;
        options.mesh.map_or(Ok(()), |mesh| check_mesh(mesh, &cell.periodic))?;
        let told = |error: NoBands| error.to_string();
        let strain = options.strain.as_ref();
        let mut found = VariedBands::of(scene, strain, &options.derivatives)?;
        let doubt = if options.bound { Some(found.doubt(scene, strain)?) } else { None };
        let (waves, varied) = (&found.waves, &found.varied);
        let edges = FreeEdges::of(&cell.repeat, &cell.periodic, cell.model.bodies.len());
        let request = RowRequest { shapes: options.shapes, varied, doubt: doubt.as_ref(), edges: &edges };
        let rows = path.points.iter().map(|point| waves.row_of(point, request));
        let rows: Vec<BandRow> = rows.collect::<Result<_, _>>().map_err(told)?;
        let zone = options.mesh.map(|mesh| waves.zone(mesh, &cell.periodic)).transpose().map_err(told)?;
        let names: Vec<&str> = cell.model.names().collect();
        let each = |of: &dyn Fn(&crate::modes::bands::Branch) -> f64| {
            rows.iter().map(|row| row.branches.iter().map(of).collect()).collect()
        };
        let shapes = options.shapes.then(|| {
            let named = |shapes: &Vec<BandShape>| {
                Named(names.iter().zip(shapes).map(|(name, shape)| ((*name).to_owned(), shape.clone())).collect())
            };
            let of_row = |row: &BandRow| row.branches.iter().map(|branch| named(&branch.shapes)).collect();
            rows.iter().map(of_row).collect()
        });
        let points = || path.points.iter().enumerate();
        Ok(Self {
            kappa: rows.iter().map(|row| row.kappa).collect(),
            k: rows.iter().map(|row| row.k.into()).collect(),
            omega: each(&|branch| branch.omega),
            decay: each(&|branch| branch.decay),
            lambda: rows.iter().map(|row| row.roots.iter().map(|root| [root.re, root.im]).collect()).collect(),
            velocity: rows
                .iter()
                .map(|row| row.branches.iter().map(|it| it.velocity.map(Into::into)).collect())
                .collect(),
            participation: rows.iter().map(|row| row.branches.iter().map(|it| it.participation).collect()).collect(),
            edges: edges.iter().enumerate().map(|(index, edges)| edge_shares(&rows, index, edges)).collect(),
            shapes,
            derivatives: derivatives(&rows, &found.numbers),
            bound: doubt.map(|_| rows.iter().map(|row| row.branches.iter().map(|it| it.bound).collect()).collect()),
            labels: points().filter_map(|(row, point)| Some((row, point.label.clone()?))).collect(),
            vertices: points().filter(|(_, point)| point.is_vertex).map(|(row, _)| row).collect(),
            begins: points().filter(|(_, point)| point.begins).map(|(row, _)| row).collect(),
            sound: waves.sound(&cell.periodic).map_err(told)?,
            rest: cell_rest(waves, &names),
            warnings: [warnings_of(cell, waves, &rows), unsure(&found.numbers)].concat(),
            zone,
        })
    }
}

/// The shares at the edges of a direction, which are those of this index.
fn edge_shares(rows: &[BandRow], index: usize, edges: &FreeEdges) -> EdgeShares {
    let of_row = |row: &BandRow| row.branches.iter().map(|branch| branch.at_edges[index]).collect();
    EdgeShares { direction: edges.direction + 1, cells: edges.cells, shares: rows.iter().map(of_row).collect() }
}

/// ∂ω by each number; none without numbers.
fn derivatives(rows: &[BandRow], numbers: &[BandNumber]) -> Option<BandDerivatives> {
    let by_number = |(index, number): (usize, &BandNumber)| {
        let of_row = |row: &BandRow| row.branches.iter().map(|branch| branch.changes[index]).collect();
        (number.key.clone(), rows.iter().map(of_row).collect())
    };
    let by_key = Named(numbers.iter().enumerate().map(by_number).collect());
    let numbers: Vec<f64> = numbers.iter().map(|number| number.value).collect();
    (!numbers.is_empty()).then_some(BandDerivatives { by_key, numbers })
}

/// Numbers whose derivatives are known less well than others.
fn unsure(numbers: &[BandNumber]) -> Vec<String> {
    let told = |number: &BandNumber| {
        format!(
            "derivatives by {} are made of changes of the matrices that are known to {:.0e} of their largest entries: \
             what it changes is not smooth in it, or known to few digits",
            number.key, number.error
        )
    };
    numbers.iter().filter(|number| number.error > UNSURE).map(told).collect()
}

/// The waves of the lattice of a scene as they pass over a block of its cells.
///
/// # Errors
/// Why there are none, in words.
pub fn passing_waves(scene: &Scene) -> Result<PassingWaves, String> {
    let cell = unit_cell(scene)?;
    let waves = waves_of(cell, None).map_err(|error| error.to_string())?;
    Ok(PassingWaves::new(cell.clone(), waves))
}

/// Where a cell is looked at.
pub(super) fn cell_rest(waves: &LatticeWaves, names: &[&str]) -> CellRestSurvey {
    let rest = waves.rest();
    let vectors = |vectors: &[Vec3]| vectors.iter().map(|vector| (*vector).into()).collect();
    let rows = |matrix: &Mat3| [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]));
    let bodies = names.iter().zip(&rest.bodies).enumerate();
    let bodies = bodies.map(|(body, (name, rest))| ((*name).to_owned(), RestPlace::of(rest, waves.place(body))));
    CellRestSurvey {
        force: vectors(&rest.force),
        stress: rows(&rest.stress),
        cell: vectors(&rest.cell),
        bodies: Named(bodies.collect()),
    }
}

/// A bound on what is left out of the contacts that is not told: bands are exact but for rounding.
const LEFT_OUT: f64 = 1e-10;

/// Images that are left out, a cell that does not rest, waves that grow, contractions that go on.
pub(super) fn warnings_of(cell: &UnitCell, waves: &LatticeWaves, rows: &[BandRow]) -> Vec<String> {
    let mut warnings: Vec<String> = endless(&cell.model, &cell.state, LEFT_OUT).into_iter().collect();
    if let Some(left) = waves.rest().unrest {
        warnings.push(format!(
            "the cell as it is written does not rest: accelerations of {left:.2e} in units of the bodies' sizes are \
             left; relax = [\"granules\"] seeks its rest"
        ));
    }
    let growing = |row: &BandRow| {
        let branch = row.branches.iter().enumerate().min_by(|a, b| a.1.decay.total_cmp(&b.1.decay))?;
        (branch.1.decay < 0.0).then_some((branch.1.decay, branch.0, row.kappa))
    };
    let fastest = rows.iter().filter_map(growing).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((decay, branch, [x, y, z])) = fastest {
        warnings.push(format!(
            "the rest state is unstable: on this path branch {branch} grows fastest, with {:.4e} 1/s at κ = ({x:.6}, \
             {y:.6}, {z:.6})",
            -decay
        ));
    }
    if waves.rest().bodies.iter().any(|rest| left_out(rest).is_some()) {
        let told = "no state was found in which contractions stand still: they are held as they are at the start";
        warnings.push(told.to_owned());
    }
    warnings
}
