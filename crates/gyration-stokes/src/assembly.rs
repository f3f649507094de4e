//! The matrix of the single layer and what the expanding body needs beside it, from all pairs of triangles.
//!
//!   S_iajb = (1/8π) ∫∫ φ_i G_ab φ_j dA dA,      e_ia = ∫ φ_i v_a dA,   v = (1/4π) ∮ n/r dA
//!
//! tr G = 4/r, so that ∫∫ φ_i/r is a quarter of the trace of a block summed over j, and e costs nothing. Each pair is
//! computed once; matrix and mirror image are added at the end. Triangles are taken in batches: the threads make one
//! strip of nine rows for each triangle, then add the strips to the rows of each node, in the order of the triangles.
//! No sum depends on the number of threads.

use crate::dense::Symmetric;
use crate::error::StokesError;
use crate::pair::{Block, block};
use crate::panel::FlatPanel;
use crate::vector::Vec3;
use crate::wall::{Image, WallImages};
use gyration_threads::Interruption;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Bytes of the strips of a batch.
const BATCH_BYTES: usize = 16 << 20;

/// The single layer in the space of piecewise linear tractions.
#[derive(Debug)]
pub(crate) struct SingleLayer {
    /// Half of the matrix: S = half + halfᵀ.
    pub half: Symmetric,
    /// e, by unknown.
    pub expansion: Vec<f64>,
    /// Π, the work of the wall's pressure on a body that expands ([`crate::wall`]); 0 without a wall.
    pub pressure: f64,
}

/// Nine rows of the matrix, from one triangle and those that follow it.
struct RowStrip {
    rows: Vec<f64>,
    /// Its share of e, at all nodes.
    expansion: Vec<f64>,
    /// Its share of Π.
    pressure: f64,
}

impl SingleLayer {
    /// Of all pairs of these triangles, `nodes` nodes in all.
    ///
    /// # Errors
    /// [`StokesError::Interrupted`].
    pub fn new(panels: &[FlatPanel], nodes: usize, wall: Option<&WallImages>) -> Result<Self, StokesError> {
        let interruption = Interruption::in_force();
        let order = 3 * nodes;
        let mut half = Symmetric::new(order);
        let (mut expansion, mut pressure) = (vec![0.0; order], 0.0);
        let stride = half.stride;
        let batch = (BATCH_BYTES / (80 * order)).clamp(16, 256);
        for (round, these) in panels.chunks(batch).enumerate() {
            let first = round * batch;
            let make = |k: usize| match interruption.is_due() {
                Some(_) => Err(StokesError::Interrupted),
                None => Ok(RowStrip::new(panels, first + k, order, wall)),
            };
            let strips = (0..these.len()).into_par_iter().map(make).collect::<Result<Vec<RowStrip>, _>>()?;
            let corners = corners_by_node(these, nodes);
            let rows = half.values.par_chunks_mut(3 * stride).zip(&corners).filter(|(_, corners)| !corners.is_empty());
            rows.for_each(|(rows, corners)| {
                for &(triangle, corner) in corners {
                    let strip = &strips[triangle].rows[3 * corner * order..][..3 * order];
                    for (row, strip) in rows.chunks_mut(stride).zip(strip.chunks(order)) {
                        row.iter_mut().zip(strip).for_each(|(sum, value)| *sum += value);
                    }
                }
            });
            for strip in &strips {
                pressure += strip.pressure;
                expansion.iter_mut().zip(&strip.expansion).for_each(|(sum, value)| *sum += value);
            }
        }
        Ok(Self { half, expansion, pressure })
    }
}

/// The corners (triangle, corner) of a batch at each node.
fn corners_by_node(panels: &[FlatPanel], nodes: usize) -> Vec<Vec<(usize, usize)>> {
    let mut corners = vec![Vec::new(); nodes];
    for (triangle, panel) in panels.iter().enumerate() {
        panel.nodes.iter().enumerate().for_each(|(corner, &node)| corners[node].push((triangle, corner)));
    }
    corners
}

impl RowStrip {
    fn new(panels: &[FlatPanel], triangle: usize, order: usize, wall: Option<&WallImages>) -> Self {
        let mut strip = Self { rows: vec![0.0; 9 * order], expansion: vec![0.0; order], pressure: 0.0 };
        let panel = &panels[triangle];
        for (k, other) in panels[triangle..].iter().enumerate() {
            let mut block = block(panel, other);
            strip.expand((panel, other), &block, k == 0);
            if let Some(wall) = wall {
                let image = wall.between(panel, other);
                strip.reflect((panel, other), &image, k == 0);
                block
                    .as_flattened_mut()
                    .iter_mut()
                    .zip(image.block.as_flattened())
                    .for_each(|(sum, value)| *sum += value);
            }
            strip.add(other, &block, order, if k == 0 { 0.5 } else { 1.0 } / (8.0 * PI));
        }
        strip
    }

    fn add(&mut self, other: &FlatPanel, block: &Block, order: usize, factor: f64) {
        for (row, values) in self.rows.chunks_mut(order).zip(block) {
            for (node, values) in other.nodes.iter().zip(values.chunks(3)) {
                let at = &mut row[3 * node..3 * node + 3];
                at.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * value);
            }
        }
    }

    /// (1/4π) n′ ∫∫ φ_i/r to the nodes of each of the two triangles.
    fn expand(&mut self, (one, other): (&FlatPanel, &FlatPanel), block: &Block, same: bool) {
        let trace = |i: usize, j: usize| (0..3).map(|a| block[3 * i + a][3 * j + a]).sum::<f64>() / (16.0 * PI);
        for k in 0..3 {
            let here: f64 = (0..3).map(|j| trace(k, j)).sum();
            self.push(one.nodes[k], other.normal() * here);
            if !same {
                let there: f64 = (0..3).map(|i| trace(i, k)).sum();
                self.push(other.nodes[k], one.normal() * there);
            }
        }
    }

    /// What the images add to e and Π.
    fn reflect(&mut self, (one, other): (&FlatPanel, &FlatPanel), image: &Image, same: bool) {
        self.pressure += if same { image.pressure } else { 2.0 * image.pressure };
        for k in 0..3 {
            self.push(one.nodes[k], image.here[k]);
            if !same {
                self.push(other.nodes[k], image.there[k]);
            }
        }
    }

    fn push(&mut self, node: usize, flow: Vec3) {
        (0..3).for_each(|a| self.expansion[3 * node + a] += flow[a]);
    }
}
