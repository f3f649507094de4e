//! The journal of an open chunk: a line a finished run.
//!
//! ```text
//! 0a1b2c3d [12, 0.5, "completed", …]      the checksum of the row (CRC-32C), a space, the row
//! ```
//!
//! A line is written whole by one call of the system, so that only the last one can be torn, when the machine stops.
//! Journals of earlier versions have rows without checksums.

use crate::column::Column;
use crate::error::StudyError;
use crate::value::Row;
use gyration_files::check;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A journal that is open for writing.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    /// Whether there are lines that the disk may not have yet.
    is_behind: bool,
}

/// A row as a line, with its end.
pub(super) fn line(row: &Row) -> String {
    let row = row.to_line();
    format!("{:08x} {row}\n", check::sum(row.as_bytes()))
}

/// The row of a line; the error says in words what is wrong.
fn row(line: &str, columns: &[Column]) -> Result<Row, &'static str> {
    let row = match line.split_once(' ').filter(|_| !line.starts_with('[')) {
        Some((sum, row)) if sum == format!("{:08x}", check::sum(row.as_bytes())) => row,
        Some(_) => return Err("does not match its checksum"),
        None => line,
    };
    Row::from_line(row, columns).ok_or("is no row of this study")
}

impl Journal {
    /// A journal, new or to be gone on with.
    pub fn open(path: PathBuf) -> Result<Self, StudyError> {
        let file = gyration_files::open_to_append(&path).map_err(StudyError::io("write", &path))?;
        Ok(Self { path, file, is_behind: false })
    }

    /// Adds lines, each with its end.
    pub fn write(&mut self, lines: &str) -> Result<(), StudyError> {
        self.is_behind = true;
        self.file.write_all(lines.as_bytes()).map_err(StudyError::io("write", &self.path))
    }

    /// Waits until the disk has all lines; whether it had to.
    pub fn sync(&mut self) -> Result<bool, StudyError> {
        let is_behind = std::mem::take(&mut self.is_behind);
        if is_behind {
            self.file.sync_data().map_err(StudyError::io("bring to the disk", &self.path))?;
        }
        Ok(is_behind)
    }
}

/// The rows of a journal, and the bytes up to the end of the last whole line.
///
/// # Errors
/// A line before the last that is no row, or another row than was written.
pub(super) fn read(path: &Path, columns: &[Column]) -> Result<(Vec<Row>, u64), StudyError> {
    let bytes = gyration_files::read(path).map_err(StudyError::io("read", path))?;
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let text = String::from_utf8_lossy(&bytes[..whole]);
    let numbered = |(number, line): (usize, &str)| {
        row(line, columns).map_err(|wrong| StudyError::damaged(path, format!("line {} {wrong}", number + 1)))
    };
    let rows = text.lines().enumerate().map(numbered).collect::<Result<_, _>>()?;
    Ok((rows, whole as u64))
}

/// Reads a journal and takes a torn last line away.
///
/// # Errors
/// As of [`read`], and if the file cannot be shortened.
pub(super) fn mend(path: &Path, columns: &[Column]) -> Result<Vec<Row>, StudyError> {
    let (rows, whole) = read(path, columns)?;
    let file = gyration_files::open_to_append(path).map_err(StudyError::io("write", path))?;
    file.set_len(whole).map_err(StudyError::io("write", path))?;
    Ok(rows)
}
