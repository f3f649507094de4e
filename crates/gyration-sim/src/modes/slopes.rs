//! The Jacobian of the rates of a system, block by block: those by the images of bodies in other cells apart.

use gyration::dynamics::Blocks;
use gyration::lattice::{Cell, HERE};
use nalgebra::DMatrix;
use std::collections::BTreeMap;
use std::ops::Range;

/// The blocks that are not zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SystemSlopes {
    sizes: Vec<usize>,
    blocks: BTreeMap<(Cell, usize, usize), DMatrix<f64>>,
}

impl SystemSlopes {
    /// Zeros, for bodies whose numbers stand there.
    pub fn new(ranges: &[Range<usize>]) -> Self {
        Self { sizes: ranges.iter().map(Range::len).collect(), blocks: BTreeMap::new() }
    }

    /// All blocks, each with the indices of its two bodies and the cell of the second as seen from the first: the rates
    /// of the first by the numbers of the second.
    pub fn iter(&self) -> impl Iterator<Item = ([usize; 2], Cell, &DMatrix<f64>)> {
        self.blocks.iter().map(|((cell, row, column), block)| ([*row, *column], *cell, block))
    }

    /// The cells of which there are blocks, ascending.
    pub fn cells(&self) -> Vec<Cell> {
        let mut cells: Vec<Cell> = self.blocks.keys().map(|(cell, ..)| *cell).collect();
        cells.dedup();
        cells
    }

    /// The blocks by bodies of one cell.
    #[must_use]
    pub fn of_cell(&self, cell: Cell) -> Self {
        let of = self.blocks.iter().filter(|((own, ..), _)| *own == cell);
        Self { sizes: self.sizes.clone(), blocks: of.map(|(key, block)| (*key, block.clone())).collect() }
    }
}

impl Blocks for SystemSlopes {
    fn block(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>> {
        self.image_block(row, column, HERE)
    }

    fn image_block(&mut self, row: usize, column: usize, cell: Cell) -> Option<&mut DMatrix<f64>> {
        let Self { sizes, blocks } = self;
        Some(blocks.entry((cell, row, column)).or_insert_with(|| DMatrix::zeros(sizes[row], sizes[column])))
    }
}
