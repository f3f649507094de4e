//! The ends of segments and the moments along them: what all formulas for segments share.

use pulp::Simd;

use super::LineKernel;
use crate::simd::{F64s, Log2, SplitExponent, integer_power};
use crate::surface::Kernel;

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

/// A kernel as the ends of segments need it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EndKernel<'a> {
    pub line: &'a LineKernel,
    exponent: SplitExponent,
    needs_log: bool,
}

impl<'a> EndKernel<'a> {
    /// Of a kernel that is prepared for segments.
    pub fn new(line: &'a LineKernel) -> Self {
        let exponent = match line.kernel {
            Kernel::Power(exponent) => exponent,
            Kernel::Log => 1.0,
        };
        Self { line, exponent: SplitExponent::new(exponent), needs_log: line.needs_log_in_registers() }
    }

    /// The ends at these gaps.
    #[inline(always)]
    pub fn at<S: Simd>(&self, gap: F64s<S>) -> End<S> {
        let inverse = 1.0 / gap;
        let log = if self.needs_log { Log2::new(gap) } else { Log2::unread(gap.simd) };
        let power = match self.line.integer {
            Some(exponent) => integer_power(gap, inverse, exponent),
            None => log.negative_power(&self.exponent),
        };
        End { gap, inverse, power, log }
    }

    /// The kernel itself at an end.
    #[inline(always)]
    pub fn value<S: Simd>(&self, end: &End<S>) -> F64s<S> {
        match self.line.kernel {
            Kernel::Power(_) => end.power,
            Kernel::Log => end.log.natural(),
        }
    }
}

/// Moments that are all zero.
#[inline(always)]
pub(super) fn zeros<S: Simd>(end: &End<S>) -> LineMoments<F64s<S>> {
    [F64s::splat(end.gap.simd, 0.0); HIGHEST_DEGREE + 1]
}
