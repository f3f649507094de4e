//! A step of the linear equation S′ = J(t) S + b(t) by collocation at the five nodes of Radau IIA.
//!
//!   S_i = S₀ + h Σ_j a_ij (J_j S_j + b_j),   S(t + h) = S₅
//!
//! Order 9, L-stable, and exact in the derivatives of what the nodes see. With Z = S − S₀ the equations read (A⁻¹/h)
//! Z_i − J_i Z_i = J_i S₀ + b_i: one LU for all columns, and one for each block of J, which do not touch
//! (`stage_equations`). The rate K = S′ of the step is a polynomial of degree four; how fast its Legendre coefficients
//! κ₀ … κ₄ fall tells how well the step is resolved. Source: Hairer, Wanner, *Solving Ordinary Differential Equations
//! II*, §IV.5; Parlett, Reinsch, *Balancing a matrix for calculation of eigenvalues and eigenvectors*, Numer. Math. 13
//! (1969).

use super::stage_equations::{STAGES, Square, StageEquations};
use nalgebra::DMatrix;
use nalgebra::linalg::balancing::balance_parlett_reinsch;

/// c, the zeros of d⁴/dx⁴ (x⁴ (x − 1)⁵).
pub(super) const NODES: [f64; STAGES] =
    [0.057_104_196_114_517_68, 0.276_843_013_638_123_8, 0.583_590_432_368_916_8, 0.860_240_135_656_219_4, 1.0];

/// The coefficients of the method, from its nodes.
#[derive(Debug, Clone)]
pub(super) struct CollocationRule {
    /// A: integrals of the Lagrange polynomials up to the nodes.
    integrals: Square,
    /// A⁻¹.
    inverse: Square,
    /// The Legendre coefficients of a polynomial from its values at the nodes.
    legendre: Square,
}

/// What the equation is at the nodes of a step.
#[derive(Debug, Clone, Default)]
pub(super) struct NodeValues {
    /// J, block by block, of each node.
    pub slopes: Vec<Vec<DMatrix<f64>>>,
    /// b, a column for each column of S, of each node.
    pub forcing: Vec<DMatrix<f64>>,
}

/// A step made.
#[derive(Debug, Clone)]
pub(super) struct CollocationStep {
    /// S at the nodes; the last is the end.
    pub values: Vec<DMatrix<f64>>,
    /// The rates S′ at the nodes.
    pub rates: Vec<DMatrix<f64>>,
}

impl CollocationRule {
    pub fn new() -> Self {
        let powers = Square::from_fn(|i, k| NODES[i].powi(k as i32));
        let antiderivatives = Square::from_fn(|i, k| NODES[i].powi(k as i32 + 1) / (k as f64 + 1.0));
        let integrals = antiderivatives * inverse(&powers);
        let legendre = inverse(&Square::from_fn(|i, m| legendre(m, 2.0 * NODES[i] - 1.0)));
        Self { inverse: inverse(&integrals), integrals, legendre }
    }

    /// The weight of a node in an integral over the step.
    pub fn weight(&self, node: usize) -> f64 {
        self.integrals[(STAGES - 1, node)]
    }

    /// Makes a step of a size from S₀; none if the equations have no solution.
    pub fn step(
        &self,
        sets: &[Vec<usize>],
        start: &DMatrix<f64>,
        size: f64,
        stages: &NodeValues,
    ) -> Option<CollocationStep> {
        let (rows, columns) = start.shape();
        let mut increments = vec![DMatrix::zeros(rows, columns); STAGES];
        for (set, places) in sets.iter().enumerate() {
            let n = places.len();
            let units = balanced_units(stages, set)?;
            let slopes: [DMatrix<f64>; STAGES] = std::array::from_fn(|i| {
                let slopes = &stages.slopes[i][set];
                DMatrix::from_fn(n, n, |row, column| slopes[(row, column)] * (units[column] / units[row]))
            });
            let mut solved = DMatrix::zeros(STAGES * n, columns);
            let own = start.select_rows(places);
            for (i, forcing) in stages.forcing.iter().enumerate() {
                let mut right = &stages.slopes[i][set] * &own + forcing.select_rows(places);
                right.row_iter_mut().zip(&units).for_each(|(mut row, unit)| row /= *unit);
                solved.rows_mut(i * n, n).copy_from(&right);
            }
            StageEquations::new(self.inverse / size, slopes.each_ref()).solve(&mut solved)?;
            for (i, increment) in increments.iter_mut().enumerate() {
                for (row, place) in places.iter().enumerate() {
                    increment.row_mut(*place).copy_from(&(solved.row(i * n + row) * units[row]));
                }
            }
        }
        let rate = |i: usize| {
            let parts = increments.iter().enumerate().map(|(j, increment)| increment * (self.inverse[(i, j)] / size));
            parts.fold(DMatrix::zeros(rows, columns), |sum, part| sum + part)
        };
        let rates = (0..STAGES).map(rate).collect();
        let values = increments.into_iter().map(|increment| increment + start).collect();
        Some(CollocationStep { values, rates })
    }

    /// |κ₀| … |κ₄| of one column of rates at the nodes, each the largest over the rows, measured in their scales.
    pub fn coefficients(&self, rates: &[DMatrix<f64>], column: usize, scales: &[f64]) -> [f64; STAGES] {
        let mut sizes = [0.0; STAGES];
        for (row, scale) in scales.iter().enumerate() {
            for (m, size) in sizes.iter_mut().enumerate() {
                let terms = rates.iter().enumerate().map(|(i, rates)| self.legendre[(m, i)] * rates[(row, column)]);
                *size = f64::max(*size, terms.sum::<f64>().abs() / scale);
            }
        }
        sizes
    }
}

/// Units of the unknowns of a set, powers of two, in which what each gets of the others is what it gives; none where J
/// is no matrix of numbers. Deep in a short impact forces change by 1e16 N/kg/m: in metres the pivots are these slopes,
/// and velocities are lost in the equations of places.
fn balanced_units(stages: &NodeValues, set: usize) -> Option<Vec<f64>> {
    let sizes = stages.slopes.iter().map(|slopes| slopes[set].abs());
    let mut sum = sizes.reduce(|sum, sizes| sum + sizes)?;
    sum.norm_squared().is_finite().then(|| balance_parlett_reinsch(&mut sum).as_slice().to_vec())
}

/// The error of a step [as S, in its scales], from the Legendre coefficients of its rate.
///
/// They fall like ρ^m: those left out begin with κ₅, but an error in S at the end is made by the tenth power of the
/// size only, h κ₉ ~ h κ₃ ρ⁶ with ρ³ = (κ₃ + κ₄)/(κ₀ + κ₁ + κ₂). The part that is noise no smaller step would mend.
pub(super) fn error(size: f64, noise: f64, [constant, first, second, third, fourth]: [f64; STAGES]) -> f64 {
    let (last, all) = (((third - noise).max(0.0) + (fourth - noise).max(0.0)), constant + first + second);
    let fall = if last > 0.0 { (last / all).min(1.0) } else { 0.0 };
    size * last * fall * fall
}

/// The inverse of a matrix of the nodes, which are all different: there is one.
fn inverse(matrix: &Square) -> Square {
    matrix.try_inverse().unwrap_or_else(Square::zeros)
}

/// The Legendre polynomial of a degree up to four.
fn legendre(degree: usize, x: f64) -> f64 {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..degree {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Integrates one block over [0, 1] in equal steps.
    fn integrate(
        steps: usize,
        start: &DMatrix<f64>,
        slopes: impl Fn(f64) -> DMatrix<f64>,
        forcing: impl Fn(f64) -> DMatrix<f64>,
    ) -> DMatrix<f64> {
        let (rule, size, blocks) = (CollocationRule::new(), 1.0 / steps as f64, vec![(0..start.nrows()).collect()]);
        let mut value = start.clone();
        for k in 0..steps {
            let times = NODES.map(|node| (k as f64 + node) * size);
            let stages =
                NodeValues { slopes: times.map(|t| vec![slopes(t)]).into(), forcing: times.map(&forcing).into() };
            value = rule.step(&blocks, &value, size, &stages).unwrap().values.pop().unwrap();
        }
        value
    }

    fn oscillation(steps: usize) -> f64 {
        // s″ = −(2π)² s by a matrix that turns with time: s = (cos 2πt², sin 2πt²).
        let slopes = |t: f64| DMatrix::from_row_slice(2, 2, &[0.0, -4.0 * PI * t, 4.0 * PI * t, 0.0]);
        let start = DMatrix::from_column_slice(2, 1, &[1.0, 0.0]);
        let end = integrate(steps, &start, slopes, |_| DMatrix::zeros(2, 1));
        (end[(0, 0)] - 1.0).hypot(end[(1, 0)])
    }

    #[test]
    fn the_order_is_nine() {
        let errors = [4, 6, 8].map(oscillation);
        let orders = [(errors[0] / errors[1]).ln() / 1.5f64.ln(), (errors[1] / errors[2]).ln() / (4.0f64 / 3.0).ln()];
        println!("errors {errors:?}, orders {orders:?}");
        // The asymptotic order, from steps of a radian or so.
        assert!(orders.iter().all(|order| (8.3..9.7).contains(order)), "{orders:?}");
    }

    #[test]
    fn stiff_parts_follow_what_drives_them() {
        // s′ = −1e9 (s − cos t) from far off: after one step of 1/4 nothing is left of the start.
        let slopes = |_| DMatrix::from_element(1, 1, -1e9);
        let end = integrate(4, &DMatrix::from_element(1, 1, 5.0), slopes, |t: f64| {
            DMatrix::from_element(1, 1, 1e9 * t.cos())
        });
        // Off by sin t/1e9.
        assert!((end[(0, 0)] - 1f64.cos()).abs() < 2e-9, "{}", end[(0, 0)]);
    }

    #[test]
    fn polynomials_are_integrated_exactly() {
        let rule = CollocationRule::new();
        for degree in 0..=8 {
            let sum: f64 = (0..STAGES).map(|i| rule.weight(i) * NODES[i].powi(degree)).sum();
            // Rounding of the weights, from a Vandermonde matrix.
            assert!((sum - 1.0 / (f64::from(degree) + 1.0)).abs() < 1e-14, "{degree}: {sum}");
        }
    }
}
