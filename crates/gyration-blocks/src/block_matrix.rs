//! A square matrix of dense blocks, which stand where a pattern has them.
//!
//! This is what `System::jacobian` writes. Blocks may be written in any order and added to; no call allocates but one
//! that arranges them anew. Diagonal blocks stand side by side, so that a system without coupling sees a plain slice of
//! them.

use std::ops::Range;

use nalgebra::DMatrix;

use crate::pattern::Pattern;

/// A matrix of dense blocks (i, j) for i = j and for the pairs of a pattern.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BlockMatrix {
    pattern: Pattern,
    diagonal: Vec<DMatrix<f64>>,
    /// The other blocks, pair by pair.
    coupling: Vec<DMatrix<f64>>,
    /// Whether it was arranged since it was cleared.
    arranged: bool,
}

impl BlockMatrix {
    /// Zeros, with room for the diagonal of a system of these blocks.
    pub fn new(blocks: &[Range<usize>]) -> Self {
        let diagonal = blocks.iter().map(|block| DMatrix::zeros(block.len(), block.len())).collect();
        Self { pattern: Pattern::uncoupled(), diagonal, coupling: Vec::new(), arranged: false }
    }

    /// Places blocks of zeros beside the diagonal where a pattern has pairs, those of before being gone; room is kept
    /// if the pattern is the same.
    ///
    /// # Panics
    /// If the pattern is one of another number of blocks.
    pub fn arrange(&mut self, pattern: &Pattern) {
        self.arranged = true;
        if self.pattern == *pattern {
            self.coupling.iter_mut().for_each(|block| block.fill(0.0));
            return;
        }
        assert!(pattern.fits(self.diagonal.len()), "the pattern is not one of {} blocks", self.diagonal.len());
        self.coupling.clear();
        let size = |block: usize| self.diagonal[block].nrows();
        let rows =
            (0..self.diagonal.len()).flat_map(|row| pattern.columns(row).iter().map(move |column| (row, *column)));
        self.coupling.extend(rows.map(|(row, column)| DMatrix::zeros(size(row), size(column))));
        self.pattern = pattern.clone();
    }

    /// Has the diagonal alone, unless it was arranged since it was cleared.
    pub fn settle(&mut self) {
        if !self.arranged {
            self.arrange(&Pattern::uncoupled());
        }
    }

    /// Where the matrix may have numbers.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// The blocks (i, i).
    pub fn diagonal(&self) -> &[DMatrix<f64>] {
        &self.diagonal
    }

    /// The blocks (i, i), to be written.
    pub fn diagonal_mut(&mut self) -> &mut [DMatrix<f64>] {
        &mut self.diagonal
    }

    /// Block (row, column); none where the pattern has none.
    pub fn block(&self, row: usize, column: usize) -> Option<&DMatrix<f64>> {
        if row == column {
            return self.diagonal.get(row);
        }
        self.pattern.place(row, column).map(|place| &self.coupling[place])
    }

    /// Block (row, column), to be written or added to; none where the pattern has none, or before it is arranged.
    pub fn block_mut(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>> {
        if row == column {
            return self.diagonal.get_mut(row);
        }
        let place = self.pattern.place(row, column).filter(|_| self.arranged);
        place.map(|place| &mut self.coupling[place])
    }

    /// The blocks of a row with their columns, the diagonal first, then ascending.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, &DMatrix<f64>)> {
        let others = self.pattern.columns(row).iter().copied().zip(&self.coupling[self.pattern.places(row)]);
        std::iter::once((row, &self.diagonal[row])).chain(others)
    }

    /// Sets the blocks of the diagonal to zero; those beside it wait for being arranged.
    pub fn clear(&mut self) {
        self.diagonal.iter_mut().for_each(|block| block.fill(0.0));
        self.arranged = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_added_to_in_any_order_where_the_pattern_has_them() {
        let mut matrix = BlockMatrix::new(&[0..2, 2..5, 5..6]);
        matrix.arrange(&Pattern::new(3, [(1, 0), (1, 2)]));
        for (row, column) in [(1, 2), (0, 0), (1, 0), (1, 2)] {
            matrix.block_mut(row, column).unwrap()[(0, 0)] += 1.0;
        }
        assert!(matrix.block_mut(0, 1).is_none() && matrix.block_mut(3, 3).is_none());
        let row: Vec<_> = matrix.row(1).map(|(column, block)| (column, block.shape(), block[(0, 0)])).collect();
        assert_eq!(row, [(1, (3, 3), 0.0), (0, (3, 2), 1.0), (2, (3, 1), 2.0)]);
        // Arranged alike, it has zeros beside the diagonal; cleared and not arranged, nothing.
        matrix.arrange(&Pattern::new(3, [(1, 2), (1, 0)]));
        assert_eq!(matrix.row(1).map(|(_, block)| block.amax()).collect::<Vec<_>>(), [0.0; 3]);
        matrix.clear();
        assert!(matrix.block_mut(1, 0).is_none());
        matrix.settle();
        assert_eq!((matrix.row(1).count(), matrix.diagonal()[0].amax()), (1, 0.0));
    }
}
