//! The change of frame of moments: X = offset + L Y, L any 3×3 matrix.
//!
//!   A₁ = L a₁ + a₀ b,   A₂ = L a₂ Lᵀ + sym(A₁' ⊗ b) + a₀ b⊗b,   A₃ likewise, with A₁' = L a₁, b the offset.
//!
//! The weight κ dA goes along unchanged: where L is not a rotation the caller has already put the area element of the
//! image into it. Errors stay small relative to ∫ κ |X|ⁿ dA, since no term exceeds it by more than a constant.

use super::moments::Moments;
use crate::tensor::{Mat3, SymmetricThird, Vec3};

impl Moments {
    /// The moments of the same weights at the points offset + linear · Y, up to `order`.
    pub(crate) fn transformed(&self, linear: &Mat3, offset: &Vec3, order: usize) -> Self {
        let mut out = Self { zeroth: self.zeroth, ..Self::default() };
        if order >= 1 {
            out.first = linear * self.first;
        }
        if order >= 2 {
            out.second = linear * self.second * linear.transpose();
        }
        if order >= 3 {
            out.third = map_third(&self.third, linear);
        }
        out.shift(offset, order);
        out
    }

    /// Replaces the points Y by offset + Y, up to `order`.
    pub(crate) fn shift(&mut self, offset: &Vec3, order: usize) {
        // From the highest order down, since each needs the lower ones about the old origin.
        if order >= 3 {
            add_offset_terms(self.zeroth, &self.first, &self.second, offset, &mut self.third);
        }
        if order >= 2 {
            let cross = (self.first + 0.5 * self.zeroth * offset) * offset.transpose();
            self.second += cross + cross.transpose();
        }
        if order >= 1 {
            self.first += self.zeroth * offset;
        }
    }
}

/// L_ai L_bj L_ck T_ijk.
fn map_third(third: &SymmetricThird, linear: &Mat3) -> SymmetricThird {
    let row = |i: usize| linear.row(i).transpose();
    let (x, y, z) = (row(0), row(1), row(2));
    let (along_x, along_y) = (third.contract(&x), third.contract(&y));
    let (xx, xy, xz) = (along_x * x, along_x * y, along_x * z);
    let (yy, yz, zz) = (along_y * y, along_y * z, third.contract(&z) * z);
    SymmetricThird([
        xx.dot(&x),
        xx.dot(&y),
        xx.dot(&z),
        xy.dot(&y),
        xy.dot(&z),
        xz.dot(&z),
        yy.dot(&y),
        yy.dot(&z),
        yz.dot(&z),
        zz.dot(&z),
    ])
}

/// Adds ∑ over the places of b in a₀ b⊗b⊗b + a₁⊗b⊗b + a₂⊗b.
fn add_offset_terms(zeroth: f64, first: &Vec3, second: &Mat3, offset: &Vec3, out: &mut SymmetricThird) {
    let indices =
        [(0, 0, 0), (0, 0, 1), (0, 0, 2), (0, 1, 1), (0, 1, 2), (0, 2, 2), (1, 1, 1), (1, 1, 2), (1, 2, 2), (2, 2, 2)];
    let (a, b) = (first, offset);
    for (sum, (i, j, k)) in out.0.iter_mut().zip(indices) {
        *sum += second[(i, j)] * b[k] + second[(i, k)] * b[j] + second[(j, k)] * b[i];
        *sum += a[i] * b[j] * b[k] + a[j] * b[i] * b[k] + a[k] * b[i] * b[j];
        *sum += zeroth * b[i] * b[j] * b[k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tensor::cross_matrix;

    fn cloud(map: impl Fn(&Vec3) -> Vec3) -> Moments {
        let mut sum = Moments::default();
        for i in 0..7 {
            let t = f64::from(i);
            let (w, y) = (1.0 + 0.3 * t, map(&Vec3::new((1.3 * t).sin(), (0.7 * t + 1.0).cos(), 0.4 * t - 1.0)));
            sum.zeroth += w;
            sum.first += w * y;
            sum.second += w * y * y.transpose();
            sum.third.add_point(w, &y);
        }
        sum
    }

    #[test]
    fn transformed_moments_are_those_of_the_transformed_points() {
        let linear = Mat3::new(0.3, -1.0, 0.2, 0.9, 0.4, 0.1, -0.2, 0.6, 1.4) + cross_matrix(&Vec3::new(0.1, 0.2, 0.3));
        let offset = Vec3::new(0.4, -2.0, 0.7);
        let direct = cloud(|y| offset + linear * y);
        let transformed = cloud(|y| *y).transformed(&linear, &offset, 3);
        // Round-off of a few dozen operations on numbers up to 100.
        assert!((direct.first - transformed.first).norm() < 1e-12);
        assert!((direct.second - transformed.second).norm() < 1e-12);
        for (a, b) in direct.third.0.iter().zip(transformed.third.0) {
            assert!((a - b).abs() < 1e-12, "{a} against {b}");
        }
    }
}
