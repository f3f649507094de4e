//! Singular values and vectors of a matrix that may be singular.
//!
//!   A = Σ u_k σ_k v_kᵀ
//!
//! by Jacobi's rotations of one side: columns are turned in pairs until all are orthogonal; their lengths are σ, and
//! what turned them is v. The decomposition of nalgebra 0.35 is wrong where singular values are rounding: of a
//! projection it finds a σ of 1.76 for 1.69. Source: Demmel, Veselić, *Jacobi's method is more accurate than QR*, SIAM
//! J. Matrix Anal. Appl. 13 (1992).

use nalgebra::{DMatrix, DVector, DVectorView};

/// Sweeps over all pairs at most; ten are the rule.
const SWEEPS: usize = 60;
/// Columns are orthogonal whose angle differs from a right one by so many roundings.
const ORTHOGONAL: f64 = 16.0 * f64::EPSILON;

/// A = Σ u_k σ_k v_kᵀ, in no order.
#[derive(Debug, Clone)]
pub(crate) struct SingularValues {
    /// u_k σ_k, a column each.
    left: DMatrix<f64>,
    /// v_k, a column each.
    right: DMatrix<f64>,
    /// σ.
    pub values: DVector<f64>,
}

impl SingularValues {
    /// Of a matrix; none of what is not finite, or of rotations that do not end.
    pub fn of(matrix: &DMatrix<f64>) -> Option<Self> {
        if !matrix.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        // The side with fewer columns has fewer pairs.
        let is_wide = matrix.ncols() > matrix.nrows();
        let mut columns = if is_wide { matrix.transpose() } else { matrix.clone() };
        let mut turn = DMatrix::identity(columns.ncols(), columns.ncols());
        let rounding = (f64::EPSILON * matrix.norm()).powi(2);
        (0..SWEEPS).find(|_| sweep(&mut columns, &mut turn, rounding))?;
        let values = DVector::from_iterator(columns.ncols(), columns.column_iter().map(|column| column.norm()));
        if !is_wide {
            return Some(Self { left: columns, right: turn, values });
        }
        let mut found = Self { left: turn, right: columns, values };
        for (k, value) in found.values.iter().enumerate().filter(|(_, value)| **value > 0.0) {
            found.left.column_mut(k).scale_mut(*value);
            found.right.column_mut(k).unscale_mut(*value);
        }
        Some(found)
    }

    /// The largest.
    pub fn largest(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }

    /// Which are above a bound.
    pub fn above(&self, least: f64) -> impl Iterator<Item = usize> + '_ {
        self.values.iter().enumerate().filter(move |(_, value)| **value > least).map(|(k, _)| k)
    }

    /// u_k of a σ that is not zero.
    pub fn left(&self, k: usize) -> DVector<f64> {
        self.left.column(k) / self.values[k]
    }

    /// v_k.
    pub fn right(&self, k: usize) -> DVectorView<'_, f64> {
        self.right.column(k)
    }

    /// The shortest x with A x nearest to b, without what belongs to values up to a bound.
    pub fn solve(&self, b: &DVector<f64>, least: f64) -> DVector<f64> {
        let start = DVector::zeros(self.right.nrows());
        self.above(least).fold(start, |x, k| x + self.right(k) * (self.left(k).dot(b) / self.values[k]))
    }
}

/// Makes all pairs of columns orthogonal, one after the other; whether they were. Columns whose square is rounding have
/// no direction.
fn sweep(columns: &mut DMatrix<f64>, turn: &mut DMatrix<f64>, rounding: f64) -> bool {
    let mut are_orthogonal = true;
    for other in 1..columns.ncols() {
        for one in 0..other {
            let (first, second) = (columns.column(one), columns.column(other));
            let product = first.dot(&second);
            let [a, b] = [first.norm_squared(), second.norm_squared()];
            if a.min(b) <= rounding || product.abs() <= ORTHOGONAL * (a * b).sqrt() {
                continue;
            }
            are_orthogonal = false;
            // cot 2θ, and the smaller root of tan² θ + 2 cot 2θ tan θ = 1.
            let cotangent = (b - a) / (2.0 * product);
            let tangent = 1.0_f64.copysign(cotangent) / (cotangent.abs() + (1.0 + cotangent * cotangent).sqrt());
            let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
            for matrix in [&mut *columns, &mut *turn] {
                for row in 0..matrix.nrows() {
                    let [x, y] = [matrix[(row, one)], matrix[(row, other)]];
                    matrix[(row, one)] = cosine * (x - tangent * y);
                    matrix[(row, other)] = cosine * (y + tangent * x);
                }
            }
        }
    }
    are_orthogonal
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An orthonormal matrix: three mirrors.
    fn turned(size: usize, seed: f64) -> DMatrix<f64> {
        (0..3).fold(DMatrix::identity(size, size), |product, mirror| {
            let entry = |i: usize| libm::sin(seed + 1.3 * f64::from(mirror) + 2.1 * i as f64);
            let normal = DVector::from_fn(size, |i, _| entry(i)).normalize();
            product * (DMatrix::identity(size, size) - 2.0 * &normal * normal.transpose())
        })
    }

    /// Symptom: one of 16 conical pendulums on a ball joint was unstable, since what spanned the states that a
    /// projection leaves did not.
    #[test]
    fn vectors_span_range_and_rows_whatever_noise_small_values_have() {
        let size = 7;
        let mut worst = 0.0_f64;
        for (number, noise) in [1e-9, 1e-11, 1e-13, 1e-14, 1e-15, 1e-16, 0.0].into_iter().enumerate() {
            let (left, right) = (turned(size, 0.1 + number as f64), turned(size, 7.7 + number as f64));
            let sizes = DVector::from_fn(size, |k, _| if k < 4 { 1.0 } else { noise * (k as f64 - 3.0) });
            let found = SingularValues::of(&(&left * DMatrix::from_diagonal(&sizes) * right.transpose())).unwrap();
            // Columns that follow from others, exactly.
            let twice = SingularValues::of(&DMatrix::from_fn(9, 8, |i, k| ((i + k % 3) % 5) as f64)).unwrap();
            assert_eq!(twice.above(1e-12 * twice.largest()).count(), 3);
            let range = left.columns(0, 4);
            let kept: Vec<_> = found.above(0.5).map(|k| found.left(k)).collect();
            assert_eq!(kept.len(), 4, "{noise:e}: {}", found.values);
            for (at, vector) in kept.iter().enumerate() {
                worst = worst.max((vector - range * range.tr_mul(vector)).norm());
                for other in &kept[..at] {
                    worst = worst.max(vector.dot(other).abs());
                }
            }
            // The shortest solution lies in the span of the right vectors.
            let wanted = right.columns(0, 4) * DVector::from_vec(vec![1.0, -2.0, 3.0, 0.5]);
            let solved = found.solve(&(left.columns(0, 4) * DVector::from_vec(vec![1.0, -2.0, 3.0, 0.5])), 0.5);
            worst = worst.max((solved - wanted).norm());
        }
        println!("off by {worst:e}");
        assert!(worst < 1e-13, "{worst:e}");
    }
}
