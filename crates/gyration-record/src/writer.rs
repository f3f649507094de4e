//! Writing a recording: create, append, flush, finish; resume.
//!
//! A flush writes, each step on the disk before the next: 1. the chunks under way, 2. the metadata with the new
//! lengths, 3. the checkpoint with the number of rows it belongs to. So whatever the moment of a crash, the metadata
//! never count a row that is not there, and the checkpoint never one that the metadata do not count. To resume is to
//! cut back to the checkpoint's rows and to go on. A new recording grows as `NAME.gyr.part` and gets its name at the
//! first flush, before which all of it comes to the disk at once: a recording that exists has its scene, its first row
//! and a checkpoint. No clock is read here.
//!
//! Readers that ignore consolidated metadata see a file an array; a crash among the renames of step 2 leaves those, and
//! nothing else, of two lengths until the run is resumed.

use crate::Attributes;
use crate::array::{ArrayInfo, DataType};
use crate::checkpoint::Checkpoint;
use crate::chunks;
use crate::disk::{self, CHECKPOINT, Disk, METADATA, STATE};
use crate::error::RecordError;
use crate::event::Event;
use crate::layout::{BOUNDARY, ENTRY, Layout, START};
use crate::metadata::{AttributeTexts, Group};
use crate::recording::Recording;
use crate::stream::Stream;
use crate::zarr;
use std::fs::File;
use std::path::{Path, PathBuf};

/// The one writer of a recording.
#[derive(Debug)]
pub struct Writer {
    /// The recording's name.
    path: PathBuf,
    /// Where it is: its name, or beside it before the first flush.
    directory: PathBuf,
    disk: Disk,
    group: Group<AttributeTexts>,
    samples: Stream,
    events: Option<Stream>,
    /// Where the entries of each sample begin, and the entries; none without a ragged group.
    ragged: Option<[Stream; 2]>,
    row_len: usize,
    /// Bytes of the row being appended.
    row: Vec<u8>,
    /// Whether the metadata on disk are behind `group`.
    stale: bool,
    /// An operation failed: what is in memory no longer says what is on disk.
    failed: bool,
    /// Held as long as the writer lives, and no longer than the process.
    _lock: File,
}

/// What [`Writer::resume`] finds.
#[derive(Debug)]
pub struct Resumed {
    /// The writer, to go on after the rows that belong to the checkpoint.
    pub writer: Writer,
    /// The caller's bytes of the last checkpoint.
    pub checkpoint: Vec<u8>,
    /// Rows that belong to it, and stay.
    pub rows: usize,
}

impl Writer {
    /// Creates a recording. It appears under its name at the first [`flush`](Writer::flush).
    ///
    /// # Errors
    /// `AlreadyExists`; `Locked` if another process is creating it; `Layout`; `Io`.
    pub fn create(path: &Path, layout: &Layout, attributes: Attributes) -> Result<Self, RecordError> {
        Self::create_on(Disk::default(), path, layout, attributes)
    }

    pub(crate) fn create_on(
        mut disk: Disk,
        path: &Path,
        layout: &Layout,
        attributes: Attributes,
    ) -> Result<Self, RecordError> {
        layout.check()?;
        let group = Group::new(layout, attributes)?;
        if path.symlink_metadata().is_ok() {
            return Err(RecordError::AlreadyExists { path: path.to_path_buf() });
        }
        let directory = disk::part_of(path);
        disk::discard(&directory, path)?;
        disk.is_unnamed = true;
        disk.create_dir(&directory)?;
        disk.create_dir(&directory.join(STATE))?;
        let lock = disk::lock(&directory, path)?;
        let subgroup = group.ragged().map(Path::new);
        for name in subgroup.into_iter().chain(group.arrays.iter().map(|array| Path::new(&array.name))) {
            disk.create_dir(&directory.join(name))?;
        }
        let fixed = fixed_chunks(layout, &group);
        let files = fixed.iter().map(|(name, bytes)| (directory.join(name), bytes.as_slice()));
        disk.replace(&files.collect::<Vec<_>>())?;
        let mut writer = Self::over(disk, path, directory, group, lock)?;
        writer.end_sample()?;
        Ok(writer)
    }

    /// Opens a recording to go on from its last checkpoint; rows beyond it are cut off. All that stays is read once,
    /// and held against its checksums.
    ///
    /// # Errors
    /// `Missing`, `NotARecording`, `Version`, `Locked`, `Corrupt`, `Truncated`, `Io`.
    pub fn resume(path: &Path) -> Result<Resumed, RecordError> {
        Self::resume_on(Disk::default(), path, &[])
    }

    /// Goes on with a recording whose last attributes are on the disk while its checkpoint is an earlier one
    /// ([`Recording::is_ahead_of_its_checkpoint`](crate::Recording::is_ahead_of_its_checkpoint)); they are taken back
    /// with the rows, so that it does not look complete meanwhile.
    ///
    /// # Errors
    /// As [`Writer::resume`].
    pub fn resume_finished(path: &Path, last_attributes: &[&str]) -> Result<Resumed, RecordError> {
        Self::resume_on(Disk::default(), path, last_attributes)
    }

    pub(crate) fn resume_on(disk: Disk, path: &Path, without: &[&str]) -> Result<Resumed, RecordError> {
        disk::read_group(path)?;
        disk::refuse_foreign_entries(path)?;
        let lock = disk::lock(path, path)?;
        // Again, now that nobody else writes.
        let mut group = disk::read_group(path)?;
        group.attributes.retain(|name, _| !without.contains(&name.as_str()));
        let file = path.join(CHECKPOINT);
        let checkpoint = Checkpoint::decode(&disk::read(&file)?, &file)?;
        let counted = (group.rows("time").unwrap_or(0), group.rows("event").unwrap_or(0));
        if checkpoint.rows > counted.0 || checkpoint.events > counted.1 {
            return Err(RecordError::corrupt(&file, "the checkpoint belongs to more rows than there are"));
        }
        // What is gone on with ends up in a recording that looks whole: nothing damaged may be in it.
        let entries = entries_of(&group, path, checkpoint.rows)?;
        let counts = [("time", checkpoint.rows), ("event", checkpoint.events)];
        let ragged = [(BOUNDARY, checkpoint.rows + 1), (ENTRY, entries)];
        chunks::verify(&group.arrays, path, &[counts, ragged].concat())?;
        let mut writer = Self::over(disk, path, path.to_path_buf(), group, lock)?;
        writer.cut(&checkpoint, entries)?;
        Ok(Resumed { writer, checkpoint: checkpoint.state, rows: checkpoint.rows })
    }

    fn over(disk: Disk, path: &Path, directory: PathBuf, group: Group, lock: File) -> Result<Self, RecordError> {
        let group = group.into_texts()?;
        let samples = Stream::new("time", &group.arrays)
            .ok_or_else(|| RecordError::corrupt(&path.join(METADATA), "nothing grows with time"))?;
        let growing = group.arrays.iter().filter(|array| array.grows_with("time"));
        Ok(Self {
            path: path.to_path_buf(),
            directory,
            disk,
            samples,
            events: Stream::new("event", &group.arrays),
            ragged: Stream::new(BOUNDARY, &group.arrays)
                .zip(Stream::new(ENTRY, &group.arrays))
                .map(<[Stream; 2]>::from),
            row_len: growing.map(ArrayInfo::row_len).sum::<usize>() - 1,
            row: Vec::new(),
            group,
            stale: true,
            failed: false,
            _lock: lock,
        })
    }

    /// Cuts back to the checkpoint; the metadata first, so that they never count what is gone.
    fn cut(&mut self, to: &Checkpoint, entries: usize) -> Result<(), RecordError> {
        let counts = [("time", to.rows), ("event", to.events), (BOUNDARY, to.rows + 1), (ENTRY, entries)];
        counts.into_iter().for_each(|(dim, rows)| self.group.set_rows(dim, rows));
        self.store_metadata()?;
        let Self { samples, events, ragged, disk, directory, .. } = self;
        for stream in std::iter::once(samples).chain(events).chain(ragged.iter_mut().flatten()) {
            let rows = counts.iter().find(|(dim, _)| *dim == stream.dim).map_or(0, |(_, rows)| *rows);
            stream.cut(rows, disk, directory)?;
        }
        let subgroup = self.group.ragged().map(|name| self.directory.join(name));
        for place in [self.directory.clone(), self.directory.join(STATE)].into_iter().chain(subgroup) {
            for name in disk::list(&place)?.iter().filter(|name| disk::is_part(name)) {
                self.disk.remove_file(&place.join(name))?;
            }
        }
        Ok(())
    }

    /// The recording's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Rows appended so far.
    pub fn rows(&self) -> usize {
        self.samples.rows
    }

    /// Appends entries of the sample that is appended next: the numbers of each in the order of the layout, one behind
    /// the other, whole numbers where the array has such.
    ///
    /// # Errors
    /// `RowLength`; `Layout` beyond 2³¹ − 1 entries; `Io` and then `Stopped`.
    pub fn append_entries(&mut self, numbers: &[f64]) -> Result<(), RecordError> {
        let types: Vec<DataType> = self.entry_types().collect();
        if types.is_empty() || !numbers.len().is_multiple_of(types.len()) {
            return Err(RecordError::RowLength { expected: types.len(), found: numbers.len() });
        }
        let count = numbers.len() / types.len();
        let known = self.ragged.as_ref().map_or(0, |[_, entries]| entries.rows);
        if known + count > i32::MAX as usize {
            return Err(RecordError::layout(format!("a recording holds {} entries at most", i32::MAX)));
        }
        for entry in numbers.chunks_exact(types.len()) {
            self.row.clear();
            for (number, data_type) in entry.iter().zip(&types) {
                match data_type {
                    // A whole number, by contract.
                    DataType::Int32 => self.row.extend((*number as i32).to_le_bytes()),
                    DataType::Float64 | DataType::String => self.row.extend(number.to_le_bytes()),
                }
            }
            self.guard(|writer| match &mut writer.ragged {
                Some([_, entries]) => entries.push(&writer.row, &writer.disk, &writer.directory),
                None => Ok(()),
            })?;
        }
        Ok(())
    }

    /// The type of each number of an entry.
    fn entry_types(&self) -> impl Iterator<Item = DataType> {
        let entries = self.group.arrays.iter().filter(|array| array.grows_with(ENTRY));
        entries.flat_map(|array| std::iter::repeat_n(array.data_type, array.row_len()))
    }

    /// Tells where the entries of the next sample begin.
    fn end_sample(&mut self) -> Result<(), RecordError> {
        let Self { ragged: Some([start, entries]), disk, directory, .. } = self else { return Ok(()) };
        let count = i32::try_from(entries.rows).unwrap_or(i32::MAX);
        start.push(&count.to_le_bytes(), disk, directory)
    }

    /// Appends the sample of a time (in s): the numbers of all arrays in the order of the layout.
    ///
    /// # Errors
    /// `RowLength`; `Io` and then `Stopped`.
    pub fn append(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        if row.len() != self.row_len {
            return Err(RecordError::RowLength { expected: self.row_len, found: row.len() });
        }
        self.row.clear();
        self.row.extend(time.to_le_bytes());
        self.row.extend(row.iter().flat_map(|number| number.to_le_bytes()));
        self.guard(|writer| {
            writer.samples.push(&writer.row, &writer.disk, &writer.directory)?;
            writer.end_sample()
        })
    }

    /// Appends an event.
    ///
    /// # Errors
    /// `Layout` if the layout does not know this kind; `Io` and then `Stopped`.
    pub fn append_event(&mut self, event: Event) -> Result<(), RecordError> {
        let kinds = self.group.arrays.iter().find(|array| array.name == "event_kind");
        let count = kinds.map_or(0, |array| array.meanings.len());
        if event.kind >= count {
            let kind = event.kind;
            return Err(RecordError::layout(format!("event of kind {kind}, the layout names {count} kinds")));
        }
        let code = |index: usize| i32::try_from(index).unwrap_or(i32::MAX).to_le_bytes();
        self.row.clear();
        self.row.extend(event.time.to_le_bytes());
        self.row.extend(code(event.kind));
        self.row.extend(event.body.map_or((-1_i32).to_le_bytes(), code));
        self.guard(|writer| match &mut writer.events {
            Some(events) => events.push(&writer.row, &writer.disk, &writer.directory),
            None => Ok(()),
        })
    }

    /// Sets attributes, from the next flush on; a null removes one.
    ///
    /// # Errors
    /// `Layout` if a name is reserved.
    pub fn patch_attributes(&mut self, patch: Attributes) -> Result<(), RecordError> {
        self.stale = true;
        self.group.patch(patch)
    }

    /// Brings all rows, and the state that a resumed run would start from, to the disk.
    ///
    /// # Errors
    /// `Io` and then `Stopped`.
    pub fn flush(&mut self, checkpoint: &[u8]) -> Result<(), RecordError> {
        self.guard(|writer| {
            writer.store_rows()?;
            writer.store_checkpoint(checkpoint)?;
            writer.publish()
        })
    }

    /// Sets the last attributes (outcome, statistics) with the last flush: one that has them is complete.
    ///
    /// They come to the disk with the metadata, after the last rows and before the checkpoint: no crash leaves a
    /// checkpoint of the end without the outcome.
    ///
    /// # Errors
    /// `Layout` if a name is reserved; `Io`.
    pub fn finish(mut self, patch: Attributes, checkpoint: &[u8]) -> Result<(), RecordError> {
        self.patch_attributes(patch)?;
        self.disk.waits_once = true;
        self.flush(checkpoint)
    }

    fn store_rows(&mut self) -> Result<(), RecordError> {
        let ragged = self.ragged.iter_mut().flatten();
        for stream in std::iter::once(&mut self.samples).chain(self.events.as_mut()).chain(ragged) {
            stream.store(&self.disk, &self.directory)?;
            if self.group.rows(stream.dim) != Some(stream.rows) {
                self.group.set_rows(stream.dim, stream.rows);
                self.stale = true;
            }
        }
        if self.stale { self.store_metadata() } else { Ok(()) }
    }

    /// The group's metadata are what counts; those of the arrays, derived from it, need not wait for the disk.
    fn store_metadata(&mut self) -> Result<(), RecordError> {
        let arrays = &self.group.arrays;
        let texts =
            arrays.iter().map(|array| (self.directory.join(&array.name).join(METADATA), zarr::array_json(array)));
        let subgroup = self.group.ragged();
        let subgroup =
            subgroup.map(|name| (self.directory.join(name).join(METADATA), zarr::subgroup_json(name, arrays)));
        let texts = texts.chain(subgroup).collect::<Vec<_>>();
        let files = texts.iter().map(|(path, text)| (path.clone(), text.as_slice())).collect::<Vec<_>>();
        self.disk.replace_lazily(&files)?;
        self.disk.replace(&[(self.directory.join(METADATA), &self.group.to_json()?)])?;
        self.stale = false;
        Ok(())
    }

    fn store_checkpoint(&self, state: &[u8]) -> Result<(), RecordError> {
        let events = self.events.as_ref().map_or(0, |events| events.rows);
        let bytes = Checkpoint::encode(self.samples.rows, events, state);
        self.disk.replace(&[(self.directory.join(CHECKPOINT), &bytes)])
    }

    /// Gives a new recording its name.
    fn publish(&mut self) -> Result<(), RecordError> {
        if self.directory == self.path {
            return Ok(());
        }
        if self.path.symlink_metadata().is_ok() {
            return Err(RecordError::AlreadyExists { path: self.path.clone() });
        }
        self.disk.name(&self.directory, &self.path)?;
        self.directory.clone_from(&self.path);
        Ok(())
    }

    /// Runs an operation unless an earlier one failed.
    fn guard(&mut self, operation: impl FnOnce(&mut Self) -> Result<(), RecordError>) -> Result<(), RecordError> {
        if self.failed {
            return Err(RecordError::Stopped { path: self.path.clone() });
        }
        operation(self).inspect_err(|_| self.failed = true)
    }
}

/// How many entries so many samples have.
fn entries_of(group: &Group, path: &Path, samples: usize) -> Result<usize, RecordError> {
    let Some(name) = group.ragged() else { return Ok(0) };
    let start = Recording::of_group(path, group.clone()).read_rows(&format!("{name}/{START}"), samples..samples + 1)?;
    let count = start.data.first().map_or(0, |count| *count as usize);
    match group.rows(ENTRY) {
        Some(known) if count <= known => Ok(count),
        _ => Err(RecordError::corrupt(&path.join(METADATA), "samples have more entries than there are")),
    }
}

/// The files that never change: fixed arrays, labels, the metadata of the state.
fn fixed_chunks(layout: &Layout, group: &Group) -> Vec<(PathBuf, Vec<u8>)> {
    let numbers = layout.fixed.iter().map(|fixed| (&fixed.spec.name, zarr::encode_numbers(&fixed.values)));
    let labels = layout.labels.iter().map(|(dim, labels)| (dim, zarr::encode_labels(labels)));
    let chunks = numbers.chain(labels).filter_map(|(name, elements)| {
        let array = group.arrays.iter().find(|array| array.name == *name)?;
        Some((Path::new(name).join(array.chunk_key(0)), array.encode(&elements)))
    });
    let state = [(Path::new(STATE).join(METADATA), zarr::state_json())];
    chunks.chain(state).collect()
}
