//! The table of a study while it grows: which runs are there, journals, chunks, and their joining at the end.

mod find;

use super::describe::{describe, manifest};
use super::disk::{
    chunk_of, folder, holds_shards, is_begun_only, is_of, lock, remove_table, replace_file, sync_names, write_manifest,
};
use super::journal::{self, Journal};
use super::lock::TableLock;
use super::parquet::{Input, Output};
use super::shard::Shard;
use super::{PORTION, RECORDINGS, ROWS, TABLE};
use crate::column::Column;
use crate::error::{MANIFEST, StudyError};
use crate::study::Study;
use crate::value::Row;
use serde_json::Value as Json;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Wall time between waits for the disk: a wait costs as much as some short runs.
const SYNC_EVERY: Duration = Duration::from_millis(500);

/// The table of a study, or of a shard of it, that is being written.
#[derive(Debug)]
pub struct Table {
    folder: PathBuf,
    shard: Shard,
    columns: Vec<Column>,
    description: Json,
    /// How many runs it will have.
    runs: u64,
    /// Runs of a chunk.
    chunk: u64,
    /// Chunks that are finished.
    finished: BTreeSet<u64>,
    /// Chunks with some rows.
    open: BTreeMap<u64, Open>,
    /// Rows that it has.
    rows: u64,
    is_complete: bool,
    /// When the disk had all rows.
    synced: Instant,
    /// How often a journal was waited for.
    syncs: u64,
    /// Held as long as this process writes.
    lock: TableLock,
}

impl Drop for Table {
    fn drop(&mut self) {
        // Whoever wants to know whether it went well asks before.
        let _ = self.sync();
        self.lock.release();
    }
}

/// A chunk with some of its rows.
#[derive(Debug)]
struct Open {
    journal: Journal,
    /// Which of its places are there.
    there: Vec<bool>,
    count: u64,
}

impl Table {
    /// A new table in the folder `path`, or of a shard in a folder in it; with `replace`, one that is there is removed,
    /// but nothing beside it.
    ///
    /// # Errors
    /// [`StudyError::Exists`] if something is there that is not to be replaced, or that is no table,
    /// [`StudyError::Shards`] if shards are: others may be at work on them.
    pub fn create(path: &Path, study: &Study, shard: Shard, replace: bool) -> Result<Self, StudyError> {
        let folder = folder(path, shard);
        let mut locked = None;
        if folder.symlink_metadata().is_ok() {
            if holds_shards(&folder) {
                return Err(StudyError::shards_there(&folder));
            }
            if !(is_begun_only(&folder) || replace && folder.join(MANIFEST).is_file()) {
                return Err(StudyError::Exists { path: folder });
            }
            // It stays with us while the old table goes and the new one comes.
            locked = Some(lock(&folder)?);
            remove_table(&folder)?;
        }
        fs::create_dir_all(&folder).map_err(StudyError::io("make", &folder))?;
        let locked = locked.map_or_else(|| lock(&folder), Ok)?;
        let table = Self::new(locked, folder, study, shard);
        write_manifest(&table.folder, manifest(study, shard))?;
        let rows = table.folder.join(ROWS);
        fs::create_dir_all(&rows).map_err(StudyError::io("make", &rows))?;
        Ok(table)
    }

    /// Whether something is at `path` to go on with.
    pub fn is_begun(path: &Path) -> bool {
        [MANIFEST, TABLE].iter().any(|name| path.join(name).is_file())
    }

    /// Goes on with a table of the same study and shard.
    ///
    /// # Errors
    /// [`StudyError::NoTable`], [`StudyError::OtherStudy`], [`StudyError::Locked`], or a file that is damaged.
    pub fn resume(path: &Path, study: &Study, shard: Shard) -> Result<Self, StudyError> {
        let folder = folder(path, shard);
        is_of(&folder, study, shard)?;
        let mut table = Self::new(lock(&folder)?, folder, study, shard);
        if table.folder.join(TABLE).is_file() {
            let rows = Input::open(&table.file())?.rows();
            if rows != table.runs {
                return Err(StudyError::damaged(&table.file(), format!("it has {rows} rows of {}", table.runs)));
            }
            table.is_complete = true;
            table.rows = table.runs;
            table.remove_rows()?;
            return Ok(table);
        }
        table.find_rows()?;
        Ok(table)
    }

    fn new(lock: File, folder: PathBuf, study: &Study, shard: Shard) -> Self {
        let runs = shard.runs(study.runs());
        Self {
            shard,
            columns: study.columns().to_vec(),
            description: describe(study),
            runs,
            chunk: chunk_of(runs),
            finished: BTreeSet::new(),
            open: BTreeMap::new(),
            rows: 0,
            is_complete: false,
            synced: Instant::now(),
            syncs: 0,
            lock: TableLock::new(lock),
            folder,
        }
    }

    /// Its lock, for whoever is forked while the table is at work.
    pub fn lock(&self) -> TableLock {
        self.lock.clone()
    }

    /// The folder of this table or shard.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The folder of its recordings.
    pub fn recordings(&self) -> PathBuf {
        self.folder.join(RECORDINGS)
    }

    /// The file of the finished table.
    pub fn file(&self) -> PathBuf {
        self.folder.join(TABLE)
    }

    /// How many runs it will have.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// How many runs it has.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Where the outcome stands in a row.
    pub(crate) fn outcome(&self) -> Option<usize> {
        self.columns.iter().position(|column| column.name == "outcome")
    }

    /// Whether all rows stand in the one file.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// The runs that are missing, in order, as of now.
    pub fn missing(&self) -> impl Iterator<Item = u64> + Send + 'static {
        let (shard, runs, chunk) = (self.shard, if self.is_complete { 0 } else { self.runs }, self.chunk);
        let finished = self.finished.clone();
        let there: BTreeMap<u64, Vec<bool>> =
            self.open.iter().map(|(number, open)| (*number, open.there.clone())).collect();
        let chunks = (0..runs.div_ceil(chunk)).filter(move |number| !finished.contains(number));
        chunks.flat_map(move |number| {
            let there = there.get(&number).cloned();
            let places = number * chunk..((number + 1) * chunk).min(runs);
            let is_there = move |place: &u64| there.as_ref().is_some_and(|there| there[(place % chunk) as usize]);
            places.filter(move |place| !is_there(place)).map(move |place| shard.run(place))
        })
    }

    /// Adds rows, in any order; a row that is there already is passed over.
    ///
    /// # Errors
    /// Whatever keeps them from being written; a row that is not of this table.
    pub fn append(&mut self, rows: &[Row]) -> Result<(), StudyError> {
        let mut lines: BTreeMap<u64, String> = BTreeMap::new();
        for row in rows {
            let place = row.run().and_then(|run| self.shard.place(run)).filter(|place| *place < self.runs);
            let fits = row.values.len() == self.columns.len();
            let Some(place) = place.filter(|_| fits) else {
                return Err(StudyError::damaged(&self.folder, "a row is not of this study"));
            };
            let number = place / self.chunk;
            if self.is_complete || self.finished.contains(&number) {
                continue;
            }
            let within = (place % self.chunk) as usize;
            let open = self.open(number)?;
            if !std::mem::replace(&mut open.there[within], true) {
                open.count += 1;
                self.rows += 1;
                let lines = lines.entry(number).or_default();
                lines.push_str(&journal::line(row));
            }
        }
        for (number, lines) in lines {
            self.open(number)?.journal.write(&lines)?;
            self.seal_if_full(number)?;
        }
        if self.synced.elapsed() >= SYNC_EVERY { self.sync() } else { Ok(()) }
    }

    /// Waits until the disk has all rows; `append` does so now and then.
    ///
    /// # Errors
    /// As the system says: the disk is full or gone.
    pub fn sync(&mut self) -> Result<(), StudyError> {
        let before = self.syncs;
        for open in self.open.values_mut() {
            self.syncs += u64::from(open.journal.sync()?);
        }
        if self.syncs > before {
            sync_names(&self.folder.join(ROWS))?;
        }
        self.synced = Instant::now();
        Ok(())
    }

    /// How often a journal was waited for.
    pub fn syncs(&self) -> u64 {
        self.syncs
    }

    /// Joins all chunks into one file, in order; false if runs are missing.
    ///
    /// # Errors
    /// Whatever keeps it from being written, or a chunk from being read.
    pub fn finish(&mut self) -> Result<bool, StudyError> {
        if self.is_complete {
            return Ok(true);
        }
        let chunks = self.runs.div_ceil(self.chunk);
        if (self.finished.len() as u64) < chunks {
            return Ok(false);
        }
        replace_file(&self.file(), |path| {
            let mut output = Output::create(path, &self.columns, &self.description)?;
            for number in 0..chunks {
                let mut input = Input::open(&self.chunk_file(number))?;
                loop {
                    let rows = input.next(PORTION)?;
                    if rows.is_empty() {
                        break;
                    }
                    rows.into_iter().try_for_each(|row| output.push(row))?;
                }
            }
            output.close()
        })?;
        self.is_complete = true;
        self.remove_rows()?;
        Ok(true)
    }

    fn remove_rows(&self) -> Result<(), StudyError> {
        let rows = self.folder.join(ROWS);
        match fs::remove_dir_all(&rows) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(StudyError::io("remove", &rows)(error)),
            _ => Ok(()),
        }
    }

    fn chunk_file(&self, number: u64) -> PathBuf {
        self.folder.join(ROWS).join(format!("{number:06}.parquet"))
    }

    /// Readers of folders of Parquet files pass over names that begin with an underscore.
    fn journal_file(&self, number: u64) -> PathBuf {
        self.folder.join(ROWS).join(format!("_{number:06}.jsonl"))
    }

    fn open(&mut self, number: u64) -> Result<&mut Open, StudyError> {
        if !self.open.contains_key(&number) {
            let length = self.chunk.min(self.runs - number * self.chunk);
            let journal = Journal::open(self.journal_file(number))?;
            // The length is that of a whole chunk, so that places are counted alike in the last one.
            let there = vec![false; self.chunk as usize];
            self.open.insert(number, Open { journal, there, count: self.chunk - length });
        }
        match self.open.get_mut(&number) {
            Some(open) => Ok(open),
            None => Err(StudyError::damaged(&self.folder, "a chunk is lost")),
        }
    }

    /// Turns the journal of a chunk whose rows are all there into a Parquet file.
    fn seal_if_full(&mut self, number: u64) -> Result<(), StudyError> {
        if self.open.get(&number).is_none_or(|open| open.count < self.chunk) {
            return Ok(());
        }
        let journal = self.journal_file(number);
        let (mut rows, _) = journal::read(&journal, &self.columns)?;
        rows.sort_by_key(Row::run);
        rows.dedup_by_key(|row| row.run());
        if rows.len() as u64 != self.chunk.min(self.runs - number * self.chunk) {
            return Err(StudyError::damaged(&journal, "it has not the rows of its chunk"));
        }
        replace_file(&self.chunk_file(number), |path| {
            let mut output = Output::create(path, &self.columns, &self.description)?;
            rows.into_iter().try_for_each(|row| output.push(row))?;
            output.close()
        })?;
        self.open.remove(&number);
        fs::remove_file(&journal).map_err(StudyError::io("remove", &journal))?;
        self.finished.insert(number);
        Ok(())
    }
}
