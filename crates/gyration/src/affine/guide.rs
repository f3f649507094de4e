//! A body that deforms within a linear space W of gradients: motion in a plane, or strain without rotation.
//!
//!   Π the projector on W in the metric of the mass, ⟨X, Z⟩ = tr(X J Zᵀ)
//!
//! P and Ṗ are in W, which does not change in time. The reaction takes no power, so that it is orthogonal to W and P̈ =
//! Π A, A being the acceleration without it. Source: `docs/theory-affine.md`.

use crate::tensor::{Mat3, Vec3};
use nalgebra::{DMatrix, SMatrix, SVector};

type Mat9 = SMatrix<f64, 9, 9>;

/// The space of gradients that a body is kept to.
#[derive(Debug, Clone, PartialEq)]
pub struct StrainGuide {
    /// Π, on matrices column by column.
    map: Mat9,
}

impl StrainGuide {
    /// P = S P₀ with S = Q S Q, Q the reflection in a plane: motion that is its own mirror image.
    ///
    /// `normal` is the unit normal of the plane in space, `start` P₀, `euler_tensor` J.
    pub fn plane(normal: &Vec3, start: &Mat3, euler_tensor: &Mat3) -> Self {
        let first = normal.cross(&Vec3::ith(normal.iamin(), 1.0)).normalize();
        let second = normal.cross(&first);
        let within = [first, second].into_iter().flat_map(|row| [first, second].map(|column| row * column.transpose()));
        Self::on(within.chain([normal * normal.transpose()]).map(|strain| strain * start), euler_tensor)
    }

    /// P = S P₀ with S = Sᵀ: strain without rotation.
    ///
    /// `start` is P₀, `euler_tensor` J.
    pub fn stretch(start: &Mat3, euler_tensor: &Mat3) -> Self {
        let unit = |k: usize| Vec3::ith(k, 1.0);
        let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        let strains = pairs.map(|(i, j)| unit(i) * unit(j).transpose() + unit(j) * unit(i).transpose());
        Self::on(strains.into_iter().map(|strain| strain * start), euler_tensor)
    }

    /// On the space of these gradients: Π = B (Bᵀ M B)⁻¹ Bᵀ M, M = J ⊗ 1.
    fn on(gradients: impl Iterator<Item = Mat3>, euler_tensor: &Mat3) -> Self {
        let columns: Vec<SVector<f64, 9>> = gradients.map(|gradient| stacked(&gradient)).collect();
        let basis = DMatrix::from_fn(9, columns.len(), |row, column| columns[column][row]);
        // Scaled, so that the determinant neither under- nor overflows for a grain or a mountain.
        let mass = (euler_tensor / euler_tensor.trace()).kronecker(&Mat3::identity());
        let weighed = basis.transpose() * mass;
        let solved = (&weighed * &basis).lu().solve(&weighed).unwrap_or(weighed);
        // A step of Newton, after which Π B = B to rounding, also of a thin plate.
        let solved = &solved * 2.0 - &solved * &basis * &solved;
        Self { map: Mat9::from_iterator((basis * solved).iter().copied()) }
    }

    /// Π of a matrix.
    pub fn within(&self, matrix: &Mat3) -> Mat3 {
        Mat3::from_column_slice((self.map * stacked(matrix)).as_slice())
    }

    /// Π on the numbers of a matrix, column by column.
    pub fn map(&self) -> &Mat9 {
        &self.map
    }
}

fn stacked(matrix: &Mat3) -> SVector<f64, 9> {
    SVector::from_column_slice(matrix.as_slice())
}
