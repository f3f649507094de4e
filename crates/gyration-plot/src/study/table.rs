//! The columns of a study as pictures see them.
//!
//! Every column has one value a run; a failed run has none of what is kept: NaN, no word, an empty list. Axes are the
//! parameters that the grid goes through, so that their values return.

use crate::chart::ticks::short;
use crate::chart::{Axis, AxisScale};
use crate::error::PlotError;
use std::collections::BTreeMap;

/// A table of runs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunTable {
    /// What the study is about.
    pub title: String,
    /// The columns.
    pub columns: Vec<TableColumn>,
}

/// One column.
#[derive(Debug, Clone, PartialEq)]
pub struct TableColumn {
    /// Its name.
    pub name: String,
    /// Its unit; empty for a pure number.
    pub unit: String,
    /// Where it comes from.
    pub role: Role,
    /// A value a run.
    pub values: ColumnValues,
}

/// Where a column comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A parameter of the grid, along this axis; several share one if they vary together.
    Axis(usize),
    /// A random parameter.
    Random,
    /// What was kept of the runs.
    Kept,
    /// Numbers of runs, outcomes, counters.
    Account,
}

/// Values, one a run.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnValues {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Words.
    Words(Vec<Option<String>>),
    /// Several numbers a run.
    Lists(Vec<Vec<f64>>),
}

/// Digits of a number behind its first one, in a legend, if they are enough.
const DIGITS: usize = 3;

/// The faces of a box, in their order.
const FACES: [&str; 6] = ["+x", "-x", "+y", "-y", "+z", "-z"];

impl RunTable {
    /// How many runs there are.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |column| match &column.values {
            ColumnValues::Numbers(values) => values.len(),
            ColumnValues::Words(values) => values.len(),
            ColumnValues::Lists(values) => values.len(),
        })
    }

    /// The column of this name.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] if there is none; the names that there are, are the fix.
    pub fn column(&self, name: &str) -> Result<&TableColumn, PlotError> {
        self.columns.iter().find(|column| column.name == name).ok_or_else(|| {
            let names: Vec<&str> = self.columns.iter().map(|column| column.name.as_str()).collect();
            PlotError::arguments(
                format!("the table has no column `{name}`"),
                format!("its columns are {}", names.join(", ")),
            )
        })
    }

    /// A column for each axis of the grid, in their order: of those that vary together the one with the most values.
    pub fn axes(&self) -> Vec<&TableColumn> {
        let mut axes: BTreeMap<usize, &TableColumn> = BTreeMap::new();
        let values = |column: &TableColumn| column.levels().len().max(column.categories().len());
        for column in &self.columns {
            let Role::Axis(axis) = column.role else { continue };
            let known = axes.entry(axis).or_insert(column);
            if values(column) > values(known) {
                *known = column;
            }
        }
        axes.into_values().collect()
    }

    /// The first column of what is kept; the outcome if nothing is.
    pub fn kept(&self) -> Result<&TableColumn, PlotError> {
        self.of(Role::Kept).next().map_or_else(|| self.column("outcome"), Ok)
    }

    /// The column of a name, or the axis of the grid of this index.
    pub fn axis_or(&self, name: Option<&str>, index: usize) -> Result<&TableColumn, PlotError> {
        let problem = "the study has no such axis of a grid";
        let missing = || PlotError::arguments(problem, "say which columns: --x NAME --y NAME");
        name.map_or_else(|| self.axes().get(index).copied().ok_or_else(missing), |name| self.column(name))
    }

    /// The columns of a role.
    pub fn of(&self, role: Role) -> impl Iterator<Item = &TableColumn> {
        self.columns.iter().filter(move |column| column.role == role)
    }

    /// How many runs failed.
    pub fn failures(&self) -> usize {
        self.outcomes(|word| word == "failed")
    }

    /// How many runs had to stop before their end.
    pub fn early(&self) -> usize {
        self.outcomes(|word| !["completed", "at_rest", "failed"].contains(&word))
    }

    fn outcomes(&self, is_meant: impl Fn(&str) -> bool) -> usize {
        let Some(ColumnValues::Words(words)) = self.column("outcome").ok().map(|column| &column.values) else {
            return 0;
        };
        words.iter().flatten().filter(|word| is_meant(word)).count()
    }
}

impl TableColumn {
    /// The numbers, if it has numbers.
    pub fn numbers(&self) -> Option<&[f64]> {
        match &self.values {
            ColumnValues::Numbers(values) => Some(values),
            _ => None,
        }
    }

    /// The value of a run in words; none if it has none.
    pub fn word(&self, run: usize) -> Option<String> {
        match &self.values {
            ColumnValues::Words(words) => words[run].clone(),
            ColumnValues::Numbers(values) => (!values[run].is_nan()).then(|| short(values[run])),
            ColumnValues::Lists(_) => None,
        }
    }

    /// The different words: all six faces where they are faces of a box, else in the order of the alphabet.
    pub fn categories(&self) -> Vec<String> {
        let ColumnValues::Words(words) = &self.values else { return Vec::new() };
        let mut found: Vec<&str> = words.iter().flatten().map(String::as_str).collect();
        found.sort_unstable();
        found.dedup();
        let faces = !found.is_empty() && found.iter().all(|word| FACES.contains(word));
        (if faces { FACES.to_vec() } else { found }).into_iter().map(str::to_owned).collect()
    }

    /// The different numbers, from the smallest.
    pub fn levels(&self) -> Vec<f64> {
        // There is one zero.
        let mut levels: Vec<f64> = self.numbers().unwrap_or_default().iter().map(|value| value + 0.0).collect();
        levels.retain(|value| value.is_finite());
        levels.sort_unstable_by(f64::total_cmp);
        levels.dedup();
        levels
    }

    /// Which of the levels a number is.
    pub fn level(&self, levels: &[f64], number: f64) -> Option<usize> {
        levels.binary_search_by(|level| level.total_cmp(&(number + 0.0))).ok()
    }

    /// The different numbers in words that tell them apart, in as few digits as do, from the smallest.
    pub fn labels(&self) -> Vec<(f64, String)> {
        let levels = self.levels();
        let rounded = |value: f64, digits: usize| format!("{value:.digits$e}").parse().unwrap_or(value);
        let words = |digits| -> Vec<String> { levels.iter().map(|level| short(rounded(*level, digits))).collect() };
        // They are in order, and so are they rounded.
        let are_apart = |words: &Vec<String>| words.windows(2).all(|pair| pair[0] != pair[1]);
        let exact = || levels.iter().map(f64::to_string).collect();
        let words = (DIGITS..2 * DIGITS).map(words).find(are_apart).unwrap_or_else(exact);
        levels.iter().copied().zip(words).collect()
    }

    /// The scale on which the levels are even.
    pub fn scale(&self) -> AxisScale {
        let levels = self.levels();
        let even = |spread: &dyn Fn(&[f64]) -> f64| {
            let steps: Vec<f64> = levels.windows(2).map(spread).collect();
            steps.iter().all(|step| (step - steps[0]).abs() < 1e-6 * steps[0].abs())
        };
        let geometric = levels.len() > 2 && levels[0] > 0.0 && even(&|pair| libm::log(pair[1] / pair[0]));
        if geometric && !even(&|pair| pair[1] - pair[0]) { AxisScale::Logarithmic } else { AxisScale::Linear }
    }

    /// The axis that holds these values of the column.
    pub fn axis(&self, values: impl IntoIterator<Item = f64>) -> Axis {
        match self.scale() {
            AxisScale::Linear => Axis::linear(&self.name, &self.unit, values),
            AxisScale::Logarithmic => Axis::logarithmic(&self.name, &self.unit, values),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(values: ColumnValues) -> TableColumn {
        TableColumn { name: "c".into(), unit: String::new(), role: Role::Axis(0), values }
    }

    #[test]
    fn values_that_grow_by_a_factor_stand_on_a_logarithmic_axis() {
        assert_eq!(column(ColumnValues::Numbers(vec![4.0, 1.0, 2.0, 1.0])).scale(), AxisScale::Logarithmic);
        assert_eq!(column(ColumnValues::Numbers(vec![1.0, 2.0, 3.0])).scale(), AxisScale::Linear);
        assert_eq!(column(ColumnValues::Numbers(vec![1.0, 2.0])).scale(), AxisScale::Linear);
        assert_eq!(column(ColumnValues::Numbers(vec![0.0, 1.0, 10.0])).scale(), AxisScale::Linear);
    }

    #[test]
    fn zero_is_one_level_whatever_its_sign() {
        let column = column(ColumnValues::Numbers(vec![0.0, -0.0, 1.0, f64::NAN]));
        assert_eq!(column.levels(), [0.0, 1.0]);
        assert_eq!([0.0, -0.0, 1.0, 2.0].map(|x| column.level(&column.levels(), x)), [Some(0), Some(0), Some(1), None]);
    }

    #[test]
    fn numbers_are_told_apart_in_few_digits() {
        let labels = |values: &[f64]| -> Vec<String> {
            column(ColumnValues::Numbers(values.to_vec())).labels().into_iter().map(|(_, words)| words).collect()
        };
        assert_eq!(labels(&[0.1 + 0.2, 0.014_125_375_446, 2.0]), ["0.01413", "0.3", "2"]);
        assert_eq!(labels(&[1.0, 1.0001, 1.0]), ["1", "1.0001"]);
        assert_eq!(labels(&[1.0, 1.0 + 1e-12]), ["1", "1.000000000001"]);
    }

    #[test]
    fn a_face_that_never_comes_is_a_category_too() {
        let words =
            |words: &[&str]| column(ColumnValues::Words(words.iter().map(|word| Some((*word).into())).collect()));
        assert_eq!(words(&["+z", "-x"]).categories(), FACES);
        assert_eq!(words(&["falls", "stands", "falls"]).categories(), ["falls", "stands"]);
    }
}
