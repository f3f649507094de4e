//! Unknowns whose rates only their own block enters, eliminated before the blocks are: positions, where forces couple.
//!
//!   q_i' = A_i q_i + G_i v_i,   v_i' = Σ_j (K_ij q_j + C_ij v_j),   D = s I − A
//!   q_i = D_i⁻¹ (r_i + G_i v_i),   Σ_j (s δ_ij − C_ij − K_ij D_j⁻¹ G_j) v_j = r'_i + Σ_j K_ij D_j⁻¹ r_j
//!
//! What is left to eliminate has the same pattern and, of rigid bodies, six unknowns a block instead of thirteen.

use std::marker::PhantomData;
use std::ops::Range;

use crate::analysis::{Analysis, BlockEntry};
use crate::block_matrix::BlockMatrix;
use crate::kernel::BlockArithmetic;
use crate::linear::Singular;

/// What brings the unknowns of local rates into the others, and back.
#[derive(Debug, Clone)]
pub(crate) struct Reduction<K> {
    /// D and −D⁻¹ G of each step.
    local: Vec<f64>,
    pivots: Vec<usize>,
    /// −K of each entry.
    entries: Vec<f64>,
    /// The unknowns of local rates, step by step.
    work: Vec<f64>,
    places: Offsets,
    kernel: PhantomData<K>,
}

/// Where the numbers of each step or entry begin, and where the last end, in units of one number.
#[derive(Debug, Clone)]
struct Offsets {
    local: Vec<usize>,
    firsts: Vec<usize>,
    entries: Vec<usize>,
}

impl<K: BlockArithmetic> Reduction<K> {
    /// Room for the factors of a component.
    pub fn new(analysis: &Analysis) -> Self {
        let begins = |sizes: &mut dyn Iterator<Item = usize>| {
            let mut sums = vec![0];
            sums.extend(sizes.scan(0, |sum, size| {
                *sum += size;
                Some(*sum)
            }));
            sums
        };
        let locals = || analysis.local.iter().map(ExactSizeIterator::len);
        let steps = locals().zip(&analysis.unknowns);
        let entries =
            analysis.entries.iter().map(|entry| analysis.size(entry.row) * analysis.local[entry.column].len());
        let places = Offsets {
            local: begins(&mut steps.map(|(n, others)| n * (n + others.len()))),
            firsts: begins(&mut locals()),
            entries: begins(&mut entries.into_iter()),
        };
        let room = |places: &[usize]| vec![0.0; K::PARTS * places.last().copied().unwrap_or(0)];
        Self {
            local: room(&places.local),
            pivots: vec![0; locals().sum()],
            entries: room(&places.entries),
            work: room(&places.firsts),
            places,
            kernel: PhantomData,
        }
    }

    /// Factorizes D of every block.
    ///
    /// # Errors
    /// `Singular` if one of them is, or something is not finite.
    pub fn factorize(&mut self, analysis: &Analysis, shift: K::Shift, jacobian: &BlockMatrix) -> Result<(), Singular> {
        for (step, block) in analysis.blocks.iter().enumerate() {
            let (n, others) = (analysis.local[step].len(), analysis.size(step));
            if n > 0 {
                let own = &jacobian.diagonal()[*block];
                let (factors, coupling) =
                    self.local[part::<K>(&self.places.local, step)].split_at_mut(K::PARTS * n * n);
                let pivots = &mut self.pivots[self.places.firsts[step]..self.places.firsts[step + 1]];
                K::set(factors, own.view((0, 0), (n, n)), Some(shift));
                K::set(coupling, own.view((0, n), (n, others)), None);
                K::factorize(factors, pivots)?;
                K::solve_columns(factors, pivots, coupling, others);
            }
        }
        for (index, BlockEntry { row, column, .. }) in analysis.entries.iter().enumerate() {
            let (rows, columns) = (analysis.size(*row), analysis.local[*column].len());
            if columns > 0 {
                let block = jacobian.block(analysis.blocks[*row], analysis.blocks[*column]).ok_or(Singular)?;
                let place = &mut self.entries[part::<K>(&self.places.entries, index)];
                K::set(place, block.view((analysis.local[*row].len(), 0), (rows, columns)), None);
            }
        }
        Ok(())
    }

    /// Subtracts K D⁻¹ G from the block of an entry.
    pub fn subtract(&self, analysis: &Analysis, index: usize, block: &mut [f64]) {
        let column = analysis.entries[index].column;
        let (n, others) = (analysis.local[column].len(), analysis.size(column));
        if n > 0 {
            let coupling = &self.local[part::<K>(&self.places.local, column)][K::PARTS * n * n..];
            K::subtract_product(block, &self.entries[part::<K>(&self.places.entries, index)], coupling, n, others);
        }
    }

    /// D⁻¹ r of every block, and what it adds to the right side of the others, in the order of the elimination.
    pub fn solve_local(&mut self, analysis: &Analysis, b: &[&mut [f64]], others: &mut [f64]) {
        for (step, unknowns) in analysis.local.iter().enumerate().filter(|(_, unknowns)| !unknowns.is_empty()) {
            let x = &mut self.work[part::<K>(&self.places.firsts, step)];
            for (part, vector) in x.chunks_exact_mut(unknowns.len()).zip(b) {
                part.copy_from_slice(&vector[unknowns.clone()]);
            }
            let factors = &self.local[part::<K>(&self.places.local, step)][..K::PARTS * unknowns.len().pow(2)];
            K::solve(factors, &self.pivots[self.places.firsts[step]..self.places.firsts[step + 1]], x);
        }
        for (index, BlockEntry { row, column, .. }) in analysis.entries.iter().enumerate() {
            let x = &self.work[part::<K>(&self.places.firsts, *column)];
            if !x.is_empty() {
                let matrix = &self.entries[part::<K>(&self.places.entries, index)];
                K::subtract_image(&mut others[part::<K>(&analysis.firsts, *row)], matrix, x);
            }
        }
    }

    /// The unknowns of local rates from the others, which are in the order of the elimination.
    pub fn solve_rest(&mut self, analysis: &Analysis, b: &mut [&mut [f64]], others: &[f64]) {
        for (step, unknowns) in analysis.local.iter().enumerate().filter(|(_, unknowns)| !unknowns.is_empty()) {
            let x = &mut self.work[part::<K>(&self.places.firsts, step)];
            let coupling = &self.local[part::<K>(&self.places.local, step)][K::PARTS * unknowns.len().pow(2)..];
            K::subtract_image(x, coupling, &others[part::<K>(&analysis.firsts, step)]);
            for (part, vector) in x.chunks_exact(unknowns.len()).zip(b.iter_mut()) {
                vector[unknowns.clone()].copy_from_slice(part);
            }
        }
    }
}

/// The range of a step or an entry, in floating-point numbers.
fn part<K: BlockArithmetic>(places: &[usize], index: usize) -> Range<usize> {
    K::PARTS * places[index]..K::PARTS * places[index + 1]
}
