//! Files beside recordings, pictures and tables: whole or not there.

use crate::error::RecordError;
use std::fs;
use std::io;
use std::path::Path;

/// Writes a whole file; no half of one is left behind.
///
/// # Errors
/// `Io` if it cannot be written.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), RecordError> {
    replace_file(path, |partial| fs::write(partial, bytes).map_err(cannot_write(path)))
}

/// Lets a file be written under another name first, `PATH.part`, so that no half of it is left behind.
///
/// A device or a pipe, `/dev/null`, is written to as it stands: there is nothing to replace. A link goes on to lead to
/// the same file.
///
/// # Errors
/// Those of `write`; `Io` if the file cannot be put in its place.
pub fn replace_file(path: &Path, write: impl FnOnce(&Path) -> Result<(), RecordError>) -> Result<(), RecordError> {
    if path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return write(path);
    }
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let mut partial = target.clone().into_os_string();
    partial.push(".part");
    let partial = Path::new(&partial);
    let written = write(partial).and_then(|()| fs::rename(partial, &target).map_err(cannot_write(path)));
    if written.is_err() {
        let _ = fs::remove_file(partial);
    }
    written
}

/// The failure to write a file, with its name.
pub fn cannot_write(path: &Path) -> impl Fn(io::Error) -> RecordError + use<> {
    let path = path.to_path_buf();
    move |source| RecordError::Io { action: "write", path: path.clone(), source }
}
