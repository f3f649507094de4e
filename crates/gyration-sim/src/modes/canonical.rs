//! A basis of the stiffness in which modes that have a name stand alone.
//!
//!   sym K = Σ k_i v_i⊗v_i
//!
//! Where several k_i are one number, as the five of a sphere, or all that are zero, any basis of their space would do.
//! Here it is made of the projections of motions that have a name, the one that lies in the space most first.

use nalgebra::{DMatrix, DVector};

/// Values nearer to each other than this part of them are one number: their vectors are not told apart better by
/// rounding.
const SAME: f64 = 1e-8;
/// Values below this part of the largest one are zero, to the rounding of the Jacobian: frequencies below 1e-6 of the
/// highest one.
pub(super) const NEUTRAL: f64 = 1e-12;
/// A pattern is taken before a later one if it lies in the space this much less.
const TIE: f64 = 1e-6;

/// Vectors v_i and values k_i, ascending.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Basis {
    /// The v_i as columns.
    pub vectors: DMatrix<f64>,
    /// The k_i [1/s²].
    pub values: Vec<f64>,
    /// The largest |k_i| that counts as zero.
    pub zero: f64,
}

/// Of a symmetric matrix, or the symmetric part of any.
pub(super) fn eigen(matrix: &DMatrix<f64>) -> Basis {
    if matrix.is_empty() {
        return Basis { vectors: DMatrix::zeros(0, 0), values: Vec::new(), zero: 0.0 };
    }
    let eigen = (0.5 * (matrix + matrix.transpose())).symmetric_eigen();
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let columns: Vec<DVector<f64>> = order.iter().map(|k| eigen.eigenvectors.column(*k).into_owned()).collect();
    let values: Vec<f64> = order.iter().map(|k| eigen.eigenvalues[*k]).collect();
    let zero = NEUTRAL * values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    Basis { vectors: DMatrix::from_columns(&columns), values, zero }
}

/// The basis of a stiffness, with patterns where there is a choice.
pub(super) fn basis(stiffness: &DMatrix<f64>, patterns: &[DVector<f64>]) -> Basis {
    let mut basis = eigen(stiffness);
    let mut from = 0;
    while from < basis.values.len() {
        let first = basis.values[from];
        let same = |value: f64| {
            let both_zero = value.abs() <= basis.zero && first.abs() <= basis.zero;
            both_zero || (value - first).abs() <= SAME * value.abs().max(first.abs())
        };
        let count = basis.values[from..].iter().take_while(|value| same(**value)).count();
        if count > 1 {
            let space = basis.vectors.columns(from, count).into_owned();
            basis.vectors.columns_mut(from, count).copy_from(&aligned(&space, patterns));
        }
        from += count;
    }
    basis
}

fn unit(size: usize, axis: usize) -> DVector<f64> {
    DVector::from_fn(size, |k, _| f64::from(u8::from(k == axis)))
}

/// An orthonormal basis of a space, from the patterns' projections on it.
fn aligned(space: &DMatrix<f64>, patterns: &[DVector<f64>]) -> DMatrix<f64> {
    let mut left: Vec<DVector<f64>> = patterns.iter().map(|pattern| space.transpose() * pattern).collect();
    let mut chosen: Vec<DVector<f64>> = Vec::new();
    // What no pattern reaches is filled with the space's own vectors.
    left.extend((0..space.ncols()).map(|k| 1e-3 * unit(space.ncols(), k)));
    while chosen.len() < space.ncols() {
        let most = left.iter().map(|part| part.norm()).fold(0.0, f64::max);
        let Some(best) = left.iter().position(|part| part.norm() >= (1.0 - TIE) * most) else { break };
        let mut direction = left[best].normalize();
        // Once more, since what is left of a pattern may be small.
        for other in &chosen {
            direction -= other * other.dot(&direction);
        }
        direction.normalize_mut();
        for part in &mut left {
            let along = direction.dot(part);
            *part -= along * &direction;
        }
        chosen.push(direction);
    }
    space * DMatrix::from_columns(&chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn basis_of_a_space_is_made_of_patterns() {
        // One value for the first three directions: the patterns e₂ and e₁ + e₃ lie in it, e₄ does not.
        let turn = nalgebra::Rotation3::from_euler_angles(0.4, 1.0, -0.3).into_inner();
        let mut mix = DMatrix::identity(4, 4);
        mix.view_mut((0, 0), (3, 3)).copy_from(&turn);
        let stiffness = &mix * DMatrix::from_diagonal(&DVector::from_vec(vec![3.0, 3.0, 3.0, 5.0])) * mix.transpose();
        let unit = |k: usize| unit(4, k);
        let basis = basis(&stiffness, &[unit(3), unit(1), (unit(0) + unit(2)) / 2.0_f64.sqrt()]);
        let close = |k: usize, expected: &DVector<f64>| {
            let off = 1.0 - basis.vectors.column(k).dot(expected).abs();
            assert!(off.abs() < 1e-14, "{k}: {off:e}");
        };
        close(0, &unit(1));
        close(1, &((unit(0) + unit(2)) / 2.0_f64.sqrt()));
        close(2, &((unit(0) - unit(2)) / 2.0_f64.sqrt()));
        close(3, &unit(3));
        let gram = basis.vectors.transpose() * &basis.vectors;
        assert!((gram - DMatrix::identity(4, 4)).norm() < 1e-14);
    }
}
