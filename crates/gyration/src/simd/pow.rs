//! Logarithm and real power in registers, to a few units in the last place.
//!
//!   d = 2^k m, √½ ≤ m < √2:   log₂ d = k + log₂ m,   log₂ m = 2/ln 2 (s + s³/3 + s⁵/5 + …),   s = (m − 1)/(m + 1)
//!   d^−ν = 2^(−ν k) 2^(−ν log₂ m)
//!
//! The integer part k and the fraction stay apart: −ν k is formed without error from ν = high + low, and the power is
//! as accurate for a gap of 1e-9 m as for one of 1 m. Only normal positive numbers; they are gaps.

use pulp::Simd;
use pulp::bytemuck::cast_slice_mut;

use super::register::F64s;
use std::f64::consts::LN_2;

/// Bits of the fraction of an f64.
const FRACTION_BITS: u32 = 52;
/// The exponent of 1.
const BIAS: u64 = 1023;
/// 2^52, which added to an integer puts it into the low bits.
const MAGIC: f64 = 4_503_599_627_370_496.0;
/// Terms of the series of the logarithm: s² ≤ 0.0295, so that the next is below 1e-17 of the first.
const LOG_TERMS: usize = 11;
/// Terms of e^z for |z| ≤ ln 2/2: the next is below 1e-17.
const EXP_TERMS: usize = 15;

/// 2/((2n + 1) ln 2).
const LOG_SERIES: [f64; LOG_TERMS] = {
    let mut series = [0.0; LOG_TERMS];
    let mut n = 0;
    while n < LOG_TERMS {
        series[n] = 2.0 / ((2 * n + 1) as f64 * LN_2);
        n += 1;
    }
    series
};

/// 1/n!.
const EXP_SERIES: [f64; EXP_TERMS] = {
    let mut series = [1.0; EXP_TERMS];
    let mut n = 1;
    while n < EXP_TERMS {
        series[n] = series[n - 1] / n as f64;
        n += 1;
    }
    series
};

/// The binary logarithm of a positive number, in two parts.
#[derive(Clone, Copy)]
pub(crate) struct Log2<S: Simd> {
    /// k.
    integer: F64s<S>,
    /// log₂ m, between −½ and ½.
    fraction: F64s<S>,
}

/// A real exponent as a sum: `high` has 30 bits, so that its product with an integer part is exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SplitExponent {
    high: f64,
    low: f64,
}

impl SplitExponent {
    /// Splits ν.
    pub fn new(exponent: f64) -> Self {
        let high = f64::from_bits(exponent.to_bits() & !((1 << (FRACTION_BITS - 30)) - 1));
        Self { high, low: exponent - high }
    }
}

impl<S: Simd> Log2<S> {
    /// log₂ d; d must be a normal positive number.
    #[inline(always)]
    pub fn new(d: F64s<S>) -> Self {
        let (integer, m) = exponent_and_mantissa(d, std::f64::consts::FRAC_1_SQRT_2);
        let s = (m - 1.0) / (m + 1.0);
        Self { integer, fraction: s * polynomial(&LOG_SERIES, s * s) }
    }

    /// log₂ 1 in every lane, where none is read.
    #[inline(always)]
    pub fn unread(simd: S) -> Self {
        let zero = F64s::splat(simd, 0.0);
        Self { integer: zero, fraction: zero }
    }

    /// ln d.
    #[inline(always)]
    pub fn natural(&self) -> F64s<S> {
        (self.integer + self.fraction) * LN_2
    }

    /// ln(e/d), free of cancellation between the integer parts.
    #[inline(always)]
    pub fn natural_ratio_to(&self, e: &Self) -> F64s<S> {
        ((e.integer - self.integer) + (e.fraction - self.fraction)) * LN_2
    }

    /// d^−ν; infinite or zero where that is out of range.
    #[inline(always)]
    pub fn negative_power(&self, exponent: &SplitExponent) -> F64s<S> {
        /// 1.5 · 2^52: adding and subtracting it rounds to an integer of either sign.
        const ROUND: f64 = 1.5 * MAGIC;
        let simd = self.integer.simd;
        let coarse = self.integer * -exponent.high;
        let fine = self.fraction * -(exponent.high + exponent.low) - self.integer * exponent.low;
        let rounded = ((coarse + fine) + ROUND) - ROUND;
        let small = (coarse - rounded) + fine;
        let mantissa = polynomial(&EXP_SERIES, small * LN_2);
        // Exponents 0 and 2047 of the format stand for zero and infinity.
        let (lowest, highest) = (F64s::splat(simd, -(BIAS as f64)), F64s::splat(simd, BIAS as f64 + 1.0));
        let clamped = rounded.less_than(lowest).select(lowest, rounded);
        let clamped = highest.less_than(clamped).select(highest, clamped);
        let mut bits = simd.transmute_u64s_f64s((clamped + (MAGIC + BIAS as f64)).values);
        for number in cast_slice_mut::<S::u64s, u64>(std::slice::from_mut(&mut bits)) {
            *number <<= FRACTION_BITS;
        }
        mantissa * F64s { simd, values: simd.transmute_f64s_u64s(bits) }
    }
}

/// k and m of d = 2^k m, least ≤ m < 2 least; d must be a normal positive number, ½ < least ≤ 1.
#[inline(always)]
pub(crate) fn exponent_and_mantissa<S: Simd>(d: F64s<S>, least: f64) -> (F64s<S>, F64s<S>) {
    let simd = d.simd;
    let bits = simd.transmute_u64s_f64s(d.values);
    // Moved so that the exponent steps at least · 2^k instead of at 2^k.
    let offset = (BIAS << FRACTION_BITS) - least.to_bits();
    let moved = simd.add_u64s(bits, simd.splat_u64s(offset));
    let mut exponent = moved;
    for number in cast_slice_mut::<S::u64s, u64>(std::slice::from_mut(&mut exponent)) {
        *number >>= FRACTION_BITS;
    }
    let in_low_bits = simd.or_u64s(exponent, simd.splat_u64s(MAGIC.to_bits()));
    let integer = F64s { simd, values: simd.transmute_f64s_u64s(in_low_bits) } - (MAGIC + BIAS as f64);
    let exponent_only = simd.and_u64s(moved, simd.splat_u64s(!((1 << FRACTION_BITS) - 1)));
    let mantissa = simd.add_u64s(simd.sub_u64s(bits, exponent_only), simd.splat_u64s(BIAS << FRACTION_BITS));
    (integer, F64s { simd, values: simd.transmute_f64s_u64s(mantissa) })
}

/// Σ c_n x^n by Horner in x², the odd terms beside the even ones.
#[inline(always)]
pub(crate) fn polynomial<S: Simd, const N: usize>(coefficients: &[f64; N], x: F64s<S>) -> F64s<S> {
    let squared = x * x;
    let mut sums = [F64s::splat(x.simd, 0.0); 2];
    for n in (0..N).rev() {
        let sum = &mut sums[n % 2];
        *sum = if n + 2 >= N { F64s::splat(x.simd, coefficients[n]) } else { *sum * squared + coefficients[n] };
    }
    sums[0] + x * sums[1]
}

/// d^−n for an integer n of either sign, from d and 1/d.
#[inline(always)]
pub(crate) fn integer_power<S: Simd>(gap: F64s<S>, inverse: F64s<S>, exponent: i32) -> F64s<S> {
    let mut base = if exponent >= 0 { inverse } else { gap };
    let mut remaining = exponent.unsigned_abs();
    let mut power = F64s::splat(gap.simd, 1.0);
    while remaining > 0 {
        if remaining & 1 == 1 {
            power = power * base;
        }
        base = base * base;
        remaining >>= 1;
    }
    power
}

#[cfg(test)]
mod tests {
    use super::super::register::{Row, WIDTH, dispatch, registers_mut};
    use super::*;
    use pulp::WithSimd;

    /// d^−ν and ln d of a row.
    struct RowPowers {
        gaps: Row,
        exponent: SplitExponent,
    }

    impl WithSimd for RowPowers {
        type Output = (Row, Row);

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> (Row, Row) {
            let mut out = ([0.0; WIDTH], [0.0; WIDTH]);
            for register in 0..WIDTH / S::F64_LANES {
                let log = Log2::new(F64s::load(simd, &self.gaps, register));
                registers_mut::<S>(&mut out.0)[register] = log.negative_power(&self.exponent).values;
                registers_mut::<S>(&mut out.1)[register] = log.natural().values;
            }
            out
        }
    }

    #[test]
    fn powers_and_logarithms_agree_with_the_library() {
        let mut worst = (0.0_f64, 0.0_f64);
        for decade in -12..7 {
            for step in 0..40 {
                let gaps: Row =
                    std::array::from_fn(|i| 10_f64.powi(decade) * (1.0 + 0.2231 * (i + 8 * step) as f64 / 8.0));
                for exponent in [-1.0, -0.3, 0.5, 1.0, 3.2, 6.3, 12.7, 17.0] {
                    let (powers, logs) = dispatch(RowPowers { gaps, exponent: SplitExponent::new(exponent) });
                    for i in 0..WIDTH {
                        worst.0 = worst.0.max((powers[i] / gaps[i].powf(-exponent) - 1.0).abs());
                        worst.1 = worst.1.max((logs[i] - gaps[i].ln()).abs() / gaps[i].ln().abs().max(1e-3));
                    }
                }
            }
        }
        println!("powers: worst relative error {:.1e}; logarithms {:.1e}", worst.0, worst.1);
        // 17 · ½ · ε from the fraction of the logarithm, and a few ε besides.
        assert!(worst.0 < 3e-15 && worst.1 < 1e-15, "{worst:?}");
    }

    #[test]
    fn powers_out_of_range_are_zero_or_infinite() {
        let mut gaps = [1.0; WIDTH];
        gaps[..4].copy_from_slice(&[1e-200, 1e200, 2e-154, 1e154]);
        let (powers, _) = dispatch(RowPowers { gaps, exponent: SplitExponent::new(2.5) });
        assert_eq!(powers[..4], [f64::INFINITY, 0.0, f64::INFINITY, 0.0]);
    }
}
