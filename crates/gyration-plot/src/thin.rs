//! Thinning: of many samples those that a picture can show, the first, least, largest and last of each column of
//! pixels.
//!
//! What is drawn through them covers the same pixels as a line through all samples. Samples are taken one by one, so
//! that a recording of any length passes through bounded memory.

use crate::draw::Point;

/// Columns of pixels across a frame; at 216 dpi a page is 1600 wide.
pub const COLUMNS: usize = 800;

/// Takes samples in the order of time.
#[derive(Debug, Clone)]
pub struct Thinner {
    rows: usize,
    column: usize,
    /// First, least, largest, last of the present column.
    kept: Option<[(usize, Point); 4]>,
    points: Vec<Point>,
    taken: usize,
}

impl Thinner {
    /// For so many samples.
    pub fn new(rows: usize) -> Self {
        Self { rows: rows.max(1), column: 0, kept: None, points: Vec::new(), taken: 0 }
    }

    /// Takes the next sample; one that is not finite interrupts the line.
    pub fn push(&mut self, time: f64, value: f64) {
        let index = self.taken;
        self.taken += 1;
        let column = (index as u128 * COLUMNS as u128 / self.rows as u128) as usize;
        if column != self.column || !value.is_finite() {
            self.close();
            self.column = column;
        }
        if !value.is_finite() {
            self.points.push([time, f64::NAN]);
            return;
        }
        let sample = (index, [time, value]);
        match &mut self.kept {
            None => self.kept = Some([sample; 4]),
            Some([_, least, largest, last]) => {
                if value < least.1[1] {
                    *least = sample;
                }
                if value > largest.1[1] {
                    *largest = sample;
                }
                *last = sample;
            }
        }
    }

    fn close(&mut self) {
        if let Some(mut kept) = self.kept.take() {
            kept.sort_by_key(|(index, _)| *index);
            let mut previous = None;
            for (index, point) in kept {
                if previous != Some(index) {
                    self.points.push(point);
                }
                previous = Some(index);
            }
        }
    }

    /// The samples kept, in the order of time.
    pub fn finish(mut self) -> Vec<Point> {
        self.close();
        self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thin(values: &[f64]) -> Vec<Point> {
        let mut thinner = Thinner::new(values.len());
        values.iter().enumerate().for_each(|(k, value)| thinner.push(k as f64, *value));
        thinner.finish()
    }

    #[test]
    fn few_samples_are_all_kept() {
        let values: Vec<f64> = (0..COLUMNS).map(|k| (k as f64).sin()).collect();
        assert_eq!(thin(&values).len(), COLUMNS);
    }

    #[test]
    fn a_single_peak_survives_among_many() {
        let mut values = vec![0.0; 1_000_000];
        values[654_321] = 7.0;
        values[654_322] = -7.0;
        let points = thin(&values);
        assert!(points.len() <= 4 * COLUMNS);
        assert!(points.contains(&[654_321.0, 7.0]) && points.contains(&[654_322.0, -7.0]));
        assert!(points.windows(2).all(|pair| pair[0][0] < pair[1][0]));
        assert_eq!(points.last(), Some(&[999_999.0, 0.0]));
    }

    #[test]
    fn gaps_in_the_data_stay_gaps() {
        let points = thin(&[1.0, f64::INFINITY, 2.0]);
        assert!(points[1][1].is_nan() && points.len() == 3);
    }
}
