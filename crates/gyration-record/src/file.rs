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
/// the same file. What a recording is made of is left alone.
///
/// # Errors
/// Those of `write`; `Io` if the file cannot be put in its place, or is a part of a recording.
pub fn replace_file(path: &Path, write: impl FnOnce(&Path) -> Result<(), RecordError>) -> Result<(), RecordError> {
    if path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return write(path);
    }
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    if is_part_of_recording(&target) {
        let reason = "it is a part of a recording, which would be lost: give another name";
        return Err(cannot_write(path)(io::Error::new(io::ErrorKind::InvalidInput, reason)));
    }
    let mut partial = target.clone().into_os_string();
    partial.push(".part");
    let partial = Path::new(&partial);
    let written = write(partial).and_then(|()| fs::rename(partial, &target).map_err(cannot_write(path)));
    if written.is_err() {
        let _ = fs::remove_file(partial);
    }
    written
}

/// Whether a file that is there holds the metadata or the numbers of a recording.
fn is_part_of_recording(file: &Path) -> bool {
    let Some(folder) = file.parent().filter(|folder| folder.join("zarr.json").is_file()) else { return false };
    let is_of_array = folder.parent().is_some_and(|folder| folder.join("zarr.json").is_file());
    file.is_file() && (is_of_array || file.ends_with("zarr.json"))
}

/// The failure to write a file, with its name.
pub fn cannot_write(path: &Path) -> impl Fn(io::Error) -> RecordError + use<> {
    let path = path.to_path_buf();
    move |source| RecordError::Io { action: "write", path: path.clone(), source }
}
