//! Eigenvalues of a real matrix without symmetry.

use nalgebra::{Complex, ComplexField as _, DMatrix, Schur};

/// Sweeps of the Schur form at most, an eigenvalue; a few are the rule.
const SWEEPS: usize = 100;
/// Entries below so many roundings count as zero, from one attempt to the next.
const MILDER: [f64; 4] = [1.0, 4.0, 16.0, 64.0];

/// The eigenvalues of a matrix; none of an iteration that does not end.
///
/// With real shifts it may not where many lie evenly on a circle, as of cells that change places, or on the imaginary
/// axis, as of a row of equal bodies; nor where all are near to one, as of a small motion, until their mean is taken
/// off. Of e^(iφ) times the matrix with a multiple of one added they lie otherwise, and shifts are complex.
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let (size, sweeps) = (matrix.nrows(), SWEEPS * matrix.nrows());
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let mean = if size > 0 { matrix.trace() / size as f64 } else { 0.0 };
    for shift in [0.0, mean] {
        let shifted = matrix - DMatrix::from_diagonal_element(size, size, shift);
        if let Some(schur) = Schur::try_new(shifted, f64::EPSILON, sweeps) {
            return Some(of_blocks(&schur.unpack().1).into_iter().map(|value| value + shift).collect());
        }
    }
    let turn = Complex::new(0.8, 0.6);
    let added = Complex::new(0.2, 0.3) * matrix.amax();
    let turned = matrix.map(|entry| turn * entry) + DMatrix::from_diagonal_element(size, size, added);
    MILDER.into_iter().find_map(|digits| {
        let (_, triangle) = Schur::try_new(turned.clone(), digits * f64::EPSILON, sweeps)?.unpack();
        Some(triangle.diagonal().iter().map(|value| (value - added) * turn.conjugate()).collect())
    })
}

/// The eigenvalues of a quasi-triangular matrix: of blocks of one, and of two,
///
///   λ = ½(a + d) ± √δ,   δ = ¼(a − d)² + bc
///
/// Two that are equal have a δ of rounding, of either sign.
fn of_blocks(triangle: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let (mut found, mut at) = (Vec::with_capacity(triangle.nrows()), 0);
    while at < triangle.nrows() {
        let a = triangle[(at, at)];
        if at + 1 == triangle.nrows() || triangle[(at + 1, at)] == 0.0 {
            found.push(Complex::from(a));
            at += 1;
            continue;
        }
        let d = triangle[(at + 1, at + 1)];
        let (middle, half) = (0.5 * (a + d), 0.5 * (a - d));
        let square = half * half + triangle[(at, at + 1)] * triangle[(at + 1, at)];
        let root = square.abs().sqrt();
        let root = if square < 0.0 { Complex::new(0.0, root) } else { Complex::from(root) };
        found.extend([middle + root, middle - root]);
        at += 2;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;

    /// Symptom: rings of a few equal bodies had no modes, since sweeps with real shifts went on for ever.
    #[test]
    fn many_equal_pairs_on_the_imaginary_axis_are_found() {
        let (count, equal) = (12, 8);
        let size = 2 * count * equal;
        let mut whole = DMatrix::zeros(size, size);
        for pair in 0..count * equal {
            let rate = 1.0 + (pair / equal) as f64;
            (whole[(2 * pair, 2 * pair + 1)], whole[(2 * pair + 1, 2 * pair)]) = (rate, -rate);
        }
        for number in 0..3 {
            let normal = DVector::from_fn(size, |i, _| libm::sin(f64::from(number) + 1.7 * i as f64)).normalize();
            let mirror = DMatrix::identity(size, size) - 2.0 * &normal * normal.transpose();
            whole = &mirror * whole * &mirror;
        }
        let mut found: Vec<f64> = eigenvalues(&whole).unwrap().iter().map(|value| value.im).collect();
        found.sort_by(f64::total_cmp);
        let upper = &found[size / 2..];
        let off = upper.iter().enumerate().map(|(at, value)| (value - 1.0 - (at / equal) as f64).abs());
        let off = off.fold(0.0, f64::max);
        println!("off by {off:e}");
        assert!(off < 1e-11, "{off:e}");
    }

    #[test]
    fn multipliers_that_lie_evenly_on_a_circle_are_found() {
        // Cells that change places: the roots of one.
        let turned = |n: usize| DMatrix::from_fn(n, n, |i, j| f64::from(u8::from((i + 1) % n == j)));
        for n in [2, 3, 4, 6, 8] {
            let found = eigenvalues(&turned(n)).unwrap();
            let off = found.iter().map(|mu| (mu.powu(n as u32) - 1.0).norm()).fold(0.0, f64::max);
            assert!(found.len() == n && off < 1e-11, "{n}: {found:?}");
        }
    }
}
