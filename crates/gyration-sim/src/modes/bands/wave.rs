//! A wave: a root λ and a shape, and what is known of it besides.

use super::by_cell::{C64, MatricesByCell};
use super::doubt::MatrixDoubt;
use gyration::tensor::Vec3;
use nalgebra::DVector;

/// A root and its shape.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wave {
    /// λ [1/s].
    pub root: C64,
    /// ξ, of length one; zero where the root has none.
    pub shape: DVector<C64>,
    /// −Im ∂λ/∂k [m/s], the group velocity; none where the frequency has no derivative.
    pub velocity: Option<Vec3>,
    /// ∂ω by each number asked for [rad/s], ascending among waves of one root; none where ω has no derivative.
    pub changes: Vec<Option<f64>>,
    /// By how much ω may be off [rad/s]; none where that was not asked for, or is not known.
    pub bound: Option<f64>,
}

/// What is asked of waves besides.
#[derive(Debug, Default)]
pub(super) struct Asked<'a> {
    /// How numbers change the matrices.
    pub changes: Vec<&'a MatricesByCell>,
    /// How far the matrices may be off.
    pub doubt: Option<&'a MatrixDoubt>,
}

/// The iteration for the roots did not end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NoRoots;

/// ∂ω of changes ∂λ of a root, ascending.
pub(super) fn ascending(root: C64, changes: &[C64]) -> Option<Vec<f64>> {
    let mut changes: Vec<f64> = changes.iter().map(|change| change.im * f64::signum(root.im)).collect();
    changes.sort_by(f64::total_cmp);
    changes.iter().all(|change| change.is_finite()).then_some(changes)
}

/// Which place each of some roots has, ascending in frequency.
pub(super) fn ranks(roots: &[C64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..roots.len()).collect();
    order.sort_by(|a, b| roots[*a].im.abs().total_cmp(&roots[*b].im.abs()).then(roots[*b].re.total_cmp(&roots[*a].re)));
    let mut ranks = vec![0; roots.len()];
    order.iter().enumerate().for_each(|(rank, root)| ranks[*root] = rank);
    ranks
}
