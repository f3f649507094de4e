//! Arithmetic on dense blocks of numbers, real or complex, for the elimination by blocks.
//!
//! A block is a slice, row by row: the real parts and, of a complex block, the imaginary parts behind them. So is a
//! vector, which is a block of one column. The factorization of a diagonal block is that of `linear`.

use nalgebra::DMatrixView;

use crate::linear::{Singular, divide, dot, factorize_complex, factorize_real, solve_complex, solve_real};

/// What an elimination by blocks asks of its numbers.
pub trait BlockArithmetic {
    /// How many floating-point numbers stand for one number.
    const PARTS: usize;
    /// The shift s of s I − J.
    type Shift: Copy;

    /// Writes s I − J, or −J where there is no shift.
    fn set(block: &mut [f64], jacobian: DMatrixView<f64>, shift: Option<Self::Shift>);

    /// Factorizes a square block in place, as many rows as there are pivots.
    ///
    /// # Errors
    /// `Singular`.
    fn factorize(block: &mut [f64], pivots: &mut [usize]) -> Result<(), Singular>;

    /// Solves A x = b in place.
    fn solve(factors: &[f64], pivots: &[usize], b: &mut [f64]);

    /// Solves A X = B in place, B of so many columns.
    fn solve_columns(factors: &[f64], pivots: &[usize], b: &mut [f64], columns: usize);

    /// C ← C − A B, of so many columns of A and of B.
    fn subtract_product(c: &mut [f64], a: &[f64], b: &[f64], inner: usize, columns: usize);

    /// c ← c − A b.
    fn subtract_image(c: &mut [f64], a: &[f64], b: &[f64]);
}

/// Real numbers.
#[derive(Debug, Clone, Default)]
pub struct Real;

impl BlockArithmetic for Real {
    const PARTS: usize = 1;
    type Shift = f64;

    fn set(block: &mut [f64], jacobian: DMatrixView<f64>, shift: Option<f64>) {
        let columns = jacobian.ncols();
        for (i, row) in block.chunks_exact_mut(columns).enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = -jacobian[(i, j)];
            }
        }
        if let Some(shift) = shift {
            block.iter_mut().step_by(columns + 1).for_each(|entry| *entry += shift);
        }
    }

    fn factorize(block: &mut [f64], pivots: &mut [usize]) -> Result<(), Singular> {
        factorize_real(block, pivots)
    }

    fn solve(factors: &[f64], pivots: &[usize], b: &mut [f64]) {
        solve_real(factors, pivots, b);
    }

    fn solve_columns(factors: &[f64], pivots: &[usize], b: &mut [f64], columns: usize) {
        let n = pivots.len();
        swap_rows(pivots, b, columns);
        for i in 0..n {
            let (above, rest) = b.split_at_mut(i * columns);
            let row = &mut rest[..columns];
            for (factor, other) in factors[i * n..].iter().zip(above.chunks_exact(columns)) {
                subtract(row, *factor, other);
            }
        }
        for i in (0..n).rev() {
            let (above, below) = b.split_at_mut((i + 1) * columns);
            let row = &mut above[i * columns..];
            for (factor, other) in factors[i * n + i + 1..].iter().zip(below.chunks_exact(columns)) {
                subtract(row, *factor, other);
            }
            let inverse = 1.0 / factors[i * n + i];
            row.iter_mut().for_each(|value| *value *= inverse);
        }
    }

    fn subtract_product(c: &mut [f64], a: &[f64], b: &[f64], inner: usize, columns: usize) {
        for (row, factors) in c.chunks_exact_mut(columns).zip(a.chunks_exact(inner)) {
            for (factor, other) in factors.iter().zip(b.chunks_exact(columns)) {
                subtract(row, *factor, other);
            }
        }
    }

    fn subtract_image(c: &mut [f64], a: &[f64], b: &[f64]) {
        for (value, row) in c.iter_mut().zip(a.chunks_exact(b.len())) {
            *value -= dot(row, b);
        }
    }
}

/// Complex numbers.
#[derive(Debug, Clone, Default)]
pub struct Complex;

impl BlockArithmetic for Complex {
    const PARTS: usize = 2;
    type Shift = (f64, f64);

    fn set(block: &mut [f64], jacobian: DMatrixView<f64>, shift: Option<(f64, f64)>) {
        let (real, imaginary) = halves_mut(block);
        Real::set(real, jacobian, shift.map(|shift| shift.0));
        imaginary.fill(0.0);
        if let Some((_, shift)) = shift {
            imaginary.iter_mut().step_by(jacobian.ncols() + 1).for_each(|entry| *entry = shift);
        }
    }

    fn factorize(block: &mut [f64], pivots: &mut [usize]) -> Result<(), Singular> {
        let (real, imaginary) = halves_mut(block);
        factorize_complex(real, imaginary, pivots)
    }

    fn solve(factors: &[f64], pivots: &[usize], b: &mut [f64]) {
        let (real, imaginary) = halves_mut(b);
        solve_complex(halves(factors), pivots, real, imaginary);
    }

    fn solve_columns(factors: &[f64], pivots: &[usize], b: &mut [f64], columns: usize) {
        let n = pivots.len();
        let ((f_re, f_im), (re, im)) = (halves(factors), halves_mut(b));
        swap_rows(pivots, re, columns);
        swap_rows(pivots, im, columns);
        for i in 0..n {
            let ((re_above, re_rest), (im_above, im_rest)) =
                (re.split_at_mut(i * columns), im.split_at_mut(i * columns));
            let row = (&mut re_rest[..columns], &mut im_rest[..columns]);
            for j in 0..i {
                let other = (&re_above[j * columns..][..columns], &im_above[j * columns..][..columns]);
                subtract_complex((&mut *row.0, &mut *row.1), (f_re[i * n + j], f_im[i * n + j]), other);
            }
        }
        for i in (0..n).rev() {
            let at = (i + 1) * columns;
            let ((re_above, re_below), (im_above, im_below)) = (re.split_at_mut(at), im.split_at_mut(at));
            let row = (&mut re_above[i * columns..], &mut im_above[i * columns..]);
            for j in i + 1..n {
                let place = (j - i - 1) * columns;
                let other = (&re_below[place..][..columns], &im_below[place..][..columns]);
                subtract_complex((&mut *row.0, &mut *row.1), (f_re[i * n + j], f_im[i * n + j]), other);
            }
            let (p, q) = divide((1.0, 0.0), (f_re[i * n + i], f_im[i * n + i]));
            for (re, im) in row.0.iter_mut().zip(row.1) {
                (*re, *im) = (*re * p - *im * q, *re * q + *im * p);
            }
        }
    }

    fn subtract_product(c: &mut [f64], a: &[f64], b: &[f64], inner: usize, columns: usize) {
        let ((c_re, c_im), (a_re, a_im), (b_re, b_im)) = (halves_mut(c), halves(a), halves(b));
        for (i, row) in c_re.chunks_exact_mut(columns).zip(c_im.chunks_exact_mut(columns)).enumerate() {
            for k in 0..inner {
                let other = (&b_re[k * columns..][..columns], &b_im[k * columns..][..columns]);
                subtract_complex((&mut *row.0, &mut *row.1), (a_re[i * inner + k], a_im[i * inner + k]), other);
            }
        }
    }

    fn subtract_image(c: &mut [f64], a: &[f64], b: &[f64]) {
        let ((c_re, c_im), (a_re, a_im), (b_re, b_im)) = (halves_mut(c), halves(a), halves(b));
        let rows = a_re.chunks_exact(b_re.len()).zip(a_im.chunks_exact(b_re.len()));
        for ((re, im), (row_re, row_im)) in c_re.iter_mut().zip(c_im).zip(rows) {
            *re -= dot(row_re, b_re) - dot(row_im, b_im);
            *im -= dot(row_re, b_im) + dot(row_im, b_re);
        }
    }
}

/// row ← row − factor · other. Rates that are unknowns themselves leave many zeros: these are passed over.
fn subtract(row: &mut [f64], factor: f64, other: &[f64]) {
    if factor != 0.0 {
        row.iter_mut().zip(other).for_each(|(value, x)| *value -= factor * x);
    }
}

/// row ← row − factor · other, of real and imaginary parts.
fn subtract_complex(row: (&mut [f64], &mut [f64]), (p, q): (f64, f64), other: (&[f64], &[f64])) {
    if p == 0.0 && q == 0.0 {
        return;
    }
    for ((re, im), (x, y)) in row.0.iter_mut().zip(row.1).zip(other.0.iter().zip(other.1)) {
        *re -= p * x - q * y;
        *im -= p * y + q * x;
    }
}

fn swap_rows(pivots: &[usize], b: &mut [f64], columns: usize) {
    for (k, pivot) in pivots.iter().enumerate().filter(|(k, pivot)| *k != **pivot) {
        let (first, second) = b.split_at_mut(pivot * columns);
        first[k * columns..][..columns].swap_with_slice(&mut second[..columns]);
    }
}

fn halves(block: &[f64]) -> (&[f64], &[f64]) {
    block.split_at(block.len() / 2)
}

fn halves_mut(block: &mut [f64]) -> (&mut [f64], &mut [f64]) {
    block.split_at_mut(block.len() / 2)
}
