//! Tables of numbers beside a scene: CSV files, with or without a line of names.

use crate::error::ReadError;
use crate::file_sum::sum_of;
use crate::read::{self, NamedFile};
use gyration::signal::{Interpolation, TableError, TensorTable};
use gyration::tensor::Mat3;
use gyration_files::{Files, REMARK, line_of_row};
use std::path::PathBuf;

/// A table that cannot be used.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TableFault {
    /// The file cannot be read.
    #[error("cannot read the table: {0}")]
    Unreadable(#[from] ReadError),
    /// Not rows of numbers.
    #[error("table {}, line {line}: {reason}", path.display())]
    Malformed {
        /// The names of its columns.
        columns: String,
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// What is wrong.
        reason: String,
    },
    /// Not a table of tensors in time.
    #[error("table {}, line {line}: {source}", path.display())]
    Rows {
        /// The file.
        path: PathBuf,
        /// The line, from 1; the first, if there are none.
        line: u64,
        /// What is wrong; it counts rows without the line of names.
        source: TableError,
    },
}

impl TableFault {
    /// What to do.
    pub(crate) fn help(&self, files: &Files) -> String {
        let help = match self {
            Self::Unreadable(_) => files.help(),
            Self::Malformed { columns, .. } => return format!("write rows of {columns}"),
            Self::Rows { source: TableError::NotSorted { .. }, .. } => "sort the rows by time, each time once",
            Self::Rows { source: TableError::NotFinite { .. }, .. } => "write finite numbers",
            Self::Rows { source: TableError::Empty, .. } => "write at least one row",
        };
        help.to_owned()
    }
}

/// A table of tensors in time, with the checksum of its file.
pub(crate) struct ReadTable {
    /// The table.
    pub(crate) table: TensorTable,
    /// The checksum of its numbers.
    pub(crate) sum: String,
}

/// What stands behind the symbol of a tensor for its entries, row by row.
const TENSOR: [&str; 9] = ["_xx", "_xy", "_xz", "_yx", "_yy", "_yz", "_zx", "_zy", "_zz"];
/// The same of the components of a vector.
const VECTOR: [&str; 3] = ["_x", "_y", "_z"];
/// The same of a number.
const NUMBER: [&str; 1] = [""];

/// Reads a table of tensors in time: rows of t \[s\] and the entries in SI units, row by row. Messages call them by
/// `symbol`.
///
/// # Errors
/// [`TableFault`] with the line: a file that cannot be read, a wrong number of columns, what is no number, times that
/// do not increase.
pub(crate) fn read_tensors(
    file: NamedFile<'_>,
    symbol: char,
    interpolation: Interpolation,
) -> Result<ReadTable, TableFault> {
    read_table(file, symbol, &TENSOR, interpolation)
}

/// The same for a table of vectors, which are the first columns of its tensors.
///
/// # Errors
/// As of [`read_tensors`].
pub(crate) fn read_vectors(
    file: NamedFile<'_>,
    symbol: char,
    interpolation: Interpolation,
) -> Result<ReadTable, TableFault> {
    read_table(file, symbol, &VECTOR, interpolation)
}

/// The same for a table of numbers, which are the first entries of its tensors.
///
/// # Errors
/// As of [`read_tensors`].
pub(crate) fn read_numbers(
    file: NamedFile<'_>,
    symbol: char,
    interpolation: Interpolation,
) -> Result<ReadTable, TableFault> {
    read_table(file, symbol, &NUMBER, interpolation)
}

/// Where a row begins, behind the one before it, and what is wrong with it.
pub(crate) type RowFault = (usize, String);

/// The content of a table, without a mark of its encoding.
pub(crate) fn content(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes)
}

/// The rows of a table, each with the byte behind the row before it: fields without the space around them, remarks left
/// out.
pub(crate) fn records(content: &[u8]) -> impl Iterator<Item = Result<(usize, csv::StringRecord), RowFault>> {
    let mut reader = csv::ReaderBuilder::new();
    reader.has_headers(false).flexible(true).comment(Some(REMARK)).trim(csv::Trim::All);
    let start = |position: Option<&csv::Position>| position.map_or(0, |position| position.byte() as usize);
    reader.from_reader(content).into_records().map(move |record| match record {
        Ok(record) => Ok((start(record.position()), record)),
        // Of a text in memory nothing else can be wrong.
        Err(error) => Err((start(error.position()), "it is not valid UTF-8 text".to_owned())),
    })
}

fn read_table(
    file: NamedFile<'_>,
    symbol: char,
    entries: &[&str],
    interpolation: Interpolation,
) -> Result<ReadTable, TableFault> {
    let bytes = read::named(file)?;
    let path = file.0.path(file.1);
    let content = content(&bytes);
    let rows = rows(content, entries.len()).map_err(|(start, reason)| {
        let line = line_of_row(content, start);
        let names: Vec<String> = entries.iter().map(|entry| format!(", {symbol}{entry}")).collect();
        TableFault::Malformed { columns: format!("`t{}`", names.concat()), path: path.clone(), line, reason }
    })?;
    let table = TensorTable::new(rows.iter().map(|row| (row.time, row.value)).collect(), interpolation);
    let table = table.map_err(|source| {
        let row = match source {
            TableError::Empty => 1,
            TableError::NotFinite { row } | TableError::NotSorted { row, .. } => row,
        };
        let line = rows.get(row - 1).map_or(1, |row| line_of_row(content, row.start));
        TableFault::Rows { path: path.clone(), line, source }
    })?;
    let numbers = rows.iter().flat_map(|row| std::iter::once(row.time).chain(row.value.iter().copied()));
    Ok(ReadTable { table, sum: sum_of(numbers) })
}

/// A row of a table.
struct WrittenRow {
    /// The byte behind the row before it.
    start: usize,
    /// t \[s\].
    time: f64,
    /// The tensor, in SI units.
    value: Mat3,
}

/// The rows; or what is wrong with the one that begins behind a byte.
fn rows(content: &[u8], entries: usize) -> Result<Vec<WrittenRow>, RowFault> {
    let mut rows = Vec::new();
    for (index, record) in records(content).enumerate() {
        let (start, record) = record?;
        // A line of names has no number.
        if index == 0 && record.len() == entries + 1 && record.iter().all(|field| field.parse::<f64>().is_err()) {
            continue;
        }
        let (time, value) = row(&record, entries).map_err(|reason| (start, reason))?;
        rows.push(WrittenRow { start, time, value });
    }
    Ok(rows)
}

/// A row, or what is wrong with it.
fn row(record: &csv::StringRecord, entries: usize) -> Result<(f64, Mat3), String> {
    let columns = entries + 1;
    if record.len() != columns {
        return Err(format!("expected {columns} columns, found {}", record.len()));
    }
    let mut numbers = Vec::with_capacity(columns);
    for (column, field) in record.iter().enumerate() {
        let number: Result<f64, _> = field.parse();
        numbers.push(number.map_err(|_| format!("column {} holds \"{field}\", which is no number", column + 1))?);
    }
    let value = match entries {
        9 => Mat3::from_row_slice(&numbers[1..]),
        _ => Mat3::from_fn(|row, column| if column == 0 && row < entries { numbers[1 + row] } else { 0.0 }),
    };
    Ok((numbers[0], value))
}
