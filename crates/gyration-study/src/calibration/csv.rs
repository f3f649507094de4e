//! A CSV file of measurements: a line of names, then rows of numbers in SI units; columns that nobody asks for may hold
//! anything, and lines that begin with # are remarks.

use gyration_files::{REMARK, in_words, line_of_row};
use std::path::Path;

/// The file, as it is written.
pub(super) struct Csv {
    /// What messages call it.
    file: String,
    names: Vec<String>,
    /// The line of the names, from 1.
    heading: u64,
    rows: Vec<Row>,
}

/// What is wrong with a file, with its line, and what to do.
pub(super) struct CsvFault {
    pub message: String,
    pub help: &'static str,
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
    /// [`CsvFault`]: it cannot be read, its cells are not divided by commas, or a row is longer or shorter than the
    /// line of names.
    pub fn read(folder: &Path, file: &str) -> Result<Self, CsvFault> {
        let bytes = gyration_files::read(&folder.join(file)).map_err(|error| CsvFault {
            message: format!("{file} cannot be read: {}", in_words(&error)),
            help: "write the path, relative to this file, of a table",
        })?;
        let text = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&bytes);
        let mut reader = csv::ReaderBuilder::new().comment(Some(REMARK)).trim(csv::Trim::All).from_reader(text);
        let wrong = |error: csv::Error| {
            let (what, help) = fault(error.kind());
            CsvFault { message: format!("{file}:{}: {what}", line(text, error.position())), help }
        };
        let header = reader.headers().map_err(wrong)?;
        let names: Vec<String> = header.iter().map(str::to_owned).collect();
        let heading = line(text, header.position());
        if let [name] = names.as_slice()
            && name.contains([';', '\t'])
        {
            let message = format!("{file}:{heading}: the names are not divided by commas");
            return Err(CsvFault {
                message,
                help: "divide names and cells by commas, and write decimals with a point",
            });
        }
        let row = |record: csv::Result<csv::StringRecord>| {
            record.map(|cells| Row { line: line(text, cells.position()), cells }).map_err(wrong)
        };
        let rows = reader.into_records().map(row).collect::<Result<_, _>>()?;
        Ok(Self { file: file.to_owned(), names, heading, rows })
    }

    /// The names of its columns.
    pub fn names(&self) -> String {
        format!("{} has the columns {}", self.file, self.names.join(", "))
    }

    /// The numbers of a column; none if there is no such column.
    ///
    /// # Errors
    /// [`CsvFault`]: there are several columns of the name, or a cell is no finite number.
    pub fn column(&self, name: &str) -> Option<Result<Vec<f64>, CsvFault>> {
        let mut places = (0..self.names.len()).filter(|place| self.names[*place] == name);
        let at = places.next()?;
        if places.next().is_some() {
            let message = format!("{}:{}: several columns are called {name}", self.file, self.heading);
            return Some(Err(CsvFault { message, help: "rename all but the one that was measured" }));
        }
        let number = |Row { line, cells }: &Row| {
            let cell = cells.get(at).unwrap_or_default();
            let wrong = || CsvFault {
                message: format!("{}:{line}: {name} is \"{cell}\", which is no finite number", self.file),
                help: "write a number in SI units",
            };
            cell.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(wrong)
        };
        Some(self.rows.iter().map(number).collect())
    }
}

/// The line of a row; the position is that behind the row before it.
fn line(text: &[u8], position: Option<&csv::Position>) -> u64 {
    line_of_row(text, position.map_or(0, |position| position.byte() as usize))
}

/// What is wrong with a row, and what to do.
fn fault(kind: &csv::ErrorKind) -> (String, &'static str) {
    match kind {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            let help = "give each row a cell for every name in the first line";
            (format!("the row has {len} of {expected_len} cells"), help)
        }
        // Of a text in memory nothing else can be wrong.
        _ => ("the row is not UTF-8 text".to_owned(), "save the file as UTF-8"),
    }
}
