//! Which measurement is wrong, where χ² says that one is.
//!
//!   Δχ² ≈ r²/(1 − h),   h = J C Jᵀ of its row      (what goes if a measurement is left out, to first order)
//!
//! A measurement that is off by a unit draws the numbers to itself and leaves its fault to the others, so that its own
//! residual may be the smallest of all. Those that promise most are therefore left out in turn, row by row and then
//! table by table, and the numbers are searched anew from their start. The first without which the others agree is it.

use super::fit::{Found, START};
use super::{Calibration, Experiment};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// χ² is far above the degrees of freedom beyond so many of its standard deviations, √(2·degrees).
const FAR: f64 = 5.0;
/// How many rows, and how many tables, are left out in turn.
const MOST: usize = 3;
/// Evaluations of all measurements in a search without one of them.
const PATIENCE: usize = 60;

/// Of a search that is in doubt: how many rows are left out in turn, and evaluations in a search without one of them.
const IN_DOUBT: (usize, usize) = (2, 30);
/// A measurement is at odds with others if it is so many standard errors off what they tell of it.
const AT_ODDS: f64 = 5.0;

/// A measurement, or a table of them, without which all others agree.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Suspect {
    /// The table, as `drop.0`.
    pub table: String,
    /// The row, from zero; none if it is the whole table.
    pub row: Option<usize>,
    /// χ² without it.
    pub chi_squared: f64,
    /// The degrees of freedom that are left.
    pub degrees_of_freedom: usize,
    /// What was measured, in the first row if it is the whole table.
    pub measured: f64,
    /// What the others tell of it.
    pub expected: f64,
}

/// Whether χ² is too large for its degrees of freedom.
pub(super) fn is_far(chi_squared: f64, degrees_of_freedom: usize) -> bool {
    let freedom = degrees_of_freedom as f64;
    freedom > 0.0 && chi_squared > freedom + FAR * (2.0 * freedom).sqrt()
}

/// What a fit knows of its measurements.
pub(super) struct Leverage<'a> {
    /// r.
    pub residuals: &'a [f64],
    /// J, a row a measurement.
    pub jacobian: &'a DMatrix<f64>,
    /// C.
    pub covariance: &'a DMatrix<f64>,
    pub degrees_of_freedom: usize,
}

/// Rows of a table that are left out; all if there is none.
#[derive(Clone, Copy)]
struct Left {
    table: usize,
    row: Option<usize>,
}

/// Measurements that agree once some are left out.
struct Agreement {
    suspect: Suspect,
    others: Calibration,
    /// The numbers that they tell.
    values: Vec<f64>,
}

impl Calibration {
    /// The measurement that is wrong, if one alone is.
    pub(super) fn suspect(&self, known: &Leverage) -> Option<Suspect> {
        let chi_squared: f64 = known.residuals.iter().map(|residual| residual * residual).sum();
        if !is_far(chi_squared, known.degrees_of_freedom) {
            return None;
        }
        let gains: Vec<f64> = (0..known.residuals.len()).map(|row| known.gain(row)).collect();
        self.suspect_by(&gains, known.degrees_of_freedom)
    }

    /// The measurement that is wrong, if one alone is; `gains` are what χ² would lose without each row.
    pub(super) fn suspect_by(&self, gains: &[f64], degrees_of_freedom: usize) -> Option<Suspect> {
        let by_row: Vec<(f64, Left)> = gains.iter().copied().zip(self.rows_to_leave()).collect();
        let of_table = |table: usize| by_row.iter().filter(move |(_, left)| left.table == table).map(|(gain, _)| gain);
        let by_table = (0..self.experiments.len())
            .filter(|&table| self.experiments[table].measured.len() > 1)
            .map(|table| (of_table(table).sum(), Left { table, row: None }));
        let mut candidates = largest(by_row.clone(), MOST);
        candidates.extend(largest(by_table.collect(), MOST));
        let agreement = |left| self.agreement_without(left, degrees_of_freedom, PATIENCE);
        candidates.into_iter().find_map(agreement).map(|agreement| agreement.suspect)
    }

    /// The row that is at odds with all others, which agree, if there is one among those of the largest `gains`. What
    /// the others do not tell is at odds with nothing.
    pub(super) fn row_at_odds(&self, gains: &[f64], degrees_of_freedom: usize) -> Option<Suspect> {
        let (most, patience) = IN_DOUBT;
        let candidates = largest(gains.iter().copied().zip(self.rows_to_leave()).collect(), most);
        candidates.into_iter().find_map(|left| {
            let agreement = self.agreement_without(left, degrees_of_freedom, patience)?;
            self.is_at_odds(left, &agreement).then_some(agreement.suspect)
        })
    }

    /// Whether a row is farther off what the others tell than their numbers are known: r² > z²(1 + g C gᵀ), with C of
    /// the others.
    fn is_at_odds(&self, left: Left, Agreement { suspect, others, values }: &Agreement) -> bool {
        let (Some(row), experiment) = (left.row, &self.experiments[left.table]) else { return false };
        let deviation = experiment.deviations[row];
        let Ok(predicted) = self.prediction_of_row(experiment, row, values) else { return false };
        let Ok(slopes) = others.weighted_slopes(values) else { return false };
        let count = values.len();
        let jacobian = DMatrix::from_row_iterator(slopes.len(), count, slopes.into_iter().flatten());
        // The start counts as a measurement.
        let normal = jacobian.tr_mul(&jacobian) + DMatrix::identity(count, count) / (START * START);
        let own = DVector::from_vec(others.inward(&predicted.slopes, values, deviation));
        let Some(solved) = normal.cholesky().map(|normal| normal.solve(&own)) else { return false };
        let off = (suspect.expected - suspect.measured) / deviation;
        off * off > AT_ODDS * AT_ODDS * (1.0 + own.dot(&solved))
    }

    /// Every row by itself, in order.
    fn rows_to_leave(&self) -> impl Iterator<Item = Left> {
        self.experiments.iter().enumerate().flat_map(|(table, experiment)| {
            (0..experiment.measured.len()).map(move |row| Left { table, row: Some(row) })
        })
    }

    /// What the measurements tell without some of them, if they agree.
    fn agreement_without(&self, left: Left, degrees_of_freedom: usize, patience: usize) -> Option<Agreement> {
        let experiment = &self.experiments[left.table];
        let count = left.row.map_or(experiment.measured.len(), |_| 1);
        let degrees_of_freedom = degrees_of_freedom.checked_sub(count).filter(|freedom| *freedom > 0)?;
        let (others, Found { values, .. }) = self.without(left).settle(Some(patience)).ok()?;
        let fitted = others.values_of_rows(&values).into_iter().collect::<Result<Vec<_>, _>>().ok()?;
        let chi_squared = others.residuals_of(fitted).map(|residual| residual.weighted * residual.weighted).sum();
        if is_far(chi_squared, degrees_of_freedom) {
            return None;
        }
        let row = left.row.unwrap_or(0);
        let expected = self.value_of_row(experiment, row, &values).ok()?;
        let measured = experiment.measured[row];
        let table = experiment.place();
        let suspect = Suspect { table, row: left.row, chi_squared, degrees_of_freedom, measured, expected };
        Some(Agreement { suspect, others, values })
    }

    fn without(&self, left: Left) -> Self {
        let mut others = self.clone();
        let Experiment { conditions, measured, deviations, .. } = &mut others.experiments[left.table];
        for column in [conditions, measured, deviations] {
            match left.row {
                Some(row) => drop(column.remove(row)),
                None => column.clear(),
            }
        }
        let waves = &mut others.experiments[left.table].waves;
        match left.row.filter(|row| *row < waves.len()) {
            Some(row) => drop(waves.remove(row)),
            None => waves.retain(|_| left.row.is_some()),
        }
        others
    }
}

impl Leverage<'_> {
    /// What χ² would lose without a row.
    fn gain(&self, row: usize) -> f64 {
        let slopes = DVector::from_iterator(self.jacobian.ncols(), self.jacobian.row(row).iter().copied());
        let leverage = slopes.dot(&(self.covariance * &slopes));
        // A row that alone tells a number has a residual of zero, whatever was measured.
        self.residuals[row].powi(2) / (1.0 - leverage).max(f64::EPSILON)
    }
}

/// So many of those that promise most, the largest first.
fn largest(mut candidates: Vec<(f64, Left)>, most: usize) -> Vec<Left> {
    candidates.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    candidates.into_iter().take(most).map(|(_, left)| left).collect()
}
