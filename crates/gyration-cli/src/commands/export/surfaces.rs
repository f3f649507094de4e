//! The time series for ParaView: the list, `NAME.pvd`, and the folder of its files beside it, `NAME-vtp`.
//!
//! The folder is written under another name first and replaces the one of an earlier export, the list comes last: no
//! half of a series is left behind. A folder with other files in it is not ours, and stays.

use crate::error::CliError;
use crate::output;
use gyration_record::export::vtk::{SeriesFile, pvd};
use gyration_record::{RecordError, Recording, cannot_write, replace_file};
use gyration_sim::replay::ReplayError;
use gyration_sim::replay::vtk::SurfaceSeries;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Bytes of a series from which on its size is told beforehand.
const LARGE: u64 = 500_000_000;

/// Writes each `every`-th sample and the last; returns what was written, in words.
pub fn write(recording: &Recording, list: &Path, every: usize) -> Result<String, CliError> {
    let folder = folder_of(list);
    refuse_foreign(&folder)?;
    let partial = with_ending(&folder, ".part");
    discard(&partial)?;
    fs::create_dir(&partial).map_err(cannot_write(&partial))?;
    let mut rows: Vec<usize> = (0..recording.rows()).step_by(every).collect();
    rows.extend(recording.rows().checked_sub(1).filter(|last| last % every > 0));
    let written = write_samples(recording, &rows, &partial).and_then(|written| {
        discard(&folder)?;
        fs::rename(&partial, &folder).map_err(cannot_write(&folder))?;
        Ok(written)
    });
    if written.is_err() {
        let _ = fs::remove_dir_all(&partial);
    }
    let (mut entries, cells) = written?;
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    entries.iter_mut().for_each(|entry| entry.file = format!("{name}/{}", entry.file));
    replace_file(list, |partial| {
        let failed = cannot_write(list);
        let mut out = BufWriter::new(File::create(partial).map_err(&failed)?);
        pvd(&entries, &mut out).and_then(|()| out.flush()).map_err(failed)
    })?;
    Ok(format!("{} samples of {cells} cells in {}", rows.len(), folder.display()))
}

/// The files of all samples, and the number of cells of each.
fn write_samples(recording: &Recording, rows: &[usize], folder: &Path) -> Result<(Vec<SeriesFile>, usize), CliError> {
    let explain = |error| explain(recording, error);
    let mut series = SurfaceSeries::open(recording).map_err(explain)?;
    let mut entries = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        entries.extend(series.write(*row, folder).map_err(explain)?);
        if k == 0 {
            tell_size(&folder.join(&entries[0].file), rows.len());
        }
    }
    Ok((entries, series.cells()))
}

/// Says how large a long series will be.
fn tell_size(first: &Path, samples: usize) {
    let total = first.metadata().map_or(0, |file| file.len()).saturating_mul(samples as u64);
    if total > LARGE {
        let size = total as f64 / 1e9;
        output::say(&format!("{samples} samples take about {size:.1} GB; --every 10 takes each tenth"));
    }
}

/// What keeps a recording from being replayed, and what to do about it.
pub fn explain(recording: &Recording, error: ReplayError) -> CliError {
    match error {
        ReplayError::Record(error) => error.into(),
        ReplayError::Scene { .. } | ReplayError::OtherFiles { .. } | ReplayError::OtherBody { .. } => {
            let fix = "put the file back beside the recording; gltf needs no scene and no mesh";
            CliError::arguments(error.to_string(), fix)
        }
        other => RecordError::Corrupt { path: recording.path().to_path_buf(), reason: other.to_string() }.into(),
    }
}

/// `NAME-vtp` of `NAME.pvd`.
fn folder_of(list: &Path) -> PathBuf {
    with_ending(&list.with_extension(""), "-vtp")
}

fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

/// Refuses to replace a folder that holds anything but an earlier export.
fn refuse_foreign(folder: &Path) -> Result<(), CliError> {
    let problem = match fs::read_dir(folder) {
        Ok(entries) => {
            let foreign = |path: &PathBuf| path.extension().is_none_or(|ending| ending != "vtp");
            let mut paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
            match paths.find(foreign) {
                None => return Ok(()),
                Some(path) => format!("{} is not of an earlier export", path.display()),
            }
        }
        Err(_) if folder.symlink_metadata().is_err() => return Ok(()),
        Err(_) => format!("{} is in the way", folder.display()),
    };
    Err(CliError::arguments(problem, "choose another name with -o NAME.pvd, or move it away"))
}

/// Removes a folder of ours, if it is there.
fn discard(folder: &Path) -> Result<(), RecordError> {
    if folder.symlink_metadata().is_err() {
        return Ok(());
    }
    fs::remove_dir_all(folder).map_err(cannot_write(folder))
}
