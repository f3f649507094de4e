//! A uniform affine moment N on a body, constant or given in time.
//!
//!   M = Nᵀ P⁻ᵀ,   power M·Ṗ = tr(N L)
//!
//! sym N stretches, skw N turns; N is spatial and does not follow the body. A table is linear between its times, so that
//! a run has to end a step at each of them. Source: Sławianowski (1975) §2, (4.3).

use crate::tensor::Mat3;

/// An affine moment N [N m] that acts on a body.
#[derive(Debug, Clone, PartialEq)]
pub enum Couple {
    /// The same at all times.
    Constant(Mat3),
    /// Given at times, linear between them.
    Table(CoupleTable),
}

/// N at times: linear between them, at its first and last value outside.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupleTable {
    times: Vec<f64>,
    values: Vec<Mat3>,
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

impl CoupleTable {
    /// A table of times [s] and moments [N m].
    ///
    /// # Errors
    /// [`TableError`] if it is empty, not sorted by strictly increasing times, or not finite.
    pub fn new(rows: Vec<(f64, Mat3)>) -> Result<Self, TableError> {
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
        let (times, values) = rows.into_iter().unzip();
        Ok(Self { times, values })
    }

    /// N [N m] at a time.
    fn at(&self, time: f64) -> Mat3 {
        let after = self.times.partition_point(|knot| *knot <= time);
        if after == 0 {
            return self.values[0];
        }
        let Some(next) = self.times.get(after) else { return self.values[after - 1] };
        let (before, value) = (self.times[after - 1], self.values[after - 1]);
        value + (time - before) / (next - before) * (self.values[after] - value)
    }
}

impl Couple {
    /// N [N m] at a time.
    pub fn at(&self, time: f64) -> Mat3 {
        match self {
            Self::Constant(value) => *value,
            Self::Table(table) => table.at(time),
        }
    }

    /// The first time after this one at which N has a kink [s].
    pub fn next_kink(&self, time: f64) -> Option<f64> {
        match self {
            Self::Constant(_) => None,
            Self::Table(table) => table.times.get(table.times.partition_point(|knot| *knot <= time)).copied(),
        }
    }

    /// M = Nᵀ P⁻ᵀ [N m] at a time; P⁻¹ is given.
    pub fn moment(&self, time: f64, inverse: &Mat3) -> Mat3 {
        (inverse * self.at(time)).transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_is_linear_between_its_times_and_constant_outside() {
        let rows = [(1.0, 2.0), (2.0, 4.0), (4.0, 0.0)].map(|(time, value)| (time, Mat3::from_diagonal_element(value)));
        let couple = Couple::Table(CoupleTable::new(rows.to_vec()).unwrap());
        for (time, value) in [(0.0, 2.0), (1.0, 2.0), (1.25, 2.5), (2.0, 4.0), (3.0, 2.0), (4.0, 0.0), (9.0, 0.0)] {
            assert_eq!(couple.at(time)[(0, 0)], value, "at {time}");
        }
        assert_eq!([0.0, 1.0, 3.9, 4.0].map(|time| couple.next_kink(time)), [Some(1.0), Some(2.0), Some(4.0), None]);
    }

    #[test]
    fn tables_that_are_not_sorted_are_refused() {
        let row = |time: f64| (time, Mat3::zeros());
        let refused = CoupleTable::new(vec![row(0.0), row(2.0), row(2.0)]).unwrap_err();
        assert_eq!(refused, TableError::NotSorted { row: 3, time: 2.0, before: 2.0 });
        assert_eq!(CoupleTable::new(vec![row(0.0), row(f64::NAN)]).unwrap_err(), TableError::NotFinite { row: 2 });
    }
}
