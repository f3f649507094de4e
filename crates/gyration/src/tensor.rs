//! Small tensors of three-dimensional space.
//!
//! Convention: `(a ⊗ b)_ij = a_i b_j`; the first index is spatial, the second material.

use nalgebra::{Matrix3, Vector3};

/// A vector of three components.
pub type Vec3 = Vector3<f64>;
/// A 3×3 matrix.
pub type Mat3 = Matrix3<f64>;

/// The matrix `[a]×` with `[a]× b = a × b`.
pub fn cross_matrix(a: &Vec3) -> Mat3 {
    Mat3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

/// The vector `a_i = ε_ijk A_kj`, so that `axial([w]×) = 2 w`.
pub fn axial(a: &Mat3) -> Vec3 {
    Vec3::new(a[(2, 1)] - a[(1, 2)], a[(0, 2)] - a[(2, 0)], a[(1, 0)] - a[(0, 1)])
}

/// `tr(A) I − A` of a symmetric matrix, free of cancellation: with A = ∫X⊗X it takes a rate of turn to X × (Ω × X).
pub fn turning(a: &Mat3) -> Mat3 {
    let diagonal = Vec3::new(a.m22 + a.m33, a.m11 + a.m33, a.m11 + a.m22);
    Mat3::new(diagonal.x, -a.m12, -a.m13, -a.m21, diagonal.y, -a.m23, -a.m31, -a.m32, diagonal.z)
}

/// A fully symmetric tensor of third rank, stored as its ten independent components
/// `xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SymmetricThird(pub [f64; 10]);

impl SymmetricThird {
    /// The contraction `(T·v)_ij = T_ijk v_k`, a symmetric matrix.
    pub fn contract(&self, v: &Vec3) -> Mat3 {
        let t = &self.0;
        let entry = |i: usize, j: usize, k: usize| t[i] * v.x + t[j] * v.y + t[k] * v.z;
        let (xx, xy, xz) = (entry(0, 1, 2), entry(1, 3, 4), entry(2, 4, 5));
        let (yy, yz, zz) = (entry(3, 6, 7), entry(4, 7, 8), entry(5, 8, 9));
        Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }

    /// The matrix `T_ijk` for the component k, which is the contraction with a unit vector without its products by zero.
    pub fn slice(&self, component: usize) -> Mat3 {
        const PLACES: [[usize; 6]; 3] = [[0, 1, 2, 3, 4, 5], [1, 3, 4, 6, 7, 8], [2, 4, 5, 7, 8, 9]];
        let [xx, xy, xz, yy, yz, zz] = PLACES[component].map(|place| self.0[place]);
        Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }

    /// Adds `w · a⊗a⊗a` for one point `a` of weight `w`.
    pub fn add_point(&mut self, w: f64, a: &Vec3) {
        let (x, y, z) = (a.x, a.y, a.z);
        let (wx, wy, wz) = (w * x, w * y, w * z);
        let products = [
            wx * x * x,
            wx * x * y,
            wx * x * z,
            wx * y * y,
            wx * y * z,
            wx * z * z,
            wy * y * y,
            wy * y * z,
            wy * z * z,
            wz * z * z,
        ];
        for (sum, product) in self.0.iter_mut().zip(products) {
            *sum += product;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slice_is_the_contraction_with_a_unit_vector() {
        let third = SymmetricThird(std::array::from_fn(|i| (1.0 + i as f64).sqrt()));
        for axis in 0..3 {
            assert_eq!(third.slice(axis), third.contract(&Vec3::ith(axis, 1.0)));
        }
    }
}
