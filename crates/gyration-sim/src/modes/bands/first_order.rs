//! The waves of a lattice that loses or drives, as eigenvalues of a system of first order.
//!
//! In the basis of the Hermitian part of K, with x_i = ω_i ξ_i as in `spectrum`: where nothing depends on a coordinate
//! there is no x_i, and its zero is taken out exactly. With Q(λ) the matrix of (ξ | γ), whose null vector is the wave,
//! and z its left null vector,
//!
//!   ∂λ = −zᴴ ∂Q (ξ | γ) / zᴴ (∂Q/∂λ) (ξ | γ)
//!
//! by k or by a number of the scene.

use super::super::weightless::MotionMatrices;
use super::by_cell::C64;
use super::doubt::MatrixDoubt;
use super::eigenspaces::{Eigenspace, eigenspaces, eigenvalues, eigenvectors, hermitian, hermitian_eigen};
use super::wave::{NoRoots, Wave, ascending, ranks};
use gyration::tensor::Vec3;
use nalgebra::{ComplexField, DMatrix, DVector};

/// Real or imaginary parts below this part of the largest root are rounding.
const ROUNDING: f64 = 1e-10;
/// Entries below this part of the largest are the rounding of a few hundred operations on it.
const NOISE: f64 = 3e-14;

/// The system of first order at a wave vector: x of the coordinates on which something depends, y of all, then γ.
pub(super) struct FirstOrderWaves {
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
pub(super) struct RootGroup {
    roots: Vec<C64>,
    shapes: DMatrix<C64>,
    left: DMatrix<C64>,
}

impl FirstOrderWaves {
    pub fn new(matrices: MotionMatrices, least: f64, places: Vec<usize>) -> Result<Self, NoRoots> {
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
    pub fn roots(&self) -> Result<Vec<RootGroup>, NoRoots> {
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

    /// The waves on which nothing depends.
    pub fn still(&self, numbers: usize, doubt: Option<&MatrixDoubt>) -> impl Iterator<Item = Wave> {
        self.neutral.iter().map(move |shape| Wave {
            root: C64::new(0.0, 0.0),
            shape: self.placed(shape),
            velocity: None,
            changes: vec![None; numbers],
            bound: doubt
                .filter(|doubt| !doubt.is_open)
                .map(|doubt| doubt.of_square(0.0, (&self.matrices.stiffness * shape).norm(), 0.0)),
        })
    }

    /// The waves of roots that are one, given the slopes along the axes and along the direction, changes by numbers,
    /// and how far the matrices may be off.
    pub fn group(
        &self,
        group: &RootGroup,
        slopes: &[MotionMatrices],
        (changes, doubt): (&[MotionMatrices], Option<&MatrixDoubt>),
    ) -> Vec<Wave> {
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
        let by_number = |slope: &MotionMatrices| ascending(root, &eigenvalues(&change(slope)?)?);
        let changes: Vec<Option<Vec<f64>>> = changes.iter().map(by_number).collect();
        let ranks = ranks(roots);
        let bound = doubt.filter(|doubt| !doubt.is_open).and_then(|doubt| self.bound(group, metric.clone(), doubt));
        let wave = |(k, root): (usize, &C64)| {
            let shape = self.placed(&shapes.column(k).into_owned());
            let norm = shape.norm();
            let shape = shape / C64::new(norm.max(f64::MIN_POSITIVE), 0.0);
            let oscillates = root.im != 0.0;
            let component = |a: usize| Some(-velocities[a].as_ref()?[(k, k)].im);
            let velocity = oscillates.then(|| Some(Vec3::new(component(0)?, component(1)?, component(2)?))).flatten();
            let of_rank = |change: &Option<Vec<f64>>| change.as_ref().filter(|_| oscillates).map(|all| all[ranks[k]]);
            Wave { root: *root, shape, velocity, changes: changes.iter().map(of_rank).collect(), bound }
        };
        roots.iter().enumerate().map(wave).collect()
    }

    /// |(zᴴ ∂Q/∂λ ξ)⁻¹| |z| (|Q ξ| + (|δK| + |λ||δC|) |ξ|): by how much λ may be off [1/s]; of coordinates alone.
    fn bound(&self, group: &RootGroup, metric: DMatrix<C64>, doubt: &MatrixDoubt) -> Option<f64> {
        let RootGroup { roots, shapes, left } = group;
        let root = roots[0];
        let matrices = &self.matrices;
        let kept = shapes * (root * root) + (&matrices.resistance * shapes) * root + &matrices.stiffness * shapes;
        let off = kept.norm() + (doubt.stiffness + root.modulus() * doubt.resistance) * shapes.norm();
        let spread = roots.iter().map(|other| (other - root).modulus()).fold(0.0, f64::max);
        let bound = metric.try_inverse()?.norm() * left.norm() * off + spread;
        bound.is_finite().then_some(bound)
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

/// A matrix whose noise is zero, so that what does not act on each other falls into parts.
fn without_noise(matrix: DMatrix<C64>) -> DMatrix<C64> {
    let least = NOISE * matrix.camax();
    matrix.map(|entry| if entry.modulus() <= least { C64::new(0.0, 0.0) } else { entry })
}
