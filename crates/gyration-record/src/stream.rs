//! Arrays that grow together, row by row, and the chunk they are at.
//!
//! Row r stands in chunk ⌊r/C⌋ whatever was flushed when, and a chunk file always has room for C rows, the missing ones
//! filled. So the files depend on the rows alone. Only the chunk under way is in memory.

use crate::array::ArrayInfo;
use crate::chunks::read_chunk;
use crate::disk::{self, Disk};
use crate::error::RecordError;
use std::path::{Path, PathBuf};

/// Arrays that grow together along one dimension.
#[derive(Debug)]
pub(crate) struct Stream {
    /// Along which they grow.
    pub(crate) dim: &'static str,
    pub(crate) rows: usize,
    chunk_rows: usize,
    parts: Vec<GrowingArray>,
    /// Rows of the chunk under way that its files hold, with fill after them; none: there are no such files.
    stored: Option<usize>,
}

/// One of the arrays: the chunk under way, with fill where no row is yet.
#[derive(Debug)]
struct GrowingArray {
    info: ArrayInfo,
    row_bytes: usize,
    chunk: Vec<u8>,
}

impl GrowingArray {
    fn clear_from(&mut self, row: usize) {
        let fill = self.info.data_type.fill_bytes();
        for slot in self.chunk[row * self.row_bytes..].chunks_exact_mut(fill.len()) {
            slot.copy_from_slice(&fill);
        }
    }

    fn path(&self, directory: &Path, index: usize) -> PathBuf {
        self.info.chunk_path(directory, index)
    }
}

impl Stream {
    /// The growing arrays of this dimension, empty; none if there are none.
    pub(crate) fn new(dim: &'static str, arrays: &[ArrayInfo]) -> Option<Self> {
        let growing = arrays.iter().filter(|array| array.grows_with(dim));
        let parts = growing.map(|info| {
            let row_bytes = info.row_len() * info.data_type.size();
            let mut part = GrowingArray { info: info.clone(), row_bytes, chunk: vec![0; info.chunk[0] * row_bytes] };
            part.clear_from(0);
            part
        });
        let parts = parts.collect::<Vec<_>>();
        let chunk_rows = parts.first()?.info.chunk[0];
        Some(Self { dim, rows: 0, chunk_rows, parts, stored: None })
    }

    /// Appends a row: the bytes of all arrays, one after the other. A chunk that is full goes to the disk.
    pub(crate) fn push(&mut self, mut row: &[u8], disk: &Disk, directory: &Path) -> Result<(), RecordError> {
        let at = self.rows % self.chunk_rows;
        for part in &mut self.parts {
            let (own, rest) = row.split_at(part.row_bytes);
            part.chunk[at * part.row_bytes..][..part.row_bytes].copy_from_slice(own);
            row = rest;
        }
        self.rows += 1;
        if self.rows.is_multiple_of(self.chunk_rows) {
            self.store_chunk(self.rows / self.chunk_rows - 1, self.chunk_rows, disk, directory)?;
            self.parts.iter_mut().for_each(|part| part.clear_from(0));
            self.stored = None;
        }
        Ok(())
    }

    /// Brings the chunk under way to the disk.
    pub(crate) fn store(&mut self, disk: &Disk, directory: &Path) -> Result<(), RecordError> {
        match self.rows % self.chunk_rows {
            0 => Ok(()),
            rows => self.store_chunk(self.rows / self.chunk_rows, rows, disk, directory),
        }
    }

    /// Whole files take the place of those that are there: a checksum holds for all of a chunk, so that none may be
    /// written to in place.
    fn store_chunk(&mut self, index: usize, rows: usize, disk: &Disk, directory: &Path) -> Result<(), RecordError> {
        if self.stored == Some(rows) {
            return Ok(());
        }
        let chunks = self.parts.iter().map(|part| (part.path(directory, index), part.info.encode(&part.chunk)));
        let chunks = chunks.collect::<Vec<_>>();
        let files = chunks.iter().map(|(path, bytes)| (path.clone(), bytes.as_slice()));
        disk.replace(&files.collect::<Vec<_>>())?;
        self.stored = Some(rows);
        Ok(())
    }

    /// Goes back to the first `rows` rows: reads the chunk under way, removes the files beyond it.
    pub(crate) fn cut(&mut self, rows: usize, disk: &Disk, directory: &Path) -> Result<(), RecordError> {
        self.rows = rows;
        // The files may hold rows beyond: they are replaced at the next chance.
        self.stored = None;
        let (index, kept) = (rows / self.chunk_rows, rows % self.chunk_rows);
        for part in &mut self.parts {
            if kept > 0 {
                let path = part.path(directory, index);
                part.chunk = read_chunk(&part.info, &path)?;
                part.clear_from(kept);
            }
            let stored = index + usize::from(kept > 0);
            remove_beyond(stored, &directory.join(&part.info.name), disk)?;
        }
        Ok(())
    }
}

/// Removes the chunks of an array from the one numbered `stored` on, and files that never reached their place.
fn remove_beyond(stored: usize, array: &Path, disk: &Disk) -> Result<(), RecordError> {
    for name in disk::list(array)? {
        let text = name.to_string_lossy();
        let number = text.strip_prefix("c.").and_then(|rest| rest.split('.').next()?.parse::<usize>().ok());
        if number.is_some_and(|number| number >= stored) || disk::is_part(&name) {
            disk.remove_file(&array.join(&name))?;
        }
    }
    Ok(())
}
