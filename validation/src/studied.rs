//! Some runs of a ready study, in memory.

use gyration_study::{Row, Study, Value};
use gyration_threads::in_order;
use std::num::NonZeroUsize;

/// As many as run beside the other tests.
pub const TWO: NonZeroUsize = NonZeroUsize::MIN.saturating_add(1);

/// Runs of a study, in the order in which they were asked for.
#[derive(Debug, Clone)]
pub struct Studied {
    columns: Vec<String>,
    rows: Vec<Row>,
}

impl Studied {
    /// Runs some of a study's runs, on two threads.
    pub fn new(study: &Study, runs: &[u64]) -> Self {
        let rows = in_order(runs, TWO, |run| study.row(*run));
        let columns = study.columns().iter().map(|column| column.name.clone()).collect();
        Self { columns, rows }
    }

    /// A ready study.
    ///
    /// # Panics
    /// If there is none of this name, or it has errors.
    pub fn ready(name: &str) -> Study {
        Study::open(name, &[]).unwrap_or_else(|errors| panic!("{errors}"))
    }

    fn column<T>(&self, name: &str, read: impl Fn(&Value) -> Option<T>) -> Vec<T> {
        let place = self.columns.iter().position(|column| column == name);
        let place = place.unwrap_or_else(|| panic!("no column {name}: {:?}", self.columns));
        let cell = |row: &Row| read(&row.values[place]).unwrap_or_else(|| panic!("{name}: {:?}", row.values));
        self.rows.iter().map(cell).collect()
    }

    /// The numbers of a column.
    ///
    /// # Panics
    /// If there is no such column, or a run has no number there.
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        self.column(name, Value::number)
    }

    /// The words of a column.
    ///
    /// # Panics
    /// If there is no such column, or a run has no word there.
    pub fn words(&self, name: &str) -> Vec<String> {
        self.column(name, |value| value.text().map(str::to_owned))
    }

    /// The lists of a column.
    ///
    /// # Panics
    /// If there is no such column, or a run has no list there.
    pub fn lists(&self, name: &str) -> Vec<Vec<f64>> {
        let list = |value: &Value| match value {
            Value::List(values) => Some(values.clone()),
            _ => None,
        };
        self.column(name, list)
    }

    /// The share of the runs for which this holds, by index.
    pub fn share(&self, holds: impl Fn(usize) -> bool) -> f64 {
        (0..self.rows.len()).filter(|index| holds(*index)).count() as f64 / self.rows.len() as f64
    }
}
