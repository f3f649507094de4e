//! The numbers of Radau IIA with three stages, order 5, L-stable and stiffly accurate.
//!
//!   Y_i = u₀ + h Σ_j a_ij f(t₀ + c_j h, Y_j),   u₁ = Y₃
//!
//! A⁻¹ has one real eigenvalue γ and a pair α ± iβ; with the columns of T,
//!
//!   T⁻¹ A⁻¹ T = ⎡γ 0  0⎤
//!               ⎢0 α −β⎥
//!               ⎣0 β  α⎦ .
//!
//! Source: Hairer, Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., table IV.5.6 and §IV.8. The tests
//! below check order, eigenvalues and transformation rather than trust the printed digits.

/// √6.
const ROOT: f64 = 2.449489742783178;

/// The nodes c.
pub(crate) const NODES: [f64; 3] = [(4.0 - ROOT) / 10.0, (4.0 + ROOT) / 10.0, 1.0];

/// The matrix A; its last row are the weights.
pub(crate) const MATRIX: [[f64; 3]; 3] = [
    [(88.0 - 7.0 * ROOT) / 360.0, (296.0 - 169.0 * ROOT) / 1800.0, (-2.0 + 3.0 * ROOT) / 225.0],
    [(296.0 + 169.0 * ROOT) / 1800.0, (88.0 + 7.0 * ROOT) / 360.0, (-2.0 - 3.0 * ROOT) / 225.0],
    [(16.0 - ROOT) / 36.0, (16.0 + ROOT) / 36.0, 1.0 / 9.0],
];

/// γ = 3 + ∛9 − ∛3, the real eigenvalue of A⁻¹.
pub(crate) const REAL: f64 = 3.637834252744496;

/// α and β of the complex pair of A⁻¹: 3 + (∛3 − ∛9)/2 and (3^⅚ + 3^⁷⁄₆)/2.
pub(crate) const COMPLEX: (f64, f64) = (2.681082873627752, 3.05043019924741);

/// T.
pub(crate) const TRANSFORM: [[f64; 3]; 3] = [
    [0.09123239487089295, -0.1412552950209542, -0.030029194105147424],
    [0.241717932707107, 0.20412935229379994, 0.3829421127572619],
    [0.966048182615093, 1.0, 0.0],
];

/// T⁻¹.
pub(crate) const INVERSE: [[f64; 3]; 3] = [
    [4.325579890063155, 0.33919925181580987, 0.5417705399358749],
    [-4.178718591551905, -0.3276828207610624, 0.4766235545005504],
    [-0.502872634945787, 2.571926949855605, -0.5960392048282249],
];

/// e of the error estimate (h/γ) (f(u₀) + Σ e_i z_i/h), where z_i = Y_i − u₀; of order 3.
pub(crate) const ERROR: [f64; 3] = [-(13.0 + 7.0 * ROOT) / 3.0, (-13.0 + 7.0 * ROOT) / 3.0, -1.0 / 3.0];

/// The weights of z₁, z₂, z₃ in the collocation polynomial at θ = (t − t₀)/h; that of 0 at θ = 0 is not needed.
pub(crate) fn basis(theta: f64) -> [f64; 3] {
    let [a, b, _] = NODES;
    [
        theta * (theta - b) * (theta - 1.0) / (a * (a - b) * (a - 1.0)),
        theta * (theta - a) * (theta - 1.0) / (b * (b - a) * (b - 1.0)),
        theta * (theta - a) * (theta - b) / ((1.0 - a) * (1.0 - b)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trees::{RootedTree, residual};
    use nalgebra::Matrix3;

    fn matrix(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| rows[i][j])
    }

    #[test]
    fn transformation_block_diagonalizes_the_inverse() {
        let (alpha, beta) = COMPLEX;
        let blocks = Matrix3::new(REAL, 0.0, 0.0, 0.0, alpha, -beta, 0.0, beta, alpha);
        let (t, t_inverse) = (matrix(TRANSFORM), matrix(INVERSE));
        // Entries of size 10 and a few roundings each.
        assert!((t * t_inverse - Matrix3::identity()).amax() < 1e-14);
        assert!((matrix(MATRIX) * t * blocks * t_inverse - Matrix3::identity()).amax() < 2e-14);
    }

    #[test]
    fn eigenvalues_are_the_closed_forms() {
        let (c, s) = (3.0_f64.cbrt(), 9.0_f64.cbrt());
        assert!((REAL - (3.0 + s - c)).abs() < 1e-15);
        assert!((COMPLEX.0 - (3.0 + 0.5 * (c - s))).abs() < 1e-15);
        assert!((COMPLEX.1 - 0.5 * (3.0_f64.powf(5.0 / 6.0) + 3.0_f64.powf(7.0 / 6.0))).abs() < 2e-15);
    }

    #[test]
    fn every_tree_up_to_order_five_satisfies_its_condition() {
        let rows: Vec<Vec<f64>> = MATRIX.iter().map(|row| row.to_vec()).collect();
        for order in 1..=5 {
            for tree in RootedTree::of_order(order) {
                assert!(residual(&tree, &rows, &MATRIX[2], 1.0).abs() < 1e-15, "order {order}");
            }
        }
        let worst = |order| -> f64 {
            RootedTree::of_order(order)
                .iter()
                .map(|tree| residual(tree, &rows, &MATRIX[2], 1.0).abs())
                .fold(0.0, f64::max)
        };
        assert!(worst(6) > 1e-4, "order 6 must not hold");
    }

    /// The embedded solution b̂ = b + (1/γ)(e₀, eᵀA) has order 3 and no more.
    #[test]
    fn error_estimate_has_order_three() {
        let mut rows = vec![vec![0.0; 4]];
        rows.extend(MATRIX.iter().map(|row| [&[0.0], row.as_slice()].concat()));
        let mut weights = vec![1.0 / REAL];
        weights.extend((0..3).map(|j| MATRIX[2][j] + (0..3).map(|i| ERROR[i] * MATRIX[i][j]).sum::<f64>() / REAL));
        let worst = |order| -> f64 {
            RootedTree::of_order(order)
                .iter()
                .map(|tree| residual(tree, &rows, &weights, 1.0).abs())
                .fold(0.0, f64::max)
        };
        assert!(worst(1).max(worst(2)).max(worst(3)) < 1e-15);
        assert!(worst(4) > 1e-3);
    }
}
