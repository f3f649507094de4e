//! The ends of segments and the moments along them: what all formulas for segments share.

use pulp::Simd;

use crate::simd::{F64s, Log2};

/// The highest degree of a moment along a segment.
pub(crate) const HIGHEST_DEGREE: usize = 5;

/// Moments m_0 … m_5 along a segment, or along those of a register; those above the wanted degree have no meaning.
pub type LineMoments<T> = [T; HIGHEST_DEGREE + 1];

/// Terms of the series for close gaps; for gaps that are closer still fewer are enough.
pub(super) const TERMS: usize = 32;

/// 1/n, for n ≥ 1.
pub(super) const RECIPROCAL: [f64; TERMS + HIGHEST_DEGREE + 3] = {
    let mut table = [0.0; TERMS + HIGHEST_DEGREE + 3];
    let mut n = 1;
    while n < table.len() {
        table[n] = 1.0 / n as f64;
        n += 1;
    }
    table
};

/// What the closed forms need of the ends of the segments.
#[derive(Clone, Copy)]
pub(crate) struct End<S: Simd> {
    /// d [m].
    pub gap: F64s<S>,
    /// 1/d [1/m].
    pub inverse: F64s<S>,
    /// d^−ν (d^−1 for the logarithmic kernel).
    pub power: F64s<S>,
    /// log₂ d.
    pub log: Log2<S>,
}

/// Moments that are all zero.
#[inline(always)]
pub(super) fn zeros<S: Simd>(end: &End<S>) -> LineMoments<F64s<S>> {
    [F64s::splat(end.gap.simd, 0.0); HIGHEST_DEGREE + 1]
}
