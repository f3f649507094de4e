//! The bands of a lattice, and how they change with numbers of its scene.
//!
//!   ∂ω = ξᴴ (∂K − ω² ∂M) ξ/(2ω ξᴴMξ),   ∂K the rest moving
//!
//! The matrices of neighbouring scenes, each at its own rest, are differentiated (`variation`), so that nothing has to
//! be sorted by branches. Where several branches have one frequency, the changes are the eigenvalues of their block.

use super::cell::{beginning, unit_cell, waves_of};
use crate::modes::bands::{LatticeWaves, MatrixDoubt, NoBands, PathPoint, RowRequest, StrainPath, VariedCell};
use crate::variation::{SceneNumber, SceneVariation};
use gyration::tensor::Mat3;
use gyration_scene::Scene;

/// A number by which bands are differentiated, and what it does.
#[derive(Debug, Clone)]
pub(super) struct BandNumber {
    /// Its dotted key.
    pub key: String,
    /// What it is, in SI units.
    pub value: f64,
    /// An estimate of the error of the derivative of the matrices by ln p, as a part of their largest entries.
    pub error: f64,
}

/// The waves of the cell of a scene, with their changes by numbers of it.
#[derive(Debug)]
pub struct VariedBands {
    pub(super) waves: LatticeWaves,
    pub(super) varied: Vec<VariedCell>,
    pub(super) numbers: Vec<BandNumber>,
}

/// The frequencies at a wave vector, and their derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedFrequencies {
    /// ω of each branch, ascending [rad/s].
    pub omega: Vec<f64>,
    /// ∂ω of each branch by each number; none where ω has no derivative.
    pub changes: Vec<Vec<Option<f64>>>,
}

impl VariedBands {
    /// Of the lattice of a scene and numbers at dotted keys; the cell deformed first, or as it is.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn of(scene: &Scene, strain: Option<&StrainPath>, keys: &[String]) -> Result<Self, String> {
        let told = |error: NoBands| error.to_string();
        let waves = waves_of(unit_cell(scene)?, strain).map_err(told)?;
        let scales = if keys.is_empty() { Vec::new() } else { waves.scales_of_numbers() };
        let tell = |neighbour: &Scene| {
            let other = waves_of(unit_cell(neighbour)?, strain).map_err(told)?;
            other.numbers_along(&waves).ok_or_else(|| "it changes what acts on what".to_owned())
        };
        let (mut varied, mut numbers): (Vec<VariedCell>, Vec<BandNumber>) = (Vec::new(), Vec::new());
        for key in keys {
            if numbers.iter().any(|known| known.key == *key) {
                return Err(format!("{key}: it stands twice among the numbers; leave one out"));
            }
            let number = SceneNumber::find_at_rest(scene, key).map_err(|unknown| unknown.to_string())?;
            let value = number.value;
            let none = |reason: String| format!("{key}: bands have no derivative by it: {reason}");
            let mut variation = SceneVariation::new(scene, number).map_err(none)?;
            let (changes, error) = variation.of_told(&scales, tell).map_err(none)?;
            varied.push(waves.varied_by(&changes));
            numbers.push(BandNumber { key: key.clone(), value, error: error * variation.scale() });
        }
        Ok(Self { waves, varied, numbers })
    }

    /// How far the matrices of the cell of a scene, deformed first or as it is, may be off.
    pub(super) fn doubt(&mut self, scene: &Scene, strain: Option<&StrainPath>) -> Result<MatrixDoubt, String> {
        let told = |error: NoBands| error.to_string();
        let doubt = self.waves.doubt().map_err(told)?;
        let cell = unit_cell(scene)?;
        if cell.load.is_none() {
            return Ok(doubt);
        }
        let gradient = strain.map_or_else(Mat3::identity, |strain| strain.at(0.0));
        let of_cell = beginning(cell).and_then(|cell| cell.doubt(&gradient)).map_err(told)?;
        Ok(doubt.with(of_cell))
    }

    /// ω and its derivatives at κ.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn at(&self, kappa: [f64; 3]) -> Result<VariedFrequencies, String> {
        let point = PathPoint { kappa, along: [0.0; 3], label: None, is_vertex: false, begins: false };
        let request = RowRequest { varied: &self.varied, ..RowRequest::default() };
        let row = self.waves.row_of(&point, request).map_err(|error| error.to_string())?;
        let (omega, changes) = row.branches.into_iter().map(|branch| (branch.omega, branch.changes)).unzip();
        Ok(VariedFrequencies { omega, changes })
    }
}
