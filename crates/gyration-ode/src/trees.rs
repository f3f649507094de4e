//! Rooted trees and the order conditions of Runge–Kutta methods, for the tests of the tableaux.
//!
//!   Σ_i b_i(θ) Φ_i(τ) = θ^|τ| / γ(τ)   for every tree τ of at most p nodes
//!
//! Φ_i(•) = 1, Φ_i([τ₁ … τ_m]) = Π_k Σ_j a_ij Φ_j(τ_k); γ(•) = 1, γ([τ₁ … τ_m]) = |τ| Π_k γ(τ_k). Source: Hairer,
//! Nørsett, Wanner I, §II.2.

/// A rooted tree: its subtrees, in a fixed order.
#[derive(Debug, Clone)]
pub(crate) struct RootedTree(Vec<RootedTree>);

impl RootedTree {
    /// All trees with so many nodes, each once.
    pub fn of_order(order: usize) -> Vec<RootedTree> {
        let mut known: Vec<Vec<RootedTree>> = vec![vec![]];
        for nodes in 1..=order {
            let forests = forests(&known, nodes - 1, nodes - 1, usize::MAX);
            known.push(forests.into_iter().map(RootedTree).collect());
        }
        known.swap_remove(order)
    }

    fn nodes(&self) -> usize {
        1 + self.0.iter().map(RootedTree::nodes).sum::<usize>()
    }

    fn density(&self) -> f64 {
        self.nodes() as f64 * self.0.iter().map(RootedTree::density).product::<f64>()
    }

    fn elementary_weights(&self, rows: &[Vec<f64>]) -> Vec<f64> {
        let mut weights = vec![1.0; rows.len()];
        for subtree in &self.0 {
            let inner = subtree.elementary_weights(rows);
            for (weight, row) in weights.iter_mut().zip(rows) {
                *weight *= row.iter().zip(&inner).map(|(a, phi)| a * phi).sum::<f64>();
            }
        }
        weights
    }
}

/// Multisets of trees with `nodes` nodes together, whose first tree does not come after (`largest`, `index`).
fn forests(known: &[Vec<RootedTree>], nodes: usize, largest: usize, index: usize) -> Vec<Vec<RootedTree>> {
    if nodes == 0 {
        return vec![vec![]];
    }
    let mut all = Vec::new();
    for size in 1..=largest.min(nodes) {
        for (position, tree) in known[size].iter().enumerate() {
            if size == largest && position > index {
                break;
            }
            for mut rest in forests(known, nodes - size, size, position) {
                rest.push(tree.clone());
                all.push(rest);
            }
        }
    }
    all
}

/// Σ_i b_i Φ_i(τ) − θ^|τ| / γ(τ); `rows` may be ragged, missing entries being zero.
pub(crate) fn residual(tree: &RootedTree, rows: &[Vec<f64>], weights: &[f64], theta: f64) -> f64 {
    let phi = tree.elementary_weights(rows);
    let sum: f64 = weights.iter().zip(&phi).map(|(b, phi)| b * phi).sum();
    sum - theta.powi(tree.nodes() as i32) / tree.density()
}

#[test]
fn trees_are_counted_right() {
    let counts: Vec<usize> = (1..=8).map(|order| RootedTree::of_order(order).len()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
}
