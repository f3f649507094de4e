//! The continuum of a lattice, in a form to print.

use super::bands::{CellRestSurvey, cell_rest, path_of, warnings_of};
use super::cell::{unit_cell, waves_of};
use crate::modes::bands::{BandRow, Continuum, ContinuumModel, NoBands, NoContinuum, Reach, Tensor, frequency_error};
use gyration_scene::Scene;
use nalgebra::DMatrix;
use serde::{Serialize, Serializer};

/// What a lattice is as a continuum, and where a model of it ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContinuumSurvey {
    /// The model.
    #[serde(serialize_with = "as_word")]
    pub model: ContinuumModel,
    /// The coordinates (u, α) of the matrices.
    pub coordinates: Vec<String>,
    /// Ω [m³; of a sheet m², of a chain m].
    pub volume: f64,
    /// M per Ω.
    pub mass: Vec<Vec<f64>>,
    /// D₀ per Ω.
    #[serde(rename = "D0")]
    pub zeroth: Vec<Vec<f64>>,
    /// D₁ᵃ per Ω.
    #[serde(rename = "D1")]
    pub first: [Vec<Vec<f64>>; 3],
    /// D₂ᵃᵇ per Ω.
    #[serde(rename = "D2")]
    pub second: [[Vec<Vec<f64>>; 3]; 3],
    /// C_iajb, α eliminated [Pa; of a sheet N/m, of a chain N].
    #[serde(rename = "macro")]
    pub macroscopic: Tensor,
    /// C_e, of strains that no α follows.
    pub held: Tensor,
    /// C_micro; none where no α follows one of the strains.
    pub micro: Option<Tensor>,
    /// Its frequencies beside those of the lattice.
    pub map: ContinuumMap,
    /// Where it ends.
    pub reach: Vec<Reach>,
    /// Where the cell is looked at.
    pub rest: CellRestSurvey,
    /// What must be told besides.
    pub warnings: Vec<String>,
}

/// Frequencies of a model beside those of the lattice, along a path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContinuumMap {
    /// κ of each row.
    pub kappa: Vec<[f64; 3]>,
    /// ω of the lattice, ascending [rad/s].
    pub omega: Vec<Vec<f64>>,
    /// ω of the model, ascending [rad/s].
    pub continuum: Vec<Vec<f64>>,
    /// |ω of the model/ω − 1|; none where ω is zero.
    pub error: Vec<Vec<Option<f64>>>,
    /// k of each row [1/m].
    #[serde(skip)]
    pub k: Vec<[f64; 3]>,
    /// The vertices with names: the number of the row, and the name.
    #[serde(skip)]
    pub labels: Vec<(usize, String)>,
    /// The rows at which there are vertices.
    #[serde(skip)]
    pub vertices: Vec<usize>,
    /// The rows at which the path begins anew.
    #[serde(skip)]
    pub begins: Vec<usize>,
}

fn as_word<S: Serializer>(model: &ContinuumModel, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(model.name())
}

/// A stress below this part of the largest modulus is none.
const STRESSED: f64 = 1e-8;

impl ContinuumSurvey {
    /// Of the lattice of a scene, along a path as it is written or the usual one.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn of(scene: &Scene, model: ContinuumModel, path: Option<&str>, points: usize) -> Result<Self, String> {
        let cell = unit_cell(scene)?;
        let path = path_of(cell, path, points)?;
        let waves = waves_of(cell, None).map_err(|error: NoBands| error.to_string())?;
        let names: Vec<&str> = cell.model.names().collect();
        let told = |error: NoContinuum| error.to_string();
        let continuum = waves.continuum(&names).map_err(told)?;
        let (mut rows_of_lattice, mut own, mut sinks) = (Vec::new(), Vec::new(), None);
        for point in &path.points {
            let k = waves.wave_vector(&point.kappa);
            let row = waves.row(point, false).map_err(|error| error.to_string())?;
            let squares = continuum.squares(model, &k).map_err(|error| error.to_string())?;
            let growing = row.branches.iter().filter(|branch| branch.decay < 0.0).count();
            if sinks.is_none() && squares.iter().filter(|square| **square < 0.0).count() > growing {
                sinks = Some(point.kappa);
            }
            own.push(squares.into_iter().map(|square| libm::sqrt(square.max(0.0))).collect::<Vec<f64>>());
            rows_of_lattice.push(row);
        }
        let frequencies = |row: &BandRow| row.branches.iter().map(|branch| branch.omega).collect();
        let omega: Vec<Vec<f64>> = rows_of_lattice.iter().map(frequencies).collect();
        let mut warnings = warnings_of(cell, &waves, &rows_of_lattice);
        warnings.extend(warnings_of_model(&continuum, waves.rest().stress.amax(), (model, sinks)));
        let errors = |(exact, own): (&Vec<f64>, &Vec<f64>)| {
            own.iter().zip(exact).map(|(own, exact)| frequency_error(*own, *exact)).collect()
        };
        let points = || path.points.iter().enumerate();
        let map = ContinuumMap {
            kappa: path.points.iter().map(|point| point.kappa).collect(),
            error: omega.iter().zip(&own).map(errors).collect(),
            k: path.points.iter().map(|point| waves.wave_vector(&point.kappa).into()).collect(),
            labels: points().filter_map(|(row, point)| Some((row, point.label.clone()?))).collect(),
            vertices: points().filter(|(_, point)| point.is_vertex).map(|(row, _)| row).collect(),
            begins: points().filter(|(_, point)| point.begins).map(|(row, _)| row).collect(),
            omega,
            continuum: own,
        };
        Ok(Self {
            model,
            coordinates: continuum.coordinates().map(str::to_owned).collect(),
            volume: continuum.volume(),
            mass: rows(continuum.mass()),
            zeroth: rows(continuum.zeroth()),
            first: continuum.first().each_ref().map(rows),
            second: continuum.second().each_ref().map(|matrices| matrices.each_ref().map(rows)),
            macroscopic: *continuum.macroscopic(),
            held: continuum.held(),
            micro: continuum.microscopic(),
            reach: continuum.reach(&waves, model, &cell.periodic).map_err(told)?,
            rest: cell_rest(&waves, &names),
            warnings,
            map,
        })
    }
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// Supports that hold the lattice, what nothing holds, stresses, squares below zero.
fn warnings_of_model(
    continuum: &Continuum,
    stress: f64,
    (model, sinks): (ContinuumModel, Option<[f64; 3]>),
) -> Vec<String> {
    let mut warnings = Vec::new();
    if continuum.foundation() > 0.0 {
        let held = "anchors, supports or forces of their own hold the bodies in space: waves have a frequency at k = 0";
        // u is the same for all of a cell.
        let moduli = match continuum.coordinates().count() > 3 {
            false => "and the moduli say what neighbours add to it",
            true => {
                "and the moduli are those of slow strains. The parts of a cell are held against one another as well, \
                 so that these are not the moduli of its waves, and differ from those of a larger cell of the same \
                 lattice: `gyration bands` tells the waves"
            }
        };
        warnings.push(format!("{held}, {moduli}"));
    }
    let floppy = continuum.floppy();
    if floppy > 0 {
        let motions = if floppy == 1 { "motion" } else { "motions" };
        warnings.push(format!("nothing holds {floppy} {motions} of the granules in the cell: they are kept beside u"));
    }
    if stress > STRESSED * continuum.stiffness() {
        warnings.push(format!(
            "the rest state is under stress, up to {stress:.4e} in the units of the moduli: C holds it too, as waves \
             do, and C_iajb and C_jbia differ by {:.2e} of the largest modulus",
            continuum.asymmetry()
        ));
    }
    if let Some([x, y, z]) = sinks {
        warnings.push(format!(
            "waves that the lattice carries grow in the model \"{}\": its ω² is below zero from κ = ({x:.6}, {y:.6}, \
             {z:.6}) on",
            model.name()
        ));
    }
    warnings
}
