//! What is kept of a column: one number over the samples, or a list.

use crate::keep::{Pick, Statistic};
use crate::value::Value;
use std::collections::VecDeque;

/// Where the numbers of a column come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ColumnSource {
    /// The time of the row.
    Time,
    /// This place of the row.
    Row(usize),
}

impl ColumnSource {
    fn of(self, time: f64, row: &[f64]) -> f64 {
        match self {
            Self::Time => time,
            Self::Row(place) => row[place],
        }
    }
}

/// One number of a column.
pub(super) struct ColumnStatistic {
    source: ColumnSource,
    measure: Statistic,
    first: Option<(f64, f64)>,
    last: (f64, f64),
    extreme: f64,
    /// ∫ value dt, by trapezoids.
    integral: f64,
}

impl ColumnStatistic {
    pub fn new(source: ColumnSource, measure: Statistic) -> Self {
        Self { source, measure, first: None, last: (f64::NAN, f64::NAN), extreme: f64::NAN, integral: 0.0 }
    }

    pub fn row(&mut self, time: f64, row: &[f64]) {
        let value = self.source.of(time, row);
        if self.first.is_none() {
            self.first = Some((time, value));
        } else {
            let (before, was) = self.last;
            self.integral += 0.5 * (was + value) * (time - before);
        }
        self.last = (time, value);
        // What is not a number is passed over.
        self.extreme = match self.measure {
            Statistic::Minimum => self.extreme.min(value),
            _ => self.extreme.max(value),
        };
    }

    pub fn value(&self) -> Value {
        let Some((began, first)) = self.first else { return Value::Null };
        let (ended, last) = self.last;
        Value::Number(match self.measure {
            Statistic::First => first,
            Statistic::Last => last,
            Statistic::Change => last - first,
            Statistic::Minimum | Statistic::Maximum => self.extreme,
            Statistic::Mean if ended > began => self.integral / (ended - began),
            Statistic::Mean => first,
        })
    }
}

/// Several values of a column.
pub(super) struct Listed {
    source: ColumnSource,
    pick: Pick,
    values: VecDeque<f64>,
}

impl Listed {
    pub fn new(source: ColumnSource, pick: Pick) -> Self {
        Self { source, pick, values: VecDeque::new() }
    }

    pub fn row(&mut self, time: f64, row: &[f64]) {
        let (Pick::First(most) | Pick::Last(most)) = self.pick;
        if self.values.len() == most {
            match self.pick {
                Pick::First(_) => return,
                Pick::Last(_) => self.values.pop_front(),
            };
        }
        self.values.push_back(self.source.of(time, row));
    }

    pub fn value(self) -> Value {
        Value::List(self.values.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(measure: Statistic, rows: &[(f64, f64)]) -> Option<f64> {
        let mut measured = ColumnStatistic::new(ColumnSource::Row(0), measure);
        rows.iter().for_each(|(time, value)| measured.row(*time, &[*value]));
        measured.value().number()
    }

    #[test]
    fn measures_are_those_of_the_samples() {
        let rows = [(0.0, 1.0), (1.0, 3.0), (3.0, -1.0)];
        let all = [
            Statistic::First,
            Statistic::Last,
            Statistic::Change,
            Statistic::Minimum,
            Statistic::Maximum,
            Statistic::Mean,
        ];
        // The mean by hand: (2·1 + 1·2)/3.
        let expected = [1.0, -1.0, -2.0, -1.0, 3.0, 4.0 / 3.0];
        assert_eq!(all.map(|measure| measured(measure, &rows)), expected.map(Some));
        assert_eq!(all.map(|measure| measured(measure, &[])), [None; 6]);
        assert_eq!(measured(Statistic::Mean, &rows[..1]), Some(1.0));
    }

    #[test]
    fn lists_keep_the_first_or_the_last() {
        let listed = |pick| {
            let mut listed = Listed::new(ColumnSource::Time, pick);
            (0..5).for_each(|k| listed.row(f64::from(k), &[]));
            listed.value()
        };
        assert_eq!(listed(Pick::First(2)), Value::List(vec![0.0, 1.0]));
        assert_eq!(listed(Pick::Last(3)), Value::List(vec![2.0, 3.0, 4.0]));
        assert_eq!(listed(Pick::Last(9)), Value::List(vec![0.0, 1.0, 2.0, 3.0, 4.0]));
    }
}
