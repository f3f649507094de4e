//! Joins the shards of a study into one table, by streaming.

use super::TABLE;
use super::describe::{describe, manifest};
use super::disk::{is_of, lock, replace_file, write_manifest};
use super::parquet::{Input, Output};
use super::shard::Shard;
use crate::error::{MANIFEST, StudyError};
use crate::study::Study;
use crate::value::Row;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::vec::IntoIter;

/// EMFILE, of Linux and of the BSDs.
const TOO_MANY_FILES: i32 = 24;
/// Shards that a message names at most.
const MOST_NAMED: usize = 20;
/// Rows of all shards together that are in memory at a time.
const HELD: usize = 1 << 14;

/// Joins the shards in a folder into its `table.parquet`, and returns its path; the shards stay.
///
/// # Errors
/// [`StudyError::Shards`] if some are missing or unfinished, or the table is there and not to be replaced;
/// [`StudyError::OtherStudy`] if one is foreign.
pub fn merge(path: &Path, study: &Study, replace: bool) -> Result<PathBuf, StudyError> {
    let count = count(path)?;
    let target = path.join(TABLE);
    if target.exists() && !replace {
        let fix = "it is as the shards were then; join them again by merge --force".to_owned();
        return Err(StudyError::Shards { path: path.to_owned(), what: "they are joined already".into(), fix });
    }
    let _lock = lock(path)?;
    let mut shards = inputs(path, study, count)?;
    replace_file(&target, |aside| {
        let mut output = Output::create(aside, study.columns(), &describe(study))?;
        for run in 0..study.runs() {
            let shard = &mut shards[(run % count) as usize];
            let row = shard.next()?.filter(|row| row.run() == Some(run));
            let missing =
                || StudyError::damaged(&shard.path, format!("the row of run {run} is not where it should be"));
            output.push(row.ok_or_else(missing)?)?;
        }
        output.close()
    })?;
    write_manifest(path, manifest(study, Shard::WHOLE))?;
    Ok(target)
}

/// Into how many shards the study in a folder was divided.
fn count(path: &Path) -> Result<u64, StudyError> {
    let mut counts: BTreeMap<u64, String> = BTreeMap::new();
    for entry in fs::read_dir(path).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if let Some(shard) = Shard::of_folder(&name) {
            counts.insert(shard.count(), name);
        }
    }
    let refused = |what: String, fix: &str| Err(StudyError::Shards { path: path.to_owned(), what, fix: fix.into() });
    match counts.len() {
        0 => refused("it holds no shards".into(), "make them by --shard 1/n to n/n, or name their folder with -o"),
        1 => Ok(counts.into_keys().next().unwrap_or(1)),
        _ => {
            let names: Vec<String> = counts.into_values().collect();
            refused(
                format!("it is divided in more ways than one: {}", names.join(", ")),
                "remove the shards of the others",
            )
        }
    }
}

/// The shards, each from its first row on.
fn inputs(path: &Path, study: &Study, count: u64) -> Result<Vec<ShardRows>, StudyError> {
    let (mut shards, mut missing, mut unfinished) = (Vec::new(), Vec::new(), Vec::new());
    for number in 1..=count {
        let shard = Shard::new(number, count)?;
        let folder = path.join(shard.folder().unwrap_or_default());
        if !folder.join(MANIFEST).is_file() {
            missing.push(number);
            if missing.len() > MOST_NAMED {
                break;
            }
            continue;
        }
        is_of(&folder, study, shard)?;
        let table = folder.join(TABLE);
        if !table.is_file() {
            unfinished.push(number);
            continue;
        }
        shards.push(
            ShardRows::open(table, (HELD / count as usize).max(1)).map_err(|error| too_many(error, path, count))?,
        );
    }
    if missing.is_empty() && unfinished.is_empty() {
        return Ok(shards);
    }
    let (what, first) = match (missing.first(), unfinished.first()) {
        (Some(first), _) => (format!("of {count} shards, there is no {}", listed(&missing)), *first),
        (_, first) => {
            (format!("of {count} shards, not finished: {}", listed(&unfinished)), first.copied().unwrap_or(1))
        }
    };
    let how = if missing.is_empty() { " --resume" } else { "" };
    let fix =
        format!("run each of them with the words that the others were run with, but --shard {first}/{count}{how}");
    Err(StudyError::Shards { path: path.to_owned(), what, fix })
}

/// All shards are read side by side: of very many, a process may not have all files open.
fn too_many(error: StudyError, path: &Path, count: u64) -> StudyError {
    match error {
        StudyError::Io { source, .. } if source.raw_os_error() == Some(TOO_MANY_FILES) => StudyError::Shards {
            path: path.to_owned(),
            what: format!("{count} shards are more files than this process may have open"),
            fix: format!("allow it more, `ulimit -n {}`", count + 100),
        },
        error => error,
    }
}

fn listed(numbers: &[u64]) -> String {
    let words: Vec<String> = numbers.iter().take(MOST_NAMED).map(u64::to_string).collect();
    format!("{}{}", words.join(", "), if numbers.len() > MOST_NAMED { ", …" } else { "" })
}

/// A shard that is being read.
struct ShardRows {
    path: PathBuf,
    input: Input,
    rows: IntoIter<Row>,
    portion: usize,
}

impl ShardRows {
    fn open(path: PathBuf, portion: usize) -> Result<Self, StudyError> {
        Ok(Self { input: Input::open(&path)?, path, rows: Vec::new().into_iter(), portion })
    }

    fn next(&mut self) -> Result<Option<Row>, StudyError> {
        if self.rows.len() == 0 {
            self.rows = self.input.next(self.portion)?.into_iter();
        }
        Ok(self.rows.next())
    }
}
