//! Tensors given at times: linear between them, or the natural cubic spline through them.
//!
//! With h = t_{k+1} − t_k, a = (t_{k+1} − t)/h, b = 1 − a and second derivatives M_k,
//!
//!   y = a y_k + b y_{k+1} + h²/6 ((a³ − a) M_k + (b³ − b) M_{k+1})
//!   h_{k−1} M_{k−1} + 2(h_{k−1} + h_k) M_k + h_k M_{k+1} = 6 (Δ_k − Δ_{k−1}),   Δ_k = (y_{k+1} − y_k)/h_k
//!
//! and M = 0 at both ends. Outside its times a table keeps its first and its last value. Source: de Boor, *A practical
//! guide to splines*, IV.

use super::Jet;
use crate::tensor::Mat3;

/// A tensor at times.
#[derive(Debug, Clone, PartialEq)]
pub struct TensorTable {
    times: Vec<f64>,
    values: Vec<Mat3>,
    /// Second derivatives of the spline; none if linear.
    bends: Option<Vec<Mat3>>,
}

/// What a table does between its times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// Straight lines.
    #[default]
    Linear,
    /// The natural cubic spline, twice differentiable.
    Cubic,
}

/// What is wrong with a table.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum TableError {
    /// It has no row.
    #[error("the table has no row")]
    Empty,
    /// A number is infinite or not a number.
    #[error("row {row} has a number that is not finite")]
    NotFinite {
        /// The row, from 1.
        row: usize,
    },
    /// Times do not increase.
    #[error("the time of row {row}, {time} s, is not later than that of the row before, {before} s")]
    NotSorted {
        /// The row, from 1.
        row: usize,
        /// Its time \[s\].
        time: f64,
        /// The time before \[s\].
        before: f64,
    },
}

impl TensorTable {
    /// A table of times [s] and values.
    ///
    /// # Errors
    /// [`TableError`] if it is empty, not sorted by strictly increasing times, or not finite.
    pub fn new(rows: Vec<(f64, Mat3)>, interpolation: Interpolation) -> Result<Self, TableError> {
        if rows.is_empty() {
            return Err(TableError::Empty);
        }
        let finite = |(time, value): &(f64, Mat3)| time.is_finite() && value.iter().all(|entry| entry.is_finite());
        if let Some(row) = rows.iter().position(|row| !finite(row)) {
            return Err(TableError::NotFinite { row: row + 1 });
        }
        if let Some(row) = rows.windows(2).position(|pair| pair[1].0 <= pair[0].0) {
            return Err(TableError::NotSorted { row: row + 2, time: rows[row + 1].0, before: rows[row].0 });
        }
        let (times, values): (Vec<f64>, Vec<Mat3>) = rows.into_iter().unzip();
        let bends = (interpolation == Interpolation::Cubic).then(|| bends(&times, &values));
        Ok(Self { times, values, bends })
    }

    /// Its first and its last time [s].
    pub fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// What it does between its times.
    pub fn interpolation(&self) -> Interpolation {
        if self.bends.is_some() { Interpolation::Cubic } else { Interpolation::Linear }
    }

    /// The value at a time [s] with its derivatives: at a time of the table those behind it, at its last those before
    /// it, since a run that the table is made for ends there.
    pub fn jet(&self, time: f64) -> Jet {
        let last = self.times.len() - 1;
        let after = match self.times.partition_point(|knot| *knot <= time) {
            after if after > last && time == self.times[last] => last,
            after => after,
        };
        let constant = |value: Mat3| Jet { value, ..Jet::default() };
        if after == 0 {
            return constant(self.values[0]);
        }
        let (k, Some(next)) = (after - 1, self.times.get(after)) else { return constant(self.values[after - 1]) };
        let (from, to, h) = (self.values[k], self.values[after], next - self.times[k]);
        let b = (time - self.times[k]) / h;
        let mut jet = Jet { value: from + (to - from) * b, rate: (to - from) / h, acceleration: Mat3::zeros() };
        if let Some(bends) = &self.bends {
            let (a, first, second) = (1.0 - b, bends[k], bends[after]);
            jet.value += (first * ((a * a - 1.0) * a) + second * ((b * b - 1.0) * b)) * (h * h / 6.0);
            jet.rate += (second * (3.0 * b * b - 1.0) - first * (3.0 * a * a - 1.0)) * (h / 6.0);
            jet.acceleration = first * a + second * b;
        }
        jet
    }

    /// The first of its times after this one [s].
    pub fn next_knot(&self, time: f64) -> Option<f64> {
        self.times.get(self.times.partition_point(|knot| *knot <= time)).copied()
    }
}

/// The second derivatives of the natural spline, by elimination of its three diagonals.
fn bends(times: &[f64], values: &[Mat3]) -> Vec<Mat3> {
    let last = times.len() - 1;
    let mut bends = vec![Mat3::zeros(); times.len()];
    let mut ratios = vec![0.0; times.len()];
    for k in 1..last {
        let (before, behind) = (times[k] - times[k - 1], times[k + 1] - times[k]);
        let turn = (values[k + 1] - values[k]) / behind - (values[k] - values[k - 1]) / before;
        let pivot = 2.0 * (before + behind) - before * ratios[k - 1];
        ratios[k] = behind / pivot;
        bends[k] = (turn * 6.0 - bends[k - 1] * before) / pivot;
    }
    for k in (1..last).rev() {
        let next = bends[k + 1];
        bends[k] -= next * ratios[k];
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(time: f64, value: f64) -> (f64, Mat3) {
        (time, Mat3::from_diagonal_element(value))
    }

    #[test]
    fn table_is_linear_between_its_times_and_constant_outside() {
        let rows = [(1.0, 2.0), (2.0, 4.0), (4.0, 0.0)].map(|(time, value)| row(time, value));
        let table = TensorTable::new(rows.to_vec(), Interpolation::Linear).unwrap();
        for (time, value) in [(0.0, 2.0), (1.0, 2.0), (1.25, 2.5), (2.0, 4.0), (3.0, 2.0), (4.0, 0.0), (9.0, 0.0)] {
            assert_eq!(table.jet(time).value[(0, 0)], value, "at {time}");
        }
        assert_eq!([0.0, 1.0, 3.9, 4.0].map(|time| table.next_knot(time)), [Some(1.0), Some(2.0), Some(4.0), None]);
        assert_eq!(table.span(), [1.0, 4.0]);
    }

    #[test]
    fn a_run_that_ends_with_its_table_ends_at_the_rate_of_the_table() {
        let rows = [(0.0, 2.0), (0.1, 4.0), (0.4, 0.7)].map(|(time, value)| row(time, value));
        for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
            let table = TensorTable::new(rows.to_vec(), interpolation).unwrap();
            let [before, last, behind] = [0.4 - 1e-9, 0.4, 0.4 + 1e-9].map(|time| table.jet(time));
            assert!((last.rate - before.rate).amax() < 1e-6 && last.rate.amax() > 1.0, "{interpolation:?}");
            // A rounding of the rise of 3.3.
            assert!((last.value - behind.value).amax() < 1e-15 && behind.rate == Mat3::zeros(), "{interpolation:?}");
        }
        let alone = TensorTable::new(rows[..1].to_vec(), Interpolation::Cubic).unwrap();
        assert_eq!(alone.jet(0.0), Jet { value: rows[0].1, ..Jet::default() });
    }

    #[test]
    fn spline_tends_to_the_curve_with_the_fourth_power_of_the_spacing() {
        // sin has no second derivative at the ends of [0, π]: the natural spline is that of the curve.
        let error = |count: u32| {
            let pi = std::f64::consts::PI;
            let rows = (0..=count).map(|k| f64::from(k) * pi / f64::from(count)).map(|t| row(t, t.sin())).collect();
            let table = TensorTable::new(rows, Interpolation::Cubic).unwrap();
            let off = |t: f64| (table.jet(t).value[(1, 1)] - t.sin()).abs();
            (0..1000).map(|k| off(pi * f64::from(k) / 1000.0)).fold(0.0, f64::max)
        };
        let order = (error(16) / error(32)).log2();
        println!("order of the spline {order}");
        assert!((order - 4.0).abs() < 0.1, "{order}");
    }

    #[test]
    fn tables_that_are_not_sorted_are_refused() {
        let refused = |rows: Vec<(f64, Mat3)>| TensorTable::new(rows, Interpolation::Linear).unwrap_err();
        let unsorted = refused(vec![row(0.0, 0.0), row(2.0, 0.0), row(2.0, 0.0)]);
        assert_eq!(unsorted, TableError::NotSorted { row: 3, time: 2.0, before: 2.0 });
        assert_eq!(refused(vec![row(0.0, 0.0), row(f64::NAN, 0.0)]), TableError::NotFinite { row: 2 });
        assert_eq!(refused(Vec::new()), TableError::Empty);
    }
}
