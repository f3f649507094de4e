//! A dense symmetric matrix and its Cholesky factor A = L Lᵀ, block by block, on all threads.
//!
//!   for each block column k:  L_kk L_kkᵀ = A_kk,   L_ik = A_ik L_kk⁻ᵀ,   A_ij ← A_ij − L_ik L_jkᵀ   (i ≥ j > k)
//!
//! Rows are contiguous and only the lower triangle is read. Each entry is computed by one thread, as a sum in the order
//! of the columns, products and sums rounded one by one: neither the number of threads nor the width of registers
//! changes a byte.

use gyration_threads::Interruption;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// Rows of a tile; orders are padded to whole tiles.
const TILE: usize = 48;
/// Columns of a block: two tiles of it fit the nearest cache.
const BLOCK: usize = 2 * TILE;
/// Rows and columns of what is summed in registers.
const ROWS: usize = 6;
const COLUMNS: usize = 8;

/// Right-hand sides solved together: one for each motion.
pub(crate) const SIDES: usize = 12;
/// Rows of right-hand sides or solutions.
pub(crate) type Columns = Vec<[f64; SIDES]>;

/// A symmetric matrix, its rows one after the other, padded by an identity.
#[derive(Debug, Clone)]
pub(crate) struct Symmetric {
    pub order: usize,
    pub stride: usize,
    pub values: Vec<f64>,
}

/// Why there is no factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoFactor {
    /// The pivot of this row is not positive: the first of them.
    NotDefinite(usize),
    /// It was given up.
    Interrupted,
}

impl NoFactor {
    /// The same with another row to name.
    pub fn in_row(self, row: usize) -> Self {
        match self {
            Self::NotDefinite(_) => Self::NotDefinite(row),
            Self::Interrupted => self,
        }
    }
}

/// L of A = L Lᵀ.
#[derive(Debug)]
pub(crate) struct Factor(Symmetric);

/// The bytes that a matrix of this order takes.
pub(crate) fn bytes(order: usize) -> u64 {
    let stride = order.next_multiple_of(BLOCK) as u64;
    8 * stride * stride
}

impl Symmetric {
    /// Zeros.
    pub fn new(order: usize) -> Self {
        let stride = order.next_multiple_of(BLOCK);
        let mut values = vec![0.0; stride * stride];
        (order..stride).for_each(|pad| values[pad * (stride + 1)] = 1.0);
        Self { order, stride, values }
    }

    /// A ← A + Aᵀ within the order, tile by tile; `add(i, j)` is added besides.
    pub fn symmetrize(&mut self, add: impl Fn(usize, usize) -> f64) {
        let (order, stride) = (self.order, self.stride);
        for top in (0..order).step_by(TILE) {
            for left in (0..=top).step_by(TILE) {
                for i in top..order.min(top + TILE) {
                    for j in left..(i + 1).min(left + TILE) {
                        let sum = self.values[i * stride + j] + self.values[j * stride + i] + add(i, j);
                        self.values[i * stride + j] = sum;
                        self.values[j * stride + i] = sum;
                    }
                }
            }
        }
    }

    /// The factor, in the place of the matrix.
    ///
    /// # Errors
    /// [`NoFactor`].
    pub fn factor(mut self) -> Result<Factor, NoFactor> {
        let stride = self.stride;
        let mut tiles = Vec::new();
        for start in (0..stride).step_by(BLOCK) {
            if Interruption::due().is_some() {
                return Err(NoFactor::Interrupted);
            }
            let end = start + BLOCK;
            let (above, below) = self.values.split_at_mut(end * stride);
            let diagonal = factor_diagonal(&mut above[start * stride..], stride, start)?;
            tiles.resize((stride - end) * BLOCK, 0.0);
            let rows = below.par_chunks_mut(TILE * stride).zip(tiles.par_chunks_mut(TILE * BLOCK));
            rows.for_each(|(rows, tile)| solve_tile(&diagonal, rows, tile, (stride, start)));
            let rows = below.par_chunks_mut(TILE * stride).enumerate();
            rows.for_each(|(row, values)| Arch::new().dispatch(Update { row, values, tiles: &tiles, stride, end }));
        }
        Ok(Factor(self))
    }
}

/// Factors the diagonal block and returns it.
fn factor_diagonal(rows: &mut [f64], stride: usize, start: usize) -> Result<Vec<[f64; BLOCK]>, NoFactor> {
    let mut block = vec![[0.0; BLOCK]; BLOCK];
    for i in 0..BLOCK {
        let (done, this) = block.split_at_mut(i);
        let row = &mut this[0];
        row[..=i].copy_from_slice(&rows[i * stride + start..][..=i]);
        for (j, above) in done.iter().enumerate() {
            let sum = row[..j].iter().zip(&above[..j]).fold(row[j], |sum, (a, b)| sum - a * b);
            row[j] = sum / above[j];
        }
        let pivot = row[..i].iter().fold(row[i], |sum, a| sum - a * a);
        if pivot.is_nan() || pivot <= 0.0 {
            return Err(NoFactor::NotDefinite(start + i));
        }
        row[i] = pivot.sqrt();
        rows[i * stride + start..][..=i].copy_from_slice(&row[..=i]);
    }
    Ok(block)
}

/// L_ik = A_ik L_kk⁻ᵀ for a tile of rows; `tile` receives it column by column.
fn solve_tile(diagonal: &[[f64; BLOCK]], rows: &mut [f64], tile: &mut [f64], (stride, start): (usize, usize)) {
    let (columns, _) = tile.as_chunks_mut::<TILE>();
    for (r, row) in rows.chunks(stride).enumerate() {
        columns.iter_mut().zip(&row[start..]).for_each(|(column, value)| column[r] = *value);
    }
    for (k, factors) in diagonal.iter().enumerate() {
        let (done, this) = columns.split_at_mut(k);
        let column = &mut this[0];
        for (before, factor) in done.iter().zip(factors) {
            (0..TILE).for_each(|r| column[r] -= factor * before[r]);
        }
        column.iter_mut().for_each(|value| *value /= factors[k]);
    }
    for (r, row) in rows.chunks_mut(stride).enumerate() {
        columns.iter().zip(&mut row[start..]).for_each(|(column, value)| *value = column[r]);
    }
}

/// A_ij ← A_ij − L_ik L_jkᵀ for a tile of rows i and all tiles j ≤ i behind the block.
struct Update<'a> {
    row: usize,
    values: &'a mut [f64],
    tiles: &'a [f64],
    stride: usize,
    end: usize,
}

impl WithSimd for Update<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let tile = |index: usize| &self.tiles[index * TILE * BLOCK..][..TILE * BLOCK];
        let rows = tile(self.row);
        for other in 0..=self.row {
            let columns = tile(other);
            for j in (0..TILE).step_by(COLUMNS) {
                for i in (0..TILE).step_by(ROWS) {
                    let sums = products::<S>(simd, &rows[i..], &columns[j..]);
                    for (k, sum) in sums.iter().enumerate() {
                        let at = (i + k) * self.stride + self.end + other * TILE + j;
                        let out = &mut self.values[at..at + COLUMNS];
                        out.iter_mut().zip(sum).for_each(|(out, sum)| *out -= sum);
                    }
                }
            }
        }
    }
}

/// Registers of a row of columns.
const MOST_REGISTERS: usize = COLUMNS;

/// Σ_k a_k b_kᵀ over the columns of two tiles.
#[inline(always)]
fn products<S: Simd>(simd: S, rows: &[f64], columns: &[f64]) -> [[f64; COLUMNS]; ROWS] {
    match COLUMNS / S::F64_LANES {
        1 => products_of::<S, 1>(simd, rows, columns),
        2 => products_of::<S, 2>(simd, rows, columns),
        4 => products_of::<S, 4>(simd, rows, columns),
        _ => products_of::<S, MOST_REGISTERS>(simd, rows, columns),
    }
}

#[inline(always)]
fn products_of<S: Simd, const N: usize>(simd: S, rows: &[f64], columns: &[f64]) -> [[f64; COLUMNS]; ROWS] {
    let mut sums = [[simd.splat_f64s(0.0); N]; ROWS];
    for (a, b) in rows.chunks(TILE).zip(columns.chunks(TILE)) {
        let (b, _) = S::as_simd_f64s(&b[..COLUMNS]);
        for (sum, a) in sums.iter_mut().zip(&a[..ROWS]) {
            let a = simd.splat_f64s(*a);
            for (sum, b) in sum.iter_mut().zip(&b[..N]) {
                *sum = simd.add_f64s(*sum, simd.mul_f64s(a, *b));
            }
        }
    }
    let mut out = [[0.0; COLUMNS]; ROWS];
    for (out, sum) in out.iter_mut().zip(&sums) {
        let (out, _) = S::as_mut_simd_f64s(out);
        out.copy_from_slice(sum);
    }
    out
}

impl Factor {
    /// A⁻¹ B, in the place of B.
    pub fn solve(&self, sides: &mut Columns) {
        let Symmetric { order, stride, values } = &self.0;
        for i in 0..*order {
            let row = &values[i * stride..][..=i];
            let (done, this) = sides.split_at_mut(i);
            let sum = row.iter().zip(done.iter()).fold(this[0], |mut sum, (l, x)| {
                (0..SIDES).for_each(|c| sum[c] -= l * x[c]);
                sum
            });
            this[0] = sum.map(|s| s / row[i]);
        }
        for i in (0..*order).rev() {
            let row = &values[i * stride..][..=i];
            let (before, this) = sides.split_at_mut(i);
            this[0] = this[0].map(|s| s / row[i]);
            for (l, x) in row.iter().zip(before) {
                (0..SIDES).for_each(|c| x[c] -= l * this[0][c]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A well-conditioned matrix of sines.
    fn example(order: usize) -> Symmetric {
        let mut matrix = Symmetric::new(order);
        for i in 0..order {
            for j in 0..order {
                matrix.values[i * matrix.stride + j] = ((i * 7 + j * 13) as f64).sin() / (1.0 + i.abs_diff(j) as f64);
            }
        }
        matrix.symmetrize(|i, j| if i == j { 12.0 } else { 0.0 });
        matrix
    }

    fn sides(order: usize) -> Columns {
        (0..order).map(|i| std::array::from_fn(|c| ((i + 3 * c) as f64).cos())).collect()
    }

    #[test]
    fn solution_satisfies_the_equations() {
        for order in [1, 5, 47, 96, 97, 250] {
            let (matrix, given) = (example(order), sides(order));
            let mut solved = given.clone();
            matrix.clone().factor().unwrap().solve(&mut solved);
            for (i, given) in given.iter().enumerate() {
                for c in 0..SIDES {
                    let sum: f64 = (0..order).map(|j| matrix.values[i * matrix.stride + j] * solved[j][c]).sum();
                    // Rounding of a matrix of small condition.
                    assert!((sum - given[c]).abs() < 1e-12, "{order}: {i} {c}");
                }
            }
        }
    }

    #[test]
    fn factor_has_the_same_bytes_on_any_number_of_threads() {
        let factor = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| example(300).factor().unwrap().0.values)
        };
        let single = factor(1);
        assert!([2, 3, 8].iter().all(|&threads| factor(threads) == single));
    }

    #[test]
    fn registers_of_any_width_give_the_same_bytes() {
        let tiles: Vec<f64> = (0..2 * TILE * BLOCK).map(|i| (i as f64).sin()).collect();
        let start: Vec<f64> = (0..TILE * 4 * TILE).map(|i| (i as f64).cos()).collect();
        let updated = |arch: Arch| {
            let mut values = start.clone();
            arch.dispatch(Update { row: 1, values: &mut values, tiles: &tiles, stride: 4 * TILE, end: 2 * TILE });
            values
        };
        assert_eq!(updated(Arch::new()), updated(Arch::Scalar));
    }

    #[test]
    fn matrix_that_is_not_definite_is_refused_with_its_row() {
        let mut matrix = example(120);
        let at = 100 * (matrix.stride + 1);
        matrix.values[at] = -1.0;
        assert_eq!(matrix.factor().unwrap_err(), NoFactor::NotDefinite(100));
    }
}
