//! The few file operations that writing a recording takes, each with the path in its error.
//!
//! A file is replaced as a whole: written beside itself as `NAME.part`, brought to the disk, renamed; so it is the old
//! or the new one at any moment. What has no name yet is brought to the disk once, before it gets one. Tests cut the
//! power before any of these operations.
//!
//! Where the system can bring a file system to the disk as a whole, that is one wait for all files of a recording; what
//! others have written there is waited for too, so that only the beginning and the end of a recording are so stored,
//! and what is between them file by file.

use crate::error::RecordError;
use crate::metadata::Group;
pub(crate) use crate::names::{METADATA, STATE};
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::thread::ScopedJoinHandle;

/// The file of the checkpoint.
pub(crate) const CHECKPOINT: &str = "state/checkpoint";
/// The file that the writing process locks.
const LOCK: &str = "state/lock";
/// Ending of a file that is not yet in its place.
const PART: &str = ".part";
/// How deep a recording is: groups, their arrays, the chunks of these.
const DEPTH: usize = 3;
/// Files on their way to the disk at once: waiting is all they do.
const SYNC_THREADS: usize = 8;

/// Access to the disk.
#[derive(Debug, Default)]
pub(crate) struct Disk {
    /// Whether what is written may still be lost: it is brought to the disk with all else before it gets its name.
    pub(crate) is_unnamed: bool,
    /// Whether files are waited for together with all of their file system, where that can be.
    pub(crate) waits_once: bool,
    #[cfg(test)]
    pub(crate) fuse: Option<crate::crash_tests::Fuse>,
}

impl Disk {
    /// Creates a directory; its parent exists.
    pub(crate) fn create_dir(&self, path: &Path) -> Result<(), RecordError> {
        self.step(path)?;
        fs::create_dir(path).map_err(RecordError::io("create the directory", path))
    }

    /// Renames a file or directory.
    pub(crate) fn rename(&self, from: &Path, to: &Path) -> Result<(), RecordError> {
        self.step(to)?;
        fs::rename(from, to).map_err(RecordError::io("put in place", to))
    }

    /// Removes a file.
    pub(crate) fn remove_file(&self, path: &Path) -> Result<(), RecordError> {
        self.step(path)?;
        fs::remove_file(path).map_err(RecordError::io("remove", path))
    }

    /// Brings the names in directories to the disk (where the system can: not on Windows).
    pub(crate) fn sync_dirs(&self, paths: &[&Path]) -> Result<(), RecordError> {
        if !cfg!(unix) {
            return Ok(());
        }
        if self.is_unnamed {
            return paths.iter().try_for_each(|path| self.step(path));
        }
        let open = |path: &&'_ Path| File::open(path).map_err(RecordError::io("open", path));
        let dirs = paths.iter().map(open).collect::<Result<Vec<_>, _>>()?;
        self.sync_files(&dirs.into_iter().zip(paths.iter().copied()).collect::<Vec<_>>())
    }

    /// Gives what has no name yet its own: all of it comes to the disk before, the name after.
    pub(crate) fn name(&mut self, from: &Path, to: &Path) -> Result<(), RecordError> {
        self.step(from)?;
        if !self.is_test() {
            sync_tree(from)?;
        }
        self.rename(from, to)?;
        self.is_unnamed = false;
        let parent = to.parent().filter(|parent| !parent.as_os_str().is_empty());
        self.sync_dirs(&[parent.unwrap_or(Path::new("."))])
    }

    /// Replaces files and brings them to the disk, with their names: all contents first, then all names.
    pub(crate) fn replace(&self, files: &[(PathBuf, &[u8])]) -> Result<(), RecordError> {
        self.put_in_place(files, !self.is_unnamed)?;
        let mut parents = files.iter().filter_map(|(path, _)| path.parent()).collect::<Vec<_>>();
        parents.sort_unstable();
        parents.dedup();
        self.sync_dirs(&parents)
    }

    /// Replaces files without waiting for the disk: safe when the process dies, not when the power fails.
    pub(crate) fn replace_lazily(&self, files: &[(PathBuf, &[u8])]) -> Result<(), RecordError> {
        self.put_in_place(files, false)
    }

    fn put_in_place(&self, files: &[(PathBuf, &[u8])], sync: bool) -> Result<(), RecordError> {
        let parts = files.iter().map(|(path, _)| part_of(path)).collect::<Vec<_>>();
        let mut open = Vec::with_capacity(files.len());
        for (part, (_, bytes)) in parts.iter().zip(files) {
            self.step(part)?;
            let mut file = File::create(part).map_err(RecordError::io("create", part))?;
            self.put(&mut file, part, bytes)?;
            if sync {
                open.push((file, part.as_path()));
            }
        }
        self.sync_files(&open)?;
        parts.iter().zip(files).try_for_each(|(part, (path, _))| self.rename(part, path))
    }

    /// Writes in two halves: the power may fail between them.
    fn put(&self, file: &mut File, path: &Path, bytes: &[u8]) -> Result<(), RecordError> {
        let (first, second) = bytes.split_at(bytes.len() / 2);
        file.write_all(first).map_err(RecordError::io("write", path))?;
        self.step(path)?;
        file.write_all(second).map_err(RecordError::io("write", path))
    }

    /// Waits until the disk has the files.
    fn sync_files(&self, files: &[(File, &Path)]) -> Result<(), RecordError> {
        files.iter().try_for_each(|(_, path)| self.step(path))?;
        match self.waits_once {
            _ if self.is_test() => Ok(()),
            true => sync_together(files),
            false => sync_each(files),
        }
    }

    /// In tests, the moment at which the power may fail.
    #[cfg(test)]
    fn step(&self, path: &Path) -> Result<(), RecordError> {
        match &self.fuse {
            Some(fuse) if fuse.blows() => Err(RecordError::io("reach", path)(io::Error::other("the power failed"))),
            _ => Ok(()),
        }
    }

    #[cfg(not(test))]
    fn step(&self, _path: &Path) -> Result<(), RecordError> {
        Ok(())
    }

    /// Unit tests do not wait for the disk: thousands of simulated crashes would take minutes.
    fn is_test(&self) -> bool {
        cfg!(test)
    }
}

/// Waits until the disk has files; several at once, since it then needs hardly longer than for one.
fn sync_each(files: &[(File, &Path)]) -> Result<(), RecordError> {
    let sync = |(file, path): &(File, &Path)| file.sync_data().map_err(RecordError::io("bring to the disk", path));
    let share = files.len().div_ceil(SYNC_THREADS).max(1);
    if files.len() < 2 {
        return files.iter().try_for_each(sync);
    }
    std::thread::scope(|scope| {
        let shares = files.chunks(share).map(|files| scope.spawn(move || files.iter().try_for_each(sync)));
        let shares = shares.collect::<Vec<_>>();
        let join = |share: ScopedJoinHandle<_>| share.join().unwrap_or_else(|panic| resume_unwind(panic));
        shares.into_iter().try_for_each(join)
    })
}

/// Waits until the disk has files of one file system, together where the system can.
fn sync_together(files: &[(File, &Path)]) -> Result<(), RecordError> {
    #[cfg(target_os = "linux")]
    if let [(file, path), _, ..] = files {
        return sync_file_system(file, path);
    }
    sync_each(files)
}

/// Waits until the disk has all that was written to the file system of a file: one wait, where each file would have its
/// own.
#[cfg(target_os = "linux")]
fn sync_file_system(file: &File, path: &Path) -> Result<(), RecordError> {
    rustix::fs::syncfs(file).map_err(|error| RecordError::io("bring to the disk", path)(error.into()))
}

/// Waits until the disk has all that is in a directory.
#[cfg(target_os = "linux")]
fn sync_tree(directory: &Path) -> Result<(), RecordError> {
    let file = File::open(directory).map_err(RecordError::io("open", directory))?;
    sync_file_system(&file, directory)
}

/// Waits until the disk has all that is in a directory: the files, then the directories (where the system can).
#[cfg(not(target_os = "linux"))]
fn sync_tree(directory: &Path) -> Result<(), RecordError> {
    let (mut files, mut dirs, mut open) = (Vec::new(), Vec::new(), vec![directory.to_path_buf()]);
    while let Some(dir) = open.pop() {
        for name in list(&dir)? {
            let entry = dir.join(name);
            if entry.is_dir() { open.push(entry) } else { files.push(entry) }
        }
        dirs.push(dir);
    }
    if cfg!(unix) {
        files.extend(dirs);
    }
    // A file of which Windows is to wait has to be open for writing.
    let open = |path: &'_ PathBuf| OpenOptions::new().read(true).write(path.is_file()).open(path);
    let opened = files.iter().map(|path| Ok((open(path).map_err(RecordError::io("open", path))?, path.as_path())));
    sync_each(&opened.collect::<Result<Vec<_>, RecordError>>()?)
}

/// The file or directory beside `path` that becomes it.
pub(crate) fn part_of(path: &Path) -> PathBuf {
    // Without a slash at the end of the name, after which the ending would stand in the folder.
    let mut name = path.components().as_path().as_os_str().to_os_string();
    name.push(PART);
    PathBuf::from(name)
}

/// Whether a file was left on its way to its place.
pub(crate) fn is_part(name: &OsString) -> bool {
    name.to_string_lossy().ends_with(PART)
}

/// Names in a directory, sorted.
pub(crate) fn list(path: &Path) -> Result<Vec<OsString>, RecordError> {
    let names = fs::read_dir(path).and_then(|dir| dir.map(|entry| Ok(entry?.file_name())).collect());
    let mut names: Vec<OsString> = names.map_err(RecordError::io("list", path))?;
    names.sort_unstable();
    Ok(names)
}

/// Reads a whole file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, RecordError> {
    gyration_files::read(path).map_err(RecordError::io("read", path))
}

/// The metadata of the recording at `path`.
///
/// # Errors
/// `Missing`, `NotARecording`, `Version`, `Io`.
pub(crate) fn read_group(path: &Path) -> Result<Group, RecordError> {
    let not = |reason: &str| RecordError::NotARecording { path: path.to_path_buf(), reason: reason.into() };
    let kind = fs::metadata(path).map_err(|source| match source.kind() {
        io::ErrorKind::NotFound => RecordError::Missing { path: path.to_path_buf() },
        _ => RecordError::io("read", path)(source),
    })?;
    let file = path.join(METADATA);
    match gyration_files::read(&file) {
        Ok(bytes) => Group::from_json(path, &bytes),
        Err(_) if !kind.is_dir() => Err(not("it is a file, not a directory")),
        Err(e) if e.kind() == io::ErrorKind::NotFound => Err(not("it holds no zarr.json")),
        Err(e) => Err(RecordError::io("read", &file)(e)),
    }
}

/// Locks the recording in the directory `work` for this process until the file returned is dropped.
///
/// # Errors
/// `Locked` if another process holds it, with `path` as its name.
pub(crate) fn lock(work: &Path, path: &Path) -> Result<File, RecordError> {
    refuse_foreign(&work.join(STATE))?;
    let name = work.join(LOCK);
    refuse_foreign(&name)?;
    // The lock must not touch what is in the file: it belongs to another process as long as that one holds it.
    let opened = OpenOptions::new().read(true).append(true).create(true).open(&name);
    let file = opened.map_err(RecordError::io("open", &name))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(RecordError::Locked { path: path.to_path_buf() }),
        Err(TryLockError::Error(e)) => Err(RecordError::io("lock", &name)(e)),
    }
}

/// Refuses a recording in which something else lies than files and folders: what is written to a link, or removed
/// behind it, would be elsewhere, and a pipe waits for ever.
///
/// # Errors
/// `NotARecording` with what lies there, `Io`.
pub(crate) fn refuse_foreign_entries(path: &Path) -> Result<(), RecordError> {
    refuse_foreign_within(path, DEPTH)
}

fn refuse_foreign_within(path: &Path, depth: usize) -> Result<(), RecordError> {
    for name in list(path)? {
        let entry = path.join(name);
        refuse_foreign(&entry)?;
        if depth > 1 && entry.is_dir() {
            refuse_foreign_within(&entry, depth - 1)?;
        }
    }
    Ok(())
}

fn refuse_foreign(path: &Path) -> Result<(), RecordError> {
    let found = path.symlink_metadata().ok().map(|found| found.file_type()).filter(|found| !found.is_dir());
    match found.and_then(gyration_files::not_a_file) {
        Some(what) => Err(RecordError::NotARecording { path: path.to_path_buf(), reason: format!("it is {what}") }),
        None => Ok(()),
    }
}

/// Removes a recording, whole, or a folder that holds nothing; anything else stays and is an error.
///
/// It first moves aside to `NAME.gyr.part`, so that a crash leaves no half recording behind.
///
/// # Errors
/// `Missing`, `NotARecording`, `Version`, `Locked` if a process is writing it, `Io`.
pub fn remove(path: &Path) -> Result<(), RecordError> {
    if path.is_symlink() {
        let reason = "it is a link; remove what it points to".into();
        return Err(RecordError::NotARecording { path: path.to_path_buf(), reason });
    }
    if path.is_dir() && list(path)?.is_empty() {
        return fs::remove_dir(path).map_err(RecordError::io("remove", path));
    }
    read_group(path)?;
    let _lock = lock(path, path)?;
    let aside = part_of(path);
    discard(&aside, path)?;
    fs::rename(path, &aside).map_err(RecordError::io("move aside", path))?;
    remove_aside(&aside)
}

/// Removes what a crash left of a recording that was being created or removed.
///
/// # Errors
/// `Locked` if a process is creating it, `NotARecording` if this is something else, `Io`.
pub(crate) fn discard(aside: &Path, path: &Path) -> Result<(), RecordError> {
    if !aside.is_dir() {
        return Ok(());
    }
    let names = list(aside)?;
    if !names.is_empty() && !names.iter().any(|name| name == STATE) {
        let reason = "a directory of this name is in the way".into();
        return Err(RecordError::NotARecording { path: aside.to_path_buf(), reason });
    }
    let _lock = if aside.join(STATE).is_dir() { Some(lock(aside, path)?) } else { None };
    remove_aside(aside)
}

/// The state goes last: as long as anything is there, it tells that this was a recording.
fn remove_aside(aside: &Path) -> Result<(), RecordError> {
    for name in list(aside)?.iter().filter(|name| *name != STATE) {
        let path = aside.join(name);
        let removed =
            if path.is_dir() && !path.is_symlink() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
        removed.map_err(RecordError::io("remove", &path))?;
    }
    fs::remove_dir_all(aside).map_err(RecordError::io("remove", aside))
}
