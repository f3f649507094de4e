//! Cells that have moved on: what a state of a ring is when every cell does as one some cells farther did.
//!
//!   (S⁻¹ y)_n = y_{n+N},   n the cells of the ring, counted around it
//!
//! Numbers of the state are those of bodies in their own cells, so that S only puts them in another order; springs,
//! bonds and contacts are those of all cells alike, so that S and the flow commute.

use gyration::model::Model;
use gyration::state::State;
use gyration_scene::{Built, CellBlock};
use nalgebra::DMatrix;

/// A shift by some cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellShift {
    /// Where each number of S⁻¹y stands in y.
    from: Vec<usize>,
}

/// Why cells cannot be moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoShift {
    /// There are no cells.
    #[error("the scene has no `[lattice]`, whose cells could be moved on")]
    NoLattice,
    /// The cells end.
    #[error("the lattice has free ends along cell vector {0}, where no cell comes to the place of the first")]
    FreeEnds(usize),
    /// They have come round.
    #[error(
        "the ring has {cells} cells along cell vector {vector}, so that {by} are more than once round: --shift takes \
         no more than {cells}"
    )]
    Round {
        /// Along which vector, from one.
        vector: usize,
        /// How many there are.
        cells: u32,
        /// By how many they should move.
        by: i32,
    },
}

impl CellShift {
    /// By so many cells along each direction of the ring of a scene.
    ///
    /// # Errors
    /// [`NoShift`].
    pub fn of(built: &Built, by: [i32; 3]) -> Result<Self, NoShift> {
        let Some(CellBlock { repeat, periodic }) = built.block else { return Err(NoShift::NoLattice) };
        let vectors = built.model.lattice.vectors().len();
        if let Some(a) = (0..3).find(|a| by[*a] != 0 && !(periodic[*a] && *a < vectors)) {
            return Err(NoShift::FreeEnds(a + 1));
        }
        if let Some(a) = (0..3).find(|a| by[*a].unsigned_abs() > repeat[*a]) {
            return Err(NoShift::Round { vector: a + 1, cells: repeat[a], by: by[a] });
        }
        let count: usize = repeat.iter().map(|many| *many as usize).product();
        let farther = |body: usize| {
            let (mut cell, mut stride, mut found) = (body % count, 1, 0);
            for (many, by) in repeat.iter().zip(by) {
                let many = *many as usize;
                found += stride * ((cell % many) as i64 + i64::from(by)).rem_euclid(many as i64) as usize;
                (cell, stride) = (cell / many, stride * many);
            }
            body - body % count + found
        };
        Ok(Self { from: Self::numbers(&built.model, farther) })
    }

    /// Where the numbers of all bodies stand, given from whom each takes them.
    fn numbers(model: &Model, from: impl Fn(usize) -> usize) -> Vec<usize> {
        (0..model.bodies.len()).flat_map(|body| model.slots(from(body)).block()).collect()
    }

    /// S⁻¹ y.
    pub fn back(&self, state: &State) -> State {
        let moved = |numbers: &[f64]| match numbers.is_empty() {
            true => Vec::new(),
            false => self.from.iter().map(|place| numbers[*place]).collect(),
        };
        State { bodies: moved(&state.bodies), low: moved(&state.low), ..state.clone() }
    }

    /// S⁻¹ of changes of a state, column by column.
    pub(super) fn rows_back(&self, changes: &DMatrix<f64>) -> DMatrix<f64> {
        changes.select_rows(&self.from)
    }
}
