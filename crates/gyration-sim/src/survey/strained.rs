//! What becomes of a lattice as its cell is deformed, in a form to print.

use super::bands::check_mesh;
use super::cell::{beginning, unit_cell};
use crate::modes::bands::{Instability, NoBands, StrainPath, StrainedRow, ZoneMesh};
use gyration::tensor::Mat3;
use gyration_scene::Scene;
use serde::Serialize;

/// A path of strains.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrainSurvey {
    /// Its values.
    pub path: Vec<StrainRow>,
    /// Where the lattice first becomes unstable.
    pub instability: Option<InstabilitySurvey>,
}

/// One of its values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrainRow {
    /// s, from 0 to 1.
    pub s: f64,
    /// F̄.
    #[serde(rename = "F")]
    pub gradient: [[f64; 3]; 3],
    /// The force of each cell vector [N].
    pub force: Vec<[f64; 3]>,
    /// The stress [Pa; of a sheet N/m, of a chain N].
    pub stress: [[f64; 3]; 3],
    /// The least ω² over the zone [1/s²], translations of everything aside; none where there is nothing else.
    pub least_omega2: Option<f64>,
    /// Its κ.
    pub at_kappa: [f64; 3],
    /// Its branch, counted by ω².
    pub branch: usize,
}

/// Where a lattice first becomes unstable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InstabilitySurvey {
    /// s.
    pub s: f64,
    /// F̄.
    #[serde(rename = "F")]
    pub gradient: [[f64; 3]; 3],
    /// κ of the wave that grows beyond; of a macroscopic one that of a long wave in its direction.
    pub kappa: [f64; 3],
    /// Its branch, counted by ω².
    pub branch: usize,
    /// Whether the lattice yields to long waves.
    pub macroscopic: bool,
}

impl StrainSurvey {
    /// Along a path in so many values.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn of(scene: &Scene, path: &StrainPath, steps: usize, mesh: Option<usize>) -> Result<Self, String> {
        let cell = unit_cell(scene)?;
        let usual = ZoneMesh::usual(&cell.periodic);
        mesh.map_or(Ok(()), |mesh| check_mesh(mesh, &cell.periodic))?;
        let zone = ZoneMesh { count: mesh.unwrap_or(usual.count), ..usual };
        let found = beginning(cell).and_then(|cell| cell.along(path, steps, zone));
        let (rows, instability) = found.map_err(|error: NoBands| error.to_string())?;
        Ok(Self { path: rows.iter().map(row).collect(), instability: instability.map(told) })
    }
}

fn rows(matrix: &Mat3) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))
}

fn row(row: &StrainedRow) -> StrainRow {
    let (rest, least) = (row.waves.rest(), row.stability.least);
    StrainRow {
        s: row.s,
        gradient: rows(&row.gradient),
        force: rest.force.iter().map(|force| (*force).into()).collect(),
        stress: rows(&rest.stress),
        least_omega2: least.square.is_finite().then_some(least.square),
        at_kappa: least.kappa,
        branch: least.branch,
    }
}

fn told(found: Instability) -> InstabilitySurvey {
    let Instability { s, gradient, wave } = found;
    InstabilitySurvey {
        s,
        gradient: rows(&gradient),
        kappa: wave.kappa,
        branch: wave.branch,
        macroscopic: wave.macroscopic,
    }
}
