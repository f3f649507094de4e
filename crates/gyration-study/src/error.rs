//! What can go wrong with the table of a study, and what to do about it.
//!
//! What is wrong with the study itself is a `LoadError` of `gyration-scene`.

use gyration_files::in_words;
use gyration_record::RecordError;
use std::io;
use std::path::{Path, PathBuf};

/// The file of a table that tells which study it is of: the one file that nothing else can give back.
pub(crate) const MANIFEST: &str = "study.json";

/// Failure to write, read or join the tables of a study.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The system refused: disk full, no permission, device gone.
    #[error("cannot {action} {path}: {}", in_words(source), path = path.display())]
    Io {
        /// What was attempted, an infinitive.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A recording of a run cannot be written.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A run could not be made, for a reason outside the physics.
    #[error("{0}")]
    Run(String),
    /// A new table would overwrite something.
    #[error("{path} exists already\n  fix: go on with it by --resume, replace it by --force, or choose another name", path = path.display())]
    Exists {
        /// The folder.
        path: PathBuf,
    },
    /// There is nothing to go on with or to read.
    #[error("there is no table at {path}{help}", path = path.display())]
    NoTable {
        /// The folder or file.
        path: PathBuf,
        /// What to do, behind a line break; may be empty.
        help: &'static str,
    },
    /// The table is of another study, or of another shard.
    #[error("{path} is a table of {what}\n  fix: {fix}; else give another folder by -o, or replace this one by --force", path = path.display())]
    OtherStudy {
        /// The folder.
        path: PathBuf,
        /// Of what.
        what: String,
        /// How to go on with it.
        fix: String,
    },
    /// Another process is at it.
    #[error("{path} is being written by another process\n  fix: wait for it or stop it", path = path.display())]
    Locked {
        /// The folder.
        path: PathBuf,
    },
    /// A file is not what it should be.
    #[error("{path} is damaged: {reason}\n  fix: {}", mending(path), path = path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// In what way.
        reason: String,
    },
    /// A shard that there is not.
    #[error("there is no shard {number} of {count}\n  fix: write --shard k/n with k from 1 to n, 3/8")]
    NoShard {
        /// k.
        number: u64,
        /// n.
        count: u64,
    },
    /// Shards that cannot be joined, or are in the way.
    #[error("{path} cannot be used as it is: {what}\n  fix: {fix}", path = path.display())]
    Shards {
        /// The folder.
        path: PathBuf,
        /// Which are missing, unfinished or foreign.
        what: String,
        /// What to do.
        fix: String,
    },
}

/// What to do about a damaged file of a table.
fn mending(path: &Path) -> &'static str {
    match path.file_name().is_some_and(|name| name == MANIFEST) {
        true => {
            "make the study anew, in another folder by -o or in this one by --force: without that file it cannot go on"
        }
        false => "move that file away, if it is of a study; --resume then makes its runs again",
    }
}

impl StudyError {
    /// An error of the system, at a file, for a map of errors.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { action, path, source }
    }

    /// A folder that is divided into shards, where one table was meant.
    pub(crate) fn shards_there(path: &Path) -> Self {
        let fix = "join them by `gyration study STUDY merge`, go on with one by --shard k/n --resume, or choose \
            another folder by -o";
        Self::Shards { path: path.to_owned(), what: "it holds shards of a study".into(), fix: fix.into() }
    }

    /// A file that is not what it should be.
    pub(crate) fn damaged(path: &Path, reason: impl ToString) -> Self {
        Self::Damaged { path: path.to_owned(), reason: reason.to_string() }
    }

    /// Whether other arguments would mend it.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Exists { .. } | Self::OtherStudy { .. } | Self::NoShard { .. } | Self::Shards { .. })
    }
}
