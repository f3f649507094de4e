//! Numbers of twice the digits, high + low, for gaps far below the size of a body.
//!
//! A gap is the difference of a height and of −m·X, both as large as the body: where it is 10⁻¹² of that, four of
//! sixteen digits are left. The state is therefore kept as high + low (by the integrator), and height, m and m·X are
//! computed so where a gap is small. Sums and products without loss: Dekker, *Numer. Math.* 18 (1971).

use crate::tensor::Vec3;
use std::ops::{Add, Mul, Sub};

/// The numbers of a state, high + low entry by entry.
#[derive(Debug, Clone, Copy)]
pub struct Numbers<'a> {
    /// The numbers, rounded.
    pub high: &'a [f64],
    /// What they lack; empty where that is not known.
    pub low: &'a [f64],
}

impl<'a> From<&'a [f64]> for Numbers<'a> {
    fn from(high: &'a [f64]) -> Self {
        Self { high, low: &[] }
    }
}

impl<'a> From<&'a Vec<f64>> for Numbers<'a> {
    fn from(high: &'a Vec<f64>) -> Self {
        Self::from(high.as_slice())
    }
}

impl Numbers<'_> {
    /// x less the three numbers from a place on, to the digits of one number: the difference of near numbers is exact.
    #[inline]
    pub(crate) fn behind(&self, x: &ExtendedVec3, place: usize) -> Vec3 {
        let high = &self.high[place..place + 3];
        let low = self.low.get(place..place + 3).unwrap_or(&[0.0; 3]);
        Vec3::from_fn(|i, _| (x[i].high - high[i]) + (x[i].low - low[i]))
    }

    /// The number at a place.
    pub(crate) fn at(&self, place: usize) -> Extended {
        Extended { high: self.high[place], low: self.low.get(place).copied().unwrap_or(0.0) }
    }
}

/// high + low, |low| at most half a unit in the last place of high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extended {
    /// The number, rounded.
    pub high: f64,
    /// What it lacks.
    pub low: f64,
}

/// Three numbers high + low.
pub(crate) type ExtendedVec3 = [Extended; 3];

impl From<f64> for Extended {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Extended {
    /// a + b without loss.
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        Self { high, low: (a - (high - of_b)) + (b - of_b) }
    }

    /// a b without loss.
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    /// Rounded.
    pub fn value(self) -> f64 {
        self.high + self.low
    }

    /// 1/x.
    pub fn reciprocal(self) -> Self {
        let first = 1.0 / self.high;
        // One step of Newton's method doubles the digits.
        let error = Self::from(1.0) - self * Self::from(first);
        Self::from(first) + Self::from(first) * error
    }

    /// √x; of zero zero.
    pub fn sqrt(self) -> Self {
        let first = self.high.sqrt();
        if first == 0.0 {
            return Self::from(0.0);
        }
        let error = self - Self::product(first, first);
        Self::from(first) + Self::from(error.value() / (2.0 * first))
    }

    /// a·b.
    pub(crate) fn dot(a: &ExtendedVec3, b: &Vec3) -> Self {
        a[0] * b.x.into() + a[1] * b.y.into() + a[2] * b.z.into()
    }
}

impl Add for Extended {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = Self::sum(self.high, other.high);
        Self::sum(sum.high, sum.low + (self.low + other.low))
    }
}

impl Sub for Extended {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self { high: -other.high, low: -other.low }
    }
}

impl Mul for Extended {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

/// mᵢ = Σ R_ji(q/|q|) n_j, the normal in the axes of a body with the quaternion q, whose length is a gauge.
pub(crate) fn rotated_back(quaternion: [Extended; 4], normal: &Vec3) -> ExtendedVec3 {
    let [w, x, y, z] = quaternion;
    let scale = (w * w + x * x + y * y + z * z).reciprocal() * 2.0.into();
    let n = [normal.x, normal.y, normal.z].map(Extended::from);
    // Rᵀn = n − s (w v × n − v × (v × n)), v = (x, y, z).
    let v = [x, y, z];
    let across = cross(v, n);
    let twice = cross(v, across);
    std::array::from_fn(|i| n[i] - scale * (w * across[i] - twice[i]))
}

fn cross(a: ExtendedVec3, b: ExtendedVec3) -> ExtendedVec3 {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::Quaternion;

    /// 1/3 and √2 to 32 digits, from their decimals.
    #[test]
    fn roots_and_reciprocals_have_twice_the_digits() {
        let third = Extended::from(3.0).reciprocal();
        let one = third * 3.0.into();
        assert!(((one.high - 1.0) + one.low).abs() < 1e-31);
        let root = Extended::from(2.0).sqrt();
        let two = root * root;
        assert!(((two.high - 2.0) + two.low).abs() < 1e-31);
        // √2 = 1.41421356237309504880168872420969807856967…; its double is 1.4142135623730951454746….
        assert!((root.low - -9.667_293_313_452_913e-17).abs() < 1e-31, "{:e}", root.low);
    }

    #[test]
    fn the_normal_turned_back_is_that_of_the_rotation_and_keeps_its_length() {
        let q = [0.8, -0.3, 0.4, 0.6];
        let normal = Vec3::new(0.36, -0.48, 0.8);
        let m = rotated_back(q.map(Extended::from), &normal);
        let plain = Quaternion(q).rotation().tr_mul(&normal);
        for (precise, plain) in m.iter().zip(&plain) {
            assert!((precise.value() - plain).abs() < 1e-15);
        }
        let squared = |v: ExtendedVec3| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        let difference = squared(m) - squared([normal.x, normal.y, normal.z].map(Extended::from));
        assert!(difference.value().abs() < 1e-30, "{:e}", difference.value());
    }
}
