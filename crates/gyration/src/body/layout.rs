//! Where the numbers of a body stand in the state: the only place that knows.
//!
//! | kind        | position | attitude       | velocity | rate  | extra                            |
//! |-------------|----------|----------------|----------|-------|----------------------------------|
//! | rigid       | p₀ (3)   | quaternion (4) | ṗ₀ (3)   | Ω (3) | relaxation modes of the history  |
//! | affine      | p₀ (3)   | P (9)          | ṗ₀ (3)   | Ṗ (9) | relaxation modes of the history  |
//! | contractile | p₀ (3)   | P (9)          | ṗ₀ (3)   | Ṗ (9) | G (9), unless it is prescribed   |
//!
//! Ω is in body axes; P, Ṗ and G stand column by column. A pinned body has neither position nor velocity, a body
//! without inertia neither velocity nor rate. The rates of a body stand where its numbers do: in the slot of the
//! velocity is the acceleration.

use super::{Body, BodyKind};
use crate::fluid::History;
use crate::tensor::{Mat3, Vec3};
use std::ops::Range;

/// Where each sort of a body's numbers stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slots {
    /// The first place of each sort, and the end.
    bounds: [usize; 6],
}

impl Slots {
    /// The slots of a body whose block begins at `start`.
    pub fn of(body: &Body, start: usize) -> Self {
        let moves = usize::from(body.has_inertia());
        Self::laid_out(body, start, moves)
    }

    /// The slots that a body would have with inertia.
    pub fn with_inertia(body: &Body, start: usize) -> Self {
        Self::laid_out(body, start, 1)
    }

    fn laid_out(body: &Body, start: usize, moves: usize) -> Self {
        let free = if body.pin.is_some() { 0 } else { 3 };
        let modes = body.history().map_or(0, History::dimension);
        let (attitude, rate, extra) = match &body.kind {
            BodyKind::Rigid(_) => (4, 3, modes),
            BodyKind::Affine(_) => (9, 9, modes),
            BodyKind::Contractile(contractile) => (9, 9, 9 * usize::from(contractile.contraction.is_driven())),
        };
        let mut end = start;
        let bounds = [0, free, attitude, moves * free, moves * rate, extra].map(|count| {
            end += count;
            end
        });
        Self { bounds }
    }

    /// p₀.
    pub fn position(&self) -> Range<usize> {
        self.bounds[0]..self.bounds[1]
    }

    /// The quaternion, or P.
    pub fn attitude(&self) -> Range<usize> {
        self.bounds[1]..self.bounds[2]
    }

    /// ṗ₀.
    pub fn velocity(&self) -> Range<usize> {
        self.bounds[2]..self.bounds[3]
    }

    /// Ω, or Ṗ.
    pub fn rate(&self) -> Range<usize> {
        self.bounds[3]..self.bounds[4]
    }

    /// G, or the relaxation modes.
    pub fn extra(&self) -> Range<usize> {
        self.bounds[4]..self.bounds[5]
    }

    /// Position and attitude.
    pub fn places(&self) -> Range<usize> {
        self.bounds[0]..self.bounds[2]
    }

    /// Velocity and rate.
    pub fn velocities(&self) -> Range<usize> {
        self.bounds[2]..self.bounds[4]
    }

    /// All of them.
    pub fn block(&self) -> Range<usize> {
        self.bounds[0]..self.bounds[5]
    }
}

/// The vector of three numbers.
#[inline]
pub fn vector(numbers: &[f64]) -> Vec3 {
    Vec3::new(numbers[0], numbers[1], numbers[2])
}

/// The matrix of nine numbers, column by column.
pub fn matrix(numbers: &[f64]) -> Mat3 {
    Mat3::from_column_slice(numbers)
}
