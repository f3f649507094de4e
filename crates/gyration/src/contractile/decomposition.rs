//! P = F G at one instant.
//!
//!   F = P G⁻¹,   F⁻¹ = G P⁻¹,   Λ = F⁻¹ L F

use crate::tensor::{Mat3, cofactor};

/// A contraction and what follows from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decomposition {
    /// G.
    pub contraction: Mat3,
    /// G⁻¹.
    pub inverse: Mat3,
    /// g = det G.
    pub volume_ratio: f64,
    /// F.
    pub elastic: Mat3,
}

impl Decomposition {
    /// Of P and G.
    ///
    /// # Errors
    /// det G where it is not a positive normal number.
    #[inline(always)]
    pub fn of(gradient: &Mat3, contraction: &Mat3) -> Result<Self, f64> {
        let cofactor = cofactor(contraction);
        let volume_ratio = contraction.column(0).dot(&cofactor.column(0));
        if volume_ratio.is_nan() || volume_ratio < f64::MIN_POSITIVE {
            return Err(volume_ratio);
        }
        let inverse = cofactor.transpose() * (1.0 / volume_ratio);
        Ok(Self { contraction: *contraction, inverse, volume_ratio, elastic: gradient * inverse })
    }
}
