//! The waves at a wave vector: roots λ and shapes ξ, and how their frequencies change with k.
//!
//! Without losses K(k) is Hermitian, λ = ±iω, ω² its eigenvalues, and
//!
//!   ∂ω/∂k = ξᴴ (∂K/∂k) ξ/(2ω |ξ|²)
//!
//! Otherwise they are the eigenvalues of the system of first order (`first_order`). Where several waves have one root
//! these derivatives are the eigenvalues of the matrix that their shapes give. Those by a number of the scene are the
//! same with the changes of the matrices by it.

use super::super::weightless::MotionMatrices;
use super::bloch::{BlochSystem, C64};
use super::eigenspaces::{SAME, eigenvalues, hermitian, hermitian_eigen};
use super::first_order::FirstOrderWaves;
use super::wave::{Asked, NoRoots, Wave, ascending};
use gyration::tensor::Vec3;
use nalgebra::{DMatrix, DVector};

/// ω² below this part of the stiffest is zero.
pub(super) const NEUTRAL: f64 = 1e-12;

/// All waves at a wave vector.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Waves {
    /// The branches: one a degree of freedom and one a first-order state, ascending in frequency.
    pub branches: Vec<Wave>,
    /// Every root [1/s].
    pub roots: Vec<C64>,
}

impl BlochSystem {
    /// The waves at κ with what is asked of them; where several have one frequency, those that stay waves along a
    /// direction.
    pub fn waves(&self, kappa: &[f64; 3], along: &Vec3, asked: &Asked<'_>) -> Result<Waves, NoRoots> {
        match self.is_conservative {
            true => self.conservative(kappa, along, asked),
            false => self.dissipative(kappa, along, asked),
        }
    }

    /// Those of K alone.
    pub(super) fn conservative(&self, kappa: &[f64; 3], along: &Vec3, asked: &Asked<'_>) -> Result<Waves, NoRoots> {
        let whole = self.wave(kappa).stiffness;
        let matrix = hermitian(whole.clone());
        let eigen = hermitian_eigen(matrix.clone()).ok_or(NoRoots)?;
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let least = NEUTRAL * self.stiffest;
        let squares: Vec<f64> = order.iter().map(|k| eigen.eigenvalues[*k]).collect();
        let columns: Vec<DVector<C64>> = order.iter().map(|k| eigen.eigenvectors.column(*k).into_owned()).collect();
        let mut vectors = DMatrix::from_columns(&columns);
        let same = SAME * squares.iter().fold(0.0, |most: f64, square| most.max(square.abs()));
        let changes: Vec<MotionMatrices> = asked.changes.iter().map(|change| change.at(kappa)).collect();
        let mut changed = Vec::new();
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
            if !changes.is_empty() {
                let space = vectors.columns(from, count).into_owned();
                let each = changes.iter().map(|change| conservative_changes(change, squares[from], &space));
                let each: Vec<Vec<f64>> = each.collect::<Option<_>>().ok_or(NoRoots)?;
                changed.extend((0..count).map(|k| each.iter().map(|of_group| of_group[k]).collect::<Vec<f64>>()));
            }
            from += count;
        }
        let skew = asked.doubt.map_or(0.0, |_| (whole - &matrix).norm());
        let bound = |k: usize, square: f64, shape: &DVector<C64>| {
            let doubt = asked.doubt.filter(|doubt| !doubt.is_open)?;
            let residual = (&matrix * shape - shape * C64::new(square, 0.0)).norm() + skew;
            let others = squares.iter().enumerate().filter(|(other, _)| *other != k);
            let gap = others.map(|(_, other)| (other - squares[k]).abs()).fold(f64::INFINITY, f64::min);
            Some(doubt.of_square(square, residual, gap))
        };
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
            let changes = changed.get(k).into_iter().flatten().map(|change| oscillates.then_some(*change)).collect();
            let bound = bound(k, if root == C64::new(0.0, 0.0) { 0.0 } else { squares[k] }, &shape);
            Wave { root, shape, velocity, changes, bound }
        };
        let mut branches: Vec<Wave> = (0..squares.len()).map(wave).collect();
        branches.sort_by(|a, b| frequency(a).total_cmp(&frequency(b)).then(b.root.re.total_cmp(&a.root.re)));
        let roots = branches.iter().flat_map(|wave| [wave.root, -wave.root]).map(unsigned).collect();
        Ok(Waves { branches, roots })
    }

    fn dissipative(&self, kappa: &[f64; 3], along: &Vec3, asked: &Asked<'_>) -> Result<Waves, NoRoots> {
        let mut matrices = self.wave(kappa);
        let mut slopes: Vec<_> =
            [Vec3::x(), Vec3::y(), Vec3::z(), *along].iter().map(|axis| self.slope(kappa, axis)).collect();
        slopes.extend(asked.changes.iter().map(|change| change.at(kappa)));
        if !self.inertial.weightless.is_empty() {
            let given: Vec<_> = std::iter::once(&matrices).chain(&slopes).collect();
            slopes = self.inertial.condensed(&given).ok_or(NoRoots)?;
            matrices = slopes.remove(0);
        }
        let system = FirstOrderWaves::new(matrices, NEUTRAL * self.stiffest_moving, self.inertial.places())?;
        let found = system.roots()?;
        let (slopes, changes) = slopes.split_at(4);
        let mut waves = Vec::new();
        for group in &found {
            waves.extend(system.group(group, slopes, (changes, asked.doubt)));
        }
        waves.extend(system.still(changes.len(), asked.doubt));
        let mut roots: Vec<C64> = waves.iter().map(|wave| wave.root).collect();
        roots.sort_by(|a, b| a.im.abs().total_cmp(&b.im.abs()).then(a.im.total_cmp(&b.im)).then(b.re.total_cmp(&a.re)));
        Ok(Waves { branches: branches(waves, self.counts().iter().sum()), roots })
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

/// ∂ω of waves of one ω² without losses, ascending, by a number that changes the matrices so:
///
///   ∂λ the eigenvalues of −ξᴴ (∂K + λ ∂C) ξ/2λ
///
/// Zeros where there is no ω.
fn conservative_changes(change: &MotionMatrices, square: f64, shapes: &DMatrix<C64>) -> Option<Vec<f64>> {
    if square <= 0.0 {
        return Some(vec![0.0; shapes.ncols()]);
    }
    let omega = libm::sqrt(square);
    let stiffness = shapes.adjoint() * &change.stiffness * shapes;
    if change.resistance.iter().all(|entry| *entry == C64::new(0.0, 0.0)) {
        let mut squares: Vec<f64> = hermitian_eigen(hermitian(stiffness))?.eigenvalues.iter().copied().collect();
        squares.sort_by(f64::total_cmp);
        return Some(squares.into_iter().map(|square| square / (2.0 * omega)).collect());
    }
    let root = C64::new(0.0, -omega);
    let within = (stiffness + shapes.adjoint() * &change.resistance * shapes * root) / (root * -2.0);
    ascending(root, &eigenvalues(&within)?)
}
