//! The chunks of a recording as they are read: whole, held against their checksums, the last one of each array kept.
//!
//! Whoever goes through a recording row by row would otherwise read each chunk as often as it has rows. What is read
//! belongs to the folder that was opened: one that has taken its place since is told, not read.

use crate::array::{ArrayInfo, DataType};
use crate::disk;
use crate::error::RecordError;
use crate::identity::Identity;
use crate::zarr;
use gyration_files::check;
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// The chunk of each array that was read last, by its number. Rows that a recording counts do not change in it.
#[derive(Clone)]
pub(crate) struct LastChunks {
    /// The folder that they are in; none where that cannot be told.
    folder: Option<Identity>,
    last: Arc<Mutex<BTreeMap<String, (usize, Elements)>>>,
}

/// The elements of a chunk, with room for all its rows.
type Elements = Arc<Vec<u8>>;

/// The elements of a chunk of numbers that stands at `path`, which has room for all its rows.
///
/// # Errors
/// `Truncated`, `Corrupt`, `Io`.
pub(crate) fn read_chunk(array: &ArrayInfo, path: &Path) -> Result<Vec<u8>, RecordError> {
    let bytes = disk::read(path)?;
    let expected = array.chunk.iter().product::<usize>() * array.data_type.size();
    let expected = expected + if array.is_checked { check::SUM } else { 0 };
    if bytes.len() != expected {
        let (expected, found) = (expected as u64, bytes.len() as u64);
        return Err(RecordError::Truncated { path: path.to_path_buf(), expected, found });
    }
    array.decode(bytes, path)
}

/// The labels of a dimension.
///
/// # Errors
/// `Corrupt`, `Io`.
pub(crate) fn read_labels(array: &ArrayInfo, folder: &Path) -> Result<Vec<String>, RecordError> {
    let path = array.chunk_path(folder, 0);
    let bytes = array.decode(disk::read(&path)?, &path)?;
    let labels = zarr::decode_labels(&bytes).filter(|labels| labels.len() == array.shape[0]);
    labels.ok_or_else(|| RecordError::corrupt(&path, "the labels cannot be read"))
}

/// Holds all that a recording of so many rows along each growing dimension consists of against its checksums.
///
/// # Errors
/// `Truncated`, `Corrupt`, `Io`: the first chunk that is not what was written.
pub(crate) fn verify(arrays: &[ArrayInfo], folder: &Path, rows: &[(&str, usize)]) -> Result<(), RecordError> {
    for array in arrays {
        if array.data_type == DataType::String {
            read_labels(array, folder)?;
            continue;
        }
        let growing = rows.iter().find(|(dim, _)| array.grows_with(dim));
        let count = growing.zip(array.chunk.first()).map_or(1, |((_, rows), chunk_rows)| rows.div_ceil(*chunk_rows));
        for index in 0..count {
            read_chunk(array, &array.chunk_path(folder, index))?;
        }
    }
    Ok(())
}

impl fmt::Debug for LastChunks {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("LastChunks")
    }
}

impl LastChunks {
    /// Of the recording that stands in a folder now, of which none is read yet.
    pub(crate) fn of(folder: &Path) -> Self {
        Self { folder: Identity::of(folder), last: Arc::default() }
    }

    /// Whether another folder stands there now.
    pub(crate) fn are_replaced(&self, folder: &Path) -> bool {
        let now = Identity::of(folder);
        now.is_some() && self.folder.is_some() && now != self.folder
    }

    /// Whether they are in the same folder as others.
    pub(crate) fn are_beside(&self, others: &Self) -> bool {
        self.folder == others.folder
    }

    /// What was just read in the folder, if that is still the one.
    ///
    /// # Errors
    /// `Replaced`; otherwise that of the reading.
    pub(crate) fn own<T>(&self, folder: &Path, read: Result<T, RecordError>) -> Result<T, RecordError> {
        if self.are_replaced(folder) { Err(RecordError::Replaced { path: folder.to_path_buf() }) } else { read }
    }

    /// The elements of a chunk of numbers of the recording in `folder`.
    ///
    /// # Errors
    /// `Replaced`, `Truncated`, `Corrupt`, `Io`.
    pub(crate) fn read(&self, folder: &Path, array: &ArrayInfo, index: usize) -> Result<Elements, RecordError> {
        let last = || self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, elements)) = last().get(&array.name).filter(|(held, _)| *held == index) {
            return Ok(Arc::clone(elements));
        }
        let elements = Arc::new(self.own(folder, read_chunk(array, &array.chunk_path(folder, index)))?);
        last().insert(array.name.clone(), (index, Arc::clone(&elements)));
        Ok(elements)
    }
}
