//! How much a coarser space of tractions would lose: the measure of what the space at hand still loses.
//!
//! The energy ⟨S⁺b, b⟩ of the best traction of a space grows with the space (Galerkin). Coarse nodes are a greedy
//! maximal set without neighbours; a node between them takes the mean of its coarse neighbours, weighted by their
//! nearness. With N of the one and n of the other the mesh is ρ = √(N/n) times finer, and for an error of order p in
//! its size
//!
//!   E − E_N = (E_N − E_n)/(ρ^p − 1) ≤ (E_N − E_n)/(ρ − 1)      p ≥ 1
//!
//! Tractions grow towards an edge as distance^(−α), α < ½ for any edge of a body, which gives p = 2(1 − α) > 1; on
//! smooth surfaces p is larger and the estimate generous.

use crate::dense::{Columns, SIDES, Symmetric};
use crate::surface::ClosedSurface;
use rayon::prelude::*;

/// A coarse space: for each node the coarse nodes that it follows, with weights of sum one.
pub(crate) struct CoarseSpace {
    follows: Vec<Vec<(usize, f64)>>,
    count: usize,
}

impl CoarseSpace {
    pub fn new(surface: &ClosedSurface) -> Self {
        let around = neighbours(surface);
        let mut names: Vec<Option<usize>> = vec![None; around.len()];
        let mut count = 0;
        for node in 0..around.len() {
            if around[node].iter().all(|&(other, _)| names[other].is_none()) {
                names[node] = Some(count);
                count += 1;
            }
        }
        let follows = |node: usize| match names[node] {
            Some(name) => vec![(name, 1.0)],
            None => {
                let near = around[node].iter().filter_map(|&(other, length)| Some((names[other]?, 1.0 / length)));
                let near: Vec<(usize, f64)> = near.collect();
                let sum: f64 = near.iter().map(|(_, weight)| weight).sum();
                near.into_iter().map(|(name, weight)| (name, weight / sum)).collect()
            }
        };
        Self { follows: (0..around.len()).map(follows).collect(), count }
    }

    /// Unknowns of the coarse space.
    pub fn order(&self) -> usize {
        3 * self.count
    }

    /// 1/(ρ − 1).
    pub fn factor(&self) -> f64 {
        let ratio = (self.follows.len() as f64 / self.count as f64).sqrt();
        1.0 / (ratio - 1.0)
    }

    /// Pᵀ S P.
    pub fn matrix(&self, fine: &Symmetric) -> Symmetric {
        let mut coarse = Symmetric::new(self.order());
        let mut followers = vec![Vec::new(); self.count];
        for (node, follows) in self.follows.iter().enumerate() {
            follows.iter().for_each(|&(name, weight)| followers[name].push((node, weight)));
        }
        let stride = coarse.stride;
        let rows = coarse.values.par_chunks_mut(3 * stride).zip(&followers);
        rows.for_each(|(rows, followers)| {
            for (a, row) in rows.chunks_mut(stride).enumerate() {
                let mut gathered = vec![0.0; fine.order];
                for (node, weight) in followers {
                    let from = &fine.values[(3 * node + a) * fine.stride..][..fine.order];
                    gathered.iter_mut().zip(from).for_each(|(sum, value)| *sum += weight * value);
                }
                for (values, follows) in gathered.as_chunks::<3>().0.iter().zip(&self.follows) {
                    for (name, weight) in follows {
                        (0..3).for_each(|b| row[3 * name + b] += weight * values[b]);
                    }
                }
            }
        });
        coarse
    }

    /// Pᵀ B.
    pub fn sides(&self, fine: &Columns) -> Columns {
        let mut coarse = vec![[0.0; SIDES]; self.order()];
        for (node, follows) in self.follows.iter().enumerate() {
            for (name, weight) in follows {
                for a in 0..3 {
                    let sums = coarse[3 * name + a].iter_mut().zip(&fine[3 * node + a]);
                    sums.for_each(|(sum, value)| *sum += weight * value);
                }
            }
        }
        coarse
    }
}

/// The nodes around each node in the order of the triangles, and how far they are.
fn neighbours(surface: &ClosedSurface) -> Vec<Vec<(usize, f64)>> {
    let mut around: Vec<Vec<(usize, f64)>> = vec![Vec::new(); surface.node_count];
    for (nodes, corners) in surface.nodes.iter().zip(&surface.triangles) {
        for k in 0..3 {
            for l in [(k + 1) % 3, (k + 2) % 3] {
                if around[nodes[k]].iter().all(|&(other, _)| other != nodes[l]) {
                    let length = (surface.points[corners[k]] - surface.points[corners[l]]).norm();
                    around[nodes[k]].push((nodes[l], length));
                }
            }
        }
    }
    around
}
