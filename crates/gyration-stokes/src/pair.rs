//! The single layer between two triangles: ∫∫ φ_i(x) G(x − y) φ_j(y) dA dA, G = I/r + rr/r³, φ linear.
//!
//! Far apart, both integrals take the three points of the rule of degree 2. Near, the integral over the larger triangle
//! is a closed form ([`crate::inner`]) and that over the smaller one a rule of degree 5 or 6: what remains to be
//! integrated is then continuous, however thin or unequal the triangles are.

use crate::inner::{StokesletMoments, Symmetric};
use crate::panel::FlatPanel;
use crate::rule::{DEGREE_5, DEGREE_6, RulePoint};
use crate::vector::{Mat3, Vec3};

/// 3×3 components for each pair of corners: rows 3i + a, columns 3j + b.
pub(crate) type Block = [[f64; 9]; 9];

/// Triangles whose centroids are farther apart than this times the sum of their radii are far: the rule of degree 2
/// then errs by less than 1e-4 of the pair.
const FAR: f64 = 3.0;
/// Those nearer than this touch, or almost: the integrand has a bend.
const CLOSE: f64 = 1.2;

/// Relative difference of radii that counts as none.
const ALIKE: f64 = 1e-6;

/// The block of a pair of triangles, or of a triangle with itself.
#[inline]
pub(crate) fn block(one: &FlatPanel, other: &FlatPanel) -> Block {
    let reach = one.radius + other.radius;
    let squared = (one.centroid - other.centroid).norm_squared();
    if squared > (FAR * reach).powi(2) {
        return far(one, other);
    }
    let rule: &[RulePoint] = if squared > (CLOSE * reach).powi(2) { &DEGREE_5 } else { &DEGREE_6 };
    // The smaller radius outside; equal ones in the order given, whatever the rounding.
    if one.radius <= other.radius * (1.0 + ALIKE) {
        near(one, other, rule)
    } else {
        transposed(&near(other, one, rule))
    }
}

fn transposed(block: &Block) -> Block {
    std::array::from_fn(|row| std::array::from_fn(|column| block[column][row]))
}

/// The Stokeslet I/r + rr/r³.
#[inline(always)]
fn stokeslet(r: &Vec3) -> Symmetric {
    let squared = r.norm_squared();
    let inverse = 1.0 / squared.sqrt();
    let cubed = inverse / squared;
    let [x, y, z] = [r.x * cubed, r.y * cubed, r.z * cubed];
    [inverse + x * r.x, x * r.y, inverse + y * r.y, x * r.z, y * r.z, inverse + z * r.z]
}

#[inline(always)]
fn write(block: &mut Block, i: usize, j: usize, g: &Symmetric, factor: f64) {
    let full = [[g[0], g[1], g[3]], [g[1], g[2], g[4]], [g[3], g[4], g[5]]];
    for (a, row) in full.iter().enumerate() {
        for (b, value) in row.iter().enumerate() {
            block[3 * i + a][3 * j + b] = factor * value;
        }
    }
}

/// Both integrals by the rule of degree 2, at whose points φ_i = 1/6 + δ_iq/2.
#[inline]
fn far(one: &FlatPanel, other: &FlatPanel) -> Block {
    let mut by_corner = [[[0.0; 6]; 3]; 3];
    for (x, row) in one.points.iter().zip(&mut by_corner) {
        let mut sum = [0.0; 6];
        for (y, at) in other.points.iter().zip(row.iter_mut()) {
            *at = stokeslet(&(x - y));
            (0..6).for_each(|k| sum[k] += at[k]);
        }
        for at in row {
            (0..6).for_each(|k| at[k] = sum[k] / 6.0 + 0.5 * at[k]);
        }
    }
    let factor = one.area * other.area / 9.0;
    let mut block = [[0.0; 9]; 9];
    for j in 0..3 {
        let sum: Symmetric =
            std::array::from_fn(|k| (by_corner[0][j][k] + by_corner[1][j][k] + by_corner[2][j][k]) / 6.0);
        for (i, row) in by_corner.iter().enumerate() {
            write(&mut block, i, j, &std::array::from_fn(|k| sum[k] + 0.5 * row[j][k]), factor);
        }
    }
    block
}

/// The integral over `inner` closed, that over `outer` by a rule.
fn near(outer: &FlatPanel, inner: &FlatPanel, rule: &[RulePoint]) -> Block {
    let mut sums = [[[0.0; 6]; 3]; 3];
    for RulePoint { barycentric, weight } in rule {
        let moments = shape_moments(inner, &outer.at(barycentric));
        for (lambda, row) in barycentric.iter().zip(&mut sums) {
            for (sum, moment) in row.iter_mut().zip(&moments) {
                (0..6).for_each(|k| sum[k] += weight * lambda * moment[k]);
            }
        }
    }
    let mut block = [[0.0; 9]; 9];
    for (i, row) in sums.iter().enumerate() {
        for (j, sum) in row.iter().enumerate() {
            write(&mut block, i, j, &turned(&inner.axes, sum), outer.area);
        }
    }
    block
}

/// ∫ G(x − y) φ_j(y) dA in the axes of the triangle.
pub(crate) fn shape_moments(panel: &FlatPanel, x: &Vec3) -> [Symmetric; 3] {
    let local = panel.axes.tr_mul(&(x - panel.corners[0]));
    let moments = StokesletMoments::new(&panel.outline, [local.x, local.y], local.z);
    std::array::from_fn(|j| {
        let (slope, corner) = (panel.slopes[j], panel.outline.corners[j]);
        let foot = 1.0 + slope[0] * (local.x - corner[0]) + slope[1] * (local.y - corner[1]);
        std::array::from_fn(|k| {
            foot * moments.mean[k] + slope[0] * moments.slope[0][k] + slope[1] * moments.slope[1][k]
        })
    })
}

/// R K Rᵀ.
pub(crate) fn turned(axes: &Mat3, k: &Symmetric) -> Symmetric {
    let full = Mat3::new(k[0], k[1], k[3], k[1], k[2], k[4], k[3], k[4], k[5]);
    let g = axes * full * axes.transpose();
    [g[(0, 0)], g[(0, 1)], g[(1, 1)], g[(0, 2)], g[(1, 2)], g[(2, 2)]]
}
