//! Surfaces and the moments of a power of the gap over them: all that contact with a plane needs.
//!
//! Over a homogeneously moving body the gap to a plane and the velocity relative to it are affine in X. Every law of
//! `contact` is a power of the gap times a polynomial in X of degree two at most, so that its force, moment and
//! power follow from
//!
//!   A₀ = ∫ κ(d) dA,  A₁ = ∫ κ(d) X dA,  A₂ = ∫ κ(d) X⊗X dA,  A₃ = ∫ κ(d) X⊗X⊗X dA,   d = g₀ + m·X,
//!
//! over the reference surface, with κ = d^−ν (or ln d, for the potential at ν = 1). A₃ occurs only in derivatives.
//! This module knows no law, no velocity and no time.

use crate::tensor::{Mat3, SymmetricThird, Vec3};

/// The gap of a plane as a function of the material point: d(X) = g₀ + m·X.
///
/// X is relative to the centre of mass; g₀ = (p₀ − o)·n [m] is the height of the centre, m = Pᵀn (3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapField {
    /// g₀, the gap of the centre of mass [m].
    pub height: f64,
    /// m = Pᵀn; a unit vector for a rigid body.
    pub direction: Vec3,
}

impl GapField {
    /// The gap d(X) = g₀ + m·X [m] of a material point.
    pub fn gap(&self, point: &Vec3) -> f64 {
        self.height + self.direction.dot(point)
    }
}

/// The function of the gap under the integral.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kernel {
    /// d^−ν, ν ≥ −1 (a potential has the exponent of its law less one).
    Power(f64),
    /// ln d.
    Log,
}

/// Which moments are wanted: all up to `order` (0 to 3) for one kernel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentRequest {
    /// The function of the gap.
    pub kernel: Kernel,
    /// The highest order wanted, 0 to 3; higher ones are left untouched.
    pub order: usize,
}

/// Moments of a kernel over a surface, about the origin of X.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moments {
    /// A₀ = ∫ κ dA.
    pub zeroth: f64,
    /// A₁ = ∫ κ X dA.
    pub first: Vec3,
    /// A₂ = ∫ κ X⊗X dA, symmetric.
    pub second: Mat3,
    /// A₃ = ∫ κ X⊗X⊗X dA, symmetric.
    pub third: SymmetricThird,
}

/// A point of the surface lies on or behind the plane: outside the model, never clamped.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the surface reaches the plane: smallest gap {gap:e} m")]
pub struct GapClosed {
    /// The smallest gap found [m], ≤ 0 (or NaN).
    pub gap: f64,
}
