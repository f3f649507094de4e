//! Least squares by the method of Levenberg and Marquardt, with the scaling and the trust region of MINPACK.
//!
//!   min ‖r(u)‖²:   (JᵀJ + λ D²) p = Jᵀr,   u ← u − p,   ‖D p‖ ≤ Δ,   D_j = the largest ‖J e_j‖ so far
//!
//! λ is that for which the step just reaches the edge of the region, within a tenth; Δ follows the ratio of what a step
//! brings to what the linear model promised. Source: Moré, *The Levenberg–Marquardt algorithm: implementation and
//! theory* (1978), and `lmder`, `lmpar` of MINPACK. J must have full rank: the start counts as a measurement (`fit`).

use gyration_threads::Interruption;
use nalgebra::{DMatrix, DVector};

/// The first Δ, in lengths of D u.
const FIRST_REGION: f64 = 100.0;
/// By how much ‖D p‖ may miss Δ, a part of it.
const MISS: f64 = 0.1;
/// Steps of Newton's method towards λ.
const MOST_TRIALS: usize = 10;
/// A step that brings less than this part of what was promised is not made.
const LEAST_RATIO: f64 = 1e-4;
/// Evaluations of r at most unless it is said otherwise, for each unknown and one more.
const PATIENCE: usize = 100;

/// Residuals and their derivatives.
pub(super) trait Problem {
    /// r; where it cannot be computed, numbers worse than any others.
    fn residuals(&self, u: &DVector<f64>) -> DVector<f64>;
    /// J = ∂r/∂u, of full rank; none where it cannot be computed.
    fn jacobian(&self, u: &DVector<f64>) -> Option<DMatrix<f64>>;
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SearchEnd {
    /// To the tolerance.
    Converged,
    /// Rounding lets one come no nearer.
    Rounding,
    /// It took too many evaluations.
    Patience,
    /// An interruption came.
    Interrupted,
    /// Where it arrived there are no derivatives, or numbers beyond all bounds.
    Stranded,
}

/// Where it ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Minimum {
    pub u: DVector<f64>,
    /// r there.
    pub residuals: DVector<f64>,
    pub ending: SearchEnd,
    /// How often r was computed, with that at the start.
    pub evaluations: usize,
}

/// Searches from u, where r is known, for the least squares, to a relative tolerance of their sum, of u, and of the
/// angle between r and J; with so many evaluations at most, the known one among them.
pub(super) fn minimize(
    problem: &impl Problem,
    (mut u, mut residuals): (DVector<f64>, DVector<f64>),
    tolerance: f64,
    patience: Option<usize>,
) -> Minimum {
    let patience = patience.unwrap_or(PATIENCE * (u.len() + 1));
    let mut norm = residuals.norm();
    let mut evaluations = 1;
    let mut region: Option<Region> = None;
    loop {
        let end = |ending| Minimum { u: u.clone(), residuals: residuals.clone(), ending, evaluations };
        let Some(jacobian) = problem.jacobian(&u).filter(|_| norm.is_finite()) else {
            return end(SearchEnd::Stranded);
        };
        let angle = largest_cosine(&jacobian, &residuals);
        if norm == 0.0 || angle <= tolerance {
            return end(SearchEnd::Converged);
        }
        let region = region.get_or_insert_with(|| Region::new(&jacobian, &u));
        region.widen_scale(&jacobian);
        loop {
            let step = region.step(&jacobian, &residuals);
            let trial = &u - &step.way;
            let there = problem.residuals(&trial);
            evaluations += 1;
            let gain = Gain::new(norm, there.norm(), (&jacobian * &step.way).norm(), &step);
            region.adapt(&gain, &step);
            let is_made = gain.ratio() >= LEAST_RATIO;
            if is_made {
                (u, residuals) = (trial, there);
                norm = residuals.norm();
            }
            let length = region.scale.component_mul(&u).norm();
            let is_within = |tolerance: f64| gain.is_within(tolerance) || region.radius <= tolerance * length;
            let ending = if Interruption::due().is_some() {
                Some(SearchEnd::Interrupted)
            } else if is_within(tolerance) {
                Some(SearchEnd::Converged)
            } else if is_within(f64::EPSILON) || angle <= f64::EPSILON {
                Some(SearchEnd::Rounding)
            } else if evaluations >= patience {
                Some(SearchEnd::Patience)
            } else {
                None
            };
            if let Some(ending) = ending {
                return Minimum { u, residuals, ending, evaluations };
            }
            if is_made {
                break;
            }
        }
    }
}

/// The largest |cos| of the angle between r and a column of J: zero at the minimum.
fn largest_cosine(jacobian: &DMatrix<f64>, residuals: &DVector<f64>) -> f64 {
    let size = residuals.norm();
    let cosines = jacobian.column_iter().map(|column| column.dot(residuals).abs() / (column.norm() * size));
    cosines.filter(|cosine| cosine.is_finite()).fold(0.0, f64::max)
}

/// Where the linear model is trusted.
struct Region {
    /// D.
    scale: DVector<f64>,
    /// Δ.
    radius: f64,
    /// λ of the last step.
    damping: f64,
    /// Whether no step has been taken yet.
    is_new: bool,
}

/// A step to a minimum of the linear model within the region.
struct TrustStep {
    /// p.
    way: DVector<f64>,
    /// ‖D p‖.
    length: f64,
    /// λ.
    damping: f64,
}

impl Region {
    fn new(jacobian: &DMatrix<f64>, u: &DVector<f64>) -> Self {
        let scale = DVector::from_iterator(jacobian.ncols(), jacobian.column_iter().map(|column| column.norm()));
        let length = scale.component_mul(u).norm();
        let radius = FIRST_REGION * if length == 0.0 { 1.0 } else { length };
        Self { scale, radius, damping: 0.0, is_new: true }
    }

    fn widen_scale(&mut self, jacobian: &DMatrix<f64>) {
        self.scale.iter_mut().zip(jacobian.column_iter()).for_each(|(scale, column)| *scale = scale.max(column.norm()));
    }

    /// The step whose length is Δ within a tenth, or that to the minimum where this is shorter.
    fn step(&self, jacobian: &DMatrix<f64>, residuals: &DVector<f64>) -> TrustStep {
        let damped = |damping: f64| Damped::new(jacobian, residuals, &self.scale, damping);
        let mut trial = damped(0.0);
        let gradient = jacobian.tr_mul(residuals).component_div(&self.scale).norm();
        let (mut low, mut high) = (0.0, gradient / self.radius);
        for count in 0..MOST_TRIALS {
            let excess = trial.step.length - self.radius;
            if excess.abs() <= MISS * self.radius || (excess < 0.0 && trial.step.damping == 0.0) {
                break;
            }
            let newton = trial.correction(&self.scale, self.radius);
            if excess > 0.0 {
                low = trial.step.damping.max(low)
            } else {
                high = trial.step.damping.min(high)
            }
            let guess = match count {
                // That of the last step is near.
                0 if self.damping > 0.0 => self.damping,
                _ => trial.step.damping + newton,
            };
            if count == 0 {
                low = newton;
            }
            trial = damped(guess.clamp(low.min(high), high));
        }
        trial.step
    }

    /// Follows what a step has brought.
    fn adapt(&mut self, gain: &Gain, step: &TrustStep) {
        if std::mem::take(&mut self.is_new) {
            self.radius = self.radius.min(step.length);
        }
        self.damping = step.damping;
        let ratio = gain.ratio();
        if ratio <= 0.25 {
            let shorter = gain.shortening();
            self.radius = shorter * self.radius.min(10.0 * step.length);
            self.damping /= shorter;
        } else if step.damping == 0.0 || ratio >= 0.75 {
            self.radius = 2.0 * step.length;
            self.damping *= 0.5;
        }
    }
}

/// The triangle R of J above √λ D, and the step that it gives.
struct Damped {
    triangle: DMatrix<f64>,
    step: TrustStep,
}

impl Damped {
    fn new(jacobian: &DMatrix<f64>, residuals: &DVector<f64>, scale: &DVector<f64>, damping: f64) -> Self {
        let (rows, count) = jacobian.shape();
        let mut above = jacobian.clone().resize_vertically(rows + count, 0.0);
        above.rows_mut(rows, count).set_diagonal(&(scale * damping.sqrt()));
        let mut right = residuals.clone().resize_vertically(rows + count, 0.0);
        let factors = above.qr();
        factors.q_tr_mul(&mut right);
        let triangle = factors.r();
        // A matrix of full rank has a solution.
        let way = triangle.solve_upper_triangular(&right.rows(0, count)).unwrap_or_else(|| DVector::zeros(count));
        let length = scale.component_mul(&way).norm();
        Self { triangle, step: TrustStep { way, length, damping } }
    }

    /// By how much λ is to change, so that ‖D p‖ gets to Δ: Newton's method on 1/‖D p‖, which is nearly linear in λ.
    fn correction(&self, scale: &DVector<f64>, radius: f64) -> f64 {
        let turned = scale.component_mul(scale).component_mul(&self.step.way) / self.step.length;
        let slope = self.triangle.tr_solve_upper_triangular(&turned).map_or(f64::INFINITY, |back| back.norm_squared());
        (self.step.length - radius) / (radius * slope)
    }
}

/// What a step brings, as parts of ‖r‖².
struct Gain {
    brought: f64,
    promised: f64,
    /// Half of the slope of ‖r‖² along the step.
    slope: f64,
}

impl Gain {
    /// From ‖r‖ before and behind a step and ‖J p‖.
    fn new(before: f64, behind: f64, change: f64, step: &TrustStep) -> Self {
        // Ten times as much is no nearer to being told apart from any other.
        let brought = if 0.1 * behind < before { 1.0 - (behind / before).powi(2) } else { -1.0 };
        let (linear, damped) = ((change / before).powi(2), step.damping * (step.length / before).powi(2));
        Self { brought, promised: linear + 2.0 * damped, slope: -(linear + damped) }
    }

    fn ratio(&self) -> f64 {
        if self.promised == 0.0 { 0.0 } else { self.brought / self.promised }
    }

    /// Whether neither matters, and the model is right.
    fn is_within(&self, tolerance: f64) -> bool {
        self.brought.abs() <= tolerance && self.promised <= tolerance && 0.5 * self.ratio() <= 1.0
    }

    /// The part of the step at which a parabola through what is known has its minimum, a tenth at least.
    fn shortening(&self) -> f64 {
        if self.brought >= 0.0 {
            return 0.5;
        }
        let part = 0.5 * self.slope / (self.slope + 0.5 * self.brought);
        if self.brought == -1.0 { 0.1 } else { part.max(0.1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Residuals and derivatives from functions.
    struct Given<R, J>(R, J);

    impl<R: Fn(&DVector<f64>) -> Vec<f64>, J: Fn(&DVector<f64>) -> Option<Vec<f64>>> Problem for Given<R, J> {
        fn residuals(&self, u: &DVector<f64>) -> DVector<f64> {
            (self.0)(u).into()
        }

        fn jacobian(&self, u: &DVector<f64>) -> Option<DMatrix<f64>> {
            let entries = (self.1)(u)?;
            Some(DMatrix::from_row_slice(entries.len() / u.len(), u.len(), &entries))
        }
    }

    /// Searches from a point of which nothing is known.
    fn minimized(problem: &impl Problem, u: DVector<f64>, tolerance: f64, patience: Option<usize>) -> Minimum {
        let residuals = problem.residuals(&u);
        minimize(problem, (u, residuals), tolerance, patience)
    }

    fn rosenbrock() -> impl Problem {
        Given(
            |u: &DVector<f64>| vec![10.0 * (u[1] - u[0] * u[0]), 1.0 - u[0]],
            |u: &DVector<f64>| Some(vec![-20.0 * u[0], 10.0, -1.0, 0.0]),
        )
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        for start in [[-1.2, 1.0], [-12.0, 10.0], [-120.0, 100.0]] {
            let found = minimized(&rosenbrock(), DVector::from_row_slice(&start), 1e-12, None);
            assert_eq!(found.ending, SearchEnd::Converged);
            assert!((found.u - DVector::repeat(2, 1.0)).norm() < 1e-10);
            // MINPACK takes 16 from the first of these starts (Moré, Garbow, Hillstrom 1981).
            assert!(found.evaluations < 40, "{}", found.evaluations);
        }
    }

    /// The minimum of a linear problem is that of the normal equations, whatever the units of the unknowns.
    #[test]
    fn scales_of_the_unknowns_do_not_count() {
        let matrix = DMatrix::from_fn(7, 3, |i, j| 1.0 / (1.0 + (i as f64 - 2.0 * j as f64).powi(2)));
        let right = DVector::from_fn(7, |i, _| (i as f64).cos());
        let exact = (matrix.transpose() * &matrix).lu().solve(&(matrix.transpose() * &right)).unwrap();
        for units in [[1.0, 1.0, 1.0], [1e-8, 1e3, 1e9]] {
            let scaled = &matrix * DMatrix::from_diagonal(&DVector::from_row_slice(&units));
            let problem = Given(
                |u: &DVector<f64>| (&scaled * u - &right).iter().copied().collect(),
                |_: &DVector<f64>| {
                    Some(scaled.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()).collect())
                },
            );
            let found = minimized(&problem, DVector::from_row_slice(&units).map(f64::recip), 1e-12, None);
            assert_eq!(found.ending, SearchEnd::Converged);
            let back = found.u.component_mul(&DVector::from_row_slice(&units));
            // The condition of the matrix is below ten.
            assert!((back - &exact).norm() < 1e-9, "{units:?}");
        }
    }

    #[test]
    fn trials_that_cannot_be_computed_are_stepped_back_from() {
        // ln u − 1, which has no value for u ≤ 0: the first step from 5 goes there.
        let problem = Given(
            |u: &DVector<f64>| vec![if u[0] > 0.0 { u[0].ln() - 1.0 } else { 1e100 }],
            |u: &DVector<f64>| (u[0] > 0.0).then(|| vec![1.0 / u[0]]),
        );
        let found = minimized(&problem, DVector::from_element(1, 30.0), 1e-12, None);
        assert_eq!(found.ending, SearchEnd::Converged);
        assert!((found.u[0] - std::f64::consts::E).abs() < 1e-10, "{}", found.u[0]);
        let stranded = minimized(&problem, DVector::from_element(1, -1.0), 1e-12, None);
        assert_eq!((stranded.ending, stranded.evaluations), (SearchEnd::Stranded, 1));
    }
}
