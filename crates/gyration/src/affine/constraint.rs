//! det P = 1 as a constraint. Twice differentiated it reads tr(P̈ P⁻¹) = tr(L²). A pressure accelerates P along Y:
//!
//!   P̈ = B J⁻¹ + π V Y,   Y = P⁻ᵀ J⁻¹,   π V a = tr(L²) − tr(B J⁻¹ P⁻¹),   a = tr(Y P⁻¹)
//!
//! with B = M − V(S_e + S_v). The corrections after a step go the same way, δP, δṖ ∝ Y: then δṖ J Pᵀ is a multiple of
//! I, and the spin is left alone. Source: `docs/theory-affine.md`.

use super::AffineBody;
use crate::simd::{F64x4, SimdMat3};
use crate::tensor::Mat3;

/// The way in which a pressure pushes, and what it takes to do so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Constraint<F = [f64; 4]> {
    /// Y.
    pub way: SimdMat3<F>,
    /// 1/a.
    pub compliance: f64,
}

impl<F: F64x4> Constraint<F> {
    /// Of a body where P⁻ᵀ is `across`.
    #[inline(always)]
    pub fn new(body: &AffineBody, across: &SimdMat3<F>) -> Self {
        let way = body.per_inertia(across);
        Self { way, compliance: 1.0 / way.dot(across) }
    }

    /// δ(π V) that takes tr(P̈ P⁻¹) = B·Y from that of a moment B to the one asked for.
    #[inline(always)]
    pub fn push(&self, moment: &SimdMat3<F>, asked: f64) -> f64 {
        (asked - moment.dot(&self.way)) * self.compliance
    }
}

/// A configuration and a velocity on the constraint, and how far they were from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correction {
    /// P with det P = 1.
    pub gradient: Mat3,
    /// Ṗ with tr L = 0 [1/s].
    pub rate: Mat3,
    /// |det P − 1| before.
    pub size: f64,
}

impl Correction {
    /// Nothing to correct.
    pub fn none(p: &Mat3, rate: &Mat3) -> Self {
        Self { gradient: *p, rate: *rate, size: 0.0 }
    }
}

/// Newton's iterations at most: the error of a step is squared by each, so that two do; a start from a file may be far.
const ITERATIONS: usize = 20;
/// The rounding of a determinant of order one.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Puts P and Ṗ back to det P = `volume` and tr L = `growth`, in which P differs from one on the constraint by a
/// factor.
pub(super) fn project_to(body: &AffineBody, (p, rate): (&Mat3, &Mat3), volume: f64, growth: f64) -> Correction {
    let scale = libm::cbrt(volume);
    let still = rate - p * (growth / 3.0);
    let correction = project(body, &(p / scale), &(still / scale));
    let gradient = correction.gradient * scale;
    Correction { gradient, rate: correction.rate * scale + gradient * (growth / 3.0), size: correction.size }
}

/// Puts P and Ṗ back on the constraint.
pub(super) fn project(body: &AffineBody, p: &Mat3, rate: &Mat3) -> Correction {
    let size = (p.determinant() - 1.0).abs();
    let mut gradient = *p;
    for _ in 0..ITERATIONS {
        let excess = gradient.determinant() - 1.0;
        let Some(inverse) = gradient.try_inverse() else { return Correction { gradient: *p, rate: *rate, size } };
        if excess.abs() <= ROUNDING {
            break;
        }
        // d det P = det P tr(P⁻¹ δP) = (1 + excess) a s along δP = s P⁻ᵀ J⁻¹.
        let across = way(body, &inverse);
        let step = excess / ((1.0 + excess) * inverse.dot(&across));
        gradient -= step * across.transpose();
    }
    let Some(inverse) = gradient.try_inverse() else { return Correction { gradient: *p, rate: *rate, size } };
    let across = way(body, &inverse);
    let spread = rate.dot(&inverse.transpose());
    Correction { gradient, rate: rate - spread / inverse.dot(&across) * across.transpose(), size }
}

/// Yᵀ = J⁻¹ P⁻¹, as far as the body may go that way.
fn way(body: &AffineBody, inverse: &Mat3) -> Mat3 {
    if body.guide.is_some() { body.way(inverse).transpose() } else { body.inverse * inverse }
}
