//! The search for the least squares, by the Levenberg–Marquardt method of a library (MINPACK's).
//!
//! What the library sees is u (`scale`) and the weighted residuals r = (m − y)/σ. A trial that cannot be computed counts as a bad
//! one: the search then tries a shorter step.

use super::{Calibration, CalibrationError, Experiment};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra_of_fit::{DMatrix, DVector, Dyn, storage::Owned};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// The residual of a trial that cannot be computed: worse than any other, and its square is still a number.
const BAD: f64 = 1e100;
/// The standard deviation, in u, with which the start counts as a measurement of each number: what nothing else tells stays there, and
/// what is told with a standard error σ moves by σ²/10⁶ of its way at most.
pub(super) const START: f64 = 1e3;
/// Digits to which the search goes: those of the derivatives.
const TOLERANCE: f64 = 1e-10;

/// The least squares.
pub(super) struct Found {
    pub values: Vec<f64>,
    /// How the search ended, in words.
    pub ending: String,
    /// How often all measurements were computed.
    pub evaluations: usize,
}

struct Problem<'a> {
    calibration: &'a Calibration,
    start: DVector<f64>,
    u: DVector<f64>,
}

impl Problem<'_> {
    fn values(&self) -> Vec<f64> {
        self.calibration.values_at(self.u.as_slice())
    }
}

impl Calibration {
    /// The numbers at a point of the search.
    pub(super) fn values_at(&self, u: &[f64]) -> Vec<f64> {
        self.numbers.iter().zip(u).map(|(number, u)| number.scale.outward(*u).0).collect()
    }

    /// What would be measured where the search starts, row by row.
    ///
    /// # Errors
    /// [`CalibrationError::Start`] with the first row that has nothing to measure.
    pub fn predictions(&self) -> Result<Vec<f64>, CalibrationError> {
        let start: Vec<f64> = self.numbers.iter().map(|number| number.start).collect();
        let predict = |(table, row): (&Experiment, usize)| {
            let place = || format!("{}, row {}", table.place(), row + 1);
            let found = self.value(table, table.conditions[row], &start);
            found.map_err(|reason| CalibrationError::Start { place: place(), reason })
        };
        self.rows().map(predict).collect()
    }

    /// Every row, with its table; in parallel, in this order.
    pub(super) fn rows(&self) -> impl ParallelIterator<Item = (&Experiment, usize)> {
        let rows = self.experiments.iter().flat_map(|table| (0..table.measured.len()).map(move |row| (table, row)));
        rows.collect::<Vec<_>>().into_par_iter()
    }

    /// Searches.
    ///
    /// # Errors
    /// [`CalibrationError`].
    pub(super) fn search(&self) -> Result<Found, CalibrationError> {
        self.predictions()?;
        let u = self.numbers.iter().map(|number| number.scale.inward(number.start));
        let start = DVector::from_iterator(self.numbers.len(), u);
        let problem = Problem { calibration: self, u: start.clone(), start };
        let method = LevenbergMarquardt::new().with_ftol(TOLERANCE).with_xtol(TOLERANCE).with_gtol(TOLERANCE);
        let (problem, report) = method.minimize(problem);
        if !report.termination.was_successful() && !report.termination.was_usable() {
            return Err(CalibrationError::Search(in_words(&report.termination)));
        }
        let ending = in_words(&report.termination);
        Ok(Found { values: problem.values(), ending, evaluations: report.number_of_evaluations })
    }
}

/// How a search ended.
fn in_words(termination: &TerminationReason) -> String {
    let words = match termination {
        TerminationReason::Converged { .. } | TerminationReason::Orthogonal | TerminationReason::ResidualsZero => {
            "converged"
        }
        TerminationReason::NoImprovementPossible(_) => "as near as rounding lets one come",
        TerminationReason::LostPatience => "it did not come to an end",
        TerminationReason::Numerical(_) => "numbers grew beyond all bounds",
        TerminationReason::User(_) => "where it arrived derivatives cannot be computed",
        TerminationReason::NoParameters | TerminationReason::NoResiduals => "there is nothing to fit",
        TerminationReason::WrongDimensions(_) => "the measurements changed their number",
    };
    words.to_owned()
}

trait Usable {
    fn was_usable(&self) -> bool;
}

impl Usable for TerminationReason {
    /// Whether the point is the best that rounding lets one find.
    fn was_usable(&self) -> bool {
        matches!(self, Self::NoImprovementPossible(_))
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, u: &DVector<f64>) {
        self.u.copy_from(u);
    }

    fn params(&self) -> DVector<f64> {
        self.u.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let values = self.values();
        let residual = |(table, row): (&Experiment, usize)| {
            let found = self.calibration.value(table, table.conditions[row], &values);
            found.map_or(BAD, |found| (found - table.measured[row]) / table.deviations[row])
        };
        let residuals: Vec<f64> = self.calibration.rows().map(residual).collect();
        let all =
            residuals.into_iter().chain((&self.u - &self.start).iter().map(|way| way / START).collect::<Vec<_>>());
        Some(DVector::from_iterator(self.calibration.rows().count() + self.u.len(), all))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let slopes = self.calibration.weighted_slopes(&self.values()).ok()?;
        let (rows, count) = (slopes.len(), self.u.len());
        let mut jacobian = DMatrix::zeros(rows + count, count);
        for (row, slopes) in slopes.iter().enumerate() {
            slopes.iter().enumerate().for_each(|(column, slope)| jacobian[(row, column)] = *slope);
        }
        (0..count).for_each(|index| jacobian[(rows + index, index)] = 1.0 / START);
        Some(jacobian)
    }
}

impl Calibration {
    /// ∂r/∂u, a list a row.
    pub(super) fn weighted_slopes(&self, values: &[f64]) -> Result<Vec<Vec<f64>>, String> {
        let row = |(table, row): (&Experiment, usize)| {
            let observed = self.observed(table, table.conditions[row], values)?;
            Ok(self.inward(&observed.slopes, values, table.deviations[row]))
        };
        self.rows().map(row).collect()
    }

    /// Derivatives by the numbers as derivatives by u, over a deviation.
    pub(super) fn inward(&self, slopes: &[f64], values: &[f64], deviation: f64) -> Vec<f64> {
        let entry = |((number, value), slope): ((&super::Number, &f64), &f64)| {
            slope * number.scale.outward(number.scale.inward(*value)).1 / deviation
        };
        self.numbers.iter().zip(values).zip(slopes).map(entry).collect()
    }
}
