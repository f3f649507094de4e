//! Reading a recording, finished or not: its attributes, its arrays whole or by rows, its columns and events.
//!
//! What is read is what stood there when it was opened: rows that a writer adds later are not seen. A range of rows is
//! read chunk by chunk, so that long runs pass through bounded memory; every chunk is held against its checksum. A
//! recording in memory answers as one on disk would.

use crate::Attributes;
use crate::array::{ArrayInfo, DataType};
use crate::checkpoint::Checkpoint;
use crate::chunks::{LastChunks, read_labels};
use crate::columns::Column;
use crate::disk;
use crate::error::RecordError;
use crate::event::Event;
use crate::layout::{Layout, START};
use crate::memory::{Memory, Rows};
use crate::metadata::Group;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// An open recording.
#[derive(Debug, Clone)]
pub struct Recording {
    path: PathBuf,
    group: Group,
    /// The columns of the CSV, once they are asked for.
    columns: OnceLock<Vec<Column>>,
    source: Source,
}

/// Where the numbers are.
#[derive(Debug, Clone)]
enum Source {
    Disk(LastChunks),
    Memory(Arc<Memory>),
}

/// Numbers with their shape, last dimension fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Sizes of the dimensions.
    pub shape: Vec<usize>,
    /// The numbers.
    pub data: Vec<f64>,
}

impl Recording {
    /// Opens a recording.
    ///
    /// # Errors
    /// `Missing`, `NotARecording`, `Version`, `Io`.
    pub fn open(path: &Path) -> Result<Self, RecordError> {
        // Of the folder first: one that takes its place while this reads is another one.
        let chunks = LastChunks::of(path);
        let group = disk::read_group(path)?;
        Ok(Self { path: path.to_path_buf(), group, columns: OnceLock::new(), source: Source::Disk(chunks) })
    }

    /// The recording at a path of which the metadata are known, while nobody else writes there.
    pub(crate) fn of_group(path: &Path, group: Group) -> Self {
        let source = Source::Disk(LastChunks::of(path));
        Self { path: path.to_path_buf(), group, columns: OnceLock::new(), source }
    }

    /// The recording that a disk would hold of some rows, without entries of samples; `name` stands in errors. It has
    /// no checkpoint.
    ///
    /// # Errors
    /// `Layout`, `RowLength`.
    pub fn in_memory(
        name: &Path,
        layout: &Layout,
        attributes: Attributes,
        rows: Arc<Rows>,
    ) -> Result<Self, RecordError> {
        let (memory, group) = Memory::new(layout, attributes, rows)?;
        let source = Source::Memory(Arc::new(memory));
        Ok(Self { path: name.to_path_buf(), group, columns: OnceLock::new(), source })
    }

    /// Whether two are the same recording, which may have grown in between, and not one in the place of another.
    pub fn is_same_as(&self, other: &Self) -> bool {
        match (&self.source, &other.source) {
            (Source::Disk(own), Source::Disk(others)) => self.path == other.path && own.are_beside(others),
            (Source::Memory(own), Source::Memory(others)) => Arc::ptr_eq(own, others),
            _ => false,
        }
    }

    /// The recording's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The attributes, with this crate's own (`record_…`).
    pub fn attributes(&self) -> &Attributes {
        &self.group.attributes
    }

    /// The caller's bytes of the last checkpoint, from which a resumed run would go on.
    ///
    /// # Errors
    /// `Replaced`, `Corrupt`, `Io`.
    pub fn checkpoint(&self) -> Result<Vec<u8>, RecordError> {
        Ok(self.read_checkpoint()?.state)
    }

    /// Whether a crash came between the last rows and the checkpoint that belongs to them: then the checkpoint is an
    /// earlier one.
    ///
    /// # Errors
    /// `Replaced`, `Corrupt`, `Io`.
    pub fn is_ahead_of_its_checkpoint(&self) -> Result<bool, RecordError> {
        Ok(self.read_checkpoint()?.rows < self.rows())
    }

    fn read_checkpoint(&self) -> Result<Checkpoint, RecordError> {
        let file = self.path.join(disk::CHECKPOINT);
        let checkpoint = disk::read(&file).and_then(|bytes| Checkpoint::decode(&bytes, &file));
        match &self.source {
            Source::Disk(chunks) => chunks.own(&self.path, checkpoint),
            Source::Memory(_) => checkpoint,
        }
    }

    /// All arrays: the growing ones in the order of a row, `time` first, then events, fixed arrays and labels.
    pub fn arrays(&self) -> &[ArrayInfo] {
        &self.group.arrays
    }

    /// The array of this name.
    ///
    /// # Errors
    /// `NoSuchArray`.
    pub fn array(&self, name: &str) -> Result<&ArrayInfo, RecordError> {
        let found = self.arrays().iter().find(|array| array.name == name);
        found.ok_or_else(|| RecordError::NoSuchArray { name: name.into() })
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.group.rows("time").unwrap_or(0)
    }

    /// Rows of a chunk: ranges that begin at its multiples are read fastest.
    pub fn chunk_rows(&self) -> usize {
        self.arrays().first().and_then(|time| time.chunk.first()).map_or(1, |rows| *rows)
    }

    /// The ranges of rows that cover the recording chunk by chunk.
    pub fn chunks(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let (rows, step) = (self.rows(), self.chunk_rows());
        (0..rows).step_by(step).map(move |from| from..rows.min(from + step))
    }

    /// Times of the samples, in s.
    ///
    /// # Errors
    /// Those of [`read`](Recording::read).
    pub fn times(&self) -> Result<Vec<f64>, RecordError> {
        Ok(self.read("time")?.data)
    }

    /// The name of the group of entries of which each sample has a number of its own; none without one.
    pub fn ragged(&self) -> Option<&str> {
        self.group.ragged()
    }

    /// The entries of a sample in the arrays of that group.
    ///
    /// # Errors
    /// `NoSuchArray` without one; `NoSuchRows`, `Replaced`, `Truncated`, `Corrupt`, `Io`.
    pub fn entries(&self, row: usize) -> Result<Range<usize>, RecordError> {
        let name = self.ragged().ok_or_else(|| RecordError::NoSuchArray { name: START.into() })?;
        let name = format!("{name}/{START}");
        let start = self.read_rows(&name, row..row.saturating_add(2))?;
        // Counts, by construction.
        match start.data[..] {
            [from, to] if from <= to => Ok(from as usize..to as usize),
            _ => Err(RecordError::corrupt(&self.path.join(name), "the entries of the samples do not ascend")),
        }
    }

    /// Reads a whole array.
    ///
    /// # Errors
    /// `NoSuchArray` (labels are read by [`labels`](Recording::labels)); `Replaced`, `Truncated`, `Corrupt`, `Io`.
    pub fn read(&self, name: &str) -> Result<Array, RecordError> {
        let rows = self.array(name)?.shape.first().map_or(1, |rows| *rows);
        self.read_rows(name, 0..rows)
    }

    /// Reads rows of an array: places along its first dimension.
    ///
    /// # Errors
    /// `NoSuchArray`, `NoSuchRows`, `Replaced`, `Truncated`, `Corrupt`, `Io`.
    pub fn read_rows(&self, name: &str, rows: Range<usize>) -> Result<Array, RecordError> {
        let array = self.array(name)?;
        if array.data_type == DataType::String {
            return Err(RecordError::NoSuchArray { name: name.into() });
        }
        let bytes = self.read_bytes(array, rows.clone())?;
        let data = if array.data_type == DataType::Int32 {
            bytes.as_chunks().0.iter().map(|b| f64::from(i32::from_le_bytes(*b))).collect()
        } else {
            bytes.as_chunks().0.iter().map(|b| f64::from_le_bytes(*b)).collect()
        };
        let first = array.shape.first().map(|_| rows.len());
        let shape = first.into_iter().chain(array.shape.iter().skip(1).copied()).collect();
        Ok(Array { shape, data })
    }

    /// The arrays that grow with time, in the order of a row; the time itself apart.
    pub fn growing(&self) -> impl Iterator<Item = &ArrayInfo> {
        self.arrays().iter().filter(|array| array.grows_with("time") && array.name != "time")
    }

    /// Names of the columns in the order of the CSV, which puts `t` before them.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        self.column_places().map(|(name, _, _)| name)
    }

    /// Reads a column: one component of an array, such as `die.x`, or `t`.
    ///
    /// # Errors
    /// `NoSuchColumn`; those of [`read_rows`](Recording::read_rows).
    pub fn column(&self, name: &str) -> Result<Vec<f64>, RecordError> {
        let found = self.column_places().find(|(column, _, _)| *column == name);
        let (_, array, index) = match found {
            Some(place) => place,
            None if name == "t" => ("t", "time", 0),
            None => return Err(RecordError::NoSuchColumn { name: name.into() }),
        };
        let stride = self.array(array)?.row_len();
        let mut column = Vec::with_capacity(self.rows());
        for rows in self.chunks() {
            let part = self.read_rows(array, rows)?;
            column.extend(part.data.iter().skip(index).step_by(stride));
        }
        Ok(column)
    }

    /// Labels of a dimension, if it has any.
    ///
    /// # Errors
    /// `Replaced`, `Corrupt`, `Io`.
    pub fn labels(&self, dim: &str) -> Result<Option<Vec<String>>, RecordError> {
        let labelled = |array: &&ArrayInfo| array.name == dim && array.data_type == DataType::String;
        let Some(array) = self.arrays().iter().find(labelled) else {
            return Ok(None);
        };
        match &self.source {
            Source::Disk(chunks) => chunks.own(&self.path, read_labels(array, &self.path)).map(Some),
            Source::Memory(memory) => Ok(Some(memory.labels(array))),
        }
    }

    /// Names of the kinds of events, by code.
    pub fn event_kinds(&self) -> &[String] {
        self.array("event_kind").map_or(&[], |array| &array.meanings)
    }

    /// All events.
    ///
    /// # Errors
    /// `Replaced`, `Truncated`, `Corrupt`, `Io`.
    pub fn events(&self) -> Result<Vec<Event>, RecordError> {
        if self.group.rows("event").is_none() {
            return Ok(Vec::new());
        }
        let [times, kinds, bodies] = ["event_time", "event_kind", "event_body"].map(|name| self.read(name));
        let (kinds, bodies) = (kinds?.data, bodies?.data);
        // The codes were indices: whole numbers from -1 (none) up.
        let event = |(time, (kind, body)): (f64, (f64, f64))| Event {
            time,
            kind: kind as usize,
            body: (body >= 0.0).then_some(body as usize),
        };
        Ok(times?.data.into_iter().zip(kinds.into_iter().zip(bodies)).map(event).collect())
    }

    /// Name, array and place in its row of each column, in the order of the CSV.
    pub fn column_places(&self) -> impl Iterator<Item = (&str, &str, usize)> {
        let columns = self.columns.get_or_init(|| self.group.columns());
        columns.iter().map(|Column { name, array, index }| (name.as_str(), array.as_str(), *index))
    }

    /// The bytes of rows of an array, in the array's own type.
    pub(crate) fn read_bytes(&self, array: &ArrayInfo, rows: Range<usize>) -> Result<Vec<u8>, RecordError> {
        let (count, chunk_rows) = match (array.shape.first(), array.chunk.first()) {
            (Some(count), Some(chunk_rows)) => (*count, *chunk_rows),
            _ => (1, 1),
        };
        if rows.start > rows.end || rows.end > count {
            return Err(RecordError::NoSuchRows { from: rows.start, to: rows.end, rows: count });
        }
        let chunks = match &self.source {
            Source::Disk(chunks) => chunks,
            Source::Memory(memory) => return Ok(memory.bytes(array, rows)),
        };
        let row_bytes = array.row_len() * array.data_type.size();
        let mut bytes = Vec::new();
        let mut from = rows.start;
        while from < rows.end {
            let index = from / chunk_rows;
            let to = rows.end.min((index + 1) * chunk_rows);
            let chunk = chunks.read(&self.path, array, index)?;
            let first = from - index * chunk_rows;
            bytes.extend(&chunk[first * row_bytes..][..(to - from) * row_bytes]);
            from = to;
        }
        Ok(bytes)
    }
}
