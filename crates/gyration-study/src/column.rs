//! The columns of a table: name, unit, kind.

use serde::{Deserialize, Serialize};

/// The column of the verdicts on the ledgers.
pub(crate) const LEDGER: &str = "ledger";

/// A column.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The SI unit of its numbers; none of what is no quantity, or where it is not known.
    pub unit: Option<String>,
    /// What stands in it.
    pub kind: ColumnKind,
}

/// What stands in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColumnKind {
    /// Integers of 64 bits.
    Integer,
    /// Real numbers.
    Number,
    /// Texts.
    Text,
    /// Lists of real numbers.
    List,
}

impl Column {
    /// A column of this name, unit and kind.
    pub fn new(name: impl Into<String>, unit: Option<&str>, kind: ColumnKind) -> Self {
        Self { name: name.into(), unit: unit.map(str::to_owned), kind }
    }
}

/// The columns before the parameters.
pub(crate) fn leading() -> [Column; 3] {
    ["run", "point", "repetition"].map(|name| Column::new(name, None, ColumnKind::Integer))
}

/// The columns between the parameters and what is kept.
pub(crate) fn ending() -> [Column; 8] {
    [
        Column::new("outcome", None, ColumnKind::Text),
        Column::new("reason", None, ColumnKind::Text),
        Column::new("time", Some("s"), ColumnKind::Number),
        Column::new("steps", None, ColumnKind::Integer),
        Column::new("rejected", None, ColumnKind::Integer),
        Column::new("evaluations", None, ColumnKind::Integer),
        Column::new("residual", Some("1"), ColumnKind::Number),
        Column::new(LEDGER, None, ColumnKind::Text),
    ]
}
