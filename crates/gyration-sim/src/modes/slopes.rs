//! The Jacobian of the rates of a system, block by block.

use gyration::dynamics::Blocks;
use nalgebra::DMatrix;
use std::collections::BTreeMap;
use std::ops::Range;

/// The blocks that are not zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SystemSlopes {
    sizes: Vec<usize>,
    blocks: BTreeMap<(usize, usize), DMatrix<f64>>,
}

impl SystemSlopes {
    /// Zeros, for bodies whose numbers stand there.
    pub fn new(ranges: &[Range<usize>]) -> Self {
        Self { sizes: ranges.iter().map(Range::len).collect(), blocks: BTreeMap::new() }
    }

    /// All blocks, each with the indices of its two bodies: the rates of the first by the numbers of the second.
    pub fn iter(&self) -> impl Iterator<Item = ([usize; 2], &DMatrix<f64>)> {
        self.blocks.iter().map(|((row, column), block)| ([*row, *column], block))
    }
}

impl Blocks for SystemSlopes {
    fn block(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>> {
        let Self { sizes, blocks } = self;
        Some(blocks.entry((row, column)).or_insert_with(|| DMatrix::zeros(sizes[row], sizes[column])))
    }
}
