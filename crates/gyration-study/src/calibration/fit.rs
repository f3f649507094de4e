//! The search for the least squares (`least_squares`).
//!
//! What it sees is u (`scale`) and the weighted residuals r = (m − y)/σ. A trial that cannot be computed counts as a
//! bad one: the search then tries a shorter step.

use super::least_squares::{Minimum, Problem, SearchEnd, minimize};
use super::{Calibration, CalibrationError, Experiment};
use nalgebra::{DMatrix, DVector};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// The residual of a trial that cannot be computed: worse than any other, and its square is still a number.
const BAD: f64 = 1e100;
/// The standard deviation, in u, with which the start counts as a measurement of each number: what nothing else tells
/// stays there, and what is told with a standard error σ moves by σ²/10⁶ of its way at most.
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

/// The measurements, and the start as one more of each number.
struct Residuals<'a> {
    calibration: &'a Calibration,
    start: DVector<f64>,
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
        let problem = Residuals { calibration: self, start: start.clone() };
        let Minimum { u, ending, evaluations } = minimize(&problem, start, TOLERANCE);
        let ending = match ending {
            SearchEnd::Converged => "converged",
            SearchEnd::Rounding => "as near as rounding lets one come",
            SearchEnd::Patience => return Err(CalibrationError::Search("it did not come to an end".into())),
            SearchEnd::Stranded => {
                let reason = "where it arrived derivatives cannot be computed";
                return Err(CalibrationError::Search(reason.into()));
            }
        };
        Ok(Found { values: self.values_at(u.as_slice()), ending: ending.to_owned(), evaluations })
    }
}

impl Problem for Residuals<'_> {
    fn residuals(&self, u: &DVector<f64>) -> DVector<f64> {
        let values = self.calibration.values_at(u.as_slice());
        let residual = |(table, row): (&Experiment, usize)| {
            let found = self.calibration.value(table, table.conditions[row], &values);
            found.map_or(BAD, |found| (found - table.measured[row]) / table.deviations[row])
        };
        let mut all: Vec<f64> = self.calibration.rows().map(residual).collect();
        all.extend((u - &self.start).iter().map(|way| way / START));
        all.into()
    }

    fn jacobian(&self, u: &DVector<f64>) -> Option<DMatrix<f64>> {
        let slopes = self.calibration.weighted_slopes(&self.calibration.values_at(u.as_slice())).ok()?;
        let (rows, count) = (slopes.len(), u.len());
        let mut jacobian = DMatrix::from_row_iterator(rows, count, slopes.into_iter().flatten());
        jacobian = jacobian.resize_vertically(rows + count, 0.0);
        jacobian.rows_mut(rows, count).fill_diagonal(1.0 / START);
        Some(jacobian)
    }
}

impl Calibration {
    /// ∂r/∂u, a list a row.
    pub(super) fn weighted_slopes(&self, values: &[f64]) -> Result<Vec<Vec<f64>>, String> {
        let row = |(table, row): (&Experiment, usize)| {
            let predicted = self.predicted(table, table.conditions[row], values)?;
            Ok(self.inward(&predicted.slopes, values, table.deviations[row]))
        };
        self.rows().map(row).collect()
    }

    /// Derivatives by the numbers as derivatives by u, over a deviation.
    pub(super) fn inward(&self, slopes: &[f64], values: &[f64], deviation: f64) -> Vec<f64> {
        let entry = |((number, value), slope): ((&super::FreeNumber, &f64), &f64)| {
            slope * number.scale.outward(number.scale.inward(*value)).1 / deviation
        };
        self.numbers.iter().zip(values).zip(slopes).map(entry).collect()
    }
}
