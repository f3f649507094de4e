//! The linear maps of 3×3 matrices of which the derivative of the balance consists, and their images of one entry:
//!
//!   δP ↦ X δPᵀ Y,   U δP V,   W (Z·δP);   of δP = e_j ⊗ e_B column A is   X_B Y_jA,   U_j V_BA,   W_A Z_jB
//!
//! An image takes nine products. The matrices stand in memory, from where any of their numbers can be fetched into all
//! places of a register.

use crate::simd::{F64x4, SimdMat3, SimdVec3};

/// Where the one of δP = e_j ⊗ e_B stands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    pub j: usize,
    pub b: usize,
}

impl Entry {
    /// X δPᵀ Y.
    #[inline(always)]
    pub fn crossed<F: F64x4>(self, x: &SimdMat3, y: &SimdMat3, registers: F) -> SimdMat3<F> {
        let Self { j, b } = self;
        dyad(&x.0[b], [y.at(j, 0), y.at(j, 1), y.at(j, 2)], registers)
    }

    /// U δP V.
    #[inline(always)]
    pub fn straight<F: F64x4>(self, u: &SimdMat3, v: &SimdMat3, registers: F) -> SimdMat3<F> {
        let Self { j, b } = self;
        dyad(&u.0[j], [v.at(b, 0), v.at(b, 1), v.at(b, 2)], registers)
    }

    /// W (Z·δP).
    #[inline(always)]
    pub fn whole<F: F64x4>(self, w: &SimdMat3, z: &SimdMat3, registers: F) -> SimdMat3<F> {
        w.with(registers) * z.at(self.j, self.b)
    }
}

/// a ⊗ (x, y, z).
#[inline(always)]
fn dyad<F: F64x4>(a: &SimdVec3, [x, y, z]: [f64; 3], registers: F) -> SimdMat3<F> {
    let a = SimdVec3(registers.like(a.0));
    SimdMat3([a * x, a * y, a * z])
}
