//! The numbers of Radau IIA with s stages, order 2s − 1, L-stable and stiffly accurate.
//!
//!   Y_i = u₀ + h Σ_j a_ij f(t₀ + c_j h, Y_j),   u₁ = Y_s
//!
//! A⁻¹ has one real eigenvalue γ and (s − 1)/2 pairs α ± iβ; with the columns of T,
//!
//!   T⁻¹ A⁻¹ T = ⎡γ 0  0 …⎤
//!               ⎢0 α −β …⎥
//!               ⎢0 β  α …⎥
//!               ⎣…      …⎦ .
//!
//! An error estimate of order s needs the rate at the start besides: (h/γ) (f(u₀) + Σ e_i z_i/h), z_i = Y_i − u₀.
//!
//! Source: Hairer, Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., table IV.5.6 and §IV.8; the same, *J.
//! Comput. Appl. Math.* 111 (1999) 93, for more stages. The tests check orders, eigenvalues and transformation rather
//! than trust the digits.

mod tables;

use crate::report::ImplicitOrder;
pub(crate) use tables::{FIVE, NINE, THIRTEEN};

/// The most stages.
pub(crate) const MOST_STAGES: usize = 7;

/// The numbers of one method; matrices row by row.
#[derive(Debug)]
pub(crate) struct Radau {
    /// The nodes c, the last of them 1.
    pub nodes: &'static [f64],
    /// The matrix A; its last row are the weights.
    pub matrix: &'static [f64],
    /// γ.
    pub real: f64,
    /// α and β of the pairs, from the smallest β on.
    pub complex: &'static [(f64, f64)],
    /// T.
    pub transform: &'static [f64],
    /// T⁻¹.
    pub inverse: &'static [f64],
    /// e.
    pub error: &'static [f64],
}

impl Radau {
    /// The method of an order.
    pub fn of(order: ImplicitOrder) -> &'static Self {
        match order {
            ImplicitOrder::Five => &FIVE,
            ImplicitOrder::Nine => &NINE,
            ImplicitOrder::Thirteen => &THIRTEEN,
        }
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        self.nodes.len()
    }

    /// How the error of a step falls with its size: one more than the order of the estimate.
    pub fn error_exponent(&self) -> f64 {
        (self.stages() + 1) as f64
    }

    /// Newton iterations after which a shorter step is cheaper. Source: radau.f.
    pub fn most_iterations(&self) -> u32 {
        (7 + 5 * (self.stages() - 3) / 2) as u32
    }

    /// The weights of the z_i in the collocation polynomial at θ = (t − t₀)/h; that of 0 at θ = 0 is not needed.
    pub fn basis(&self, theta: f64) -> [f64; MOST_STAGES] {
        let mut weights = [0.0; MOST_STAGES];
        for (i, (weight, own)) in weights.iter_mut().zip(self.nodes).enumerate() {
            let (mut value, mut there) = (theta, *own);
            for (_, other) in self.nodes.iter().enumerate().filter(|(k, _)| *k != i) {
                value *= theta - other;
                there *= own - other;
            }
            *weight = value / there;
        }
        weights
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trees::{RootedTree, residual};
    use nalgebra::DMatrix;

    const ALL: [&Radau; 3] = [&FIVE, &NINE, &THIRTEEN];

    fn matrix(method: &Radau, rows: &[f64]) -> DMatrix<f64> {
        DMatrix::from_row_slice(method.stages(), method.stages(), rows)
    }

    #[test]
    fn transformation_block_diagonalizes_the_inverse() {
        for method in ALL {
            let s = method.stages();
            let mut blocks = DMatrix::zeros(s, s);
            blocks[(0, 0)] = method.real;
            for (k, (alpha, beta)) in method.complex.iter().enumerate() {
                let at = 2 * k + 1;
                (blocks[(at, at)], blocks[(at + 1, at + 1)]) = (*alpha, *alpha);
                (blocks[(at, at + 1)], blocks[(at + 1, at)]) = (-beta, *beta);
            }
            let (t, t_inverse) = (matrix(method, method.transform), matrix(method, method.inverse));
            // A few roundings of the largest entries, which are 4, 33 and 299.
            let rounding = 4.0 * s as f64 * f64::EPSILON * t_inverse.amax();
            assert!((&t * &t_inverse - DMatrix::identity(s, s)).amax() < rounding);
            assert!(
                (matrix(method, method.matrix) * t * blocks * t_inverse - DMatrix::identity(s, s)).amax() < rounding
            );
        }
    }

    #[test]
    fn eigenvalues_of_three_stages_are_the_closed_forms() {
        let (c, s) = (3.0_f64.cbrt(), 9.0_f64.cbrt());
        let (alpha, beta) = FIVE.complex[0];
        assert!((FIVE.real - (3.0 + s - c)).abs() < 1e-15);
        assert!((alpha - (3.0 + 0.5 * (c - s))).abs() < 1e-15);
        assert!((beta - 0.5 * (3.0_f64.powf(5.0 / 6.0) + 3.0_f64.powf(7.0 / 6.0))).abs() < 2e-15);
    }

    #[test]
    fn every_tree_up_to_order_five_satisfies_its_condition() {
        let rows: Vec<Vec<f64>> = FIVE.matrix.chunks(3).map(<[f64]>::to_vec).collect();
        let worst = |order| -> f64 {
            RootedTree::of_order(order)
                .iter()
                .map(|tree| residual(tree, &rows, &rows[2], 1.0).abs())
                .fold(0.0, f64::max)
        };
        assert!((1..=5).all(|order| worst(order) < 1e-15));
        assert!(worst(6) > 1e-4, "order 6 must not hold");
    }

    /// Σ_j a_ij c_j^(k−1) = c_i^k/k for k ≤ s and Σ b_i c_i^(k−1) = 1/k for k ≤ 2s − 1: order 2s − 1 (Butcher).
    #[test]
    fn simplifying_assumptions_hold_and_no_more() {
        for method in ALL {
            let (s, nodes) = (method.stages(), method.nodes);
            let defect = |row: &[f64], end: f64, k: usize| {
                let sum: f64 = row.iter().zip(nodes).map(|(a, c)| a * c.powi(k as i32 - 1)).sum();
                (sum - end.powi(k as i32) / k as f64).abs()
            };
            let rows = || method.matrix.chunks(s).zip(nodes);
            assert!(rows().all(|(row, end)| (1..=s).all(|k| defect(row, *end, k) < 1e-15)));
            let weights = &method.matrix[s * (s - 1)..];
            assert!((1..2 * s).all(|k| defect(weights, 1.0, k) < 1e-15));
            // What is left over is the square of the norm of a shifted polynomial: 5.6e-4, 1.6e-6 and 4.3e-9.
            assert!(defect(weights, 1.0, 2 * s) > 1e-9);
        }
    }

    /// The embedded solution b̂ = b + (1/γ)(e₀, eᵀA) integrates powers up to s − 1 and no more, on stages of order s.
    #[test]
    fn error_estimate_has_the_order_of_the_stages() {
        for method in ALL {
            let s = method.stages();
            let weight = |j: usize| {
                let through: f64 = (0..s).map(|i| method.error[i] * method.matrix[s * i + j]).sum();
                method.matrix[s * (s - 1) + j] + through / method.real
            };
            let defect = |k: usize| {
                let start = if k == 1 { 1.0 / method.real } else { 0.0 };
                let sum: f64 = (0..s).map(|j| weight(j) * method.nodes[j].powi(k as i32 - 1)).sum();
                (start + sum - 1.0 / k as f64).abs()
            };
            // Entries of e up to 54.
            assert!((1..=s).all(|k| defect(k) < 2e-15));
            assert!(defect(s + 1) > 1e-6, "{:e}", defect(s + 1));
        }
    }

    #[test]
    fn polynomials_through_the_stages_are_themselves() {
        for method in ALL {
            let s = method.stages() as i32;
            for theta in [0.1, 0.5, 0.9, 1.7] {
                let basis = method.basis(theta);
                let sum: f64 = method.nodes.iter().zip(basis).map(|(c, weight)| weight * c.powi(s)).sum();
                // Weights of alternating sign: up to 1e4 for seven stages outside the step.
                assert!((sum - f64::powi(theta, s)).abs() < 1e-12 * f64::powi(theta, s).max(1.0));
            }
        }
    }
}
