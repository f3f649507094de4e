//! The phases of undamped waves, in a form to print.

use super::bands::path_of;
use super::cell::{unit_cell, waves_of};
use crate::modes::bands::{BranchChern, ChernGap, MOST_POINTS, StrainPath, Topology};
use gyration_scene::Scene;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use std::f64::consts::PI;

/// Wave vectors of a mesh along each direction where none is given.
pub const USUAL_MESH: usize = 24;

/// Zak phases and Chern numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TopologySurvey {
    /// The directions of the rows of `zak`, from 1.
    pub directions: Vec<usize>,
    /// The Zak phases [rad]: a row a periodic direction, an entry a branch; none where ω vanishes and gyroscopic loads
    /// act.
    pub zak: Vec<Vec<Option<f64>>>,
    /// The Chern numbers: of a branch, or of branches that touch.
    pub chern: Vec<ChernSurvey>,
    /// The gaps of the mesh, with the sum of the Chern numbers below.
    pub gaps: Vec<ChernGap>,
    /// What must be told besides.
    pub warnings: Vec<String>,
}

/// A Chern number: a number alone of a branch, a table of those that touch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChernSurvey(pub BranchChern);

impl Serialize for ChernSurvey {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let BranchChern { branches, number } = &self.0;
        if branches.len() == 1 {
            return number.serialize(serializer);
        }
        let mut table = serializer.serialize_struct("Chern", 2)?;
        table.serialize_field("branches", branches)?;
        table.serialize_field("chern", number)?;
        table.end()
    }
}

/// A Zak phase that twice as many overlaps change by more is told [rad].
const UNSETTLED: f64 = 1e-8;

impl TopologySurvey {
    /// Of the lattice of a scene: the mesh along each direction, and the κ at which the others stay, those of the first
    /// point of a path.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn of(scene: &Scene, path: Option<&str>, mesh: usize, strain: Option<&StrainPath>) -> Result<Self, String> {
        let cell = unit_cell(scene)?;
        let path = path_of(cell, path, 2)?;
        let kappa = path.points.first().map_or([0.0; 3], |point| point.kappa);
        let directions: Vec<usize> = (0..cell.periodic.len()).filter(|a| cell.periodic[*a]).collect();
        let planes = if directions.len() == 2 { 2 } else { 1 };
        if mesh.checked_pow(planes).is_none_or(|many| many > MOST_POINTS) {
            return Err(format!("a mesh of {mesh} has more than {MOST_POINTS} wave vectors: take fewer"));
        }
        let waves = waves_of(cell, strain).map_err(|error| error.to_string())?;
        let found = waves.topology(kappa, mesh, &cell.periodic).map_err(|error| error.to_string())?;
        let Topology { zak, zak_change, chern, gaps, largest_phase } = found;
        let mut warnings = Vec::new();
        if zak_change > UNSETTLED {
            warnings.push(format!(
                "twice as many overlaps still change a Zak phase by {zak_change:.1e} rad: take a finer mesh, or other κ"
            ));
        }
        if largest_phase > 0.5 * PI {
            warnings.push(format!(
                "a plaquette of the mesh has a phase of {largest_phase:.2} rad, and beyond π it would count as \
                 another: take a finer mesh"
            ));
        }
        let (directions, chern) = (directions.iter().map(|a| a + 1).collect(), chern.into_iter().map(ChernSurvey));
        Ok(Self { directions, zak, chern: chern.collect(), gaps, warnings })
    }
}
