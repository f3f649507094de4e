//! A CSV file of measurements: a line of names, then rows of numbers in SI units; columns that nobody asks for may hold
//! anything, and lines that begin with # are remarks.

use gyration_files::in_words;
use std::path::Path;

/// The file, as it is written.
pub(super) struct Csv {
    /// What messages call it.
    file: String,
    names: Vec<String>,
    rows: Vec<csv::StringRecord>,
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
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text);
        let wrong = |error: csv::Error| format!("{file}: {error}");
        let names = reader.headers().map_err(wrong)?.iter().map(str::to_owned).collect();
        let rows = reader.into_records().collect::<Result<_, _>>().map_err(wrong)?;
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
        let number = |row: &csv::StringRecord| {
            let cell = row.get(at).unwrap_or_default();
            let line = row.position().map_or(0, csv::Position::line);
            let wrong = || format!("{}:{line}: {name} is \"{cell}\", which is no finite number", self.file);
            cell.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(wrong)
        };
        Some(self.rows.iter().map(number).collect())
    }
}
