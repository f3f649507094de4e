//! The folder of a table: its lock, its manifest, and files that are put into their place whole.

use super::other::other_study;
use super::shard::Shard;
use super::{LOCK, RECORDINGS, ROWS, TABLE};
use crate::error::{MANIFEST, StudyError};
use crate::study::Study;
use gyration_files::check;
use serde_json::Value as Json;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// The key of the manifest's checksum: CRC-32C of the file with zeros in its place.
const CHECKSUM: &str = "checksum";
/// What stands before that checksum in the file, and nowhere else: keys further in stand further to the right.
const CHECKSUM_PLACE: &str = "\n  \"checksum\": \"";

/// The folder of a shard of the table at a path.
pub(super) fn folder(path: &Path, shard: Shard) -> PathBuf {
    shard.folder().map_or_else(|| path.to_owned(), |name| path.join(name))
}

pub(super) fn holds_shards(folder: &Path) -> bool {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.into_iter().any(|entry| Shard::of_folder(&entry.file_name().to_string_lossy()).is_some())
}

/// Whether a folder is empty, or all that is in it is what a writer leaves who stops before it has begun.
pub(super) fn is_begun_only(folder: &Path) -> bool {
    let is_trace = |entry: fs::DirEntry| {
        let name = entry.file_name();
        let is_aside = name.to_string_lossy().starts_with('_') && name.to_string_lossy().ends_with(".tmp");
        is_aside
            || name == LOCK
            || name == ROWS && fs::read_dir(entry.path()).is_ok_and(|mut rows| rows.next().is_none())
    };
    fs::read_dir(folder).is_ok_and(|entries| entries.flatten().all(is_trace))
}

/// Removes a table, and nothing that lies beside it.
pub(super) fn remove_table(folder: &Path) -> Result<(), StudyError> {
    // What says that this is a table goes last.
    for name in [ROWS, RECORDINGS, &format!("_{TABLE}.tmp"), &format!("_{MANIFEST}.tmp"), TABLE, MANIFEST] {
        let path = folder.join(name);
        let removed = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
        match removed {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(StudyError::io("remove", &path)(error));
            }
            _ => {}
        }
    }
    Ok(())
}

/// Runs of a chunk: few enough that a table can be looked at while it grows, and that a chunk fits the memory.
pub(super) fn chunk_of(runs: u64) -> u64 {
    const FEWEST: u64 = 64;
    const MOST: u64 = 1 << 14;
    (runs / 32).clamp(FEWEST, MOST).next_power_of_two()
}

/// Writes a file beside its place, waits until the disk has it, and then puts it there.
pub(super) fn replace_file(path: &Path, write: impl FnOnce(&Path) -> Result<(), StudyError>) -> Result<(), StudyError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    // Readers of folders of Parquet files pass over names that begin with an underscore.
    let aside = path.with_file_name(format!("_{name}.tmp"));
    write(&aside)?;
    File::options()
        .write(true)
        .open(&aside)
        .and_then(|file| file.sync_all())
        .map_err(StudyError::io("bring to the disk", path))?;
    fs::rename(&aside, path).map_err(StudyError::io("write", path))?;
    sync_names(path.parent().unwrap_or(Path::new("")))
}

/// Brings the names in a folder to the disk (where the system can: not on Windows).
pub(super) fn sync_names(folder: &Path) -> Result<(), StudyError> {
    if !cfg!(unix) {
        return Ok(());
    }
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    File::open(folder).and_then(|file| file.sync_all()).map_err(StudyError::io("bring to the disk", folder))
}

/// Writes the manifest of a table, with its checksum.
pub(super) fn write_manifest(folder: &Path, mut manifest: Json) -> Result<(), StudyError> {
    manifest[CHECKSUM] = check::UNKNOWN.into();
    let mut text = format!("{manifest:#}\n").into_bytes();
    check::seal(&mut text, CHECKSUM_PLACE);
    replace_file(&folder.join(MANIFEST), |path| fs::write(path, &text).map_err(StudyError::io("write", path)))
}

/// Keeps other processes from writing the same table.
pub(super) fn lock(folder: &Path) -> Result<File, StudyError> {
    let path = folder.join(LOCK);
    let file = gyration_files::open_to_append(&path).map_err(StudyError::io("write", &path))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StudyError::Locked { path: folder.to_owned() }),
        Err(TryLockError::Error(error)) => Err(StudyError::io("lock", &path)(error)),
    }
}

/// Refuses a folder that holds no table of this study and shard.
pub(super) fn is_of(folder: &Path, study: &Study, shard: Shard) -> Result<(), StudyError> {
    let manifest = read_manifest(folder)?;
    let other = |what: &str, fix: &str| {
        Err(StudyError::OtherStudy { path: folder.to_owned(), what: what.to_owned(), fix: fix.to_owned() })
    };
    if manifest.get("fingerprint").and_then(Json::as_str) != Some(study.fingerprint()) {
        return match manifest.get("version").and_then(Json::as_str) {
            Some(version) if version != env!("CARGO_PKG_VERSION") => {
                other(&format!("version {version} of the program"), "go on with it by that version")
            }
            _ => Err(other_study(folder, &manifest, study)),
        };
    }
    let found = ["number", "count"].map(|key| manifest.pointer(&format!("/shard/{key}")).and_then(Json::as_u64));
    if found != [Some(shard.number()), Some(shard.count())] {
        other("another shard", "name the shard by --shard k/n")
    } else {
        Ok(())
    }
}

pub(super) fn read_manifest(folder: &Path) -> Result<Json, StudyError> {
    let path = folder.join(MANIFEST);
    match gyration_files::read(&path) {
        Ok(bytes) => {
            let manifest: Json = serde_json::from_slice(&bytes)
                .map_err(|error| StudyError::damaged(&path, format!("line {} is not JSON", error.line())))?;
            // Manifests of earlier versions have no checksum.
            if manifest.get(CHECKSUM).is_some() && check::is_sealed(&bytes, CHECKSUM_PLACE) != Some(true) {
                return Err(StudyError::damaged(&path, "it does not match its checksum"));
            }
            Ok(manifest)
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound && holds_shards(folder) => {
            Err(StudyError::shards_there(folder))
        }
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            Err(StudyError::NoTable { path: folder.to_owned(), help: "\n  fix: leave --resume out" })
        }
        Err(error) => Err(StudyError::io("read", &path)(error)),
    }
}
