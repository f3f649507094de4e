//! The eigenvalues and vectors of ξ̈ + C ξ̇ + K ξ = 0.
//!
//! In the basis of sym K, with x_i = ω_i ξ_i, ω_i = √|k_i|, and y = ξ̇:
//!
//!   ẋ_i = ω_i y_i,   ẏ_i = −Σ (K_ij/ω_j) x_j − Σ C_ij y_j
//!
//! Where nothing depends on a coordinate there is no x_i, and its eigenvalue 0 is taken out exactly (left in, it would
//! be a double one, known to the square root of rounding alone). Coordinates that do not act on each other fall into
//! parts; a part of one is λ² + cλ + k = 0.

use super::canonical::Basis;
use super::{ModeBehaviour, NoSpectrum};
use nalgebra::{Complex, ComplexField, DMatrix, DVector, Schur};

type C64 = Complex<f64>;

/// Entries below this part of the rates that they couple change the eigenvalues by rounding.
const UNCOUPLED: f64 = 1e-12;
/// Entries below this part of the largest are the rounding of a few hundred operations on it.
const NOISE: f64 = 3e-14;
/// Real or imaginary parts below this part of the fastest eigenvalue of a part are rounding.
const ROUNDING: f64 = 1e-10;
/// Eigenvalues nearer than this part of the fastest are one, with as many vectors.
const SAME: f64 = 1e-8;
/// Sweeps of the Schur form at most; a few for each eigenvalue are the rule.
const SWEEPS: usize = 10_000;

/// A pair of eigenvalues and how the body moves, in the coordinates z.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EigenPair {
    pub eigenvalues: [C64; 2],
    pub motion: ModeBehaviour,
    pub shape: DVector<C64>,
}

/// All of them, one a coordinate.
pub(super) fn solve(k: &DMatrix<f64>, c: &DMatrix<f64>, basis: &Basis) -> Result<Vec<EigenPair>, NoSpectrum> {
    let into = |matrix: &DMatrix<f64>| basis.vectors.transpose() * matrix * &basis.vectors;
    let mut stiffness = into(k);
    for mut column in stiffness.column_iter_mut() {
        if column.norm() <= basis.zero {
            column.fill(0.0);
        }
    }
    let oscillator = Oscillator { stiffness, resistance: into(c) };
    let mut pairs = Vec::new();
    for part in oscillator.parts() {
        let found = match part[..] {
            [alone] => vec![oscillator.single(alone)],
            _ => oscillator.coupled(&part)?,
        };
        pairs.extend(found.into_iter().map(|pair| {
            let mut whole = DVector::zeros(basis.values.len());
            part.iter().zip(pair.shape.iter()).for_each(|(at, value)| whole[*at] = *value);
            let vectors = basis.vectors.map(|entry| C64::new(entry, 0.0));
            EigenPair { shape: vectors * whole, ..pair }
        }));
    }
    Ok(pairs)
}

struct Oscillator {
    stiffness: DMatrix<f64>,
    resistance: DMatrix<f64>,
}

impl Oscillator {
    /// Whether any force depends on the coordinate.
    fn bound(&self, i: usize) -> bool {
        self.scale(i) > 0.0
    }

    /// ω_i; without potential also where k_i = 0.
    fn scale(&self, i: usize) -> f64 {
        self.stiffness.column(i).norm().sqrt()
    }

    /// The coordinates in groups that do not act on each other.
    fn parts(&self) -> Vec<Vec<usize>> {
        let count = self.stiffness.nrows();
        let (most_stiff, most_resisted) = (self.stiffness.amax(), self.resistance.amax());
        let rate = |i: usize| self.scale(i).max(self.resistance[(i, i)].abs());
        let acts = |i: usize, j: usize| {
            let product = rate(i) * rate(j);
            self.resistance[(i, j)].abs() > (UNCOUPLED * product.sqrt()).max(NOISE * most_resisted)
                || self.stiffness[(i, j)].abs() > (UNCOUPLED * product).max(NOISE * most_stiff)
        };
        let mut left: Vec<usize> = (0..count).collect();
        let mut parts = Vec::new();
        while let Some(first) = left.first().copied() {
            left.remove(0);
            let mut part = vec![first];
            let mut at = 0;
            while at < part.len() {
                let (joined, apart) = left.iter().partition(|j| acts(part[at], **j) || acts(**j, part[at]));
                left = apart;
                part.extend::<Vec<usize>>(joined);
                at += 1;
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }

    /// λ² + cλ + k = 0.
    fn single(&self, i: usize) -> EigenPair {
        let (k, c) = (self.stiffness[(i, i)], self.resistance[(i, i)]);
        let square = 0.25 * c * c - k;
        let eigenvalues = if square < 0.0 {
            [1.0, -1.0].map(|sign| C64::new(0.0 - 0.5 * c, sign * (-square).sqrt()))
        } else {
            // The larger one first, so that nothing cancels: λ₁ λ₂ = k.
            let fast = -0.5 * c - square.sqrt().copysign(c);
            let slow = if fast == 0.0 { 0.0 } else { k / fast };
            // Zero has no sign.
            [slow, fast].map(|value| C64::new(value + 0.0, 0.0))
        };
        let motion = judge(&eigenvalues, 0.0, !self.bound(i));
        EigenPair { eigenvalues, motion, shape: DVector::from_element(1, C64::new(1.0, 0.0)) }
    }

    /// The first-order system of a part: x of the bound coordinates, then y of all.
    fn first_order(&self, part: &[usize], bound: &[usize]) -> DMatrix<f64> {
        let size = bound.len() + part.len();
        let mut matrix = DMatrix::zeros(size, size);
        for (row, i) in part.iter().enumerate() {
            for (column, j) in bound.iter().enumerate() {
                matrix[(bound.len() + row, column)] = -self.stiffness[(*i, *j)] / self.scale(*j);
            }
            for (column, j) in part.iter().enumerate() {
                matrix[(bound.len() + row, bound.len() + column)] = -self.resistance[(*i, *j)];
            }
        }
        for (row, i) in bound.iter().enumerate() {
            let column = part.iter().position(|j| j == i).unwrap_or(0);
            matrix[(row, bound.len() + column)] = self.scale(*i);
        }
        matrix
    }

    fn coupled(&self, part: &[usize]) -> Result<Vec<EigenPair>, NoSpectrum> {
        let bound: Vec<usize> = part.iter().copied().filter(|i| self.bound(*i)).collect();
        let matrix = self.first_order(part, &bound);
        let schur = Schur::try_new(matrix.clone(), f64::EPSILON, SWEEPS).ok_or(NoSpectrum)?;
        let values: Vec<C64> = schur.complex_eigenvalues().iter().copied().collect();
        let fastest = values.iter().map(|value| value.modulus()).fold(0.0, f64::max);
        let neutral = part.len() - bound.len();
        let snap = |value: f64| if value.abs() <= ROUNDING * fastest && neutral > 0 { 0.0 } else { value };
        let shape = |value: C64, vector: &DVector<C64>| {
            let moved = |times: C64| {
                let mut moved = part.iter().enumerate().map(|(at, i)| match bound.iter().position(|j| j == i) {
                    // ξ̇ = λ ξ, and ξ is what is known best of a slow motion.
                    Some(x) => vector[x] / self.scale(*i) * times,
                    None => vector[bound.len() + at],
                });
                DVector::from_fn(part.len(), |_, _| moved.next().unwrap_or_default())
            };
            let speeds = moved(value);
            // Where rates are some 30 orders apart the speeds of the slow motions vanish; their displacements do not.
            let moved = if speeds.norm().is_normal() { speeds } else { moved(C64::new(1.0, 0.0)) };
            moved.normalize()
        };
        let mut pairs = Vec::new();
        let mut reals = Vec::new();
        for (value, vector) in eigenvectors(&matrix, &values, SAME * fastest) {
            if value.im > ROUNDING * fastest {
                let eigenvalues = [C64::new(snap(value.re), value.im), C64::new(snap(value.re), -value.im)];
                let motion = judge(&eigenvalues, ROUNDING * fastest, false);
                pairs.push(EigenPair { eigenvalues, motion, shape: shape(value, &vector) });
            } else if value.im >= -ROUNDING * fastest {
                reals.push((snap(value.re), shape(value, &vector)));
            }
        }
        pairs.extend(self.joined(part, reals, neutral, ROUNDING * fastest));
        Ok(pairs)
    }

    /// Joins real eigenvalues to pairs: those that move along free coordinates most with the zeros of these, the others
    /// by likeness.
    fn joined(
        &self,
        part: &[usize],
        mut reals: Vec<(f64, DVector<C64>)>,
        neutral: usize,
        rounding: f64,
    ) -> Vec<EigenPair> {
        let freedom = |shape: &DVector<C64>| -> f64 {
            part.iter().zip(shape.iter()).filter(|(i, _)| !self.bound(**i)).map(|(_, value)| value.norm_sqr()).sum()
        };
        reals.sort_by(|a, b| freedom(&b.1).total_cmp(&freedom(&a.1)));
        let mut pairs = Vec::new();
        let pair = |slow: f64, fast: f64, shape: DVector<C64>, free: bool| {
            let eigenvalues = [slow, fast].map(|value| C64::new(value, 0.0));
            EigenPair { eigenvalues, motion: judge(&eigenvalues, rounding, free), shape }
        };
        for (value, shape) in reals.drain(..neutral.min(reals.len())) {
            pairs.push(pair(0.0, value, shape, true));
        }
        reals.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        while !reals.is_empty() {
            let (slow, shape) = reals.remove(0);
            let likeness = |other: &DVector<C64>| shape.dotc(other).modulus();
            let best = (0..reals.len()).max_by(|a, b| likeness(&reals[*a].1).total_cmp(&likeness(&reals[*b].1)));
            let fast = best.map_or(slow, |best| reals.remove(best).0);
            pairs.push(pair(slow, fast, shape, false));
        }
        pairs
    }
}

/// What a pair does; `free` if one of its zeros is that of a free coordinate.
fn judge(eigenvalues: &[C64; 2], rounding: f64, free: bool) -> ModeBehaviour {
    if eigenvalues.iter().any(|value| value.re > rounding) {
        ModeBehaviour::Grows
    } else if free {
        ModeBehaviour::Free
    } else if eigenvalues[0].im != 0.0 {
        ModeBehaviour::Oscillates
    } else {
        ModeBehaviour::Creeps
    }
}

/// Vectors of the eigenvalues in order, by inverse iteration with as many columns as there are eigenvalues that are
/// one.
fn eigenvectors(matrix: &DMatrix<f64>, values: &[C64], same: f64) -> Vec<(C64, DVector<C64>)> {
    let size = matrix.nrows();
    let mut left: Vec<C64> = values.to_vec();
    let mut found = Vec::new();
    while let Some(first) = left.first().copied() {
        let (group, others): (Vec<C64>, Vec<C64>) = left.iter().partition(|value| (*value - first).modulus() <= same);
        left = others;
        // A shift beside the eigenvalue by more than its rounding keeps the matrix regular.
        let shift = first + C64::new(0.3, 0.4) * (1e-3 * same).max(f64::MIN_POSITIVE);
        let shifted = matrix.map(|entry| C64::new(entry, 0.0)) - DMatrix::from_diagonal_element(size, size, shift);
        let solver = shifted.lu();
        // Any start without zeros and without symmetry.
        let mut columns = DMatrix::from_fn(size, group.len(), |i, j| {
            C64::new(libm::sin(1.0 + 1.7 * i as f64 + 2.3 * (j * i) as f64), 0.1)
        });
        for _ in 0..3 {
            if let Some(next) = solver.solve(&columns) {
                columns = next.qr().q();
            }
        }
        found.extend(group.into_iter().zip(columns.column_iter().map(|column| column.into_owned())));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::canonical;
    use super::*;

    fn pairs(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Vec<EigenPair> {
        solve(k, c, &canonical::basis(k, &[])).unwrap_or_else(|error| panic!("{error}"))
    }

    /// |λ² ξ + λ C ξ + K ξ| relative to the sizes of the three.
    fn residual(pair: &EigenPair, k: &DMatrix<f64>, c: &DMatrix<f64>) -> f64 {
        let complex = |matrix: &DMatrix<f64>| matrix.map(|entry| C64::new(entry, 0.0));
        let (value, shape) = (pair.eigenvalues[0], &pair.shape);
        let parts = [shape * (value * value), complex(c) * shape * value, complex(k) * shape];
        let size: f64 = parts.iter().map(|part| part.norm()).sum();
        parts.into_iter().reduce(|sum, part| sum + part).map_or(0.0, |sum| sum.norm()) / size
    }

    #[test]
    fn coupled_pairs_solve_the_quadratic_problem() {
        // Neither matrix is symmetric, and their directions differ.
        let k = DMatrix::from_row_slice(3, 3, &[40.0, 3.0, 0.0, -3.0, 90.0, 5.0, 1.0, 5.0, 40.0]);
        let c = DMatrix::from_row_slice(3, 3, &[0.5, 0.2, -0.3, 0.2, 1.0, 0.1, 0.3, 0.1, 0.2]);
        let found = pairs(&k, &c);
        assert_eq!(found.len(), 3);
        for pair in &found {
            let residual = residual(pair, &k, &c);
            println!("{} residual {residual:.1e}", pair.eigenvalues[0]);
            // Rounding of a Schur form of order six.
            assert!(residual < 1e-12 && pair.motion == ModeBehaviour::Oscillates);
        }
    }

    #[test]
    fn free_coordinates_keep_their_exact_zeros() {
        // A free coordinate that friction couples to another, as a ball that rolls: c (1, −a)⊗(1, −a).
        let along = DVector::from_vec(vec![1.0, -0.6, 0.0]);
        let c = 7.0 * &along * along.transpose();
        let mut k = DMatrix::zeros(3, 3);
        k[(2, 2)] = 1e8;
        let mut found = pairs(&k, &c);
        found.sort_by(|a, b| a.eigenvalues[1].re.total_cmp(&b.eigenvalues[1].re));
        let free: Vec<&EigenPair> = found.iter().filter(|pair| pair.motion == ModeBehaviour::Free).collect();
        let [sliding, rolling] = free[..] else { panic!("{found:?}") };
        assert_eq!(rolling.eigenvalues, [C64::new(0.0, 0.0); 2]);
        // Rounding beside a stiffness of 1e8.
        assert!((sliding.eigenvalues[1].re + 7.0 * 1.36).abs() < 1e-12, "{}", sliding.eigenvalues[1]);
        let ratio = rolling.shape[1] / rolling.shape[0];
        assert!((ratio - C64::new(1.0 / 0.6, 0.0)).norm() < 1e-9, "{ratio}");
    }

    #[test]
    fn slow_creep_beside_fast_decay_keeps_its_digits() {
        let (k, c) = (DMatrix::from_element(1, 1, 1e-4), DMatrix::from_element(1, 1, 1e6));
        let [pair] = &pairs(&k, &c)[..] else { panic!("one pair") };
        assert_eq!(pair.motion, ModeBehaviour::Creeps);
        assert!((pair.eigenvalues[0].re / -1e-10 - 1.0).abs() < 1e-15, "{}", pair.eigenvalues[0]);
    }
}
