//! The directions in which damping and friction act at a plane, and rows of matrices along them.

use super::placed::Placed;
use super::{Mat4, Mat34, Vec4};
use crate::contact::LawKind;
use crate::tensor::Vec3;

/// The rows of a 3×4 matrix in the image of Π along its directions: of damping n, and nothing behind it, of friction t₁
/// and t₂.
pub(super) type Rows = [Vec4; 2];

/// No row.
pub(super) const NOTHING: Vec4 = Vec4::new(0.0, 0.0, 0.0, 0.0);
/// What X̃ has first, the same everywhere.
pub(super) const UNIFORM: Vec4 = Vec4::new(1.0, 0.0, 0.0, 0.0);

/// The directions of Π.
#[derive(Debug, Clone, Copy)]
pub(super) struct Directions {
    axes: [Vec3; 2],
    /// How many there are.
    count: usize,
}

impl Directions {
    /// Of a law, at a plane.
    pub fn of(kind: LawKind, placed: &Placed) -> Self {
        if kind == LawKind::Damping {
            Self { axes: [placed.plane.normal, Vec3::zeros()], count: 1 }
        } else {
            Self { axes: placed.tangents, count: 2 }
        }
    }

    /// The rows of a matrix.
    pub fn rows(&self, matrix: &Mat34) -> Rows {
        self.each(|axis, _| matrix.tr_mul(axis))
    }

    /// The matrix of these rows.
    pub fn matrix(&self, rows: &Rows) -> Mat34 {
        let matrix = self.axes[0] * rows[0].transpose();
        if self.count == 1 { matrix } else { matrix + self.axes[1] * rows[1].transpose() }
    }

    /// Rows times M.
    pub fn times(&self, rows: &Rows, moments: &Mat4) -> Rows {
        self.each(|_, k| moments * rows[k])
    }

    /// A·B.
    pub fn product(&self, one: &Rows, other: &Rows) -> f64 {
        let first = one[0].dot(&other[0]);
        if self.count == 1 { first } else { first + one[1].dot(&other[1]) }
    }

    fn each(&self, row: impl Fn(&Vec3, usize) -> Vec4) -> Rows {
        [row(&self.axes[0], 0), if self.count == 1 { NOTHING } else { row(&self.axes[1], 1) }]
    }
}
