//! What is known of the numbers: values, standard errors, correlations, and what the measurements cannot tell apart.
//!
//!   C = (JᵀJ)⁻¹ = V diag(1/s²) Vᵀ,   J = ∂r/∂u = U diag(s) Vᵀ
//!
//! with residuals weighted by the deviations of the measurements, which are taken as they are: χ² over the degrees of
//! freedom says whether they can be right. Along a direction v that tells less than the start counts (`fit`) nothing is
//! fitted: it is left out of C and of what is counted. A number has no error where that would be a factor of twenty or
//! more, or where a direction that is not fitted, followed so far, moves it by more than its error.

use super::fit::{Found, START};
use super::predict::Prediction;
use super::suspect::{Leverage, Suspect};
use super::{Calibration, CalibrationError, FreeNumber};
use gyration_threads::{Interruption, on_own_threads};
use nalgebra::DMatrix;
use serde::Serialize;

/// A number is told if its standard error is below this (factor e³), on the scale on which it is varied.
const LOOSE: f64 = 3.0;
/// A direction that moves a number by less is said not to move it: its derivatives are no better.
const NOISE: f64 = 1e-5;
/// Smaller singular values than this part of the largest are the rounding of the derivatives.
const ROUNDING: f64 = 1e-8;

/// What was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fitted {
    /// The numbers.
    pub numbers: Vec<FittedNumber>,
    /// Correlations of their errors, row by row; none with what is not determined.
    pub correlations: Vec<Vec<Option<f64>>>,
    /// Σ ((m − y)/σ)².
    pub chi_squared: f64,
    /// Measurements less directions in which numbers were fitted.
    pub degrees_of_freedom: usize,
    /// The measurement without which the others agree, if χ² is far above the degrees of freedom and there is one.
    pub suspect: Option<Suspect>,
    /// What is left of each measurement.
    pub residuals: Vec<Residual>,
    /// What cannot be told apart.
    pub undetermined: Vec<Undetermined>,
    /// How the search ended.
    pub ending: String,
    /// How often it computed all measurements.
    pub evaluations: usize,
    /// Covariances of the numbers, D C D with D = diag(dp/du), without the directions in which nothing was fitted.
    #[serde(skip)]
    pub(super) covariance: DMatrix<f64>,
    /// What the scene with these numbers gives in each row.
    #[serde(skip)]
    pub(super) predictions: Vec<Prediction>,
}

/// A number that was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedNumber {
    /// Its name in the file.
    pub name: String,
    /// The keys of the scene that have it.
    pub keys: Vec<String>,
    /// Its value, in SI units.
    pub value: f64,
    /// Its standard error; none where it is not determined.
    pub error: Option<f64>,
    /// Whether it lies on a bound.
    pub is_on_bound: bool,
}

/// A measurement and what was found for it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Residual {
    /// The table, as `drop.0`.
    pub table: String,
    /// The row, from zero.
    pub row: usize,
    /// The condition.
    pub condition: f64,
    /// What was measured.
    pub measured: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// What the scene gives.
    pub fitted: f64,
    /// (fitted − measured)/deviation.
    pub weighted: f64,
}

/// A combination of numbers that the measurements leave open.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Undetermined {
    /// The numbers that take part, with dp/p along it, the largest being one.
    pub direction: Vec<(String, f64)>,
    /// What that means, in a sentence.
    pub in_words: String,
}

impl Calibration {
    /// Finds the numbers that fit best.
    ///
    /// # Errors
    /// [`CalibrationError`] if the search cannot begin or does not end.
    pub fn fit(&self) -> Result<Fitted, CalibrationError> {
        let interruption = Interruption::in_force().after(self.max_wall_time());
        on_own_threads(|| {
            interruption.within(|| {
                let (sized, found) = self.settle(None)?;
                sized.judge(found)
            })
        })
    }

    /// What is known of the numbers that a search has found, with the sizes that it found too.
    fn judge(&self, found: Found) -> Result<Fitted, CalibrationError> {
        let values = found.values;
        // What would be measured there, of which slopes, residuals and the points of a drawing are made.
        let predictions = self.predictions_of_rows(&values).into_iter().collect::<Result<Vec<_>, _>>();
        if let Some(cause) = Interruption::due() {
            // A run that was given up has derivatives as well: those of an earlier time.
            return Err(self.interrupted(cause, &found.residuals));
        }
        let predictions = predictions.map_err(CalibrationError::Search)?;
        let slopes = self.slopes_of(&predictions, &values);
        let residuals: Vec<_> = self.residuals_of(predictions.iter().map(|predicted| predicted.value)).collect();
        let (rows, count) = (slopes.len(), values.len());
        let jacobian = DMatrix::from_row_iterator(rows, count, slopes.into_iter().flatten());
        let Eigendirections { covariance, all } = Eigendirections::of(&jacobian);
        let fitted_directions = all.iter().filter(|direction| direction.spread.is_some()).count();
        let degrees_of_freedom = rows.saturating_sub(fitted_directions);
        let weighted: Vec<f64> = residuals.iter().map(|residual| residual.weighted).collect();
        let suspect = self.suspect(&Leverage {
            residuals: &weighted,
            jacobian: &jacobian,
            covariance: &covariance,
            degrees_of_freedom,
        });
        let scales: Vec<f64> =
            self.numbers.iter().zip(&values).map(|(number, value)| number.scale.slope(*value)).collect();
        let error = |index: usize| covariance[(index, index)].sqrt();
        // Whether a direction keeps a number from being told, or is itself not told by that number.
        let opens = |direction: &Eigendirection, index: usize| match direction.spread {
            Some(spread) => direction.along[index].abs() * spread * scales[index] > LOOSE,
            None => direction.along[index].abs() * LOOSE > error(index).max(NOISE),
        };
        let is_open = |index: usize| {
            self.numbers[index].scale.is_on_bound(values[index])
                || error(index) * scales[index] > LOOSE
                || all.iter().any(|direction| opens(direction, index))
        };
        let undetermined = |direction: &Eigendirection| {
            let taking: Vec<bool> = (0..count).map(|index| opens(direction, index)).collect();
            let is_any = direction.spread.is_none() || taking.contains(&true);
            is_any.then(|| self.undetermined(&direction.along, &taking, &values))
        };
        let mut undetermined: Vec<_> = all.iter().filter_map(undetermined).collect();
        for index in (0..count).filter(|index| is_open(*index)) {
            let is_named =
                |open: &Undetermined| open.direction.iter().any(|(name, _)| *name == self.numbers[index].name);
            if !undetermined.iter().any(is_named) {
                let alone: Vec<bool> = (0..count).map(|other| other == index).collect();
                let along: Vec<f64> = alone.iter().map(|own| f64::from(u8::from(*own))).collect();
                undetermined.push(self.undetermined(&along, &alone, &values));
            }
        }
        let outward = |(number, value): (&FreeNumber, &f64)| number.scale.outward(number.scale.inward(*value)).1;
        let outward: Vec<f64> = self.numbers.iter().zip(&values).map(outward).collect();
        let number = |(index, number): (usize, &FreeNumber)| FittedNumber {
            name: number.name.clone(),
            keys: number.keys.clone(),
            value: values[index],
            error: (!is_open(index)).then(|| error(index) * outward[index].abs()),
            is_on_bound: number.scale.is_on_bound(values[index]),
        };
        let correlation = |i: usize, j: usize| {
            let size = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
            (!is_open(i) && !is_open(j)).then(|| covariance[(i, j)] / size)
        };
        Ok(Fitted {
            numbers: self.numbers.iter().enumerate().map(number).collect(),
            correlations: (0..count).map(|i| (0..count).map(|j| correlation(i, j)).collect()).collect(),
            chi_squared: residuals.iter().map(|residual| residual.weighted * residual.weighted).sum(),
            degrees_of_freedom,
            suspect,
            residuals,
            undetermined,
            ending: found.ending,
            evaluations: found.evaluations,
            covariance: DMatrix::from_fn(count, count, |i, j| outward[i] * covariance[(i, j)] * outward[j]),
            predictions,
        })
    }

    /// What is left of each measurement, from what would be measured in each row.
    pub(super) fn residuals_of(&self, fitted: impl IntoIterator<Item = f64>) -> impl Iterator<Item = Residual> {
        self.rows().zip(fitted).map(|((table, row), fitted)| {
            let (condition, measured, deviation) = (table.conditions[row], table.measured[row], table.deviations[row]);
            let weighted = (fitted - measured) / deviation;
            Residual { table: table.place(), row, condition, measured, deviation, fitted, weighted }
        })
    }

    /// What a direction leaves open: the numbers that take part, and the one that moves most.
    fn undetermined(&self, direction: &[f64], taking: &[bool], values: &[f64]) -> Undetermined {
        let beside = self.numbers.iter().zip(values);
        let on_bound: Vec<&str> = beside
            .clone()
            .filter(|(number, value)| number.scale.is_on_bound(**value))
            .map(|(number, _)| number.name.as_str())
            .collect();
        // From u to relative changes.
        let relative = |((number, value), part): ((&FreeNumber, &f64), &f64)| {
            let size = if *value == 0.0 { number.scale.size } else { value.abs() };
            part * number.scale.outward(number.scale.inward(*value)).1 / size
        };
        let direction: Vec<f64> =
            if on_bound.is_empty() { beside.zip(direction).map(relative).collect() } else { direction.to_vec() };
        let direction = direction.as_slice();
        let largest =
            direction.iter().copied().fold(0.0, |most: f64, part| if part.abs() > most.abs() { part } else { most });
        let parts = self.numbers.iter().zip(direction).zip(taking);
        let named = parts.filter(|((_, part), taking)| **taking || part.abs() == largest.abs());
        let direction: Vec<(String, f64)> =
            named.map(|((number, part), _)| (number.name.clone(), part / largest)).collect();
        let in_words = match direction.as_slice() {
            [(name, _)] if on_bound.contains(&name.as_str()) => {
                format!(
                    "`{name}` lies on its bound: what was measured asks for less or more than that, or does not tell it"
                )
            }
            [(name, _)] => format!("what was measured does not tell `{name}`"),
            parts => {
                let moves: Vec<String> = parts.iter().map(|(name, part)| format!("{name} ({part:+.3})")).collect();
                let names: Vec<String> = parts.iter().map(|(name, _)| format!("`{name}`")).collect();
                format!(
                    "{} cannot be told apart: changes in the ratio {} leave everything measured as it is (relative \
                        changes)",
                    names.join(" and "),
                    moves.join(" : ")
                )
            }
        };
        Undetermined { direction, in_words }
    }
}

/// A direction in u.
struct Eigendirection {
    along: Vec<f64>,
    /// 1/s, the standard error along it; none where nothing was fitted.
    spread: Option<f64>,
}

/// The eigenvectors of JᵀJ, and C from those along which something was fitted.
struct Eigendirections {
    covariance: DMatrix<f64>,
    all: Vec<Eigendirection>,
}

impl Eigendirections {
    fn of(jacobian: &DMatrix<f64>) -> Self {
        let normal = jacobian.transpose() * jacobian;
        let eigen = normal.symmetric_eigen();
        let largest = eigen.eigenvalues.iter().fold(0.0, |most: f64, value| most.max(*value));
        // s², from a product of J with itself: rounding is that of s² too. The start counts as a measurement.
        let least = (ROUNDING * ROUNDING * largest).max(f64::EPSILON * largest).max(1.0 / (START * START));
        let mut covariance = DMatrix::zeros(jacobian.ncols(), jacobian.ncols());
        let mut all = Vec::new();
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            let is_fitted = *value > least;
            if is_fitted {
                covariance += vector * vector.transpose() / *value;
            }
            all.push(Eigendirection {
                along: vector.iter().copied().collect(),
                spread: is_fitted.then(|| 1.0 / value.sqrt()),
            });
        }
        Self { covariance, all }
    }
}
