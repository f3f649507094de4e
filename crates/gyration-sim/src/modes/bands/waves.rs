//! The waves at a wave vector: roots λ and shapes ξ, and how their frequencies change with k.
//!
//! Without losses K(k) is Hermitian, λ = ±iω, ω² its eigenvalues, and
//!
//!   ∂ω/∂k = ξᴴ (∂K/∂k) ξ/(2ω |ξ|²)
//!
//! Otherwise they are the eigenvalues of the system of first order in the basis of the Hermitian part of K, with x_i =
//! ω_i ξ_i as in `spectrum`: where nothing depends on a coordinate there is no x_i, and its zero is taken out exactly.
//! With Q(λ) the matrix of (ξ | γ), whose null vector is the wave, and z its left null vector,
//!
//!   ∂λ/∂k = −zᴴ (∂Q/∂k) (ξ | γ) / zᴴ (∂Q/∂λ) (ξ | γ)
//!
//! Where several waves have one root these derivatives are the eigenvalues of the matrix that their shapes give.

use super::super::weightless::MotionMatrices;
use super::bloch::{BlochSystem, C64};
use super::eigenspaces::{Eigenspace, SAME, eigenspaces, hermitian_eigen};
use gyration::tensor::Vec3;
use nalgebra::{ComplexField, DMatrix, DVector, Schur};

/// ω² below this part of the stiffest is zero.
pub(super) const NEUTRAL: f64 = 1e-12;
/// Real or imaginary parts below this part of the largest root are rounding.
const ROUNDING: f64 = 1e-10;
/// Entries below this part of the largest are the rounding of a few hundred operations on it.
const NOISE: f64 = 3e-14;
/// Sweeps of an iteration at most.
const SWEEPS: usize = 10_000;

/// A root and its shape.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Wave {
    /// λ [1/s].
    pub root: C64,
    /// ξ, of length one; zero where the root has none.
    pub shape: DVector<C64>,
    /// −Im ∂λ/∂k [m/s], the group velocity; none where the frequency has no derivative.
    pub velocity: Option<Vec3>,
}

/// All waves at a wave vector.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Waves {
    /// The branches: one a degree of freedom and one a first-order state, ascending in frequency.
    pub branches: Vec<Wave>,
    /// Every root [1/s].
    pub roots: Vec<C64>,
}

/// The iteration for the roots did not end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NoRoots;

impl BlochSystem {
    /// The waves at κ; where several have one frequency, those that stay waves along a direction.
    pub fn waves(&self, kappa: &[f64; 3], along: &Vec3) -> Result<Waves, NoRoots> {
        match self.is_conservative {
            true => self.conservative(kappa, along),
            false => self.dissipative(kappa, along),
        }
    }

    fn conservative(&self, kappa: &[f64; 3], along: &Vec3) -> Result<Waves, NoRoots> {
        let matrix = hermitian(self.wave(kappa).stiffness);
        let eigen = hermitian_eigen(matrix).ok_or(NoRoots)?;
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let least = NEUTRAL * self.stiffest;
        let squares: Vec<f64> = order.iter().map(|k| eigen.eigenvalues[*k]).collect();
        let columns: Vec<DVector<C64>> = order.iter().map(|k| eigen.eigenvectors.column(*k).into_owned()).collect();
        let mut vectors = DMatrix::from_columns(&columns);
        let same = SAME * squares.iter().fold(0.0, |most: f64, square| most.max(square.abs()));
        let mut from = 0;
        while from < squares.len() {
            let count = squares[from..].iter().take_while(|square| *square - squares[from] <= same).count();
            if count > 1 {
                let space = vectors.columns(from, count).into_owned();
                let shapes: Vec<DVector<C64>> = space.column_iter().map(|column| column.into_owned()).collect();
                let slope = |i: usize, j: usize| self.stiffness_slope(kappa, &shapes[i], &shapes[j]);
                let directed =
                    |i: usize, j: usize| along.iter().zip(&slope(i, j)).map(|(part, slope)| slope * *part).sum();
                let within = hermitian(DMatrix::from_fn(count, count, directed));
                let turned = hermitian_eigen(within).ok_or(NoRoots)?.eigenvectors;
                vectors.columns_mut(from, count).copy_from(&(space * turned));
            }
            from += count;
        }
        let wave = |k: usize| {
            let shape = vectors.column(k).into_owned();
            let omega = libm::sqrt(squares[k].max(0.0));
            let root = match squares[k] {
                square if square.abs() <= least => C64::new(0.0, 0.0),
                square if square < 0.0 => C64::new(libm::sqrt(-square), 0.0),
                _ => C64::new(0.0, -omega),
            };
            let oscillates = root.im != 0.0;
            // Zero has no sign.
            let velocity = oscillates
                .then(|| self.stiffness_slope(kappa, &shape, &shape).map(|slope| slope.re / (2.0 * omega) + 0.0));
            Wave { root, shape, velocity }
        };
        let mut branches: Vec<Wave> = (0..squares.len()).map(wave).collect();
        branches.sort_by(|a, b| frequency(a).total_cmp(&frequency(b)).then(b.root.re.total_cmp(&a.root.re)));
        let roots = branches.iter().flat_map(|wave| [wave.root, -wave.root]).map(unsigned).collect();
        Ok(Waves { branches, roots })
    }

    fn dissipative(&self, kappa: &[f64; 3], along: &Vec3) -> Result<Waves, NoRoots> {
        let mut matrices = self.wave(kappa);
        let mut slopes: Vec<_> =
            [Vec3::x(), Vec3::y(), Vec3::z(), *along].iter().map(|axis| self.slope(kappa, axis)).collect();
        if !self.inertial.weightless.is_empty() {
            let given: Vec<_> = std::iter::once(&matrices).chain(&slopes).collect();
            slopes = self.inertial.condensed(&given).ok_or(NoRoots)?;
            matrices = slopes.remove(0);
        }
        let system = FirstOrderWaves::new(matrices, NEUTRAL * self.stiffest_moving, self.inertial.places())?;
        let found = system.roots()?;
        let mut waves = Vec::new();
        for group in &found {
            waves.extend(system.group(group, &slopes));
        }
        let still = Wave { root: C64::new(0.0, 0.0), shape: DVector::zeros(self.counts[0]), velocity: None };
        waves.extend(system.neutral.iter().map(|shape| Wave { shape: system.placed(shape), ..still.clone() }));
        let mut roots: Vec<C64> = waves.iter().map(|wave| wave.root).collect();
        roots.sort_by(|a, b| a.im.abs().total_cmp(&b.im.abs()).then(a.im.total_cmp(&b.im)).then(b.re.total_cmp(&a.re)));
        Ok(Waves { branches: branches(waves, self.counts.iter().sum()), roots })
    }
}

/// ω of a wave.
fn frequency(wave: &Wave) -> f64 {
    wave.root.im.abs()
}

/// Zeros without a sign.
fn unsigned(root: C64) -> C64 {
    C64::new(root.re + 0.0, root.im + 0.0)
}

/// Of all waves those with ω > 0 that run as e^{ik·R − iωt}, and of those that do not oscillate the slowest.
fn branches(waves: Vec<Wave>, count: usize) -> Vec<Wave> {
    let (mut chosen, others): (Vec<Wave>, Vec<Wave>) = waves.into_iter().partition(|wave| wave.root.im < 0.0);
    let (mut real, mut backward): (Vec<Wave>, Vec<Wave>) = others.into_iter().partition(|wave| wave.root.im == 0.0);
    // What grows first, then what decays slowest.
    real.sort_by(|a, b| b.root.re.total_cmp(&a.root.re));
    backward.sort_by(|a, b| frequency(a).total_cmp(&frequency(b)));
    let missing = count.saturating_sub(chosen.len());
    chosen.extend(real.into_iter().chain(backward).take(missing));
    chosen.sort_by(|a, b| frequency(a).total_cmp(&frequency(b)).then(b.root.re.total_cmp(&a.root.re)));
    chosen
}

/// The Hermitian part.
pub(super) fn hermitian(matrix: DMatrix<C64>) -> DMatrix<C64> {
    let half = C64::new(0.5, 0.0);
    (&matrix + matrix.adjoint()) * half
}

/// A matrix whose noise is zero, so that what does not act on each other falls into parts.
fn without_noise(matrix: DMatrix<C64>) -> DMatrix<C64> {
    let least = NOISE * matrix.camax();
    matrix.map(|entry| if entry.modulus() <= least { C64::new(0.0, 0.0) } else { entry })
}

/// The system of first order at a wave vector: x of the coordinates on which something depends, y of all, then γ.
struct FirstOrderWaves {
    matrices: MotionMatrices,
    /// Where the places among (ξ | γ) stand among all: ξ, and γ of bodies without inertia.
    places: Vec<usize>,
    /// The basis of sym K.
    basis: DMatrix<C64>,
    /// Which coordinates have an x.
    bound: Vec<usize>,
    /// The shapes of the others.
    neutral: Vec<DVector<C64>>,
    matrix: DMatrix<C64>,
}

/// Roots that are one, with the shapes (ξ | γ) and the left null vectors of their waves, column by column.
struct RootGroup {
    roots: Vec<C64>,
    shapes: DMatrix<C64>,
    left: DMatrix<C64>,
}

impl FirstOrderWaves {
    fn new(matrices: MotionMatrices, least: f64, places: Vec<usize>) -> Result<Self, NoRoots> {
        let basis = hermitian_eigen(hermitian(matrices.stiffness.clone())).ok_or(NoRoots)?.eigenvectors;
        let (size, own) = (basis.ncols(), matrices.own.nrows());
        let within = without_noise(basis.adjoint() * &matrices.stiffness * &basis);
        let resistance = without_noise(basis.adjoint() * &matrices.resistance * &basis);
        let (by_place, by_rate) = (&matrices.by_place * &basis, &matrices.by_rate * &basis);
        let forces = basis.adjoint() * &matrices.forces;
        let felt = by_place.iter().fold(0.0, |most: f64, entry| most.max(entry.modulus()));
        let scale = |i: usize| {
            let scale = libm::sqrt(within.column(i).norm());
            if scale * scale > least {
                scale
            } else if by_place.column(i).norm() > ROUNDING * felt {
                by_place.column(i).norm()
            } else {
                0.0
            }
        };
        let scales: Vec<f64> = (0..size).map(scale).collect();
        let (bound, free): (Vec<usize>, Vec<usize>) = (0..size).partition(|i| scales[*i] > 0.0);
        let (y, gamma) = (bound.len(), bound.len() + size);
        let mut matrix = DMatrix::zeros(gamma + own, gamma + own);
        for (x, i) in bound.iter().enumerate() {
            matrix[(x, y + i)] = C64::new(scales[*i], 0.0);
            for j in 0..size {
                matrix[(y + j, x)] = -within[(j, *i)] / scales[*i];
            }
            for k in 0..own {
                matrix[(gamma + k, x)] = by_place[(k, *i)] / scales[*i];
            }
        }
        matrix.view_mut((y, y), (size, size)).copy_from(&-resistance);
        matrix.view_mut((y, gamma), (size, own)).copy_from(&forces);
        matrix.view_mut((gamma, y), (own, size)).copy_from(&by_rate);
        matrix.view_mut((gamma, gamma), (own, own)).copy_from(&matrices.own);
        let neutral = free.iter().map(|i| basis.column(*i).into_owned()).collect();
        Ok(Self { matrices, places, basis, bound, neutral, matrix })
    }

    /// ξ of all bodies, given (ξ | γ), or its first numbers alone.
    fn placed(&self, numbers: &DVector<C64>) -> DVector<C64> {
        let mut whole = DVector::zeros(self.places.len());
        self.places.iter().zip(numbers.iter()).for_each(|(at, number)| whole[*at] = *number);
        whole
    }

    /// All roots with their shapes.
    fn roots(&self) -> Result<Vec<RootGroup>, NoRoots> {
        let found = eigenspaces(&self.matrix).ok_or(NoRoots)?;
        let largest = found.iter().flat_map(|it| &it.values).map(|value| value.modulus()).fold(0.0, f64::max);
        let snap = |value: f64| if value.abs() <= ROUNDING * largest { 0.0 } else { value };
        let group = |Eigenspace { values, right, left }: Eigenspace| RootGroup {
            roots: values.iter().map(|value| C64::new(snap(value.re), snap(value.im))).collect(),
            shapes: self.shapes(values[0], &right),
            left: self.left(&left),
        };
        Ok(found.into_iter().map(group).collect())
    }

    /// (ξ | γ) of eigenvectors: ξ = x/ω where there is an x, else y/λ.
    fn shapes(&self, root: C64, vectors: &DMatrix<C64>) -> DMatrix<C64> {
        let (size, own) = (self.basis.ncols(), self.matrices.own.nrows());
        let y = self.bound.len();
        let mut shapes = DMatrix::zeros(size + own, vectors.ncols());
        for column in 0..vectors.ncols() {
            let along = DVector::from_fn(size, |i, _| match self.bound.iter().position(|bound| *bound == i) {
                Some(x) => vectors[(x, column)] / self.matrix[(x, y + i)],
                None if root.modulus() > 0.0 => vectors[(y + i, column)] / root,
                None => C64::new(0.0, 0.0),
            });
            shapes.view_mut((0, column), (size, 1)).copy_from(&(&self.basis * along));
            shapes.view_mut((size, column), (own, 1)).copy_from(&vectors.view((y + size, column), (own, 1)));
        }
        shapes
    }

    /// The left null vectors of Q: those of the rows of y and γ.
    fn left(&self, vectors: &DMatrix<C64>) -> DMatrix<C64> {
        let (size, own) = (self.basis.ncols(), self.matrices.own.nrows());
        let y = self.bound.len();
        let mut left = DMatrix::zeros(size + own, vectors.ncols());
        left.rows_mut(0, size).copy_from(&(&self.basis * vectors.rows(y, size)));
        left.rows_mut(size, own).copy_from(&vectors.rows(y + size, own));
        left
    }

    /// The waves of roots that are one, given the slopes along the axes and along the direction.
    fn group(&self, group: &RootGroup, slopes: &[MotionMatrices]) -> Vec<Wave> {
        let RootGroup { roots, shapes, left } = group;
        let root = roots[0];
        // ∂λ = −(zᴴ ∂Q/∂λ ξ)⁻¹ zᴴ ∂Q ξ.
        let metric = left.adjoint() * self.by_root(root, shapes);
        let change = |slope: &MotionMatrices| {
            let changed = left.adjoint() * along(slope, root, shapes);
            metric.clone().lu().solve(&-changed)
        };
        let count = roots.len();
        // Combinations of shapes that stay waves along the direction.
        let turned = match count {
            1 => None,
            _ => slopes.last().and_then(change).and_then(eigenvectors),
        };
        let inverse = turned.as_ref().and_then(|turned| turned.clone().try_inverse());
        let velocity = |slope: &MotionMatrices| {
            let change = change(slope)?;
            match (&turned, &inverse) {
                (Some(turned), Some(inverse)) => Some(inverse * change * turned),
                _ => Some(change),
            }
        };
        let velocities: Vec<Option<DMatrix<C64>>> = slopes.iter().take(3).map(velocity).collect();
        let shapes = match (&turned, &inverse) {
            (Some(turned), Some(_)) => shapes * turned,
            _ => shapes.clone(),
        };
        let wave = |(k, root): (usize, &C64)| {
            let shape = self.placed(&shapes.column(k).into_owned());
            let norm = shape.norm();
            let shape = shape / C64::new(norm.max(f64::MIN_POSITIVE), 0.0);
            let oscillates = root.im != 0.0;
            let component = |a: usize| Some(-velocities[a].as_ref()?[(k, k)].im);
            let velocity = oscillates.then(|| Some(Vec3::new(component(0)?, component(1)?, component(2)?))).flatten();
            Wave { root: *root, shape, velocity }
        };
        roots.iter().enumerate().map(wave).collect()
    }

    /// ∂Q/∂λ (ξ | γ) = ((2λ + C) ξ | γ − E ξ).
    fn by_root(&self, root: C64, shapes: &DMatrix<C64>) -> DMatrix<C64> {
        let size = self.basis.ncols();
        let (xi, gamma) = (shapes.rows(0, size), shapes.rows(size, shapes.nrows() - size));
        let mut product = shapes.clone();
        product.rows_mut(0, size).copy_from(&(xi * (root * 2.0) + &self.matrices.resistance * xi));
        product.rows_mut(size, gamma.nrows()).copy_from(&(gamma - &self.matrices.by_rate * xi));
        product
    }
}

/// ∂Q (ξ | γ) = ((λ ∂C + ∂K) ξ − ∂B γ | −(∂D + λ ∂E) ξ − ∂H γ).
fn along(slope: &MotionMatrices, root: C64, shapes: &DMatrix<C64>) -> DMatrix<C64> {
    let size = slope.stiffness.nrows();
    let (xi, gamma) = (shapes.rows(0, size), shapes.rows(size, shapes.nrows() - size));
    let mut product = shapes.clone();
    let upper = &slope.resistance * xi * root + &slope.stiffness * xi - &slope.forces * gamma;
    let lower = -(&slope.by_place * xi) - &slope.by_rate * xi * root - &slope.own * gamma;
    product.rows_mut(0, size).copy_from(&upper);
    product.rows_mut(size, gamma.nrows()).copy_from(&lower);
    product
}

/// The eigenvectors of a small matrix, if it has as many as rows.
fn eigenvectors(matrix: DMatrix<C64>) -> Option<DMatrix<C64>> {
    let size = matrix.nrows();
    let (unitary, triangle) = Schur::try_new(matrix, f64::EPSILON, SWEEPS)?.unpack();
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
