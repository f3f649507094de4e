//! A table in a few numbers, column by column, worked out while it is read: memory does not grow with it.

use super::PORTION;
use super::parquet::Input;
use crate::column::{Column, LEDGER};
use crate::error::StudyError;
use crate::value::Value;
use gyration_sim::{OpenLedgers, Verdict};
use std::collections::BTreeMap;
use std::path::Path;

/// The most different texts of a column that are counted.
const MOST_TEXTS: usize = 1000;

/// What a table says at a glance.
#[derive(Debug, Clone, PartialEq)]
pub struct Digest {
    /// How many rows it has.
    pub rows: u64,
    /// Its columns, in order.
    pub columns: Vec<(Column, Spread)>,
    /// The runs whose ledger is open.
    pub open: OpenLedgers,
}

/// How the cells of a column are spread; of lists, all their values together.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spread {
    /// How many finite numbers.
    pub count: u64,
    /// Their mean.
    pub mean: f64,
    /// The least; NaN if there are none.
    pub least: f64,
    /// The greatest; NaN if there are none.
    pub greatest: f64,
    /// How often each text occurs; of very many, those met first.
    pub texts: BTreeMap<String, u64>,
    /// Σ (x − mean)².
    squares: f64,
}

impl Digest {
    /// Reads a finished table.
    ///
    /// # Errors
    /// A file that cannot be read or is damaged.
    pub fn read(file: &Path) -> Result<Self, StudyError> {
        let mut input = Input::open(file)?;
        let empty = Spread { least: f64::NAN, greatest: f64::NAN, ..Spread::default() };
        let columns: Vec<_> = input.columns().into_iter().map(|column| (column, empty.clone())).collect();
        let ledger = columns.iter().position(|(column, _)| column.name == LEDGER);
        let mut digest = Self { rows: 0, columns, open: OpenLedgers::default() };
        loop {
            let rows = input.next(PORTION)?;
            if rows.is_empty() {
                return Ok(digest);
            }
            for row in rows {
                digest.rows += 1;
                if ledger.and_then(|place| row.values[place].text()) == Some(Verdict::Open.name()) {
                    row.run().into_iter().for_each(|run| digest.open.add(run));
                }
                digest.columns.iter_mut().zip(row.values).for_each(|((_, spread), value)| spread.add(value));
            }
        }
    }

    /// A column by its name.
    pub fn column(&self, name: &str) -> Option<&(Column, Spread)> {
        self.columns.iter().find(|(column, _)| column.name == name)
    }
}

impl Spread {
    fn add(&mut self, value: Value) {
        match value {
            Value::Text(text) if self.texts.len() < MOST_TEXTS || self.texts.contains_key(&text) => {
                *self.texts.entry(text).or_default() += 1;
            }
            Value::List(values) => values.into_iter().for_each(|value| self.add_number(value)),
            other => other.number().into_iter().for_each(|value| self.add_number(value)),
        }
    }

    /// One number more (Welford 1962).
    fn add_number(&mut self, value: f64) {
        if !value.is_finite() {
            return;
        }
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
        (self.least, self.greatest) = (self.least.min(value), self.greatest.max(value));
    }

    /// The standard deviation; zero of fewer than two numbers.
    pub fn deviation(&self) -> f64 {
        (self.squares / self.count.saturating_sub(1).max(1) as f64).sqrt()
    }
}
