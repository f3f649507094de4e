//! A CSV file of measurements: a line of names, then rows of numbers in SI units; columns that nobody asks for may hold
//! anything, and lines that begin with # are remarks.

use gyration_files::{REMARK, in_words, line_of_row};
use std::path::Path;

/// The file, as it is written.
pub(super) struct Csv {
    /// What messages call it.
    file: String,
    names: Vec<String>,
    rows: Vec<Row>,
}

/// A row with its line, from 1.
struct Row {
    line: u64,
    cells: csv::StringRecord,
}

impl Csv {
    /// Reads a file that stands in a folder.
    ///
    /// # Errors
    /// In words: it cannot be read, or a row is longer or shorter than the line of names.
    pub fn read(folder: &Path, file: &str) -> Result<Self, String> {
        let bytes = gyration_files::read(&folder.join(file))
            .map_err(|error| format!("{file} cannot be read: {}", in_words(&error)))?;
        let text = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&bytes);
        let mut reader = csv::ReaderBuilder::new().comment(Some(REMARK)).trim(csv::Trim::All).from_reader(text);
        let wrong = |error: csv::Error| format!("{file}:{}: {}", line(text, error.position()), fault(error.kind()));
        let names = reader.headers().map_err(wrong)?.iter().map(str::to_owned).collect();
        let row = |record: csv::Result<csv::StringRecord>| {
            record.map(|cells| Row { line: line(text, cells.position()), cells }).map_err(wrong)
        };
        let rows = reader.into_records().map(row).collect::<Result<_, _>>()?;
        Ok(Self { file: file.to_owned(), names, rows })
    }

    /// The names of its columns.
    pub fn names(&self) -> String {
        format!("{} has the columns {}", self.file, self.names.join(", "))
    }

    /// The numbers of a column; none if there is no such column.
    ///
    /// # Errors
    /// In words: the line of a cell that is no finite number.
    pub fn column(&self, name: &str) -> Option<Result<Vec<f64>, String>> {
        let at = self.names.iter().position(|other| other == name)?;
        let number = |Row { line, cells }: &Row| {
            let cell = cells.get(at).unwrap_or_default();
            let wrong = || format!("{}:{line}: {name} is \"{cell}\", which is no finite number", self.file);
            cell.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(wrong)
        };
        Some(self.rows.iter().map(number).collect())
    }
}

/// The line of a row; the position is that behind the row before it.
fn line(text: &[u8], position: Option<&csv::Position>) -> u64 {
    line_of_row(text, position.map_or(0, |position| position.byte() as usize))
}

/// What is wrong with a row.
fn fault(kind: &csv::ErrorKind) -> String {
    match kind {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("the row has {len} of {expected_len} cells")
        }
        // Of a text in memory nothing else can be wrong.
        _ => "the row is not UTF-8 text".to_owned(),
    }
}
