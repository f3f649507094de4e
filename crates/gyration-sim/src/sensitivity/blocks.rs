//! Blocks of a state whose equations are solved apart.

use gyration_ode::{BlockMatrix, Pattern};
use nalgebra::DMatrix;
use std::ops::Range;

/// The blocks whose equations are solved apart: all bodies together where some act on others.
pub(super) fn apart(blocks: &[Range<usize>], pattern: &Pattern) -> Vec<Range<usize>> {
    let whole = 0..blocks.last().map_or(0, |block| block.end);
    if pattern.is_uncoupled() { blocks.to_vec() } else { std::iter::once(whole).collect() }
}

/// The matrices of these blocks.
pub(super) fn together(slopes: BlockMatrix, blocks: &[Range<usize>]) -> Vec<DMatrix<f64>> {
    if slopes.pattern().is_uncoupled() {
        return slopes.diagonal().to_vec();
    }
    let n = blocks.last().map_or(0, |block| block.end);
    let mut whole = DMatrix::zeros(n, n);
    for (row, rows) in blocks.iter().enumerate() {
        for (column, part) in slopes.row(row) {
            whole.view_mut((rows.start, blocks[column].start), part.shape()).copy_from(part);
        }
    }
    vec![whole]
}
