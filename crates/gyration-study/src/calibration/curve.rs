//! The fit as a drawing shows it: curves over the conditions, with the band in which they lie with 95 %.
//!
//!   m(x) ± 1.96 √(gᵀ C g),   g = ∂m/∂p,   C the covariances of the numbers

use super::predict::Prediction;
use super::{Calibration, Experiment, ExperimentKind, Fitted};
use gyration_threads::on_own_threads;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::collections::BTreeSet;

/// Half of the width of an interval of 95 %, in standard errors.
const WIDTH: f64 = 1.959_963_984_540_054;
/// Points of a curve.
const POINTS: usize = 25;
/// Points of a curve of runs, which is nearly straight and each of which takes a run.
const RUNS: usize = 9;
/// How far a curve goes beyond the conditions, a part of their range.
const BEYOND: f64 = 0.05;

/// One table and its curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The table.
    pub experiment: Experiment,
    /// Its rows, from zero: of waves those of one branch.
    pub rows: Vec<usize>,
    /// The branch of waves.
    pub branch: Option<usize>,
    /// By condition; with but one condition, that one.
    pub points: Vec<CurvePoint>,
}

/// A point of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// The condition.
    pub condition: f64,
    /// What would be measured.
    pub value: f64,
    /// Half of the width of the band.
    pub half_width: f64,
}

impl Calibration {
    /// The curves of a fit; points that cannot be computed are left out.
    pub fn curves(&self, fitted: &Fitted) -> Vec<Curve> {
        let values: Vec<f64> = fitted.numbers.iter().map(|number| number.value).collect();
        let mut predicted = fitted.predictions.as_slice();
        let mut curves = |table: &Experiment| {
            let (own, behind) = predicted.split_at(table.measured.len().min(predicted.len()));
            predicted = behind;
            match table.kind {
                ExperimentKind::Dispersion => self.branches((table, own), fitted),
                _ => vec![self.curve((table, own), fitted, &values)],
            }
        };
        on_own_threads(|| self.experiments.iter().flat_map(&mut curves).collect())
    }

    /// The curve of a table, whose own rows are known.
    fn curve(&self, (table, known): (&Experiment, &[Prediction]), fitted: &Fitted, values: &[f64]) -> Curve {
        let low = table.conditions.iter().copied().fold(f64::INFINITY, f64::min);
        let high = table.conditions.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let beyond = BEYOND * (high - low);
        let (low, high) = (if low > 0.0 { (low - beyond).max(0.5 * low) } else { low - beyond }, high + beyond);
        let points = if table.kind == ExperimentKind::Drop { RUNS } else { POINTS };
        let count = if high > low && (table.key.is_some() || table.kind.condition().is_some()) { points } else { 1 };
        let even = (0..count).map(|k| low + (high - low) * k as f64 / (count - 1).max(1) as f64);
        // Through what was measured, as long as that is little.
        let own = table.conditions.iter().copied().filter(|_| count > 1 && table.conditions.len() <= points);
        let mut conditions: Vec<f64> = even.chain(own).collect();
        conditions.sort_unstable_by(f64::total_cmp);
        conditions.dedup();
        let point = |condition: f64| {
            let row = table.conditions.iter().position(|own| *own == condition);
            let predicted = match row.and_then(|row| known.get(row)) {
                Some(known) => known.clone(),
                None => self.predicted(table, condition, values).ok()?,
            };
            Some(point_at(condition, &predicted, fitted))
        };
        let points = conditions.into_par_iter().filter_map(point).collect();
        Curve { experiment: table.clone(), rows: (0..table.measured.len()).collect(), branch: None, points }
    }

    /// A curve a branch, through the waves that were measured, by |κ|.
    fn branches(&self, (table, known): (&Experiment, &[Prediction]), fitted: &Fitted) -> Vec<Curve> {
        let branches: BTreeSet<usize> = table.waves.iter().map(|wave| wave.branch).collect();
        let curve = |branch: usize| {
            let mut rows: Vec<usize> =
                (0..table.waves.len()).filter(|row| table.waves[*row].branch == branch).collect();
            rows.sort_by(|a, b| table.conditions[*a].total_cmp(&table.conditions[*b]));
            let point = |row: &usize| Some(point_at(table.conditions[*row], known.get(*row)?, fitted));
            let points = rows.iter().filter_map(point).collect();
            Curve { experiment: table.clone(), rows, branch: Some(branch), points }
        };
        branches.into_iter().map(curve).collect()
    }
}

fn point_at(condition: f64, predicted: &Prediction, fitted: &Fitted) -> CurvePoint {
    let slopes = nalgebra::DVector::from_column_slice(&predicted.slopes);
    let variance = slopes.dot(&(&fitted.covariance * &slopes));
    CurvePoint { condition, value: predicted.value, half_width: WIDTH * variance.max(0.0).sqrt() }
}
