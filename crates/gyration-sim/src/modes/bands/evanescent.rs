//! Complex bands: all κ along one direction that a frequency has, waves that run and waves that die out.
//!
//!   Q(ζ) (ξ | γ) = 0,   Q = Σ_n ζⁿ Q_n,   ζ = e^{2πiκ},   λ = −iω
//!
//!   Q_n = λ² δ_n0 + λ C_n + K_n and −B_n over −(D_n + λ E_n) and λ δ_n0 − H_n
//!
//! with the cells along the others summed by their phases. What springs reach has a low rank: so the outer blocks are
//! taken apart, Σ_{n>0} ζⁿ Q_n = F (1/ζ − N)⁻¹ G with as few states a as there are (the rank of the block Hankel matrix
//! tells, Ho and Kalman 1966), and Σ_{n>0} ζ⁻ⁿ Q_−n alike with states b, which leaves a pencil
//!
//!   Q₀ u + F a + F′ b = 0,   a = ζ (N a + G u),   ζ b = N′ b + G′ u   or   L x = ζ R x
//!
//! without most of the roots ζ = 0 and ∞ that singular outer blocks bring. Of ζ = ζ₀ + 1/μ, ζ₀ of no meaning, the μ are
//! the eigenvalues of M = R̂ (L − ζ₀R)⁻¹ E, where R = E R̂ has the rows of a and b alone; nothing singular is inverted.
//! What is left of ζ = ∞ and 0, where two bonds lead on of which the determinant feels one, are the μ = 0 and −1/ζ₀:
//! with null vectors V of M − μ, and W across them, M goes on as WᴴMW. Each root is then refined with ζ₀ beside it.

use super::NoBands;
use super::bloch::{BlochSystem, C64};
use super::eigenspaces::eigenvalues;
use nalgebra::{ComplexField, DMatrix, DVector};
use std::f64::consts::TAU;

/// Columns below this part of the largest are rounding.
const ROUNDING: f64 = 1e-11;
/// |Im κ| beyond which a wave is of no use.
const FARTHEST: f64 = 6.0;
/// Real and imaginary parts of κ nearer to a symmetric value than this are rounding.
const SYMMETRIC: f64 = 1e-10;
/// Coordinates may be so much softer than the stiffest one: what rounding leaves of zeros stays below [`ROUNDING`]
/// then.
const SPREAD: f64 = 1e-5;
/// So many roundings of M are what tells a root from 0 and ∞.
const ROUNDINGS: f64 = 5.0;
/// Some ζ₀ of no meaning: where an iteration does not end with one it does with another.
const BESIDE: [C64; 3] = [C64::new(0.731, 0.417), C64::new(-0.388, 0.913), C64::new(0.246, -1.137)];

/// A sum Σ_{n>0} ηⁿ Q_n as F (1/η − N)⁻¹ G.
struct Realization {
    next: DMatrix<C64>,
    input: DMatrix<C64>,
    output: DMatrix<C64>,
}

/// L x = ζ R x.
struct Pencil {
    left: DMatrix<C64>,
    right: DMatrix<C64>,
    /// How many u there are.
    inner: usize,
}

impl BlochSystem {
    /// All κ along a direction that ω has, the others as given: nearest to running first.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn evanescent(&self, kappa: &[f64; 3], direction: usize, omega: f64) -> Result<Vec<[f64; 2]>, NoBands> {
        let root = C64::new(0.0, -omega);
        let blocks = balanced(gathered(self.blocks(kappa, direction, root)));
        let Some(pencil) = Pencil::of(&blocks) else { return Ok(Vec::new()) };
        let roots = BESIDE.into_iter().find_map(|beside| pencil.roots(beside)).ok_or(NoBands::Evanescent(omega))?;
        let mut found: Vec<[f64; 2]> = roots.into_iter().filter_map(wave_number).collect();
        let least = |im: f64| if im.abs() <= SYMMETRIC { 0.0 } else { im.abs() };
        found.sort_by(|a, b| {
            let same = (least(a[1]) - least(b[1])).abs() <= SYMMETRIC;
            let nearest = if same { std::cmp::Ordering::Equal } else { least(a[1]).total_cmp(&least(b[1])) };
            nearest.then(a[0].total_cmp(&b[0])).then(a[1].total_cmp(&b[1]))
        });
        Ok(found)
    }

    /// Q_n for n from −N to N.
    fn blocks(&self, kappa: &[f64; 3], direction: usize, root: C64) -> Vec<DMatrix<C64>> {
        let reach = self.reach(direction);
        let [size, own] = self.counts();
        let block = |n: i32| {
            let at = self.wave_of_layer(kappa, direction, n);
            let mut block = DMatrix::zeros(size + own, size + own);
            block.view_mut((0, 0), (size, size)).copy_from(&(at.stiffness + at.resistance * root));
            block.view_mut((0, size), (size, own)).copy_from(&-at.forces);
            block.view_mut((size, 0), (own, size)).copy_from(&-(at.by_place + at.by_rate * root));
            block.view_mut((size, size), (own, own)).copy_from(&-at.own);
            if n == 0 {
                self.inertial.moving.iter().for_each(|i| block[(*i, *i)] += root * root);
                (size..size + own).for_each(|i| block[(i, i)] += root);
            }
            block
        };
        (-reach..=reach).map(block).collect()
    }
}

/// The same with coordinates counted to other cells, o_i on from those in which they are written, where that lets bonds
/// reach less far: ζ^{o_i} Q_ij ζ^{−o_j} has the same roots, and no others at ζ = 0 and ∞ that rounding could part.
fn gathered(blocks: Vec<DMatrix<C64>>) -> Vec<DMatrix<C64>> {
    let (reach, size) = (blocks.len() / 2, blocks[0].nrows());
    let layers = |i: usize, j: usize| {
        let leads = |n: &usize| {
            blocks[*n][(i, j)] != C64::new(0.0, 0.0) || blocks[2 * reach - *n][(j, i)] != C64::new(0.0, 0.0)
        };
        let first = (0..blocks.len()).find(leads)?;
        let last = (0..blocks.len()).rfind(leads)?;
        Some([first as i32 - reach as i32, last as i32 - reach as i32])
    };
    let mut offsets: Vec<Option<i32>> = vec![None; size];
    for root in 0..size {
        if offsets[root].is_some() {
            continue;
        }
        offsets[root] = Some(0);
        let mut open = vec![root];
        while let Some(i) = open.pop() {
            for j in 0..size {
                if let (None, Some([first, last])) = (offsets[j], layers(i, j)) {
                    offsets[j] = offsets[i].map(|own| own + (first + last).div_euclid(2));
                    open.push(j);
                }
            }
        }
    }
    let offset = |i: usize| offsets[i].unwrap_or(0);
    let entries = || (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
    let farthest = |(i, j): (usize, usize)| {
        let by = offset(i) - offset(j);
        layers(i, j).map_or(0, |[first, last]| (first + by).abs().max((last + by).abs()))
    };
    let nearer = entries().map(farthest).max().unwrap_or(0) as usize;
    if nearer >= reach {
        return blocks;
    }
    let mut gathered = vec![DMatrix::zeros(size, size); 2 * nearer + 1];
    for (i, j) in entries() {
        let Some([first, last]) = layers(i, j) else { continue };
        let by = offset(i) - offset(j);
        for n in first..=last {
            let there = (n + by + nearer as i32) as usize;
            gathered[there][(i, j)] = blocks[(n + reach as i32) as usize][(i, j)];
        }
    }
    gathered
}

/// The same in units of the coordinates in which none is stiffer than another, as far as rounding lets them.
fn balanced(mut blocks: Vec<DMatrix<C64>>) -> Vec<DMatrix<C64>> {
    let size = blocks[0].nrows();
    let largest = |i: usize| {
        let own = blocks.iter().map(|block| block.row(i).camax().max(block.column(i).camax()));
        own.fold(0.0, f64::max)
    };
    let stiffness: Vec<f64> = (0..size).map(largest).collect();
    let least = SPREAD * stiffness.iter().copied().fold(0.0, f64::max);
    // What nothing holds, at ω = 0, has no unit.
    if least == 0.0 {
        return blocks;
    }
    let units: Vec<f64> = stiffness.iter().map(|stiffness| stiffness.max(least).sqrt()).collect();
    for block in &mut blocks {
        for i in 0..size {
            (0..size).for_each(|j| block[(i, j)] = block[(i, j)].unscale(units[i] * units[j]));
        }
    }
    blocks
}

/// κ of ζ = e^{2πiκ}; none where the wave dies out within a part of a cell.
fn wave_number(zeta: C64) -> Option<[f64; 2]> {
    let (modulus, turns) = (zeta.modulus(), libm::atan2(zeta.im, zeta.re) / TAU);
    let decay = -libm::log(modulus) / TAU;
    let is_near = |value: f64, to: f64| (value - to).abs() <= SYMMETRIC;
    let re = match turns {
        turns if is_near(turns, 0.0) => 0.0,
        turns if is_near(turns.abs(), 0.5) => 0.5,
        turns => turns,
    };
    let im = if is_near(decay, 0.0) { 0.0 } else { decay };
    (im.abs() <= FARTHEST).then_some([re, im])
}

impl Realization {
    /// Of Q_1 … Q_N; what is at or below `least` is none.
    fn of(blocks: &[&DMatrix<C64>], least: f64) -> Option<Self> {
        let (count, size) = (blocks.len(), blocks.first()?.nrows());
        let hankel = |shift: usize| {
            DMatrix::from_fn(count * size, count * size, |i, j| {
                let n = i / size + j / size + shift;
                blocks.get(n).map_or(C64::new(0.0, 0.0), |block| block[(i % size, j % size)])
            })
        };
        // H = C R, C orthonormal, and Rᴴ = Q T: the shifted one is C N R.
        let columns = range(&hankel(0), least);
        let rows = columns.adjoint() * hankel(0);
        let rank = columns.ncols();
        let (basis, triangle) = rows.adjoint().qr().unpack();
        let inverse = triangle.adjoint().try_inverse()?;
        let next = columns.adjoint() * hankel(1) * basis * inverse;
        let (output, input) = (columns.rows(0, size).into_owned(), rows.columns(0, size).into_owned());
        debug_assert!(next.nrows() == rank && input.nrows() == rank, "a state for each column");
        Some(Self { next, input, output })
    }
}

impl Pencil {
    /// Of Q_−N … Q_N; none where nothing leads to other cells.
    fn of(blocks: &[DMatrix<C64>]) -> Option<Self> {
        let reach = blocks.len() / 2;
        let largest = blocks.iter().map(DMatrix::norm).fold(0.0, f64::max);
        let basis = moving(blocks, ROUNDING * largest)?;
        // The states have no unit of their own.
        let within = blocks.iter().map(|block| (basis.adjoint() * block * &basis).unscale(largest));
        let within: Vec<DMatrix<C64>> = within.collect();
        let outer = within.iter().enumerate().filter(|(n, _)| *n != reach).map(|(_, block)| block.norm());
        let least = ROUNDING * outer.fold(0.0, f64::max);
        let ahead: Vec<_> = within[reach + 1..].iter().collect();
        let behind: Vec<_> = within[..reach].iter().rev().collect();
        let (ahead, behind) = (Realization::of(&ahead, least)?, Realization::of(&behind, least)?);
        let (inner, a, b) = (basis.ncols(), ahead.next.nrows(), behind.next.nrows());
        if a + b == 0 {
            return None;
        }
        let mut left = DMatrix::zeros(inner + a + b, inner + a + b);
        let mut right = left.clone();
        left.view_mut((0, 0), (inner, inner)).copy_from(&within[reach]);
        left.view_mut((0, inner), (inner, a)).copy_from(&ahead.output);
        left.view_mut((0, inner + a), (inner, b)).copy_from(&behind.output);
        left.view_mut((inner, inner), (a, a)).fill_with_identity();
        left.view_mut((inner + a, 0), (b, inner)).copy_from(&behind.input);
        left.view_mut((inner + a, inner + a), (b, b)).copy_from(&behind.next);
        right.view_mut((inner, 0), (a, inner)).copy_from(&ahead.input);
        right.view_mut((inner, inner), (a, a)).copy_from(&ahead.next);
        right.view_mut((inner + a, inner + a), (b, b)).fill_with_identity();
        Some(Self { left, right, inner })
    }

    /// Every ζ but 0 and ∞, by ζ₀; of those as near to them as rounding none either.
    fn roots(&self, beside: C64) -> Option<Vec<C64>> {
        let outer = self.left.nrows() - self.inner;
        let shifted = &self.left - &self.right * beside;
        // Where nothing holds a motion at any ζ there is none that could be told.
        let Some(inverse) = shifted.try_inverse() else { return Some(Vec::new()) };
        let rows = self.right.rows(self.inner, outer);
        let matrix = rows * inverse.columns(self.inner, outer);
        let least = ROUNDINGS * f64::EPSILON * matrix.norm();
        let finite = without(matrix, C64::new(0.0, 0.0), least);
        let mut left = without(finite, -beside.inv(), least);
        // Polarizations that rounding alone joins go apart.
        let none = f64::EPSILON * left.camax();
        left.iter_mut().filter(|entry| entry.modulus() < none).for_each(|entry| *entry = C64::new(0.0, 0.0));
        let found = eigenvalues(&left)?;
        Some(found.into_iter().map(|mu| self.refined(beside + mu.inv())).collect())
    }

    /// A root, refined by inverse iteration with ζ₀ beside it; that given where it leads elsewhere.
    fn refined(&self, root: C64) -> C64 {
        let mut at = root;
        for _ in 0..2 {
            let beside = at * C64::new(1.0 + 1e-7, 1e-7);
            let shifted = (&self.left - &self.right * beside).lu();
            let mut vector = DVector::from_fn(self.left.nrows(), |i, _| C64::new(1.0, libm::sin(1.0 + 1.7 * i as f64)));
            let mut mu = C64::new(0.0, 0.0);
            for _ in 0..4 {
                let Some(solved) = shifted.solve(&(&self.right * &vector)) else { return at };
                mu = vector.dotc(&solved) / vector.norm_squared();
                let norm = solved.norm();
                if norm.is_nan() || norm == 0.0 {
                    return at;
                }
                vector = solved.unscale(norm);
            }
            let found = beside + mu.inv();
            // Beside a double root the iteration goes on slowly: its first value is the better one.
            if (found - root).modulus() > 1e-4 * root.modulus() || !found.is_finite() {
                return at;
            }
            at = found;
        }
        at
    }
}

/// A matrix without an eigenvalue, which its null vectors tell: what is at or below `least` is none.
fn without(mut matrix: DMatrix<C64>, value: C64, least: f64) -> DMatrix<C64> {
    loop {
        let shifted = &matrix - DMatrix::from_diagonal_element(matrix.nrows(), matrix.nrows(), value);
        let across = range(&shifted.adjoint(), least);
        if across.ncols() == matrix.nrows() {
            return matrix;
        }
        matrix = across.adjoint() * matrix * across;
    }
}

/// A basis of what some block moves or feels: the rest moves alone, at every ζ alike.
fn moving(blocks: &[DMatrix<C64>], least: f64) -> Option<DMatrix<C64>> {
    let size = blocks.first()?.nrows();
    let mut stacked = DMatrix::zeros(2 * blocks.len() * size, size);
    for (n, block) in blocks.iter().enumerate() {
        stacked.view_mut((2 * n * size, 0), (size, size)).copy_from(block);
        stacked.view_mut(((2 * n + 1) * size, 0), (size, size)).copy_from(&block.adjoint());
    }
    let basis = range(&stacked.adjoint(), least);
    (basis.ncols() > 0).then_some(basis)
}

/// An orthonormal basis of what the columns of a matrix span, the longest first; what is at or below `least` is none.
fn range(matrix: &DMatrix<C64>, least: f64) -> DMatrix<C64> {
    let mut left = matrix.clone();
    let mut basis: Vec<DVector<C64>> = Vec::new();
    while basis.len() < matrix.nrows() {
        let norms = left.column_iter().map(|column| column.norm());
        let (longest, norm) = norms.enumerate().fold((0, 0.0), |most, next| if next.1 > most.1 { next } else { most });
        if norm <= least {
            break;
        }
        let mut unit = left.column(longest).unscale(norm);
        // Once more, lest the digits that were lost show.
        for other in &basis {
            let along = other.dotc(&unit);
            unit -= other * along;
        }
        unit.normalize_mut();
        for mut column in left.column_iter_mut() {
            let along = unit.dotc(&column);
            column.axpy(-along, &unit, C64::new(1.0, 0.0));
        }
        basis.push(unit);
    }
    DMatrix::from_fn(matrix.nrows(), basis.len(), |i, j| basis[j][i])
}
