//! Division by the Euler tensor, which is diagonal for most bodies.

use crate::simd::{F64x4, SimdMat3};
use crate::tensor::Mat3;

/// J⁻¹.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Mobility {
    Diagonal([f64; 3]),
    Full(SimdMat3),
}

impl Mobility {
    /// Of J⁻¹.
    #[inline(always)]
    pub fn of(inverse: &Mat3) -> Self {
        let inverse = SimdMat3::of(inverse);
        if inverse.is_diagonal() {
            return Self::Diagonal([inverse.at(0, 0), inverse.at(1, 1), inverse.at(2, 2)]);
        }
        Self::Full(inverse)
    }

    /// B J⁻¹.
    #[inline(always)]
    pub fn of_moment<F: F64x4>(&self, moment: &SimdMat3<F>) -> SimdMat3<F> {
        match self {
            Self::Diagonal(factors) => moment.scaled(factors),
            Self::Full(inverse) => moment.times(&inverse.with(moment.0[0].0)),
        }
    }
}
