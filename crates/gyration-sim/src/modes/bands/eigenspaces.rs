//! The eigenvalues of a complex matrix that has no symmetry, with right and left vectors, and of a Hermitian one.
//!
//! Indices that no entry joins fall into parts, each with a Schur form of its own: a part is small where most
//! coordinates do not act on each other, and many equal eigenvalues, on which the iteration may stall, are each in
//! another part.

use super::super::parts::joined_parts;
use super::bloch::C64;
use nalgebra::{ComplexField, DMatrix, DVector, Dyn, Schur, SymmetricEigen};

/// Eigenvalues nearer than this part of the largest are one.
pub(super) const SAME: f64 = 1e-8;
/// Sweeps of an iteration at most, an eigenvalue; a few are the rule.
const SWEEPS: usize = 30;
/// The same for small matrices.
const SMALL_SWEEPS: usize = 10_000;
/// In so many roundings an entry is none where an iteration does not end otherwise, which the rounding of its own steps
/// may keep it from.
const MILDER: [f64; 6] = [1.0, 4.0, 16.0, 64.0, 256.0, 1024.0];

/// Eigenvalues that are one, and what spans their right and left vectors.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Eigenspace {
    /// At least one.
    pub values: Vec<C64>,
    /// Column by column.
    pub right: DMatrix<C64>,
    pub left: DMatrix<C64>,
}

/// All of them; none of what is not finite, or if an iteration did not end.
pub(super) fn eigenspaces(matrix: &DMatrix<C64>) -> Option<Vec<Eigenspace>> {
    if !is_finite(matrix) {
        return None;
    }
    let forms = parts(matrix).into_iter().map(|part| Form::of(matrix, part)).collect::<Option<Vec<_>>>()?;
    let values = forms.iter().flat_map(|form| form.triangle.diagonal().iter().copied().collect::<Vec<_>>());
    let same = SAME * values.map(|value| value.modulus()).fold(0.0, f64::max);
    let mut found: Vec<Eigenspace> = Vec::new();
    for space in forms.iter().flat_map(|form| form.spaces(matrix.nrows(), same)) {
        match found.iter_mut().find(|known| (known.values[0] - space.values[0]).modulus() <= same) {
            Some(known) => known.join(&space),
            None => found.push(space),
        }
    }
    Some(found)
}

impl Eigenspace {
    /// Takes in one of another part.
    fn join(&mut self, other: &Self) {
        self.values.extend(&other.values);
        for (own, others) in [(&mut self.right, &other.right), (&mut self.left, &other.left)] {
            let joined: Vec<_> = own.column_iter().chain(others.column_iter()).collect();
            *own = DMatrix::from_columns(&joined);
        }
    }
}

/// The indices that entries join, part by part, ascending.
fn parts(matrix: &DMatrix<C64>) -> Vec<Vec<usize>> {
    joined_parts((0..matrix.nrows()).collect(), |i, j| matrix[(i, j)].modulus() > 0.0)
}

/// 1 − 2 v ⊗ v of a unit vector without zeros and without symmetry, another for each number.
fn mirror(size: usize, number: f64) -> DMatrix<C64> {
    let normal = DVector::from_fn(size, |i, _| C64::new(libm::sin(number + 1.7 * i as f64), 0.1)).normalize();
    DMatrix::identity(size, size) - &normal * normal.adjoint() * C64::new(2.0, 0.0)
}

/// A multiple of one that is larger than a matrix.
///
/// Entries are judged beside those of the diagonal, so that an iteration may not end where several eigenvalues are
/// zero; of a matrix with this added they are not.
fn shift(matrix: &DMatrix<C64>) -> DMatrix<C64> {
    DMatrix::from_diagonal_element(matrix.nrows(), matrix.ncols(), C64::new(2.0 * matrix.norm(), 0.0))
}

/// The same without entries that are rounding of rounding: reflections of what squares to nothing are none, and leave
/// vectors that are not across one another, or no numbers.
fn without_dust(mut matrix: DMatrix<C64>) -> DMatrix<C64> {
    let least = f64::EPSILON * f64::EPSILON * matrix.camax();
    matrix.iter_mut().filter(|entry| entry.modulus() < least).for_each(|entry| *entry = C64::new(0.0, 0.0));
    matrix
}

fn is_finite(matrix: &DMatrix<C64>) -> bool {
    matrix.iter().all(|entry| entry.re.is_finite() && entry.im.is_finite())
}

/// The eigenvalues of a Hermitian matrix, and their vectors; none of what is not finite, or if an iteration did not
/// end.
pub(super) fn hermitian_eigen(matrix: DMatrix<C64>) -> Option<SymmetricEigen<C64, Dyn>> {
    let size = matrix.nrows();
    if size == 0 {
        return Some(SymmetricEigen { eigenvectors: DMatrix::zeros(0, 0), eigenvalues: DVector::zeros(0) });
    }
    if !is_finite(&matrix) {
        return None;
    }
    let matrix = without_dust(matrix);
    if let Some(found) = matrix.clone().try_symmetric_eigen(f64::EPSILON, SWEEPS * size) {
        return Some(found);
    }
    let shift = shift(&matrix);
    let (mirror, found) = MILDER.iter().find_map(|digits| {
        let mirror = mirror(size, *digits);
        let turned = &mirror * (&matrix + &shift) * &mirror;
        Some((mirror, turned.try_symmetric_eigen(*digits * f64::EPSILON, SWEEPS * size)?))
    })?;
    let eigenvalues = found.eigenvalues.map(|value| value - shift[(0, 0)].re);
    Some(SymmetricEigen { eigenvectors: mirror * found.eigenvectors, eigenvalues })
}

/// The Hermitian part.
pub(super) fn hermitian(matrix: DMatrix<C64>) -> DMatrix<C64> {
    let half = C64::new(0.5, 0.0);
    (&matrix + matrix.adjoint()) * half
}

/// The eigenvalues of a small matrix.
pub(super) fn eigenvalues(matrix: &DMatrix<C64>) -> Option<Vec<C64>> {
    Some(eigenspaces(matrix)?.into_iter().flat_map(|space| space.values).collect())
}

/// The eigenvectors of a small matrix, if it has as many as rows.
pub(super) fn eigenvectors(matrix: DMatrix<C64>) -> Option<DMatrix<C64>> {
    let size = matrix.nrows();
    let (unitary, triangle) = Schur::try_new(without_dust(matrix), f64::EPSILON, SMALL_SWEEPS)?.unpack();
    let mut vectors = DMatrix::identity(size, size);
    for k in 0..size {
        for i in (0..k).rev() {
            let sum: C64 = (i + 1..=k).map(|j| triangle[(i, j)] * vectors[(j, k)]).sum();
            let gap = triangle[(i, i)] - triangle[(k, k)];
            vectors[(i, k)] = if sum.modulus() == 0.0 { C64::new(0.0, 0.0) } else { -sum / gap };
        }
    }
    let vectors = unitary * vectors;
    vectors.iter().all(|entry| entry.re.is_finite() && entry.im.is_finite()).then_some(vectors)
}

/// The Schur form of a part.
struct Form {
    part: Vec<usize>,
    unitary: DMatrix<C64>,
    triangle: DMatrix<C64>,
}

impl Form {
    fn of(matrix: &DMatrix<C64>, part: Vec<usize>) -> Option<Self> {
        let own = without_dust(matrix.select_rows(&part).select_columns(&part));
        let size = own.nrows();
        if let Some((unitary, triangle)) = Schur::try_new(own.clone(), f64::EPSILON, SWEEPS * size).map(Schur::unpack) {
            return Some(Self { part, unitary, triangle });
        }
        let shift = shift(&own);
        let (mirror, schur) = MILDER.iter().find_map(|digits| {
            let mirror = mirror(size, *digits);
            let turned = &mirror * (&own + &shift) * &mirror;
            Some((mirror, Schur::try_new(turned, *digits * f64::EPSILON, SWEEPS * size)?))
        })?;
        let (unitary, triangle) = schur.unpack();
        Some(Self { part, unitary: mirror * unitary, triangle: triangle - shift })
    }

    /// Its eigenvalues, those within a distance together, with vectors of the whole.
    fn spaces(&self, whole: usize, same: f64) -> Vec<Eigenspace> {
        let size = self.part.len();
        let values: Vec<C64> = self.triangle.diagonal().iter().copied().collect();
        let mut left: Vec<usize> = (0..size).collect();
        let mut spaces = Vec::new();
        while let Some(first) = left.first().copied() {
            let is_same = |k: &usize| (values[*k] - values[first]).modulus() <= same;
            let (group, others): (Vec<usize>, Vec<usize>) = left.iter().partition(|k| is_same(k));
            left = others;
            // A shift beside the eigenvalue by more than its rounding keeps the triangle regular.
            let shift = values[first] + C64::new(0.3, 0.4) * (1e-3 * same).max(f64::MIN_POSITIVE);
            let shifted = &self.triangle - DMatrix::from_diagonal_element(size, size, shift);
            let start = DMatrix::from_fn(size, group.len(), |i, j| {
                C64::new(libm::sin(1.0 + 1.7 * i as f64 + 2.3 * (j * i) as f64), 0.1)
            });
            let (mut right_vectors, mut left_vectors) = (start.clone(), start);
            for _ in 0..3 {
                shifted.solve_upper_triangular_mut(&mut right_vectors);
                right_vectors = right_vectors.qr().q();
                shifted.ad_solve_upper_triangular_mut(&mut left_vectors);
                left_vectors = left_vectors.qr().q();
            }
            let [right, left] = [right_vectors, left_vectors].map(|vectors| self.spread(&vectors, whole));
            spaces.push(Eigenspace { values: group.iter().map(|k| values[*k]).collect(), right, left });
        }
        spaces
    }

    /// Vectors of the whole matrix.
    fn spread(&self, vectors: &DMatrix<C64>, whole: usize) -> DMatrix<C64> {
        let own = &self.unitary * vectors;
        let mut spread = DMatrix::zeros(whole, own.ncols());
        for (row, at) in self.part.iter().enumerate() {
            spread.row_mut(*at).copy_from(&own.row(row));
        }
        spread
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symptom: frequencies had derivatives that were no numbers, so that a calibration stood still: equal branches are
    /// turned to their slopes, of which some were rounding of rounding.
    #[test]
    fn entries_of_rounding_leave_eigenvectors() {
        let mut lost = 0;
        let one = DMatrix::identity(5, 5);
        let are_kept = |vectors: &DMatrix<C64>| (vectors.adjoint() * vectors - &one).norm() < 1e-13;
        for smallness in (20..=300).step_by(20) {
            for shape in 0..8 {
                let entry = |i: usize, j: usize| {
                    let turn = 1.0 + 2.3 * (i * j) as f64 + 0.7 * (i + j) as f64 + f64::from(shape);
                    let size = if i < 2 && j < 2 { 1.0 } else { libm::pow(10.0, -f64::from(smallness)) };
                    C64::new(
                        libm::sin(turn),
                        if i == j { 0.0 } else { (i as f64 - j as f64).signum() * libm::cos(turn) },
                    ) * size
                };
                let matrix = DMatrix::from_fn(5, 5, entry);
                let raw = matrix.clone().try_symmetric_eigen(f64::EPSILON, SWEEPS * 5);
                lost += usize::from(raw.is_none_or(|found| !are_kept(&found.eigenvectors)));
                let found = hermitian_eigen(matrix.clone()).unwrap();
                let vectors = &found.eigenvectors;
                let values = DMatrix::from_diagonal(&found.eigenvalues.map(|value| C64::new(value, 0.0)));
                let left = (&matrix * vectors - vectors * values).norm();
                assert!(left < 1e-13 && are_kept(vectors), "1e-{smallness}: {left:e}, {vectors}");
            }
        }
        println!("{lost} of 120 lost with dust");
        assert!(lost > 0, "an iteration that loses none needs no care");
    }
}
