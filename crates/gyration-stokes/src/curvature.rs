//! What flat triangles cut off a smooth surface through their corners, and what it does to the resistance.
//!
//! A surface of curvature κ rises above a triangle by δ = (1/24) Σ κ(s, s) in the mean, s its sides; with unit normals
//! at the corners κ(s, s) = (n₊ − n₋)·s. Moving the surface out by δ changes the energy ⟨S⁺b, b′⟩ by (Hadamard)
//!
//!   ∫ δ [ψ_t·ψ′_t − q ψ′_n − q′ ψ_n] dA
//!
//! ψ the density of the single layer without pressure in the body, t tangential, n normal: on the moved surface the
//! flow misses the motion by −δ ∂_n(u_fluid − u), whose tangential part is ψ_t and whose normal part is −q.

use crate::dense::{Columns, SIDES};
use crate::motion::{Mat12, UnitMotion, inner_work};
use crate::panel::FlatPanel;
use crate::vector::Vec3;

/// Cosine between the normal of a node and that of a triangle below which the node is taken for a tip, as of a cone:
/// 37°.
const TIP_COSINE: f64 = 0.8;

/// How the normals of triangles count in that of a node; all three are consistent, and their spread tells their error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Weight {
    /// The angle at the node.
    Angle,
    /// The area of the triangle.
    Area,
    /// sin of the angle over both sides: exact on a sphere (Max, *J. Graphics Tools* 4 (1999) 1).
    Sphere,
}

/// Normals at the nodes, as means of those of their triangles.
pub(crate) fn node_normals(panels: &[FlatPanel], nodes: usize, weight: Weight) -> Vec<Vec3> {
    let mut normals = vec![Vec3::zeros(); nodes];
    for panel in panels {
        for k in 0..3 {
            let [here, next, last] = [0, 1, 2].map(|l| panel.corners[(k + l) % 3]);
            let (one, other) = (next - here, last - here);
            let weight = match weight {
                Weight::Angle => one.angle(&other),
                Weight::Area => panel.area,
                Weight::Sphere => panel.area / (one.norm_squared() * other.norm_squared()),
            };
            normals[panel.nodes[k]] += panel.normal() * weight;
        }
    }
    normals.into_iter().map(|normal| normal.normalize()).collect()
}

/// The mean rise δ of the smooth surface above each triangle [length]; nothing beyond edges and at tips.
fn rises(panels: &[FlatPanel], normals: &[Vec3]) -> Vec<f64> {
    let rise = |panel: &FlatPanel| {
        let flat = panel.normal();
        let [a, b, c] = panel.nodes.map(|node| match normals[node].dot(&flat) < TIP_COSINE {
            true => flat,
            false => normals[node],
        });
        let [x, y, z] = panel.corners;
        ((b - a).dot(&(y - x)) + (c - b).dot(&(z - y)) + (a - c).dot(&(x - z))) / 24.0
    };
    panels.iter().map(rise).collect()
}

/// What the rise adds to the matrix, to first order: to the energy and, by the volume, to the inner work.
pub(crate) fn risen(panels: &[FlatPanel], normals: &[Vec3], densities: &Columns) -> Mat12 {
    let rises = rises(panels, normals);
    let volume: f64 = panels.iter().zip(&rises).map(|(panel, rise)| panel.area * rise).sum();
    rise_energy(panels, &rises, densities) - UnitMotion::matrix(|one, other| volume * inner_work(one, other))
}

/// ∫ δ [φ_t·φ′_t + q φ′_n + q′ φ_n] dA for all motions, φ = −ψ by unknown.
fn rise_energy(panels: &[FlatPanel], rises: &[f64], densities: &Columns) -> Mat12 {
    let expansion = UnitMotion::all().map(|motion| motion.expansion());
    let mut sum = Mat12::zeros();
    for (panel, rise) in panels.iter().zip(rises) {
        let normal = panel.normal();
        let at_corners: [[Vec3; SIDES]; 3] =
            panel.nodes.map(|node| std::array::from_fn(|k| Vec3::from_fn(|a, _| densities[3 * node + a][k])));
        // φφ′ is quadratic: the rule of degree 2 is exact.
        for point in 0..3 {
            let phi: [Vec3; SIDES] = std::array::from_fn(|k| {
                (at_corners[0][k] + at_corners[1][k] + at_corners[2][k]) / 6.0 + 0.5 * at_corners[point][k]
            });
            let along = phi.map(|phi| normal.dot(&phi));
            let weight = rise * panel.area / 3.0;
            for i in 0..SIDES {
                for j in 0..=i {
                    let tangential = phi[i].dot(&phi[j]) - along[i] * along[j];
                    sum[(i, j)] += weight * (tangential + expansion[i] * along[j] + expansion[j] * along[i]);
                }
            }
        }
    }
    Mat12::from_fn(|i, j| sum[(i.max(j), i.min(j))])
}
