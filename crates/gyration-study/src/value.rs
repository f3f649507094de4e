//! What stands in a cell of the table, and a row as one line of JSON.
//!
//! A line is an array of the cells: an integer, a number with all its digits, a text, a list of numbers, null. JSON has
//! no numbers beyond the range: they are the texts `NaN`, `inf`, `-inf` in a column of numbers.

use crate::column::{Column, ColumnKind};
use serde_json::Value as Json;

/// A cell of the table.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Value {
    /// Nothing: the run failed, or there is no reason to give.
    #[default]
    Null,
    /// A count or a number of a run.
    Integer(i64),
    /// A real number, in SI units.
    Number(f64),
    /// A text.
    Text(String),
    /// Several real numbers, in SI units.
    List(Vec<f64>),
}

/// A run in the table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Row {
    /// The cells, in the order of the columns.
    pub values: Vec<Value>,
}

impl Value {
    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Integer(value) => Some(*value as f64),
            _ => None,
        }
    }

    /// The text, if it is one.
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    fn to_json(&self) -> Json {
        match self {
            Self::Null => Json::Null,
            Self::Integer(value) => (*value).into(),
            Self::Number(value) => number_to_json(*value),
            Self::Text(text) => text.as_str().into(),
            Self::List(values) => values.iter().copied().map(number_to_json).collect(),
        }
    }

    fn from_json(json: Json, kind: ColumnKind) -> Option<Self> {
        match (kind, json) {
            (_, Json::Null) => Some(Self::Null),
            (ColumnKind::Integer, Json::Number(value)) => value.as_i64().map(Self::Integer),
            (ColumnKind::Number, value) => number_from_json(&value).map(Self::Number),
            (ColumnKind::Text, Json::String(text)) => Some(Self::Text(text)),
            (ColumnKind::List, Json::Array(values)) => {
                values.iter().map(number_from_json).collect::<Option<_>>().map(Self::List)
            }
            _ => None,
        }
    }
}

/// Numbers beyond the range, as JSON has them.
const BEYOND: [(&str, f64); 3] = [("NaN", f64::NAN), ("inf", f64::INFINITY), ("-inf", f64::NEG_INFINITY)];

fn number_to_json(value: f64) -> Json {
    let beyond = || BEYOND.iter().find(|(_, known)| *known == value).map_or("NaN", |(name, _)| name);
    if value.is_finite() { value.into() } else { beyond().into() }
}

fn number_from_json(json: &Json) -> Option<f64> {
    match json {
        Json::String(text) => BEYOND.iter().find(|(name, _)| name == text).map(|(_, value)| *value),
        other => other.as_f64(),
    }
}

impl Row {
    /// The number of the run; none of a row without cells.
    pub fn run(&self) -> Option<u64> {
        match self.values.first() {
            Some(Value::Integer(run)) => u64::try_from(*run).ok(),
            _ => None,
        }
    }

    /// The row as one line of JSON, without the end of the line.
    pub fn to_line(&self) -> String {
        self.values.iter().map(Value::to_json).collect::<Json>().to_string()
    }

    /// Reads a line; none if it is not a row of these columns.
    pub fn from_line(line: &str, columns: &[Column]) -> Option<Self> {
        let cells: Vec<Json> = serde_json::from_str(line).ok()?;
        if cells.len() != columns.len() {
            return None;
        }
        let values = cells.into_iter().zip(columns).map(|(cell, column)| Value::from_json(cell, column.kind));
        Some(Self { values: values.collect::<Option<_>>()? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_gives_back_every_bit() {
        let kinds = [
            ColumnKind::Integer,
            ColumnKind::Number,
            ColumnKind::Number,
            ColumnKind::Text,
            ColumnKind::List,
            ColumnKind::Text,
        ];
        let columns = kinds.map(|kind| Column { name: "x".into(), unit: None, kind });
        let values = vec![
            Value::Integer(1 << 40),
            Value::Number(0.1 + 0.2),
            Value::Number(f64::NEG_INFINITY),
            Value::Text("a \"quoted\"\nline".into()),
            Value::List(vec![1.0, f64::INFINITY, -1e-310]),
            Value::Null,
        ];
        let row = Row { values };
        let line = row.to_line();
        assert!(!line.contains('\n'), "{line}");
        assert_eq!(Row::from_line(&line, &columns), Some(row));
        // Any shorter text is no row: that is how a torn line is known.
        let whole = |end: usize| line.is_char_boundary(end) && Row::from_line(&line[..end], &columns).is_some();
        assert!(!(0..line.len()).any(whole));
    }
}
