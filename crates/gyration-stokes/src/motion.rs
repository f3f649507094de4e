//! The twelve motions u = U + L (x − c): velocity of the centre, then L row by row.
//!
//! In each of them E = sym L and q = tr L. What the single layer must balance on the surface is u − q v, v the field of
//! a uniform source in the body ([`crate::assembly`]).

use crate::dense::{Columns, SIDES};
use crate::panel::FlatPanel;
use crate::vector::{Mat3, Vec3};
use nalgebra::SMatrix;

/// A bilinear form of the motions.
pub(crate) type Mat12 = SMatrix<f64, SIDES, SIDES>;

/// One of the twelve unit motions; of its velocity only the right sides know.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UnitMotion {
    pub gradient: Mat3,
}

impl UnitMotion {
    /// In the order of the rows of the matrix.
    pub fn all() -> [Self; SIDES] {
        std::array::from_fn(|k| {
            let mut gradient = Mat3::zeros();
            if k >= 3 {
                gradient[((k - 3) / 3, k % 3)] = 1.0;
            }
            Self { gradient }
        })
    }

    /// The matrix of a bilinear form.
    pub fn matrix(form: impl Fn(&Self, &Self) -> f64) -> Mat12 {
        let all = Self::all();
        Mat12::from_fn(|i, j| form(&all[i], &all[j]))
    }

    /// E = sym L.
    pub fn strain(&self) -> Mat3 {
        0.5 * (self.gradient + self.gradient.transpose())
    }

    /// q = tr L.
    pub fn expansion(&self) -> f64 {
        self.gradient.trace()
    }
}

/// 2 (E:E′ − q q′): the work of the inner stress per volume, which the single layer counts and the fluid does not.
pub(crate) fn inner_work(one: &UnitMotion, other: &UnitMotion) -> f64 {
    2.0 * (one.strain().dot(&other.strain()) - one.expansion() * other.expansion())
}

/// ∫ φ_i (u − q v) dA for the twelve motions about a centre; `expansion` is ∫ φ_i v dA.
pub(crate) fn right_sides(panels: &[FlatPanel], centre: &Vec3, expansion: &[f64]) -> Columns {
    let mut sides = vec![[0.0; SIDES]; expansion.len()];
    for panel in panels {
        for (corner, node) in panel.corners.iter().zip(panel.nodes) {
            // ∫ φ_i φ_j dA = A (1 + δ_ij)/12.
            let arm = (3.0 * panel.centroid + corner - 4.0 * centre) * (panel.area / 12.0);
            for a in 0..3 {
                let row = &mut sides[3 * node + a];
                row[a] += panel.area / 3.0;
                (0..3).for_each(|b| row[3 + 3 * a + b] += arm[b]);
            }
        }
    }
    for (row, value) in sides.iter_mut().zip(expansion) {
        [3, 7, 11].into_iter().for_each(|diagonal| row[diagonal] -= value);
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expansion_is_the_trace_of_the_rows() {
        let diagonal: Vec<usize> = (0..12).filter(|&k| UnitMotion::all()[k].expansion() != 0.0).collect();
        assert_eq!(diagonal, [3, 7, 11]);
    }
}
