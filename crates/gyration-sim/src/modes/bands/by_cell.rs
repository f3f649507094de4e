//! The matrices of the cells that act on one, and their sums with a factor for each: those at a wave vector.
//!
//!   K(k) = Σ_R K_R e^{ik·R},   and so C, B, D, E, H
//!
//! As a list of numbers they are compared with those of a neighbouring lattice, along the coordinates of one of both.

use super::super::spectrum::FirstOrder;
use super::super::weightless::MotionMatrices;
use gyration::lattice::Cell;
use gyration::tensor::Vec3;
use nalgebra::{Complex, DMatrix};
use std::f64::consts::TAU;

pub(super) type C64 = Complex<f64>;

/// Entries below this part of the stiffest are no action of a cell.
const NO_ACTION: f64 = 1e-14;

/// What one cell does to another.
#[derive(Debug, Clone)]
pub(super) struct CellMatrices {
    pub cell: Cell,
    /// R [m].
    pub place: Vec3,
    pub stiffness: DMatrix<f64>,
    /// The entries of the stiffness that are not zero, few between cells.
    pub entries: Vec<(usize, usize, f64)>,
    pub resistance: DMatrix<f64>,
    pub first: FirstOrder,
}

impl CellMatrices {
    pub fn new(
        (cell, place): (Cell, Vec3),
        stiffness: DMatrix<f64>,
        resistance: DMatrix<f64>,
        first: FirstOrder,
    ) -> Self {
        let entries = entries(&stiffness);
        Self { cell, place, stiffness, entries, resistance, first }
    }

    /// K, C, B, D, E and H.
    fn each(&self) -> [&DMatrix<f64>; 6] {
        let FirstOrder { forces, by_place, by_rate, own, .. } = &self.first;
        [&self.stiffness, &self.resistance, forces, by_place, by_rate, own]
    }
}

/// The matrices of all cells.
#[derive(Debug, Clone)]
pub(super) struct MatricesByCell {
    pub cells: Vec<CellMatrices>,
    /// How many ξ and γ there are.
    pub counts: [usize; 2],
    /// Whether all but the stiffness is zero.
    only_stiffness: bool,
}

impl MatricesByCell {
    pub fn new(cells: Vec<CellMatrices>, counts: [usize; 2]) -> Self {
        let only_stiffness =
            counts[1] == 0 && cells.iter().all(|cell| cell.resistance.iter().all(|entry| *entry == 0.0));
        Self { cells, counts, only_stiffness }
    }

    /// The largest |K| that there may be [1/s²].
    pub fn stiffest(&self) -> f64 {
        self.cells.iter().map(|cell| cell.stiffness.norm()).sum()
    }

    /// Whether all but the stiffness is zero.
    pub fn has_only_stiffness(&self) -> bool {
        self.only_stiffness
    }

    /// The matrices at κ.
    pub fn at(&self, kappa: &[f64; 3]) -> MotionMatrices {
        self.weighted(|cell| phase(kappa, cell.cell))
    }

    /// Σ_R f_R K_R, and so the others.
    pub fn weighted(&self, factor: impl Fn(&CellMatrices) -> C64) -> MotionMatrices {
        let mut sum = MotionMatrices::zeros(self.counts);
        let add = |sum: &mut DMatrix<C64>, part: &DMatrix<f64>, factor: C64| {
            sum.iter_mut().zip(part.iter()).for_each(|(sum, part)| *sum += factor * *part);
        };
        for cell in &self.cells {
            let factor = factor(cell);
            if factor == C64::new(0.0, 0.0) {
                continue;
            }
            for (i, j, entry) in &cell.entries {
                sum.stiffness[(*i, *j)] += factor * *entry;
            }
            if self.only_stiffness {
                continue;
            }
            add(&mut sum.resistance, &cell.resistance, factor);
            add(&mut sum.forces, &cell.first.forces, factor);
            add(&mut sum.by_place, &cell.first.by_place, factor);
            add(&mut sum.by_rate, &cell.first.by_rate, factor);
            add(&mut sum.own, &cell.first.own, factor);
        }
        sum
    }

    /// Every entry along the coordinates of a neighbour, U ξ of ξ: cell by cell as the neighbour has them.
    ///
    /// None if other cells act, or on other coordinates.
    pub fn numbers_along(&self, neighbour: &Self, turn: &DMatrix<f64>) -> Option<Vec<f64>> {
        let least = NO_ACTION * self.stiffest();
        let is_known = |cell: &CellMatrices| neighbour.cells.iter().any(|own| own.cell == cell.cell);
        let acts = |cell: &CellMatrices| cell.each().iter().any(|matrix| matrix.amax() > least);
        if self.counts != neighbour.counts || self.cells.iter().any(|cell| !is_known(cell) && acts(cell)) {
            return None;
        }
        let mut numbers = Vec::new();
        for cell in &neighbour.cells {
            let Some(own) = self.cells.iter().find(|own| own.cell == cell.cell) else {
                numbers.extend(cell.each().iter().flat_map(|matrix| vec![0.0; matrix.len()]));
                continue;
            };
            let [stiffness, resistance, forces, by_place, by_rate, contraction] = own.each();
            let both = |matrix: &DMatrix<f64>| turn * matrix * turn.transpose();
            let turned = [
                both(stiffness),
                both(resistance),
                turn * forces,
                by_place * turn.transpose(),
                by_rate * turn.transpose(),
                contraction.clone(),
            ];
            numbers.extend(turned.iter().flat_map(|matrix| matrix.iter().copied()));
        }
        Some(numbers)
    }

    /// Σ_R |C_R| [1/s].
    pub fn most_resisting(&self) -> f64 {
        self.cells.iter().map(|cell| cell.resistance.norm()).sum()
    }

    /// Σ_R |K_R − K′_R| [1/s²] and Σ_R |C_R − C′_R| [1/s] of a neighbour, along its coordinates; none where other cells
    /// act, or on other coordinates.
    pub fn distances(&self, neighbour: &Self, turn: &DMatrix<f64>) -> Option<[f64; 2]> {
        let there = neighbour.with_numbers(&self.numbers_along(neighbour, turn)?);
        let pairs = || there.cells.iter().zip(&neighbour.cells);
        let stiffness = pairs().map(|(one, other)| (&one.stiffness - &other.stiffness).norm()).sum();
        Some([stiffness, pairs().map(|(one, other)| (&one.resistance - &other.resistance).norm()).sum()])
    }

    /// The largest entry of each kind of matrix, as often as it has numbers in a list of them; infinite where there is
    /// none.
    pub fn scales(&self) -> Vec<f64> {
        let most = |kind: usize| match self.cells.iter().map(|cell| cell.each()[kind].amax()).fold(0.0, f64::max) {
            0.0 => f64::INFINITY,
            most => most,
        };
        let kinds: [f64; 6] = std::array::from_fn(most);
        let of_cell = |cell: &CellMatrices| {
            let lengths = cell.each().map(DMatrix::len);
            kinds.iter().zip(lengths).flat_map(|(kind, length)| vec![*kind; length]).collect::<Vec<f64>>()
        };
        self.cells.iter().flat_map(of_cell).collect()
    }

    /// Matrices of the same cells with other numbers, as `numbers_along` lists them.
    #[must_use]
    pub fn with_numbers(&self, numbers: &[f64]) -> Self {
        let mut left = numbers.iter().copied();
        let cells = self.cells.iter().map(|cell| {
            let [stiffness, resistance, forces, by_place, by_rate, own] = cell
                .each()
                .map(|matrix| DMatrix::from_iterator(matrix.nrows(), matrix.ncols(), left.by_ref().take(matrix.len())));
            let first = FirstOrder { forces, by_place, by_rate, own, turns: cell.first.turns.clone() };
            CellMatrices::new((cell.cell, cell.place), stiffness, resistance, first)
        });
        Self::new(cells.collect(), self.counts)
    }
}

/// e^{2πi κ·n}.
pub(super) fn phase(kappa: &[f64; 3], cell: Cell) -> C64 {
    unit_phase(kappa.iter().zip(cell).map(|(kappa, n)| kappa * f64::from(n)).sum())
}

/// e^{2πi x}; exact where x is a multiple of a quarter.
pub(crate) fn unit_phase(turns: f64) -> C64 {
    let quarters = 4.0 * (turns - turns.round());
    match quarters {
        0.0 => C64::new(1.0, 0.0),
        1.0 => C64::new(0.0, 1.0),
        -1.0 => C64::new(0.0, -1.0),
        2.0 | -2.0 => C64::new(-1.0, 0.0),
        _ => {
            let (sine, cosine) = libm::sincos(0.25 * TAU * quarters);
            C64::new(cosine, sine)
        }
    }
}

/// The entries of a matrix that are not zero.
fn entries(matrix: &DMatrix<f64>) -> Vec<(usize, usize, f64)> {
    let places = (0..matrix.ncols()).flat_map(|j| (0..matrix.nrows()).map(move |i| (i, j)));
    places.map(|(i, j)| (i, j, matrix[(i, j)])).filter(|(.., entry)| *entry != 0.0).collect()
}
