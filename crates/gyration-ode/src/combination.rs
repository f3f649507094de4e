//! Linear combinations of stage rates, h Σ a_j k_j alone or added to a state, on as many components at once as a
//! register holds.
//!
//! The instruction set is found at run time. A component's sum runs over the stages in the order of the row, products
//! and sums rounded one by one: every width of registers gives the same bytes.

use pulp::{Arch, Simd, WithSimd};

use crate::extended::{Extended, ExtendedMut};
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

    /// Hands Σ a_j k_j to `each`, component by component; a few at once, as they lie in memory.
    pub fn each_sum(&self, row: &[(usize, f64)], mut each: impl FnMut(usize, f64)) {
        for group in 0..self.per_row {
            let mut sums = [-0.0; WIDEST];
            for (stage, coefficient) in row {
                let rates = &self.groups[stage * self.per_row + group];
                sums.iter_mut().zip(rates).for_each(|(sum, rate)| *sum += coefficient * rate);
            }
            let first = group * WIDEST;
            let count = WIDEST.min(self.width - first);
            sums[..count].iter().enumerate().for_each(|(k, sum)| each(first + k, *sum));
        }
    }

    /// out = h Σ a_j k_j.
    pub fn combine(&self, out: &mut [f64], h: f64, row: Row) {
        Arch::new().dispatch(Combine { rates: self, h, row, into: Target::Change(out) });
    }

    /// out = base + h Σ a_j k_j, and what that lacks beside it.
    pub fn add_combined(&self, out: ExtendedMut, base: Extended, h: f64, row: Row) {
        Arch::new().dispatch(Combine { rates: self, h, row, into: Target::Sum(out, base) });
    }
}

/// Where a combination goes.
enum Target<'a> {
    /// It is wanted itself.
    Change(&'a mut [f64]),
    /// It is added to a base.
    Sum(ExtendedMut<'a>, Extended<'a>),
}

struct Combine<'a> {
    rates: &'a Rates,
    h: f64,
    row: Row,
    into: Target<'a>,
}

impl WithSimd for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { rates, h, row, into } = self;
        let per_row = rates.per_row * WIDEST / S::F64_LANES;
        let rates = S::as_simd_f64s(rates.groups.as_flattened()).0;
        let sums = StageSums::<S> { simd, rates, per_row, row, h: simd.splat_f64s(h) };
        match into {
            Target::Change(out) => {
                let (out, rest) = S::as_mut_simd_f64s(out);
                sums.fill(&mut Change { out });
                if !rest.is_empty() {
                    simd.partial_store_f64s(rest, sums.changes::<1>(out.len())[0]);
                }
            }
            Target::Sum(out, base) => {
                let ((high, high_rest), (low, low_rest)) =
                    (S::as_mut_simd_f64s(out.high), S::as_mut_simd_f64s(out.low));
                let ((base, base_rest), (lack, lack_rest)) = (S::as_simd_f64s(base.high), S::as_simd_f64s(base.low));
                let whole = high.len();
                sums.fill(&mut Sum { simd, high, low, base, lack });
                if !high_rest.is_empty() {
                    let (base, lack) = (simd.partial_load_f64s(base_rest), simd.partial_load_f64s(lack_rest));
                    let (sum, lacking) = two_sum(simd, base, lack, sums.changes::<1>(whole)[0]);
                    simd.partial_store_f64s(high_rest, sum);
                    simd.partial_store_f64s(low_rest, lacking);
                }
            }
        }
    }
}

/// base + change and, with what the base lacks, what the sum lacks.
#[inline(always)]
fn two_sum<S: Simd>(simd: S, base: S::f64s, lack: S::f64s, change: S::f64s) -> (S::f64s, S::f64s) {
    let sum = simd.add_f64s(base, change);
    let of_change = simd.sub_f64s(sum, base);
    let of_base = simd.sub_f64s(sum, of_change);
    let error = simd.add_f64s(simd.sub_f64s(base, of_base), simd.sub_f64s(change, of_change));
    (sum, simd.add_f64s(lack, error))
}

/// What is done with the changes of registers side by side.
trait Writer<S: Simd> {
    /// How many whole registers there are.
    fn count(&self) -> usize;

    /// Takes the changes from this register on; those past the end are padding.
    fn put(&mut self, first: usize, changes: &[S::f64s]);
}

struct Change<'a, S: Simd> {
    out: &'a mut [S::f64s],
}

impl<S: Simd> Writer<S> for Change<'_, S> {
    #[inline(always)]
    fn count(&self) -> usize {
        self.out.len()
    }

    #[inline(always)]
    fn put(&mut self, first: usize, changes: &[S::f64s]) {
        for (out, change) in self.out[first..].iter_mut().zip(changes) {
            *out = *change;
        }
    }
}

struct Sum<'a, S: Simd> {
    simd: S,
    high: &'a mut [S::f64s],
    low: &'a mut [S::f64s],
    base: &'a [S::f64s],
    lack: &'a [S::f64s],
}

impl<S: Simd> Writer<S> for Sum<'_, S> {
    #[inline(always)]
    fn count(&self) -> usize {
        self.high.len()
    }

    #[inline(always)]
    fn put(&mut self, first: usize, changes: &[S::f64s]) {
        let out = self.high[first..].iter_mut().zip(&mut self.low[first..]);
        let bases = self.base[first..].iter().zip(&self.lack[first..]);
        for (((high, low), (base, lack)), change) in out.zip(bases).zip(changes) {
            (*high, *low) = two_sum(self.simd, *base, *lack, *change);
        }
    }
}

/// What is summed, in registers.
struct StageSums<'a, S: Simd> {
    simd: S,
    rates: &'a [S::f64s],
    /// The registers of one row.
    per_row: usize,
    row: Row,
    h: S::f64s,
}

impl<S: Simd> StageSums<'_, S> {
    /// Hands all whole registers to a writer.
    #[inline(always)]
    fn fill(&self, writer: &mut impl Writer<S>) {
        let (mut done, whole) = (0, writer.count());
        while done < whole {
            // As many as are left, with what a row is padded with if that makes them one tile.
            done += match (whole - done).next_power_of_two().min(self.per_row - done) {
                1 => self.tile::<1>(done, writer),
                2 | 3 => self.tile::<2>(done, writer),
                4..8 => self.tile::<4>(done, writer),
                _ => self.tile::<8>(done, writer),
            };
        }
    }

    #[inline(always)]
    fn tile<const N: usize>(&self, first: usize, writer: &mut impl Writer<S>) -> usize {
        writer.put(first, &self.changes::<N>(first));
        N
    }

    /// h Σ a_j k_j of N registers side by side, the place of the first in a row being given.
    #[inline(always)]
    fn changes<const N: usize>(&self, first: usize) -> [S::f64s; N] {
        let simd = self.simd;
        let mut sums = [simd.splat_f64s(0.0); N];
        for &(stage, coefficient) in self.row {
            let coefficient = simd.splat_f64s(coefficient);
            for (sum, rate) in sums.iter_mut().zip(&self.rates[stage * self.per_row + first..][..N]) {
                *sum = simd.add_f64s(*sum, simd.mul_f64s(coefficient, *rate));
            }
        }
        for sum in &mut sums {
            *sum = simd.mul_f64s(self.h, *sum);
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extended;
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
            let high: Vec<f64> = (0..width).map(|i| (i as f64).cos()).collect();
            let low: Vec<f64> = high.iter().map(|x| 1e-17 * x).collect();
            let base = Extended { high: &high, low: &low };
            let direct = |i: usize| 0.37 * WEIGHTS.iter().fold(0.0, |sum, (stage, a)| sum + a * rates.row(*stage)[i]);
            let changes: Vec<f64> = (0..width).map(direct).collect();
            let sums: Vec<_> = (0..width).map(|i| extended::two_sum(high[i], changes[i])).collect();
            for arch in [Arch::new(), Arch::Scalar] {
                let combined = |into| arch.dispatch(Combine { rates: &rates, h: 0.37, row: WEIGHTS, into });
                let [mut change, mut sum, mut lack] = std::array::from_fn(|_| vec![0.0; width]);
                combined(Target::Change(&mut change));
                combined(Target::Sum(ExtendedMut { high: &mut sum, low: &mut lack }, base));
                assert_eq!(change, changes);
                assert_eq!(sum, sums.iter().map(|(sum, _)| *sum).collect::<Vec<_>>());
                assert_eq!(lack, sums.iter().zip(&low).map(|((_, error), low)| low + error).collect::<Vec<_>>());
            }
        }
    }
}
