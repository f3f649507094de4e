//! The gap of a plane over the material points of a body: affine in X.

use crate::extended::{Extended, ExtendedVec3};
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
    /// What the two lack of twice their digits, where the gap is far below them.
    pub lack: Option<GapLack>,
}

/// What a gap field lacks of twice its digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapLack {
    /// Of g₀ [m].
    pub height: f64,
    /// Of m.
    pub direction: Vec3,
}

impl GapField {
    /// The field of a height g₀ [m] and m = Pᵀn.
    pub fn new(height: f64, direction: Vec3) -> Self {
        Self { height, direction, lack: None }
    }

    /// The same to twice the digits.
    pub(crate) fn extended(height: Extended, direction: &ExtendedVec3) -> Self {
        let [x, y, z] = direction;
        let lack = GapLack { height: height.low, direction: Vec3::new(x.low, y.low, z.low) };
        Self { height: height.high, direction: Vec3::new(x.high, y.high, z.high), lack: Some(lack) }
    }

    /// The gap d(X) = g₀ + m·X [m] of a material point.
    pub fn gap(&self, point: &Vec3) -> f64 {
        match &self.lack {
            None => self.height + self.direction.dot(point),
            Some(_) => self.extended_gap(point).value(),
        }
    }

    /// The gap of a point to twice the digits, as far as the field has them.
    pub(crate) fn extended_gap(&self, point: &Vec3) -> Extended {
        let (height, direction) = self.parts();
        height + Extended::dot(&direction, point)
    }

    /// g₀ and m to twice the digits, as far as the field has them.
    pub(crate) fn parts(&self) -> (Extended, ExtendedVec3) {
        let lack = self.lack.unwrap_or(GapLack { height: 0.0, direction: Vec3::zeros() });
        let entry = |i: usize| Extended { high: self.direction[i], low: lack.direction[i] };
        (Extended { high: self.height, low: lack.height }, [entry(0), entry(1), entry(2)])
    }
}

/// A point of the surface lies on or behind the plane: outside the model, never clamped.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the surface reaches the plane: smallest gap {gap:e} m")]
pub struct GapClosed {
    /// The smallest gap found [m], ≤ 0 (or NaN).
    pub gap: f64,
}
