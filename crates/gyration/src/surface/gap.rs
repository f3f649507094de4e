//! The gap of a plane over the material points of a body: affine in X.

use crate::tensor::Vec3;

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

/// A point of the surface lies on or behind the plane: outside the model, never clamped.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the surface reaches the plane: smallest gap {gap:e} m")]
pub struct GapClosed {
    /// The smallest gap found [m], ≤ 0 (or NaN).
    pub gap: f64,
}
