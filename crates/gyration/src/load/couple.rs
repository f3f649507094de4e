//! A uniform affine moment N on a body, constant or given in time.
//!
//!   M = Nᵀ P⁻ᵀ,   power M·Ṗ = tr(N L)
//!
//! sym N stretches, skw N turns; N is spatial and does not follow the body. A table is linear between its times, so
//! that a run has to end a step at each of them. Source: Sławianowski (1975) §2, (4.3).

use crate::signal::TensorTable;
use crate::tensor::Mat3;

/// An affine moment N [N m] that acts on a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Couple {
    /// The same at all times.
    Constant(Mat3),
    /// Given at times, linear between them, at its first and last value outside.
    Table(TensorTable),
}

impl Couple {
    /// N [N m] at a time.
    pub fn at(&self, time: f64) -> Mat3 {
        match self {
            Self::Constant(value) => *value,
            Self::Table(table) => table.jet(time).value,
        }
    }

    /// The first time after this one at which N has a kink [s].
    pub fn next_kink(&self, time: f64) -> Option<f64> {
        match self {
            Self::Constant(_) => None,
            Self::Table(table) => table.next_knot(time),
        }
    }

    /// M = Nᵀ P⁻ᵀ [N m] at a time; P⁻¹ is given.
    pub fn moment(&self, time: f64, inverse: &Mat3) -> Mat3 {
        (inverse * self.at(time)).transpose()
    }
}
