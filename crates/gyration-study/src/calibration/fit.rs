//! The search for the least squares (`least_squares`).
//!
//! What it sees is u (`scale`) and the weighted residuals r = (m − y)/σ. A trial that cannot be computed counts as a
//! bad one: the search then tries a shorter step. Where a number comes out larger than what counts as its size, the
//! search is made anew with that size: the start would hold the number back.

use super::least_squares::{Minimum, Problem, SearchEnd, minimize};
use super::predict::Prediction;
use super::{Calibration, CalibrationError, Experiment};
use gyration_threads::{Interrupted, Interruption};
use nalgebra::{DMatrix, DVector};

/// The residual of a trial that cannot be computed: worse than any other, and its square is still a number.
const BAD: f64 = 1e100;
/// The standard deviation, in u, with which the start counts as a measurement of each number: what nothing else tells
/// stays there, and what is told with a standard error σ moves by σ²/10⁶ of its way at most.
pub(super) const START: f64 = 1e3;
/// By what part of itself a step of the search may still lessen χ². Rebounds have derivatives to 1e-6: where they leave
/// something, the numbers found are off by some 1e-6 of what is left, in standard deviations.
const TOLERANCE: f64 = 1e-10;

/// Searches with sizes of their own at most: each of them passes some decades, and numbers have 616.
const MOST_SIZES: usize = 200;

/// Evaluations after which a search looks whether one measurement leads it astray.
const DOUBT: usize = 30;

/// The least squares.
pub(super) struct Found {
    pub values: Vec<f64>,
    /// r there.
    pub residuals: Vec<f64>,
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
        let placed = |((table, row), found): ((&Experiment, usize), Result<f64, String>)| {
            let place = format!("{}, row {}", table.place(), row + 1);
            found.map_err(|reason| CalibrationError::Start { place, reason })
        };
        self.rows().zip(self.values_of_rows(&start)).map(placed).collect()
    }

    /// Searches until no number outgrows its size, with so many evaluations at most a search if that is given; gives
    /// the calibration with the sizes that were found.
    ///
    /// # Errors
    /// [`CalibrationError`].
    pub(super) fn settle(&self, patience: Option<usize>) -> Result<(Self, Found), CalibrationError> {
        let (mut sized, mut evaluations) = (self.clone(), 0);
        for _ in 0..MOST_SIZES {
            let found = sized.search(patience)?;
            evaluations += found.evaluations;
            let mut is_outgrown = false;
            for (number, value) in sized.numbers.iter_mut().zip(&found.values) {
                is_outgrown |= number.scale.grow(*value);
            }
            if !is_outgrown {
                return Ok((sized, Found { evaluations, ..found }));
            }
        }
        Err(CalibrationError::Search("a number grows beyond all bounds".to_owned()))
    }

    /// Searches with the sizes that the numbers have.
    fn search(&self, patience: Option<usize>) -> Result<Found, CalibrationError> {
        let predicted = self.predictions();
        if let Some(cause) = Interruption::due() {
            return Err(self.interrupted(cause, &[]));
        }
        let predicted = predicted?;
        let first = self.squares(&predicted);
        let u = self.numbers.iter().map(|number| number.scale.inward(number.start));
        let start = DVector::from_iterator(self.numbers.len(), u);
        let problem = Residuals { calibration: self, start: start.clone() };
        let known = problem.weighted(&start, predicted.into_iter().map(Ok));
        let mut found = minimize(&problem, (start, known), TOLERANCE, Some(patience.unwrap_or(DOUBT)));
        if patience.is_none() && found.ending == SearchEnd::Patience {
            // On its way the search may have satisfied the wrong measurement at the cost of the others.
            let gains: Vec<f64> = first.iter().zip(&found.residuals).map(|(first, now)| first.max(now * now)).collect();
            if let Some(suspect) = self.row_at_odds(&gains, gains.len().saturating_sub(self.numbers.len())) {
                let reason = format!("it had come to no end after {DOUBT} evaluations; {}", suspect.in_words());
                return Err(CalibrationError::Search(reason));
            }
            let more = minimize(&problem, (found.u, found.residuals), TOLERANCE, None);
            found = Minimum { evaluations: found.evaluations + more.evaluations - 1, ..more };
        }
        let Minimum { u, residuals, ending, evaluations } = found;
        if let Some(cause) = Interruption::due() {
            return Err(self.interrupted(cause, residuals.as_slice()));
        }
        let ending = match ending {
            SearchEnd::Converged => "converged",
            SearchEnd::Rounding => "as near as rounding lets one come",
            SearchEnd::Patience | SearchEnd::Interrupted => {
                return Err(self.lost("it did not come to an end", (&first, &residuals), patience));
            }
            SearchEnd::Stranded => {
                return Err(self.lost(
                    "where it arrived derivatives cannot be computed",
                    (&first, &residuals),
                    patience,
                ));
            }
        };
        let (values, residuals) = (self.values_at(u.as_slice()), residuals.as_slice().to_vec());
        Ok(Found { values, residuals, ending: ending.to_owned(), evaluations })
    }
}

impl Calibration {
    /// r² of each row, from what would be measured.
    fn squares(&self, predictions: &[f64]) -> Vec<f64> {
        let squared = |((table, row), found): ((&Experiment, usize), &f64)| {
            ((found - table.measured[row]) / table.deviations[row]).powi(2)
        };
        self.rows().zip(predictions).map(squared).collect()
    }

    /// The end of a search that led nowhere; of one with all the patience there is, with the measurement that led it
    /// there if one alone did, else with the one that was farthest off at the start.
    fn lost(&self, reason: &str, (first, now): (&[f64], &DVector<f64>), patience: Option<usize>) -> CalibrationError {
        if patience.is_some() {
            return CalibrationError::Search(reason.to_owned());
        }
        let gains: Vec<f64> = now.iter().take(first.len()).map(|residual| residual * residual).collect();
        let suspect = self.suspect_by(&gains, first.len().saturating_sub(self.numbers.len()));
        let named = suspect.map_or_else(|| self.farthest_at_start(first), |suspect| suspect.in_words());
        CalibrationError::Search(format!("{reason}; {named}"))
    }

    /// The row of the largest r² where the search began, in words.
    fn farthest_at_start(&self, first: &[f64]) -> String {
        let rows = self.rows().zip(first);
        let farthest = rows.max_by(|(_, one), (_, other)| one.total_cmp(other));
        farthest.map_or_else(String::new, |((table, row), square)| {
            let off = square.sqrt();
            format!("where it began, row {} of {} was farthest off, by {off:.3e} deviations", row + 1, table.place())
        })
    }

    /// Every row with its table, in order.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&Experiment, usize)> {
        self.experiments.iter().flat_map(|table| (0..table.measured.len()).map(move |row| (table, row)))
    }

    /// The end of a search that was given up, with the residuals at the best point so far; none before the first.
    pub(super) fn interrupted(&self, cause: Interrupted, known: &[f64]) -> CalibrationError {
        let farthest = self.rows().zip(known).max_by(|(_, one), (_, other)| one.abs().total_cmp(&other.abs()));
        let why = match cause {
            Interrupted::Raised => "by request",
            Interrupted::Overdue => "after solver.max_wall_time",
        };
        let fix = match (cause, farthest) {
            (Interrupted::Raised, _) => "let it run longer",
            (Interrupted::Overdue, Some(_)) => {
                "look at that measurement and its unit, raise solver.max_wall_time, or start the search nearer"
            }
            (Interrupted::Overdue, None) => "raise solver.max_wall_time: computing every measurement once takes longer",
        };
        let reached = farthest.map_or_else(
            || "before the measurements were computed once".to_owned(),
            |((table, row), residual)| {
                let chi_squared: f64 = known.iter().map(|residual| residual * residual).sum();
                let (row, place, off) = (row + 1, table.place(), residual.abs());
                format!("at χ² = {chi_squared:.4e}, with row {row} of {place} farthest off, by {off:.3e} deviations")
            },
        );
        CalibrationError::Interrupted { why, reached, fix }
    }
}

impl Residuals<'_> {
    /// r, from what would be measured at u in each row.
    fn weighted(&self, u: &DVector<f64>, found: impl IntoIterator<Item = Result<f64, String>>) -> DVector<f64> {
        let residual = |((table, row), found): ((&Experiment, usize), Result<f64, String>)| {
            found.map_or(BAD, |found| (found - table.measured[row]) / table.deviations[row])
        };
        let mut all: Vec<f64> = self.calibration.rows().zip(found).map(residual).collect();
        all.extend((u - &self.start).iter().map(|way| way / START));
        all.into()
    }
}

impl Problem for Residuals<'_> {
    fn residuals(&self, u: &DVector<f64>) -> DVector<f64> {
        let found = self.calibration.values_of_rows(&self.calibration.values_at(u.as_slice()));
        self.weighted(u, found)
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
        let found = self.predictions_of_rows(values).into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(self.slopes_of(&found, values))
    }

    /// ∂r/∂u of what would be measured in each row, a list a row.
    pub(super) fn slopes_of(&self, predictions: &[Prediction], values: &[f64]) -> Vec<Vec<f64>> {
        let row = |((table, row), found): ((&Experiment, usize), &Prediction)| {
            self.inward(&found.slopes, values, table.deviations[row])
        };
        self.rows().zip(predictions).map(row).collect()
    }

    /// Derivatives by the numbers as derivatives by u, over a deviation.
    pub(super) fn inward(&self, slopes: &[f64], values: &[f64], deviation: f64) -> Vec<f64> {
        let entry = |((number, value), slope): ((&super::FreeNumber, &f64), &f64)| {
            slope * number.scale.outward(number.scale.inward(*value)).1 / deviation
        };
        self.numbers.iter().zip(values).zip(slopes).map(entry).collect()
    }
}
