//! The cell of a lattice beside that of a neighbouring scene, in which a number of the scene is a little another.
//!
//!   ∂K_R/∂p at κ fixed, the rest moving with p, along coordinates in which the mass is one
//!
//! Such coordinates ξ follow from the mass, the rest and the joints up to a turn U of them, which need not go smoothly
//! from scene to scene. The turn is that of the polar decomposition of the velocities of one as seen from the other,
//! and then does: what it leaves of a smooth turn is of no effect on ∂ω, ξᴴ[K, Ω]ξ = 0.

use super::super::system::SystemCoordinates;
use super::LatticeWaves;
use super::by_cell::MatricesByCell;

/// How the matrices of a cell change with a number of its scene.
#[derive(Debug, Clone)]
pub struct VariedCell(MatricesByCell);

impl VariedCell {
    pub(super) fn matrices(&self) -> &MatricesByCell {
        &self.0
    }
}

impl LatticeWaves {
    /// Every entry of the matrices of all cells, along the coordinates of another cell: in the order of its own.
    ///
    /// None if the cells differ in what acts.
    pub(crate) fn numbers_along(&self, other: &Self) -> Option<Vec<f64>> {
        let turn = SystemCoordinates::turn(&self.coordinates, &other.coordinates)?;
        self.system.by_cell().numbers_along(other.system.by_cell(), &turn)
    }

    /// Σ_R |K_R − K′_R| [1/s²] and Σ_R |C_R − C′_R| [1/s] of another cell; infinite where something else acts.
    pub(super) fn distances(&self, other: &Self) -> [f64; 2] {
        let turn = SystemCoordinates::turn(&self.coordinates, &other.coordinates);
        let apart = turn.and_then(|turn| self.system.by_cell().distances(other.system.by_cell(), &turn));
        apart.unwrap_or([f64::INFINITY; 2])
    }

    /// The sizes by which these entries are judged.
    pub(crate) fn scales_of_numbers(&self) -> Vec<f64> {
        self.system.by_cell().scales()
    }

    /// The changes of the matrices, given those of their entries.
    pub(crate) fn varied_by(&self, changes: &[f64]) -> VariedCell {
        VariedCell(self.system.by_cell().with_numbers(changes))
    }
}
