//! The share that an uncertain part may have of a resistance, for the motion where it is largest.
//!
//!   max over x of |x·D x| / x·H x = largest |eigenvalue| of C⁻¹ D C⁻ᵀ,  H = C Cᵀ
//!
//! The share depends neither on units nor on the centre of the motions.

use crate::error::StokesError;
use crate::motion::Mat12;

/// The sum of the largest shares of some parts in H.
///
/// # Errors
/// A motion that H does not resist.
pub(crate) fn largest_share(matrix: &Mat12, parts: &[Mat12]) -> Result<f64, StokesError> {
    // Rows of velocities and of gradients differ by a length squared.
    let scale = matrix.diagonal().map(|entry| 1.0 / entry.abs().sqrt());
    let scaled = |m: &Mat12| Mat12::from_fn(|i, j| m[(i, j)] * scale[i] * scale[j]);
    if let Some(motion) = (0..12).find(|&k| matrix[(k, k)].is_nan() || matrix[(k, k)] <= 0.0) {
        return Err(StokesError::TooCoarse { motion });
    }
    let h = scaled(matrix);
    let Some(factor) = h.cholesky() else {
        let (motion, _) = h.symmetric_eigen().eigenvectors.column(0).argmax();
        return Err(StokesError::TooCoarse { motion });
    };
    let lower = factor.l();
    let share = |part: &Mat12| {
        let half = lower.solve_lower_triangular(&scaled(part)).unwrap_or_default();
        let whole = lower.solve_lower_triangular(&half.transpose()).unwrap_or_default();
        whole.symmetric_eigenvalues().amax()
    };
    Ok(parts.iter().map(share).sum())
}
