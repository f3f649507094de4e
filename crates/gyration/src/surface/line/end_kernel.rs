//! The powers and logarithms of gaps at the ends of segments, as a kernel needs them.

use pulp::Simd;

use super::ends::End;
use super::kernel::LineKernel;
use crate::simd::{F64s, Log2, SplitExponent, integer_power};
use crate::surface::Kernel;

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
