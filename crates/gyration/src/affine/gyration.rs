//! P, Ṗ and what follows from them: P⁻¹, det P, and Eringen's gyration L = Ṗ P⁻¹.

use crate::tensor::{Mat3, cofactor};

/// A gradient and its rate, with det P > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gyration {
    /// P.
    pub gradient: Mat3,
    /// Ṗ [1/s].
    pub rate: Mat3,
    /// P⁻¹.
    pub inverse: Mat3,
    /// det P.
    pub volume_ratio: f64,
    /// L = Ṗ P⁻¹, the velocity gradient [1/s].
    pub velocity_gradient: Mat3,
}

impl Gyration {
    /// Of P and Ṗ.
    ///
    /// # Errors
    /// det P where it is not a positive normal number.
    #[inline(always)]
    pub fn of(gradient: &Mat3, rate: &Mat3) -> Result<Self, f64> {
        let cofactor = cofactor(gradient);
        let volume_ratio = gradient.column(0).dot(&cofactor.column(0));
        if volume_ratio.is_nan() || volume_ratio < f64::MIN_POSITIVE {
            return Err(volume_ratio);
        }
        let inverse = cofactor.transpose() * (1.0 / volume_ratio);
        Ok(Self { gradient: *gradient, rate: *rate, inverse, volume_ratio, velocity_gradient: rate * inverse })
    }
}
