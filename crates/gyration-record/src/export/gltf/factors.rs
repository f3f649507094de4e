//! P = U S Vᵀ as rotations and scales, kept continuous from key to key.
//!
//! A node of glTF has a translation, a rotation and a scale, so that a sheared body takes two, nested: the outer one
//! with rotation U and scale S, the inner one with rotation Vᵀ. U and V are determined up to the order and the signs of
//! their columns, and where stretches are equal up to a rotation; what is wanted is the pair nearest to that of the key
//! before. With C = PᵀP and the V₀ of that key, V₀ᵀ C V₀ is nearly diagonal, and Jacobi's rotations, none by more than
//! 45°, make it so:
//!
//!   V = V₀ J,   S² = diag(Vᵀ C V),   U = P V S⁻¹
//!
//! Neither columns are swapped where two stretches cross, nor is the frame turned where they agree to rounding. det P >
//! 0, so that U is a rotation as V is.

use crate::export::drawing::{Mat3, Vec3};
use nalgebra::{Rotation3, UnitQuaternion};

/// Entries of V₀ᵀ C V₀ beside the diagonal that count as zero, relative to the stretches: P is missed by half as much.
const DIAGONAL: f64 = 1e-9;
/// Sweeps of Jacobi's method; it converges quadratically and takes five at most.
const SWEEPS: usize = 20;

/// The factors of one placement gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GradientFactors {
    /// U.
    pub outer: UnitQuaternion<f64>,
    /// The diagonal of S, > 0.
    pub stretches: Vec3,
    /// Vᵀ.
    pub inner: UnitQuaternion<f64>,
}

impl GradientFactors {
    /// Those of no deformation.
    pub fn identity() -> Self {
        let one = UnitQuaternion::identity();
        Self { outer: one, stretches: Vec3::repeat(1.0), inner: one }
    }

    /// The factors of P nearest to these; none unless det P > 0.
    pub fn follow(&self, p: &Mat3) -> Option<Self> {
        if p.determinant().is_nan() || p.determinant() <= 0.0 {
            return None;
        }
        let mut v = self.inner.to_rotation_matrix().transpose().into_inner();
        let mut c = v.transpose() * (p.transpose() * p) * v;
        for _ in 0..SWEEPS {
            let turned = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| turn(&mut c, &mut v, i, j));
            if turned == [false; 3] {
                break;
            }
        }
        let stretches = Vec3::from_fn(|i, _| c[(i, i)].sqrt());
        let u = p * v * Mat3::from_diagonal(&stretches.map(f64::recip));
        Some(Self {
            outer: nearest_sign(rotation(&u), &self.outer),
            stretches,
            inner: nearest_sign(rotation(&v.transpose()), &self.inner),
        })
    }

    /// U S Vᵀ.
    pub fn product(&self) -> Mat3 {
        let [outer, inner] = [self.outer, self.inner].map(|q| q.to_rotation_matrix().into_inner());
        outer * Mat3::from_diagonal(&self.stretches) * inner
    }

    /// What a player of the animation shows at a part of the way to the next key: rotations turned on, on the shorter
    /// way, and scales in proportion.
    pub fn between(&self, to: &Self, part: f64) -> Self {
        Self {
            outer: turned_on(&self.outer, &to.outer, part),
            stretches: self.stretches.lerp(&to.stretches, part),
            inner: turned_on(&self.inner, &to.inner, part),
        }
    }
}

/// Half-way between two placement gradients: their rotations turned half-way, their stretches √(PᵀP) averaged.
pub(super) fn natural_mean(p: &Mat3, q: &Mat3) -> Option<Mat3> {
    let [a, b] = [p, q].map(|gradient| {
        let factors = GradientFactors::identity().follow(gradient)?;
        let turn = factors.outer * factors.inner;
        Some((turn, turn.to_rotation_matrix().into_inner().transpose() * gradient))
    });
    let ((turn_a, stretch_a), (turn_b, stretch_b)) = (a?, b?);
    Some(turned_on(&turn_a, &turn_b, 0.5).to_rotation_matrix().into_inner() * (0.5 * (stretch_a + stretch_b)))
}

/// One rotation of Jacobi's in the plane (i, j), if it is worth one.
///
/// tan φ is the smaller root of t² + 2θt − 1 = 0, θ = (c_jj − c_ii)/2c_ij. Source: Golub and Van Loan, *Matrix
/// Computations*, 8.5.
fn turn(c: &mut Mat3, v: &mut Mat3, i: usize, j: usize) -> bool {
    let beside = c[(i, j)];
    if beside.abs() <= DIAGONAL * (c[(i, i)] * c[(j, j)]).sqrt() {
        return false;
    }
    let theta = (c[(j, j)] - c[(i, i)]) / (2.0 * beside);
    let tangent = theta.signum() / (theta.abs() + libm::hypot(theta, 1.0));
    let cosine = libm::hypot(tangent, 1.0).recip();
    let sine = tangent * cosine;
    let mut jacobi = Mat3::identity();
    (jacobi[(i, i)], jacobi[(i, j)], jacobi[(j, i)], jacobi[(j, j)]) = (cosine, sine, -sine, cosine);
    *c = jacobi.transpose() * *c * jacobi;
    *v *= jacobi;
    true
}

/// The quaternion of a matrix that is a rotation to rounding; its length must be one, since the factors of the next key
/// begin at it, and a matrix has its square.
fn rotation(matrix: &Mat3) -> UnitQuaternion<f64> {
    let found = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*matrix));
    UnitQuaternion::new_normalize(found.into_inner())
}

/// The quaternion of the two that mean the same rotation that lies nearer.
pub(super) fn nearest_sign(q: UnitQuaternion<f64>, last: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    if q.coords.dot(&last.coords) < 0.0 { UnitQuaternion::new_unchecked(-q.into_inner()) } else { q }
}

/// Spherical interpolation, on the shorter way.
fn turned_on(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>, part: f64) -> UnitQuaternion<f64> {
    let (a, b) = (a.into_inner(), nearest_sign(*b, a).into_inner());
    let angle = libm::acos(a.coords.dot(&b.coords).min(1.0));
    let weight = |part: f64| if angle > 0.0 { libm::sin(part * angle) } else { part };
    UnitQuaternion::new_normalize(a * weight(1.0 - part) + b * weight(part))
}
