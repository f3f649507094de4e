//! P = F G at one instant: the elastic gradient F, and the velocity gradient seen from the relaxed body.
//!
//!   F = P G⁻¹,   F⁻¹ = G P⁻¹,   Λ = F⁻¹ L F

use crate::affine::Gyration;
use crate::columns::Columns;
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

/// The same in columns, with what the balance needs besides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Split {
    /// F.
    pub elastic: Columns,
    /// F⁻¹.
    pub back: Columns,
    /// Λ.
    pub pulled: Columns,
    /// L.
    pub l: Columns,
    /// P⁻ᵀ.
    pub across: Columns,
}

impl Decomposition {
    /// Of P and G.
    ///
    /// # Errors
    /// det G where it is not a positive normal number.
    #[inline]
    pub fn of(gradient: &Mat3, contraction: &Mat3) -> Result<Self, f64> {
        let cofactor = cofactor(contraction);
        let volume_ratio = contraction.column(0).dot(&cofactor.column(0));
        if volume_ratio.is_nan() || volume_ratio < f64::MIN_POSITIVE {
            return Err(volume_ratio);
        }
        let inverse = cofactor.transpose() * (1.0 / volume_ratio);
        Ok(Self { contraction: *contraction, inverse, volume_ratio, elastic: gradient * inverse })
    }

    #[inline(always)]
    pub(super) fn split(&self, at: &Gyration) -> Split {
        let (elastic, across) = (Columns::of(&self.elastic), Columns::of(&at.inverse).transpose());
        let back = Columns::of(&self.contraction).times_transposed(&across);
        let l = Columns::of(&at.velocity_gradient);
        Split { elastic, back, pulled: back.times(&l).times(&elastic), l, across }
    }
}
