//! A recording on disk as the page sees it: its header, and its arrays by name.

use crate::blob;
use crate::error::ViewError;
use crate::header::Header;
use gyration_record::{RecordError, Recording};
use std::ops::Range;
use std::path::Path;

/// A recording to be shown, finished or still growing.
#[derive(Debug, Clone)]
pub struct Stored {
    recording: Recording,
    header: Header,
}

impl Stored {
    /// Opens a recording as it stands.
    ///
    /// # Errors
    /// `Record` if it is none, or of another version, or damaged.
    pub fn open(path: &Path) -> Result<Self, ViewError> {
        let recording = Recording::open(path)?;
        let mut header = Header::of_recording(&recording);
        if !header.is_complete() {
            header.notes.push(
                "The run has not ended: it is under way, or was interrupted and can go on by --resume.".to_owned(),
            );
        }
        if header.surfaces.is_empty() && header.rows > 0 {
            header.notes.push("The recording holds no surfaces: bodies are drawn by their outlines.".to_owned());
        }
        Ok(Self { recording, header })
    }

    /// What the page is told first.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Samples there are.
    pub fn rows(&self) -> usize {
        self.header.rows
    }

    /// Where the recording is.
    pub fn path(&self) -> &Path {
        self.recording.path()
    }

    /// The bytes of a blob, see [`blob`]; of one that grows the rows asked for, one in `every` of them and the last.
    ///
    /// # Errors
    /// `Record` if there is no such blob, if it has no such rows, or if it cannot be read.
    pub fn blob(&self, name: &str, rows: Range<usize>, every: usize) -> Result<Vec<u8>, ViewError> {
        if name == "events" {
            return Ok(blob::events(&self.recording.events()?));
        }
        if let Some((surface, part)) = name.strip_prefix("surface/").and_then(|rest| rest.split_once('/')) {
            let array = self.recording.read(&format!("surface_{surface}_{part}"))?;
            return Ok(if part == "triangles" { blob::indices(&array.data) } else { blob::singles(&array.data) });
        }
        let grows = name == "time" || self.header.arrays.iter().any(|array| array.name == name);
        if !grows {
            return Err(RecordError::NoSuchArray { name: name.to_owned() }.into());
        }
        let mut bytes = Vec::new();
        self.each_row(name, rows, every, |row| {
            bytes.extend(if name == "time" { blob::doubles(row.iter().copied()) } else { blob::singles(row) });
        })?;
        Ok(bytes)
    }

    /// Hands on one row in `every` of an array, and the last, reading no more than a chunk at a time.
    fn each_row(
        &self,
        name: &str,
        rows: Range<usize>,
        every: usize,
        mut each: impl FnMut(&[f64]),
    ) -> Result<(), ViewError> {
        let last = rows.end.saturating_sub(1);
        let chunk = self.recording.chunk_rows();
        let mut from = rows.start;
        // An empty or impossible range is judged by the recording.
        if rows.start >= rows.end {
            self.recording.read_rows(name, rows)?;
            return Ok(());
        }
        while from <= last {
            let to = ((from / chunk + 1) * chunk).min(last + 1);
            let part = self.recording.read_rows(name, from..to)?;
            let stride = part.data.len() / (to - from);
            for (row, values) in (from..to).zip(part.data.chunks_exact(stride.max(1))) {
                if (row - rows.start).is_multiple_of(every) || row == last {
                    each(values);
                }
            }
            from = to;
        }
        Ok(())
    }
}

/// How many rows [`Stored::blob`] keeps.
pub(crate) fn kept(rows: usize, every: usize) -> usize {
    let whole = rows.div_ceil(every);
    let last_is_extra = rows > 0 && !(rows - 1).is_multiple_of(every);
    whole + usize::from(last_is_extra)
}

#[cfg(test)]
mod tests {
    use super::kept;

    #[test]
    fn the_last_row_is_kept_whatever_the_thinning() {
        for rows in 0..40 {
            for every in 1..9 {
                let expected = (0..rows).filter(|row| row % every == 0 || row + 1 == rows).count();
                assert_eq!(kept(rows, every), expected, "{rows} rows, every {every}");
            }
        }
    }
}
