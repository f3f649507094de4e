//! What a scene says that would be measured.
//!
//! | measured | computed |
//! |---|---|
//! | rebound | the smallest gap at the first apex behind the first closest approach, from rest at a gap h |
//! | gap | of the rest state, where the exact balance has no force left |
//! | speed on a slope θ | at which friction is m g sin θ, at rest under g cos θ; without a bound m g sin θ/c |
//! | slope where sliding begins | tan θ = F/(m g cos θ), F the most that friction holds at rest under g cos θ |
//! | frequency | that of the branch at κ, counted by ascending frequency (`dispersion`) |
//! | pull-off | the largest force towards the support over all gaps, in the attitude of the start |

use super::nearby::Nearby;
use super::pull_off::pull_off;
use super::rebound::Drop;
use super::scene::body;
use super::sliding::speed;
use super::{Calibration, Experiment, ExperimentKind};
use gyration_scene::Scene;
use gyration_threads::Interruption;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Step of differences, a part of the number.
const DIFFERENCE: f64 = 1e-4;

/// What would be measured, and its derivatives by the numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Prediction {
    pub value: f64,
    pub slopes: Vec<f64>,
}

impl Calibration {
    /// What would be measured in a row of a table.
    ///
    /// # Errors
    /// Why nothing would be, in words.
    pub(super) fn value_of_row(&self, table: &Experiment, row: usize, values: &[f64]) -> Result<f64, String> {
        match table.waves.get(row) {
            Some(wave) => Ok(self.frequencies(&table.of_wave(wave), values)?[0]),
            None => self.value(table, table.conditions[row], values),
        }
    }

    /// The same with derivatives by the numbers.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub(super) fn prediction_of_row(
        &self,
        table: &Experiment,
        row: usize,
        values: &[f64],
    ) -> Result<Prediction, String> {
        match table.waves.get(row) {
            Some(wave) => Ok(self.predicted_frequencies(&table.of_wave(wave), values)?.swap_remove(0)),
            None => self.predicted(table, table.conditions[row], values),
        }
    }

    /// What would be measured in every row.
    pub(super) fn values_of_rows(&self, values: &[f64]) -> Vec<Result<f64, String>> {
        let row = |table: &Experiment, row: usize| self.value(table, table.conditions[row], values);
        self.of_rows(row, |table| self.frequencies(table, values))
    }

    /// The same with derivatives by the numbers.
    pub(super) fn predictions_of_rows(&self, values: &[f64]) -> Vec<Result<Prediction, String>> {
        let row = |table: &Experiment, row: usize| self.predicted(table, table.conditions[row], values);
        self.of_rows(row, |table| self.predicted_frequencies(table, values))
    }

    /// Something of every row, in order: of a table of waves all at once, since they share a rest.
    fn of_rows<T: Send>(
        &self,
        row: impl Fn(&Experiment, usize) -> Result<T, String> + Sync,
        waves: impl Fn(&Experiment) -> Result<Vec<T>, String> + Sync,
    ) -> Vec<Result<T, String>> {
        let jobs = self.experiments.iter().flat_map(|table| match table.kind {
            ExperimentKind::Dispersion => vec![(table, None)],
            _ => (0..table.measured.len()).map(|row| (table, Some(row))).collect(),
        });
        let interruption = Interruption::in_force();
        let work = |(table, at): (&Experiment, Option<usize>)| match at {
            Some(at) => vec![interruption.within(|| row(table, at))],
            None => match interruption.within(|| waves(table)) {
                Ok(all) => all.into_iter().map(Ok).collect(),
                Err(reason) => table.waves.iter().map(|_| Err(reason.clone())).collect(),
            },
        };
        let found: Vec<Vec<_>> = jobs.collect::<Vec<_>>().into_par_iter().map(work).collect();
        found.into_iter().flatten().collect()
    }

    /// What would be measured under a condition.
    ///
    /// # Errors
    /// Why nothing would be, in words.
    pub(super) fn value(&self, experiment: &Experiment, condition: f64, values: &[f64]) -> Result<f64, String> {
        self.value_beside(experiment, condition, values, &mut Nearby::default())
    }

    /// The same, looked for where it was found with other numbers nearby: the same but for rounding.
    fn value_beside(
        &self,
        experiment: &Experiment,
        condition: f64,
        values: &[f64],
        nearby: &mut Nearby,
    ) -> Result<f64, String> {
        match experiment.kind {
            ExperimentKind::Drop => Drop::of(self, experiment, condition, values)?.rebound(),
            ExperimentKind::Gap => rest_gap(&self.scene(experiment, condition, values, &[])?, experiment, nearby),
            ExperimentKind::Slope => {
                let gravity = match &nearby.gravity {
                    Some(known) => known.clone(),
                    None => self.pressing(experiment, &self.scene(experiment, condition, values, &[])?, condition)?,
                };
                let tilted = self.scene(experiment, condition, values, std::slice::from_ref(&gravity))?;
                nearby.gravity = self.moves_no_support().then_some(gravity);
                speed(&tilted, experiment, condition, nearby)
            }
            ExperimentKind::Begins => self.begins(experiment, values, nearby),
            ExperimentKind::PullOff => pull_off(&self.scene(experiment, condition, values, &[])?, experiment, nearby),
            ExperimentKind::Dispersion => Err("a frequency is that of a wave, which no condition tells".to_owned()),
        }
    }

    /// The same with derivatives: along the run of a drop, else by differences of fourth order of what is known to
    /// rounding.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub(super) fn predicted(
        &self,
        experiment: &Experiment,
        condition: f64,
        values: &[f64],
    ) -> Result<Prediction, String> {
        let mut nearby = Nearby::default();
        let (value, known) = match experiment.kind {
            ExperimentKind::Drop => Drop::of(self, experiment, condition, values)?.predicted(self)?,
            _ => (self.value_beside(experiment, condition, values, &mut nearby)?, vec![None; values.len()]),
        };
        let mut slope = |index: usize| {
            let step =
                DIFFERENCE * if values[index] == 0.0 { self.numbers[index].scale.size } else { values[index].abs() };
            let mut at = |steps: f64| {
                let mut moved = values.to_vec();
                moved[index] += steps * step;
                self.value_beside(experiment, condition, &moved, &mut nearby)
            };
            let near = [at(-1.0)?, at(1.0)?];
            // Most of what is measured knows some of the numbers only.
            if near[0] == near[1] {
                return Ok(0.0);
            }
            Ok((8.0 * (near[1] - near[0]) - (at(2.0)? - at(-2.0)?)) / (12.0 * step))
        };
        let slopes = known.into_iter().enumerate().map(|(index, known)| known.map_or_else(|| slope(index), Ok));
        Ok(Prediction { value, slopes: slopes.collect::<Result<_, String>>()? })
    }
}

fn rest_gap(scene: &Scene, experiment: &Experiment, nearby: &mut Nearby) -> Result<f64, String> {
    let built = scene.built();
    let index = body(&built.model, experiment)?;
    Ok(nearby.rest(&built.model, &built.state, index)?.gap)
}
