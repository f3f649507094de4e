//! The journal of an open chunk: a line a finished run.
//!
//! A line is written whole by one call of the system, so that only the last one can be torn, when the machine stops.

use crate::column::Column;
use crate::error::StudyError;
use crate::value::Row;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A journal that is open for writing.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: File,
}

impl Journal {
    /// A journal, new or to be gone on with.
    pub fn open(path: PathBuf) -> Result<Self, StudyError> {
        let file = OpenOptions::new().append(true).create(true).open(&path).map_err(StudyError::io("write", &path))?;
        Ok(Self { path, file })
    }

    /// Adds lines, each with its end.
    pub fn write(&mut self, lines: &str) -> Result<(), StudyError> {
        self.file.write_all(lines.as_bytes()).map_err(StudyError::io("write", &self.path))
    }
}

/// The rows of a journal, and the bytes up to the end of the last whole line.
///
/// # Errors
/// A line before the last that is no row.
pub(super) fn read(path: &Path, columns: &[Column]) -> Result<(Vec<Row>, u64), StudyError> {
    let bytes = gyration_files::read(path).map_err(StudyError::io("read", path))?;
    let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let text = String::from_utf8_lossy(&bytes[..whole]);
    let row = |(number, line): (usize, &str)| {
        let row = Row::from_line(line, columns);
        row.ok_or_else(|| StudyError::damaged(path, format!("line {} is no row of this study", number + 1)))
    };
    let rows = text.lines().enumerate().map(row).collect::<Result<_, _>>()?;
    Ok((rows, whole as u64))
}

/// Reads a journal and takes a torn last line away.
///
/// # Errors
/// As of [`read`], and if the file cannot be shortened.
pub(super) fn mend(path: &Path, columns: &[Column]) -> Result<Vec<Row>, StudyError> {
    let (rows, whole) = read(path, columns)?;
    let file = OpenOptions::new().write(true).open(path).map_err(StudyError::io("write", path))?;
    file.set_len(whole).map_err(StudyError::io("write", path))?;
    Ok(rows)
}
