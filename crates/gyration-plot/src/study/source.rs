//! A table of a study on disk, as pictures see it.
//!
//! The columns of a parameter with an axis are along that axis of the grid; lists and integers become numbers. A table
//! that tells nothing of its study has no axes: then `--x` says what goes to the right.

use super::request::PlotRequest;
use super::table::{ColumnValues, Role, RunTable, TableColumn};
use crate::error::PlotError;
use gyration_study::{Data, DataFrame, FrameColumn};

/// The columns that every study has beside those of its parameters and of what it keeps.
const ACCOUNT: [&str; 11] = [
    "run",
    "point",
    "repetition",
    "outcome",
    "reason",
    "time",
    "steps",
    "rejected",
    "evaluations",
    "residual",
    "ledger",
];

impl RunTable {
    /// The table of a frame.
    pub fn of_frame(frame: &DataFrame, name: &str) -> Self {
        let parameters = frame.parameters();
        let role = |name: &str| {
            let own = parameters.iter().find(|parameter| parameter.columns.iter().any(|column| column == name));
            match own {
                Some(parameter) => parameter.axis.map_or(Role::Random, Role::Axis),
                None if ACCOUNT.contains(&name) => Role::Account,
                None => Role::Kept,
            }
        };
        let column = |column: &FrameColumn| TableColumn {
            name: column.column.name.clone(),
            unit: column.column.unit.clone().filter(|unit| unit != "1").unwrap_or_default(),
            role: role(&column.column.name),
            values: values(&column.data),
        };
        let columns = frame.columns().iter().map(column).collect();
        Self { title: frame.title().unwrap_or(name).to_owned(), columns }
    }
}

impl PlotRequest {
    /// What the study of a frame asks for.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] if its `[plot]` cannot be used.
    pub fn of_frame(frame: &DataFrame) -> Result<Self, PlotError> {
        let own = frame.plot().filter(|plot| plot.as_object().is_some_and(|keys| !keys.is_empty()));
        own.map_or_else(|| Ok(Self::default()), Self::of_json)
    }
}

fn values(data: &Data) -> ColumnValues {
    let number = |cell: &Option<f64>| cell.unwrap_or(f64::NAN);
    match data {
        Data::Integer(cells) => {
            ColumnValues::Numbers(cells.iter().map(|cell| number(&cell.map(|n| n as f64))).collect())
        }
        Data::Number(cells) => ColumnValues::Numbers(cells.iter().map(number).collect()),
        Data::Text(cells) => ColumnValues::Words(cells.clone()),
        Data::List(cells) => ColumnValues::Lists(cells.iter().map(|cell| cell.clone().unwrap_or_default()).collect()),
    }
}
