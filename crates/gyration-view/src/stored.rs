//! A recording on disk as the page sees it: its header, and its arrays by name.

use crate::computed::{Computed, described};
use crate::error::ViewError;
use gyration_page::blob;
use gyration_page::header::Header;
use gyration_record::{RecordError, Recording};
use gyration_scene::Scene;
use std::ops::Range;
use std::path::Path;

/// A recording to be shown, finished or still growing.
#[derive(Debug, Clone)]
pub struct Stored {
    recording: Recording,
    header: Header,
    /// Arrays that are not recorded.
    computed: Option<Computed>,
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
        let computed = if may_lack(&header) { Computed::offer(&recording, &mut header) } else { None };
        Ok(Self { recording, header, computed })
    }

    /// Numbers it among the recordings that stood at its path, from one.
    pub(crate) fn number(&mut self, number: u64) {
        self.header.run = number;
    }

    /// What the page is told first.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Samples there are.
    pub fn rows(&self) -> usize {
        self.header.rows
    }

    /// Bodies there are.
    pub(crate) fn bodies(&self) -> usize {
        described(&self.header, "bodies").len()
    }

    /// Where the recording is.
    pub fn path(&self) -> &Path {
        self.recording.path()
    }

    /// The recording itself.
    pub(crate) fn recording(&self) -> &Recording {
        &self.recording
    }

    /// The scene that was run, ready to run again.
    ///
    /// # Errors
    /// `Replay` if it is not to be had.
    pub(crate) fn scene(&self) -> Result<Scene, ViewError> {
        Ok(gyration_sim::replay::scene(&self.recording)?)
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
        let grows = name == "time"
            || name == "network" && self.header.network
            || self.header.arrays.iter().any(|array| array.name == name);
        if !grows {
            return Err(RecordError::NoSuchArray { name: name.to_owned() }.into());
        }
        if rows.start > rows.end || rows.end > self.rows() {
            return Err(RecordError::NoSuchRows { from: rows.start, to: rows.end, rows: self.rows() }.into());
        }
        let kept = || kept_rows(rows.clone(), every);
        if let Some(bytes) = self.computed.as_ref().and_then(|computed| computed.blob(name, kept())) {
            return bytes;
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
        // An empty range is judged by the recording.
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

/// Whether the page may want more than was recorded: of bodies that deform, of several bodies, or of several supports.
fn may_lack(header: &Header) -> bool {
    let bodies = described(header, "bodies");
    bodies.iter().any(|body| body["kind"] != "rigid") || bodies.len() > 1 || described(header, "supports").len() > 1
}

/// The rows that are kept of a range: one in `every`, and the last.
fn kept_rows(rows: Range<usize>, every: usize) -> impl Iterator<Item = usize> {
    let last = rows.end.checked_sub(1).filter(|last| rows.start <= *last && !(last - rows.start).is_multiple_of(every));
    rows.step_by(every).chain(last)
}

/// How many rows [`Stored::blob`] keeps.
pub(crate) fn kept(rows: usize, every: usize) -> usize {
    kept_rows(0..rows, every).count()
}

#[cfg(test)]
mod tests {
    use super::{kept, kept_rows};

    #[test]
    fn the_last_row_is_kept_whatever_the_thinning() {
        for rows in 0..40 {
            for every in 1..9 {
                let expected: Vec<_> = (0..rows).filter(|row| row % every == 0 || row + 1 == rows).collect();
                assert_eq!(kept_rows(0..rows, every).collect::<Vec<_>>(), expected);
                assert_eq!(kept(rows, every), expected.len(), "{rows} rows, every {every}");
            }
        }
    }
}
