//! Multipliers: eigenvalues of what a period makes of neighbours.

use super::SWEEPS;
use nalgebra::{Complex, DMatrix, Schur};

/// The eigenvalues of a matrix; none of an iteration that does not end.
///
/// It may not where several lie evenly on a circle, as of cells that change places: of a matrix with a multiple of one
/// added they do not lie about zero.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    [0.0, 0.37, 1.7].into_iter().find_map(|part| {
        let added = part * matrix.amax();
        let shifted = matrix + DMatrix::from_diagonal_element(matrix.nrows(), matrix.ncols(), added);
        let found = Schur::try_new(shifted, f64::EPSILON, SWEEPS)?.complex_eigenvalues();
        Some(found.iter().map(|value| value - added).collect())
    })
}
