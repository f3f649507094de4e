//! The times of the samples of a run: what they are worth in a mean, and which are evenly apart.

use gyration_record::{RecordError, Recording};

/// Times that differ by less than this part of a step between samples are even.
const EVEN: f64 = 1e-9;
/// Roundings of a time.
const ROUNDINGS: f64 = 4.0;

/// The times of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SampleTimes {
    /// t \[s\].
    pub times: Vec<f64>,
    /// Their weights in a mean over time, by trapezia; they sum to one.
    pub weights: Vec<f64>,
    /// How far apart most are \[s\]; zero of one sample.
    pub apart: f64,
}

impl SampleTimes {
    /// Of a recording.
    pub fn of(recording: &Recording) -> Result<Self, RecordError> {
        Ok(Self::new(recording.read_rows("time", 0..recording.rows())?.data))
    }

    fn new(times: Vec<f64>) -> Self {
        let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let span: f64 = steps.iter().sum();
        let step = |number: Option<usize>| number.and_then(|number| steps.get(number)).copied().unwrap_or(0.0);
        let weight = |row: usize| match span > 0.0 {
            true => 0.5 * (step(row.checked_sub(1)) + step(Some(row))) / span,
            false => 1.0 / times.len() as f64,
        };
        let weights = (0..times.len()).map(weight).collect();
        steps.sort_by(f64::total_cmp);
        let apart = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
        Self { times, weights, apart }
    }

    /// Whether a sample follows the one before as most do.
    pub fn follows(&self, row: usize) -> bool {
        let Some(before) = row.checked_sub(1) else { return false };
        let (before, now) = (self.times[before], self.times[row]);
        let rounding = ROUNDINGS * f64::EPSILON * now.abs();
        self.apart > 0.0 && (now - before - self.apart).abs() <= EVEN * self.apart + rounding
    }

    /// The mean over time of a number of each sample.
    pub fn mean(&self, values: &[f64]) -> f64 {
        self.weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
    }

    /// What a sample is worth in the mean over the last quarter of the time less that over the first.
    pub fn change_weights(&self) -> Vec<f64> {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else { return Vec::new() };
        let quarter = 0.25 * (last - first);
        let share = |is_in: &dyn Fn(f64) -> bool| {
            let all: f64 = self.times.iter().zip(&self.weights).filter(|it| is_in(*it.0)).map(|it| it.1).sum();
            self.times.iter().zip(&self.weights).map(|it| if is_in(*it.0) { it.1 / all } else { 0.0 }).collect()
        };
        let (early, late): (Vec<f64>, Vec<f64>) = (share(&|t| t <= first + quarter), share(&|t| t >= last - quarter));
        late.iter().zip(early).map(|(late, early)| late - early).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_last_sample_that_comes_early_counts_less_and_follows_no_other() {
        let times = SampleTimes::new(vec![0.0, 0.3, 0.6, 0.9, 1.0]);
        assert_eq!(times.apart, 0.3);
        assert_eq!([1, 2, 3, 4].map(|row| times.follows(row)), [true, true, true, false]);
        assert!((times.mean(&[0.0, 0.3, 0.6, 0.9, 1.0]) - 0.5).abs() < 1e-15);
        assert!((times.mean(&[1.0; 5]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn changes_are_those_from_the_first_quarter_to_the_last() {
        let times = SampleTimes::new((0..=8).map(f64::from).collect());
        let weights = times.change_weights();
        assert_eq!(weights.iter().map(|weight| weight.signum()).collect::<Vec<_>>()[..3], [-1.0; 3]);
        assert!(weights.iter().sum::<f64>().abs() < 1e-15 && weights[4] == 0.0);
        let alone = SampleTimes::new(vec![2.0]);
        assert_eq!((alone.mean(&[7.0]), alone.change_weights(), alone.follows(0)), (7.0, vec![0.0], false));
    }
}
