//! What can go wrong with a recording, and what to do about it.
//!
//! Every variant names the path or the name it is about. Problems of a layout are the caller's and are told apart from
//! those of the disk.

use gyration_files::in_words;
use std::io;
use std::path::{Path, PathBuf};

/// Failure to write, read or export a recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The operating system refused: disk full, no permission, device gone.
    #[error("cannot {action} {path}: {}", in_words(source))]
    Io {
        /// What was attempted, an infinitive.
        action: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// Nothing is at this path.
    #[error("there is no recording at {path}")]
    Missing {
        /// The path asked for.
        path: PathBuf,
    },
    /// Something is at this path, but no recording.
    #[error("{path} is not a recording: {reason}")]
    NotARecording {
        /// The path asked for.
        path: PathBuf,
        /// What is missing or strange.
        reason: String,
    },
    /// A new recording would overwrite something.
    #[error("{path} exists already: resume it, remove it or choose another name")]
    AlreadyExists {
        /// The path asked for.
        path: PathBuf,
    },
    /// The recording was written by another version of this format.
    #[error("{path} has format {found}, this program reads formats to {supported}")]
    Version {
        /// The recording.
        path: PathBuf,
        /// Its format.
        found: u64,
        /// The last format that this program reads.
        supported: u64,
    },
    /// Another process is writing this recording.
    #[error("{path} is being written by another process: wait for it or stop it")]
    Locked {
        /// The recording.
        path: PathBuf,
    },
    /// Another recording stands in the place of the one that was opened.
    #[error("another recording has taken the place of {path} since it was opened: open it again")]
    Replaced {
        /// The recording.
        path: PathBuf,
    },
    /// A file of the recording is shorter or longer than it must be.
    #[error("{path} is damaged: {found} bytes where {expected} belong")]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Length that the metadata ask for, in bytes.
        expected: u64,
        /// Length found, in bytes.
        found: u64,
    },
    /// A file of the recording contradicts itself or another one.
    #[error("{path} is damaged: {reason}")]
    Corrupt {
        /// The file.
        path: PathBuf,
        /// The contradiction.
        reason: String,
    },
    /// The recording is older than the surfaces that recordings hold.
    #[error("{path} has no surfaces of its bodies, which recordings of earlier versions lack: run its scene again")]
    NoSurfaces {
        /// The recording.
        path: PathBuf,
    },
    /// The description of the arrays cannot be recorded.
    #[error("the layout of the recording is not valid: {reason}")]
    Layout {
        /// What is wrong, with the name concerned.
        reason: String,
    },
    /// A row has not as many numbers as the layout.
    #[error("a row holds {found} numbers, the layout asks for {expected}")]
    RowLength {
        /// Numbers of a row by the layout.
        expected: usize,
        /// Numbers given.
        found: usize,
    },
    /// There is no such array.
    #[error("the recording has no array `{name}`")]
    NoSuchArray {
        /// The name asked for.
        name: String,
    },
    /// There is no such column.
    #[error("the recording has no column `{name}`")]
    NoSuchColumn {
        /// The name asked for.
        name: String,
    },
    /// The rows asked for are not there.
    #[error("rows {from} to {to} asked for, the array has {rows}")]
    NoSuchRows {
        /// First row asked for.
        from: usize,
        /// One past the last row asked for.
        to: usize,
        /// Rows there are.
        rows: usize,
    },
    /// An earlier operation of this writer failed; what is on disk is good up to the last flush.
    #[error("{path}: writing stopped at an earlier error; resume from the last checkpoint")]
    Stopped {
        /// The recording.
        path: PathBuf,
    },
}

impl RecordError {
    /// Attaches what was attempted, and where, to an error of the system.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> RecordError + use<> {
        let path = path.to_path_buf();
        move |source| RecordError::Io { action, path, source }
    }

    /// A layout that cannot be recorded.
    pub(crate) fn layout(reason: impl Into<String>) -> RecordError {
        RecordError::Layout { reason: reason.into() }
    }

    /// A file whose checksum is that of another content.
    pub(crate) fn mismatch(path: &Path) -> RecordError {
        RecordError::corrupt(path, "it does not match its checksum; run the scene again, or take the file from a copy")
    }

    /// A damaged file.
    pub(crate) fn corrupt(path: &Path, reason: impl Into<String>) -> RecordError {
        RecordError::Corrupt { path: path.to_path_buf(), reason: reason.into() }
    }
}
