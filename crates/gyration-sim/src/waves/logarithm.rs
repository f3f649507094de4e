//! log X and its derivative along a matrix: what `exponential` took to X.
//!
//!   log X = 2^k log X^(1/2^k),   log X = 2 artanh Y = 2 Σ Y^(2n+1)/(2n+1),   Y = (X − 1)(X + 1)⁻¹
//!
//! The principal one: turns below half a turn. Everything is done with pairs (X, dX) that multiply as (XY, dX Y + X
//! dY). Square roots by the iteration of Denman and Beavers, X ← ½(X + Z⁻¹), Z ← ½(Z + X⁻¹).
//!
//! Source: N. J. Higham, *Functions of Matrices* (2008), ch. 6 and 11.

use gyration::tensor::Mat3;

/// Terms of the series of a root that is nearer to one than a half, where |Y| < 1/3: the last is below 2⁻⁵³.
const TERMS: u32 = 17;
/// A root is as near to one as this.
const NEAR: f64 = 0.5;
/// Square roots that are taken at most, and steps of each: two are the rule, and eight.
const MOST_ROOTS: u32 = 16;
const MOST_STEPS: usize = 40;
/// A step of a square root that changes less than this part of it is its last.
const SETTLED: f64 = 1e-14;

/// A matrix and how it changes.
#[derive(Debug, Clone, Copy)]
struct Pair {
    value: Mat3,
    change: Mat3,
}

impl Pair {
    fn times(&self, other: &Self) -> Self {
        Self { value: self.value * other.value, change: self.change * other.value + self.value * other.change }
    }

    fn inverse(&self) -> Option<Self> {
        let value = self.value.try_inverse()?;
        Some(Self { value, change: -value * self.change * value })
    }

    fn mean(&self, other: &Self) -> Self {
        Self { value: 0.5 * (self.value + other.value), change: 0.5 * (self.change + other.change) }
    }

    fn plus(&self, part: f64, other: &Self) -> Self {
        Self { value: self.value + part * other.value, change: self.change + part * other.change }
    }

    /// How far it is from another, as a part of each.
    fn distance(&self, other: &Self) -> f64 {
        let part = |own: &Mat3, other: &Mat3| if *own == *other { 0.0 } else { (own - other).norm() / own.norm() };
        part(&self.value, &other.value).max(part(&self.change, &other.change))
    }

    fn is_finite(&self) -> bool {
        self.value.iter().chain(&self.change).all(|entry| entry.is_finite())
    }

    fn root(&self) -> Option<Self> {
        let (mut root, mut other) = (*self, ONE);
        for _ in 0..MOST_STEPS {
            let next = root.mean(&other.inverse()?);
            other = other.mean(&root.inverse()?);
            let left = next.distance(&root);
            root = next;
            if !root.is_finite() {
                return None;
            }
            if left < SETTLED {
                return Some(root);
            }
        }
        None
    }
}

const ONE: Pair = Pair {
    value: Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
    change: Mat3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
};

/// log X and d/ds log(X + sB) at s = 0; none where X has an eigenvalue on the negative axis.
pub(crate) fn logarithm(x: &Mat3, b: &Mat3) -> Option<[Mat3; 2]> {
    let mut root = Pair { value: *x, change: *b };
    let mut scale = 2.0;
    for _ in 0..MOST_ROOTS {
        if (root.value - ONE.value).norm() <= NEAR {
            break;
        }
        root = root.root()?;
        scale *= 2.0;
    }
    if (root.value - ONE.value).norm() > NEAR || !root.is_finite() {
        return None;
    }
    let y = root.plus(-1.0, &ONE).times(&root.plus(1.0, &ONE).inverse()?);
    let square = y.times(&y);
    // From the last term to the first.
    let mut sum = Pair { value: Mat3::zeros(), change: Mat3::zeros() };
    for k in (0..TERMS).rev() {
        sum = square.times(&sum).plus(1.0 / f64::from(2 * k + 1), &ONE);
    }
    let Pair { value, change } = y.times(&sum);
    Some([scale * value, scale * change])
}

#[cfg(test)]
mod tests {
    use super::super::exponential::exponential;
    use super::*;
    use gyration::tensor::{Vec3, cross_matrix};

    #[test]
    fn logarithm_undoes_the_exponential_and_its_derivative() {
        let turn = cross_matrix(&Vec3::new(0.9, -1.3, 1.7));
        let strain = Mat3::new(0.3, 0.1, -0.2, 0.5, 0.7, 0.2, -0.4, 0.6, 1.0);
        for a in [1e-7 * strain, 0.3 * strain, turn, 0.5 * turn + 0.4 * strain, Mat3::zeros()] {
            let b = Mat3::new(0.2, -0.1, 0.4, 0.3, 0.5, -0.6, 0.1, 0.7, -0.3);
            let [x, slope] = exponential(&a, &b);
            let [log, back] = logarithm(&x, &slope).unwrap();
            // Roundings of numbers near one, four times doubled at most.
            assert!((log - a).norm() < 5e-15, "{a} {log}");
            assert!((back - b).norm() < 5e-14, "{b} {back}");
        }
    }

    #[test]
    fn half_a_turn_has_no_principal_logarithm() {
        let half = Mat3::from_diagonal(&Vec3::new(-1.0, -1.0, 1.0));
        assert_eq!(logarithm(&half, &Mat3::zeros()), None);
        assert_eq!(logarithm(&Mat3::zeros(), &Mat3::zeros()), None);
        assert_eq!(logarithm(&Mat3::repeat(f64::NAN), &Mat3::zeros()), None);
    }
}
