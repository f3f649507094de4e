//! The recording of a run as bytes, for a process that has no disk in common with the one that made it.
//!
//! A recording is a folder of small files; a parcel holds all of them by their paths within it. It is unpacked beside
//! its place, brought to the disk and then moved there: whatever stands at the place of a recording is whole.

use gyration_record::{RecordError, remove};
use gyration_study::StudyError;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

/// The number of a run and the files of its recording: paths with `/` between their parts, and bytes.
pub type Parcel<Bytes> = (u64, Vec<(String, Bytes)>);

/// Packs the recording of a run that stands in a folder, if it left one, and removes it.
pub fn pack(folder: &Path, run: u64) -> Result<Option<Parcel<Vec<u8>>>, StudyError> {
    let place = place(folder, run);
    if !place.is_dir() {
        return Ok(None);
    }
    let mut files = Vec::new();
    gather(&place, "", &mut files).map_err(at("read", &place))?;
    fs::remove_dir_all(&place).map_err(at("remove", &place))?;
    Ok(Some((run, files)))
}

/// Unpacks the recording of a run into a folder; one that a broken study has left is replaced.
pub fn unpack<Bytes: AsRef<[u8]>>(folder: &Path, (run, files): &Parcel<Bytes>) -> Result<(), StudyError> {
    let place = place(folder, *run);
    let arriving = place.with_extension("gyr.arriving");
    let write = || -> io::Result<()> {
        if arriving.exists() {
            fs::remove_dir_all(&arriving)?;
        }
        for (path, content) in files {
            let path = arriving.join(within(path)?);
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            let mut file = File::create(&path)?;
            file.write_all(content.as_ref())?;
            file.sync_data()?;
        }
        Ok(())
    };
    write().map_err(at("write", &arriving))?;
    if place.symlink_metadata().is_ok() {
        remove(&place)?;
    }
    fs::rename(&arriving, &place).map_err(at("write", &place))
}

/// Where the recording of a run stands.
fn place(folder: &Path, run: u64) -> PathBuf {
    folder.join(format!("run-{run:06}.gyr"))
}

/// All files below a folder, in order of their names.
fn gather(folder: &Path, prefix: &str, into: &mut Vec<(String, Vec<u8>)>) -> io::Result<()> {
    let mut entries = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            gather(&entry.path(), &format!("{name}/"), into)?;
        } else {
            into.push((name, gyration_files::read(&entry.path())?));
        }
    }
    Ok(())
}

/// A path that leads nowhere but down.
fn within(path: &str) -> io::Result<&Path> {
    let path = Path::new(path);
    match path.components().all(|part| matches!(part, Component::Normal(_))) {
        true => Ok(path),
        false => {
            Err(io::Error::new(io::ErrorKind::InvalidData, "a worker sent a path that leads out of the recording"))
        }
    }
}

fn at<'a>(action: &'static str, path: &'a Path) -> impl FnOnce(io::Error) -> StudyError + 'a {
    move |source| RecordError::Io { action, path: path.to_owned(), source }.into()
}
