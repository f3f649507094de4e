//! Small dense linear systems, real and complex, by LU with partial pivoting.
//!
//!   P A = L U
//!
//! Rows are contiguous and nothing is allocated after construction. Real and imaginary parts are kept apart so that a
//! row operation runs over plain arrays. For blocks of a few dozens of unknowns; larger ones belong to a library.

/// A matrix to be factorized is singular to working precision, or not finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Singular;

/// The factors of a real matrix.
#[derive(Debug, Clone, Default)]
pub struct RealLu {
    size: usize,
    rows: Vec<f64>,
    pivots: Vec<usize>,
}

impl RealLu {
    /// Room for the factors of a matrix of so many rows.
    pub fn new(size: usize) -> Self {
        Self { size, rows: vec![0.0; size * size], pivots: vec![0; size] }
    }

    /// Has a smaller matrix from now on than it was made for, or again one of that size.
    pub fn resize(&mut self, size: usize) {
        self.size = size.min(self.pivots.len());
    }

    /// Factorizes the matrix of these entries, by row and column.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, entry: impl Fn(usize, usize) -> f64) -> Result<(), Singular> {
        let n = self.size;
        for i in 0..n {
            for j in 0..n {
                self.rows[i * n + j] = entry(i, j);
            }
        }
        factorize_real(&mut self.rows[..n * n], &mut self.pivots[..n])
    }

    /// Solves A x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = self.size;
        solve_real(&self.rows[..n * n], &self.pivots[..n], b);
    }
}

/// Factorizes a matrix in place, as many rows as there are pivots.
///
/// # Errors
/// `Singular`.
pub(crate) fn factorize_real(rows: &mut [f64], pivots: &mut [usize]) -> Result<(), Singular> {
    let n = pivots.len();
    for k in 0..n {
        let pivot = largest(k..n, |i| rows[i * n + k].abs())?;
        pivots[k] = pivot;
        swap_rows(rows, n, k, pivot);
        let (above, below) = rows.split_at_mut((k + 1) * n);
        let pivot_row = &above[k * n..];
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / pivot_row[k];
            row[k] = factor;
            for (value, p) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
                *value -= factor * p;
            }
        }
    }
    Ok(())
}

/// Solves A x = b in place with the factors of `factorize_real`.
pub(crate) fn solve_real(rows: &[f64], pivots: &[usize], b: &mut [f64]) {
    let n = pivots.len();
    for (k, pivot) in pivots.iter().enumerate() {
        b.swap(k, *pivot);
    }
    for (i, row) in rows.chunks_exact(n.max(1)).enumerate() {
        b[i] -= dot(&row[..i], &b[..i]);
    }
    for (i, row) in rows.chunks_exact(n.max(1)).enumerate().rev() {
        b[i] = (b[i] - dot(&row[i + 1..], &b[i + 1..n])) / row[i];
    }
}

/// The factors of a complex matrix.
#[derive(Debug, Clone, Default)]
pub struct ComplexLu {
    size: usize,
    real: Vec<f64>,
    imaginary: Vec<f64>,
    pivots: Vec<usize>,
}

impl ComplexLu {
    /// Room for the factors of a matrix of so many rows.
    pub fn new(size: usize) -> Self {
        let zeros = vec![0.0; size * size];
        Self { size, real: zeros.clone(), imaginary: zeros, pivots: vec![0; size] }
    }

    /// Has a smaller matrix from now on than it was made for, or again one of that size.
    pub fn resize(&mut self, size: usize) {
        self.size = size.min(self.pivots.len());
    }

    /// Factorizes the matrix of these entries, real and imaginary parts, by row and column.
    ///
    /// # Errors
    /// `Singular`.
    pub fn factorize(&mut self, entry: impl Fn(usize, usize) -> (f64, f64)) -> Result<(), Singular> {
        let n = self.size;
        for i in 0..n {
            for j in 0..n {
                (self.real[i * n + j], self.imaginary[i * n + j]) = entry(i, j);
            }
        }
        factorize_complex(&mut self.real[..n * n], &mut self.imaginary[..n * n], &mut self.pivots[..n])
    }

    /// Solves A x = b in place, b = real + i imaginary.
    pub fn solve(&self, real: &mut [f64], imaginary: &mut [f64]) {
        let n = self.size;
        solve_complex((&self.real[..n * n], &self.imaginary[..n * n]), &self.pivots[..n], real, imaginary);
    }
}

/// Factorizes a matrix in place, as many rows as there are pivots.
///
/// # Errors
/// `Singular`.
pub(crate) fn factorize_complex(real: &mut [f64], imaginary: &mut [f64], pivots: &mut [usize]) -> Result<(), Singular> {
    let n = pivots.len();
    for k in 0..n {
        // |re| + |im| chooses pivots as well as the modulus and cannot overflow earlier.
        let pivot = largest(k..n, |i| real[i * n + k].abs() + imaginary[i * n + k].abs())?;
        pivots[k] = pivot;
        swap_rows(real, n, k, pivot);
        swap_rows(imaginary, n, k, pivot);
        eliminate(real, imaginary, n, k);
    }
    Ok(())
}

fn eliminate(real: &mut [f64], imaginary: &mut [f64], n: usize, k: usize) {
    let (real_above, real_below) = real.split_at_mut((k + 1) * n);
    let (imaginary_above, imaginary_below) = imaginary.split_at_mut((k + 1) * n);
    let (p_re, p_im) = (&real_above[k * n..], &imaginary_above[k * n..]);
    let pivot = (p_re[k], p_im[k]);
    for (re, im) in real_below.chunks_exact_mut(n).zip(imaginary_below.chunks_exact_mut(n)) {
        let (fr, fi) = divide((re[k], im[k]), pivot);
        (re[k], im[k]) = (fr, fi);
        let row = re[k + 1..].iter_mut().zip(im[k + 1..].iter_mut());
        for ((r, i), (pr, pi)) in row.zip(p_re[k + 1..].iter().zip(&p_im[k + 1..])) {
            *r -= fr * pr - fi * pi;
            *i -= fr * pi + fi * pr;
        }
    }
}

/// Solves A x = b in place with the factors of `factorize_complex`, b = real + i imaginary.
pub(crate) fn solve_complex(factors: (&[f64], &[f64]), pivots: &[usize], real: &mut [f64], imaginary: &mut [f64]) {
    let n = pivots.len();
    for (k, pivot) in pivots.iter().enumerate() {
        real.swap(k, *pivot);
        imaginary.swap(k, *pivot);
    }
    // Σ_j A_ij x_j over some columns.
    let partial = |i: usize, columns: std::ops::Range<usize>, real: &[f64], imaginary: &[f64]| {
        let (mut re, mut im) = (0.0, 0.0);
        for j in columns {
            let (a, b) = (factors.0[i * n + j], factors.1[i * n + j]);
            re += a * real[j] - b * imaginary[j];
            im += a * imaginary[j] + b * real[j];
        }
        (re, im)
    };
    for i in 0..n {
        let (re, im) = partial(i, 0..i, real, imaginary);
        (real[i], imaginary[i]) = (real[i] - re, imaginary[i] - im);
    }
    for i in (0..n).rev() {
        let (re, im) = partial(i, i + 1..n, real, imaginary);
        let pivot = (factors.0[i * n + i], factors.1[i * n + i]);
        (real[i], imaginary[i]) = divide((real[i] - re, imaginary[i] - im), pivot);
    }
}

/// The index of the largest size; singular if that is zero or not finite.
fn largest(mut rows: std::ops::Range<usize>, size: impl Fn(usize) -> f64) -> Result<usize, Singular> {
    let mut best = rows.next().ok_or(Singular)?;
    let mut most = size(best);
    for i in rows {
        let candidate = size(i);
        if candidate > most || candidate.is_nan() {
            (best, most) = (i, candidate);
        }
    }
    if most > 0.0 && most.is_finite() { Ok(best) } else { Err(Singular) }
}

fn swap_rows(rows: &mut [f64], n: usize, a: usize, b: usize) {
    if a != b {
        let (first, second) = rows.split_at_mut(a.max(b) * n);
        first[a.min(b) * n..][..n].swap_with_slice(&mut second[..n]);
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Smith's division, which does not overflow in between.
pub(crate) fn divide((a, b): (f64, f64), (c, d): (f64, f64)) -> (f64, f64) {
    if c.abs() >= d.abs() {
        let (ratio, whole) = (d / c, c + d * (d / c));
        ((a + b * ratio) / whole, (b - a * ratio) / whole)
    } else {
        let (ratio, whole) = (c / d, d + c * (c / d));
        ((a * ratio + b) / whole, (b * ratio - a) / whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;
    use proptest::prelude::*;

    proptest! {
        /// Residual within n² ulp of |A||x|: the growth of partial pivoting is small for random matrices.
        #[test]
        fn factors_solve_what_they_factorized(
            n in 1_usize..9,
            entries in proptest::collection::vec(-1.0_f64..1.0, 64),
            x in proptest::collection::vec(-1.0_f64..1.0, 16),
            shift in (0.5_f64..3.0, 0.5_f64..3.0),
        ) {
            let jacobian = DMatrix::from_fn(n, n, |i, j| entries[8 * i + j]);
            let mut real = RealLu::new(n);
            let mut complex = ComplexLu::new(n);
            prop_assume!(real.factorize(|i, j| if i == j { shift.0 } else { 0.0 } - jacobian[(i, j)]).is_ok());
            complex.factorize(|i, j| {
                let shift = if i == j { shift } else { (0.0, 0.0) };
                (shift.0 - jacobian[(i, j)], shift.1)
            }).unwrap();
            let column = |k: usize, i: usize| x[8 * k + i];
            let apply = |k: usize, i: usize| -> f64 { (0..n).map(|j| jacobian[(i, j)] * column(k, j)).sum() };
            let mut b: Vec<f64> = (0..n).map(|i| shift.0 * column(0, i) - apply(0, i)).collect();
            real.solve(&mut b);
            let row = |i: usize, v: &[f64]| -> f64 { (0..n).map(|j| jacobian[(i, j)] * v[j]).sum() };
            let largest = b.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
            for i in 0..n {
                let wanted = shift.0 * column(0, i) - apply(0, i);
                prop_assert!((shift.0 * b[i] - row(i, &b) - wanted).abs() < 1e-13 * largest);
            }
            let wanted = |i: usize| {
                let (x, y) = (column(0, i), column(1, i));
                (shift.0 * x - shift.1 * y - apply(0, i), shift.0 * y + shift.1 * x - apply(1, i))
            };
            let (mut re, mut im): (Vec<f64>, Vec<f64>) = (0..n).map(wanted).unzip();
            let (re_wanted, im_wanted) = (re.clone(), im.clone());
            complex.solve(&mut re, &mut im);
            let largest = re.iter().chain(&im).fold(1.0, |m: f64, v| m.max(v.abs()));
            for i in 0..n {
                prop_assert!((shift.0 * re[i] - shift.1 * im[i] - row(i, &re) - re_wanted[i]).abs() < 1e-13 * largest);
                prop_assert!((shift.0 * im[i] + shift.1 * re[i] - row(i, &im) - im_wanted[i]).abs() < 1e-13 * largest);
            }
        }
    }

    #[test]
    fn singular_and_not_finite_matrices_are_refused() {
        let mut lu = RealLu::new(2);
        assert_eq!(lu.factorize(|_, _| 1.0), Err(Singular));
        assert_eq!(lu.factorize(|_, _| f64::NAN), Err(Singular));
        let mut lu = ComplexLu::new(2);
        assert_eq!(lu.factorize(|_, _| (1.0, 0.0)), Err(Singular));
    }
}
