//! 3×3 matrices as three columns of four numbers, the fourth of which is idle: what the balance of a body that deforms
//! and its derivative are computed in.
//!
//! All products of matrices are sums of columns times numbers,
//!
//!   (A B)_K = Σ_L A_L B_LK,   (A Bᵀ)_K = Σ_L A_L B_KL
//!
//! and a column is worked on as a whole: `SimdMat3` is a matrix in memory, `SimdMat3<F>` one in registers. Everything
//! is written out, without `map` or loops over slices.

use super::F64x4;
use crate::tensor::Mat3;
use std::ops::{Add, AddAssign, Mul, Sub};

/// Three numbers and an idle one, which is zero or not a number.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct SimdVec3<F = [f64; 4]>(pub F);

/// A matrix column by column.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct SimdMat3<F = [f64; 4]>(pub [SimdVec3<F>; 3]);

/// The columns of the unit matrix.
pub(crate) const UNIT: [SimdVec3; 3] =
    [SimdVec3([1.0, 0.0, 0.0, 0.0]), SimdVec3([0.0, 1.0, 0.0, 0.0]), SimdVec3([0.0, 0.0, 1.0, 0.0])];

impl<F: F64x4> SimdVec3<F> {
    /// a_i.
    #[inline(always)]
    pub fn at(&self, row: usize) -> f64 {
        self.0.at(row)
    }

    /// a × b = (a b′ − a′ b)′, where ′ takes (a₀, a₁, a₂) to (a₁, a₂, a₀).
    #[inline(always)]
    pub fn cross(&self, other: &Self) -> Self {
        let (a, b) = (self.0, other.0);
        Self(a.product(b.yzx()).minus(a.yzx().product(b)).yzx())
    }

    /// a_i b_i.
    #[inline(always)]
    pub fn product(&self, other: &Self) -> Self {
        Self(self.0.product(other.0))
    }

    /// (a₀b₀ + a₁b₁) + a₂b₂.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> f64 {
        let [one, two, three, _] = self.0.product(other.0).numbers();
        (one + two) + three
    }
}

impl SimdMat3 {
    /// The numbers of a matrix.
    #[inline(always)]
    pub fn of(matrix: &Mat3) -> Self {
        Self::read(matrix.as_slice())
    }

    /// Nine numbers, column by column.
    #[inline(always)]
    pub fn read(numbers: &[f64]) -> Self {
        let n: &[f64] = &numbers[..9];
        Self([SimdVec3([n[0], n[1], n[2], 0.0]), SimdVec3([n[3], n[4], n[5], 0.0]), SimdVec3([n[6], n[7], n[8], 0.0])])
    }

    /// The numbers of a matrix in registers of this kind.
    #[inline(always)]
    pub fn load<F: F64x4>(matrix: &Mat3, registers: F) -> SimdMat3<F> {
        Self::of(matrix).with(registers)
    }

    /// In registers of this kind.
    #[inline(always)]
    pub fn with<F: F64x4>(&self, registers: F) -> SimdMat3<F> {
        let Self([SimdVec3(a), SimdVec3(b), SimdVec3(c)]) = *self;
        SimdMat3([SimdVec3(registers.like(a)), SimdVec3(registers.like(b)), SimdVec3(registers.like(c))])
    }
}

impl<F: F64x4> SimdMat3<F> {
    /// In memory.
    #[inline(always)]
    pub fn kept(&self) -> SimdMat3 {
        let Self([SimdVec3(a), SimdVec3(b), SimdVec3(c)]) = self;
        SimdMat3([SimdVec3(a.numbers()), SimdVec3(b.numbers()), SimdVec3(c.numbers())])
    }

    /// Writes the nine numbers.
    #[inline(always)]
    pub fn write(&self, numbers: &mut [f64]) {
        let (SimdMat3([SimdVec3(a), SimdVec3(b), SimdVec3(c)]), out) = (self.kept(), &mut numbers[..9]);
        // Idle numbers are written as well, each then overwritten by the next column.
        out[..4].copy_from_slice(&a);
        out[3..7].copy_from_slice(&b);
        out[6..].copy_from_slice(&c[..3]);
    }

    /// The matrix.
    #[inline(always)]
    pub fn matrix(&self) -> Mat3 {
        let SimdMat3([SimdVec3(a), SimdVec3(b), SimdVec3(c)]) = self.kept();
        Mat3::new(a[0], b[0], c[0], a[1], b[1], c[1], a[2], b[2], c[2])
    }

    /// A_ik.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.0[column].at(row)
    }

    /// Aᵀ.
    #[inline(always)]
    pub fn transpose(&self) -> Self {
        let [SimdVec3(a), SimdVec3(b), SimdVec3(c)] = self.0;
        let [a, b, c] = F::transposed([a, b, c, a.like([0.0; 4])]);
        Self([SimdVec3(a), SimdVec3(b), SimdVec3(c)])
    }

    /// A b.
    #[inline(always)]
    pub fn image(&self, b: &SimdVec3<F>) -> SimdVec3<F> {
        let [SimdVec3(x), SimdVec3(y), SimdVec3(z)] = self.0;
        let SimdVec3(b) = *b;
        let sum = x.product(b.broadcast::<0>()).plus(y.product(b.broadcast::<1>()));
        SimdVec3(sum.plus(z.product(b.broadcast::<2>())))
    }

    /// A B.
    #[inline(always)]
    pub fn times(&self, other: &Self) -> Self {
        Self([self.image(&other.0[0]), self.image(&other.0[1]), self.image(&other.0[2])])
    }

    /// A Bᵀ.
    #[inline(always)]
    pub fn times_transposed(&self, other: &Self) -> Self {
        self.times(&other.transpose())
    }

    /// Each column times a number of its own: A diag(d).
    #[inline(always)]
    pub fn scaled(&self, factors: &[f64; 3]) -> Self {
        let [x, y, z] = self.0;
        Self([x * factors[0], y * factors[1], z * factors[2]])
    }

    /// A + s I; what stands outside the diagonal is left alone.
    #[inline(always)]
    pub fn plus_unit(&self, s: f64) -> Self {
        let like = |numbers| SimdVec3(self.0[0].0.like(numbers));
        // x + (−0) is x, whatever x is.
        let unit = [like([s, -0.0, -0.0, -0.0]), like([-0.0, s, -0.0, -0.0]), like([-0.0, -0.0, s, -0.0])];
        *self + Self(unit)
    }

    /// A_ik + d_k off the diagonal, A_ii on it.
    #[inline(always)]
    pub fn plus_beside(&self, d: &[f64; 3]) -> Self {
        let like = self.0[0].0;
        let ([x, y, z], [a, b, c]) = (self.0, *d);
        Self([
            x + SimdVec3(like.like([-0.0, a, a, -0.0])),
            y + SimdVec3(like.like([b, -0.0, b, -0.0])),
            z + SimdVec3(like.like([c, c, -0.0, -0.0])),
        ])
    }

    /// ½(A + Aᵀ).
    #[inline(always)]
    pub fn symmetric(&self) -> Self {
        (*self + self.transpose()) * 0.5
    }

    /// A_ik B_ik.
    #[inline(always)]
    pub fn entrywise(&self, other: &Self) -> Self {
        let ([SimdVec3(a), SimdVec3(b), SimdVec3(c)], [SimdVec3(x), SimdVec3(y), SimdVec3(z)]) = (self.0, other.0);
        Self([SimdVec3(a.product(x)), SimdVec3(b.product(y)), SimdVec3(c.product(z))])
    }

    /// A·B = tr(AᵀB).
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> f64 {
        let ([SimdVec3(a), SimdVec3(b), SimdVec3(c)], [SimdVec3(x), SimdVec3(y), SimdVec3(z)]) = (self.0, other.0);
        let [one, two, three, _] = a.product(x).plus(b.product(y)).plus(c.product(z)).numbers();
        (one + two) + three
    }

    /// tr A.
    #[inline(always)]
    pub fn trace(&self) -> f64 {
        (self.at(0, 0) + self.at(1, 1)) + self.at(2, 2)
    }

    /// Whether all but the diagonal is zero.
    #[inline(always)]
    pub fn is_diagonal(&self) -> bool {
        let SimdMat3([SimdVec3([_, a1, a2, _]), SimdVec3([b0, _, b2, _]), SimdVec3([c0, c1, _, _])]) = self.kept();
        a1 == 0.0 && a2 == 0.0 && b0 == 0.0 && b2 == 0.0 && c0 == 0.0 && c1 == 0.0
    }

    /// cof A = det A · A⁻ᵀ.
    #[inline(always)]
    pub fn cofactor(&self) -> Self {
        let [x, y, z] = &self.0;
        Self([y.cross(z), z.cross(x), x.cross(y)])
    }
}

impl<F: F64x4> Mul<f64> for SimdVec3<F> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self(self.0.times(factor))
    }
}

impl<F: F64x4> Add for SimdVec3<F> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0.plus(other.0))
    }
}

impl<F: F64x4> Sub for SimdVec3<F> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0.minus(other.0))
    }
}

impl<F: F64x4> AddAssign for SimdVec3<F> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<F: F64x4> Mul<f64> for SimdMat3<F> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        let [a, b, c] = self.0;
        Self([a * factor, b * factor, c * factor])
    }
}

impl<F: F64x4> Add for SimdMat3<F> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl<F: F64x4> Sub for SimdMat3<F> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a - x, b - y, c - z])
    }
}

impl<F: F64x4> AddAssign for SimdMat3<F> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_those_of_matrices() {
        let a = Mat3::new(1.3, 0.4, -0.2, -0.1, 0.7, 0.3, 0.5, -0.6, 1.9);
        let b = Mat3::new(0.2, -0.7, 0.1, 0.9, 0.3, -0.4, 0.5, 0.6, -0.8);
        let (x, y) = (SimdMat3::of(&a), SimdMat3::of(&b));
        // A few roundings of numbers of order one.
        let near = |columns: SimdMat3, matrix: Mat3| assert!((columns.matrix() - matrix).norm() < 1e-15);
        near(x.times(&y), a * b);
        near(x.times_transposed(&y), a * b.transpose());
        near(x.transpose(), a.transpose());
        near(x.cofactor(), crate::tensor::cofactor(&a));
        near(x.scaled(&[1.0, 2.0, 3.0]), a * Mat3::from_diagonal(&[1.0, 2.0, 3.0].into()));
        assert!((x.dot(&y) - a.dot(&b)).abs() < 1e-15 && (x.trace() - a.trace()).abs() < 1e-15);
        assert!(!x.is_diagonal() && SimdMat3(UNIT).is_diagonal());
        let mut numbers = [0.0; 9];
        x.write(&mut numbers);
        assert_eq!(SimdMat3::read(&numbers), x);
    }
}
