//! Linear combinations of stage rates, u = u₀ + h Σ a_j k_j, on as many components at once as a register holds.
//!
//! The instruction set is found at run time. A component's sum runs over the stages in the order of the row, products
//! and sums rounded one by one: every width of registers gives the same bytes.

use pulp::{Arch, Simd, WithSimd};

use crate::prince::Row;

/// Rows of rates are padded with zeros to whole groups of as many components as the widest registers hold.
const WIDEST: usize = 8;

/// The rates of the stages, one row after the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rates {
    groups: Vec<[f64; WIDEST]>,
    /// The groups of one row.
    per_row: usize,
    width: usize,
}

impl Rates {
    /// Zeros, for so many stages of vectors of the given width.
    pub fn new(stages: usize, width: usize) -> Self {
        let per_row = width.div_ceil(WIDEST);
        Self { groups: vec![[0.0; WIDEST]; stages * per_row], per_row, width }
    }

    /// The rates of one stage.
    pub fn row(&self, stage: usize) -> &[f64] {
        &self.groups[stage * self.per_row..].as_flattened()[..self.width]
    }

    /// The rates of one stage, to be written.
    pub fn row_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.groups[stage * self.per_row..].as_flattened_mut()[..self.width]
    }

    /// out = base + h Σ a_j k_j.
    pub fn combine(&self, out: &mut [f64], base: &[f64], h: f64, row: Row) {
        Arch::new().dispatch(Combine { rates: self, out, base, h, row });
    }
}

struct Combine<'a> {
    rates: &'a Rates,
    out: &'a mut [f64],
    base: &'a [f64],
    h: f64,
    row: Row,
}

impl WithSimd for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { rates, out, base, h, row } = self;
        let sums = StageSums::<S> { rates: S::as_simd_f64s(rates.groups.as_flattened()).0, row, h: simd.splat_f64s(h) };
        let per_row = rates.per_row * WIDEST / S::F64_LANES;
        let (base, base_rest) = S::as_simd_f64s(base);
        let (out, out_rest) = S::as_mut_simd_f64s(out);
        let (mut done, whole) = (0, out.len());
        while done < whole {
            let (out, base) = (&mut out[done..], &base[done..]);
            // As many as are left, with what a row is padded with if that makes them one tile.
            done += match (whole - done).next_power_of_two().min(per_row - done) {
                1 => sums.add::<1>(simd, (per_row, done), out, base),
                2 | 3 => sums.add::<2>(simd, (per_row, done), out, base),
                4..8 => sums.add::<4>(simd, (per_row, done), out, base),
                _ => sums.add::<8>(simd, (per_row, done), out, base),
            };
        }
        if !out_rest.is_empty() {
            let mut last = [simd.splat_f64s(0.0)];
            sums.add::<1>(simd, (per_row, whole), &mut last, &[simd.partial_load_f64s(base_rest)]);
            simd.partial_store_f64s(out_rest, last[0]);
        }
    }
}

/// What is summed, in registers.
struct StageSums<'a, S: Simd> {
    rates: &'a [S::f64s],
    row: Row,
    h: S::f64s,
}

impl<S: Simd> StageSums<'_, S> {
    /// out = base + h Σ a_j k_j of at most N registers side by side, the place of the first in a row being given;
    /// returns N.
    #[inline(always)]
    fn add<const N: usize>(
        &self,
        simd: S,
        (per_row, first): (usize, usize),
        out: &mut [S::f64s],
        base: &[S::f64s],
    ) -> usize {
        let mut sums = [simd.splat_f64s(0.0); N];
        for &(stage, coefficient) in self.row {
            let coefficient = simd.splat_f64s(coefficient);
            for (sum, rate) in sums.iter_mut().zip(&self.rates[stage * per_row + first..][..N]) {
                *sum = simd.add_f64s(*sum, simd.mul_f64s(coefficient, *rate));
            }
        }
        for ((out, base), sum) in out.iter_mut().zip(base).zip(sums) {
            *out = simd.add_f64s(*base, simd.mul_f64s(self.h, sum));
        }
        N
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prince::WEIGHTS;

    #[test]
    fn combinations_of_any_width_are_the_sums_in_order() {
        let stages = 1 + WEIGHTS.iter().map(|(stage, _)| *stage).max().unwrap_or(0);
        for width in 0..70 {
            let mut rates = Rates::new(stages, width);
            for stage in 0..stages {
                for (i, rate) in rates.row_mut(stage).iter_mut().enumerate() {
                    *rate = ((stage * 31 + i) as f64).sin();
                }
            }
            let base: Vec<f64> = (0..width).map(|i| (i as f64).cos()).collect();
            let (mut widest, mut single) = (vec![0.0; width], vec![0.0; width]);
            rates.combine(&mut widest, &base, 0.37, WEIGHTS);
            Arch::Scalar.dispatch(Combine { rates: &rates, out: &mut single, base: &base, h: 0.37, row: WEIGHTS });
            let direct = |i: usize| {
                let sum = WEIGHTS.iter().fold(0.0, |sum, (stage, a)| sum + a * rates.row(*stage)[i]);
                base[i] + 0.37 * sum
            };
            assert_eq!(widest, single);
            assert_eq!(widest, (0..width).map(direct).collect::<Vec<_>>());
        }
    }
}
