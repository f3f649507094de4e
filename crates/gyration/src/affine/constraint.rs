//! det P = 1 as a constraint. Twice differentiated it reads tr(P̈ P⁻¹) = tr(L²); with B = M − V(S_e + S_v)
//!
//!   π V a = tr(L²) − tr(B J⁻¹ P⁻¹),   a = tr(P⁻ᵀ J⁻¹ P⁻¹),   P̈ = (B + π V P⁻ᵀ) J⁻¹
//!
//! The corrections after a step go the way in which a pressure would push: δP, δṖ ∝ P⁻ᵀ J⁻¹. Then δṖ J Pᵀ is a multiple of I:
//! the spin is left alone. Source: `physics.md` §4.

use super::{AffineBody, Gyration};
use crate::tensor::Mat3;

/// The pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Constraint {
    /// π [Pa].
    pub pressure: f64,
}

impl Constraint {
    /// The pressure for B.
    pub fn solve(body: &AffineBody, gyration: &Gyration, free: &Mat3) -> Self {
        let l = &gyration.gradient;
        let across = body.inverse * gyration.inverse;
        let lacking = l.dot(&l.transpose()) - free.dot(&across.transpose());
        Self { pressure: lacking / (body.volume * gyration.inverse.dot(&across)) }
    }

    /// π V P⁻ᵀ.
    pub fn reaction(&self, body: &AffineBody, gyration: &Gyration) -> Mat3 {
        self.pressure * body.volume * gyration.inverse.transpose()
    }
}

/// What the derivative of the pressure needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ConstraintSlopes {
    pressure: f64,
    /// a.
    stiffness: f64,
    /// J⁻¹ P⁻¹.
    across: Mat3,
    /// (B J⁻¹)ᵀ.
    driven: Mat3,
}

impl ConstraintSlopes {
    pub fn new(body: &AffineBody, gyration: &Gyration, free: &Mat3) -> Self {
        let across = body.inverse * gyration.inverse;
        Self {
            pressure: Constraint::solve(body, gyration, free).pressure,
            stiffness: gyration.inverse.dot(&across),
            across,
            driven: (free * body.inverse).transpose(),
        }
    }

    /// The changes of π V P⁻ᵀ and of π.
    pub fn apply(&self, body: &AffineBody, gyration: &Gyration, change: &Gyration, dfree: &Mat3) -> (Mat3, f64) {
        let lacking = 2.0 * gyration.gradient.dot(&change.gradient.transpose())
            - dfree.dot(&self.across.transpose())
            - self.driven.dot(&change.inverse);
        let dstiffness = 2.0 * self.across.dot(&change.inverse);
        let dpressure = lacking / (body.volume * self.stiffness) - self.pressure * dstiffness / self.stiffness;
        let reaction = dpressure * gyration.inverse.transpose() + self.pressure * change.inverse.transpose();
        (body.volume * reaction, dpressure)
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
        let across = body.inverse * inverse;
        let step = excess / ((1.0 + excess) * inverse.dot(&across));
        gradient -= step * across.transpose();
    }
    let Some(inverse) = gradient.try_inverse() else { return Correction { gradient: *p, rate: *rate, size } };
    let across = body.inverse * inverse;
    let spread = rate.dot(&inverse.transpose());
    Correction { gradient, rate: rate - spread / inverse.dot(&across) * across.transpose(), size }
}
