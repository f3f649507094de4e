//! Which folder stands at a path: another recording may take the place of one that is open.

use std::path::Path;
use std::time::SystemTime;

/// What tells a folder from all others that may stand at its path: when it was made, and its number on the disk where
/// there are such. Numbers are given again to what comes later; disks that are far away may have others after a while.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Identity {
    created: Option<SystemTime>,
    number: Option<u64>,
}

impl Identity {
    /// Of the folder at a path; none where there is none, or no disk.
    pub fn of(path: &Path) -> Option<Self> {
        let metadata = path.metadata().ok()?;
        Some(Self { created: metadata.created().ok(), number: number(&metadata) })
    }
}

#[cfg(unix)]
fn number(metadata: &std::fs::Metadata) -> Option<u64> {
    use std::os::unix::fs::MetadataExt;
    Some(metadata.ino())
}

#[cfg(not(unix))]
fn number(_: &std::fs::Metadata) -> Option<u64> {
    None
}
