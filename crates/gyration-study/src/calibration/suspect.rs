//! Which measurement is wrong, where χ² says that one is.
//!
//!   Δχ² ≈ r²/(1 − h),   h = J C Jᵀ of its row      (what goes if a measurement is left out, to first order)
//!
//! A measurement that is off by a unit draws the numbers to itself and leaves its fault to the others, so that its own
//! residual may be the smallest of all. Those that promise most are therefore left out in turn, row by row and then
//! table by table, and the numbers are searched anew from their start. The first without which the others agree is it.

use super::fit::Found;
use super::{Calibration, Experiment};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// χ² is far above the degrees of freedom beyond so many of its standard deviations, √(2·degrees).
const FAR: f64 = 5.0;
/// How many rows, and how many tables, are left out in turn.
const MOST: usize = 3;
/// Evaluations of all measurements in a search without one of them.
const PATIENCE: usize = 60;

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
        let places = self.experiments.iter().enumerate();
        let rows: Vec<Left> = places
            .flat_map(|(table, experiment)| {
                (0..experiment.measured.len()).map(move |row| Left { table, row: Some(row) })
            })
            .collect();
        let by_row: Vec<(f64, Left)> = gains.iter().copied().zip(rows.iter().copied()).collect();
        let of_table = |table: usize| by_row.iter().filter(move |(_, left)| left.table == table).map(|(gain, _)| gain);
        let by_table = (0..self.experiments.len())
            .filter(|&table| self.experiments[table].measured.len() > 1)
            .map(|table| (of_table(table).sum(), Left { table, row: None }));
        let mut candidates = largest(by_row.clone());
        candidates.extend(largest(by_table.collect()));
        candidates.into_iter().find_map(|left| self.agreement_without(left, degrees_of_freedom))
    }

    /// The others by themselves, if they agree.
    fn agreement_without(&self, left: Left, degrees_of_freedom: usize) -> Option<Suspect> {
        let experiment = &self.experiments[left.table];
        let count = left.row.map_or(experiment.measured.len(), |_| 1);
        let degrees_of_freedom = degrees_of_freedom.checked_sub(count).filter(|freedom| *freedom > 0)?;
        let others = self.without(left);
        let Found { values, .. } = others.search(Some(PATIENCE)).ok()?;
        let residuals = others.residuals(&values).ok()?;
        let chi_squared = residuals.iter().map(|residual| residual.weighted * residual.weighted).sum();
        if is_far(chi_squared, degrees_of_freedom) {
            return None;
        }
        let row = left.row.unwrap_or(0);
        let expected = self.value(experiment, experiment.conditions[row], &values).ok()?;
        let measured = experiment.measured[row];
        Some(Suspect { table: experiment.place(), row: left.row, chi_squared, degrees_of_freedom, measured, expected })
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

/// Those that promise most, the largest first.
fn largest(mut candidates: Vec<(f64, Left)>) -> Vec<Left> {
    candidates.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    candidates.into_iter().take(MOST).map(|(_, left)| left).collect()
}
