//! Sets of bodies whose equations are solved apart: each that acts on no other.

use gyration_ode::{BlockMatrix, Components};
use nalgebra::DMatrix;
use std::ops::Range;

/// The places of the numbers of each set of blocks that hang together.
pub(super) fn apart(components: &Components, blocks: &[Range<usize>]) -> Vec<Vec<usize>> {
    let places = |members: &[usize]| members.iter().flat_map(|block| blocks[*block].clone()).collect();
    components.iter().map(places).collect()
}

/// The matrix of each of these sets.
pub(super) fn together(slopes: &BlockMatrix, components: &Components, blocks: &[Range<usize>]) -> Vec<DMatrix<f64>> {
    let matrix = |members: &[usize]| {
        let mut starts = vec![0; blocks.len()];
        let size = members.iter().fold(0, |start, block| {
            starts[*block] = start;
            start + blocks[*block].len()
        });
        let mut matrix = DMatrix::zeros(size, size);
        for row in members {
            for (column, part) in slopes.row(*row) {
                matrix.view_mut((starts[*row], starts[column]), part.shape()).copy_from(part);
            }
        }
        matrix
    };
    components.iter().map(matrix).collect()
}
