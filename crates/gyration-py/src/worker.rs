//! What a worker of a study does, in whatever process and on whatever machine: rows of some runs, and their recordings.
//!
//! ```text
//! (study, numbers) → lines of JSON, recordings as bytes
//! ```
//!
//! A worker may have no disk in common with the process that keeps the table: recordings are made in a temporary folder
//! and travel as bytes, beside the rows.

use crate::errors;
use crate::monitor::PythonMonitor;
use crate::parcel::{Parcel, pack};
use gyration_scene::LoadError;
use gyration_study::{Recordings, Study, StudyError, StudySource, Worker};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use tempfile::TempDir;

/// What another process needs to open a study again: name, text, folder, changes; and the word that tells it from every
/// other, with the files that it refers to and the version of the program.
pub type StudyParts = (String, String, PathBuf, Vec<String>, String);

/// The study that this process worked for last.
static LAST: Mutex<Option<(StudyParts, Arc<Study>)>> = Mutex::new(None);

/// What runs leave: a line of JSON each, and the recordings that the study wants of them.
type Made<Bytes> = (Vec<String>, Vec<Parcel<Bytes>>);

/// The rows of some runs as lines of JSON, and their recordings, computed without the lock: what a worker does.
#[pyfunction]
#[pyo3(name = "_study_rows")]
pub fn study_rows(py: Python<'_>, source: StudyParts, numbers: Vec<u64>) -> PyResult<Made<Py<PyBytes>>> {
    let study = py.detach(|| again(source)).map_err(|wrong| match wrong {
        Wrong::File(error) => errors::study_file(error),
        Wrong::Other => errors::study_said(OTHER),
    })?;
    let folder = match study.recordings() {
        Recordings::None => None,
        Recordings::Failures | Recordings::All => Some(temporary()?),
    };
    let mut monitor = PythonMonitor::new(None)?;
    let made = py.detach(|| make(&study, &numbers, folder.as_ref().map(TempDir::path), &mut monitor));
    monitor.finish(py)?;
    let (lines, parcels) = made.map_err(errors::study)?;
    let bytes = |(path, content): (String, Vec<u8>)| (path, PyBytes::new(py, &content).unbind());
    let parcels = parcels.into_iter().map(|(run, files)| (run, files.into_iter().map(bytes).collect()));
    Ok((lines, parcels.collect()))
}

fn temporary() -> PyResult<TempDir> {
    let made = TempDir::with_prefix("gyration-");
    made.map_err(|error| errors::write(Path::new("a temporary folder"), &error))
}

/// Makes runs one after the other, until there are no more or Python asks to stop.
fn make(
    study: &Study,
    numbers: &[u64],
    folder: Option<&Path>,
    monitor: &mut PythonMonitor,
) -> Result<Made<Vec<u8>>, StudyError> {
    let worker = folder.map_or_else(Worker::new, |folder| Worker::new().recording_into(folder));
    let (mut lines, mut parcels) = (Vec::with_capacity(numbers.len()), Vec::new());
    for run in numbers.iter().copied().filter(|run| *run < study.runs()) {
        if !monitor.ask(0.0, 1.0) {
            break;
        }
        // Nobody stops this worker: there is a row.
        lines.extend(study.attempt(run, &worker)?.map(|row| row.to_line()));
        parcels.extend(folder.map(|folder| pack(folder, run)).transpose()?.flatten());
    }
    Ok((lines, parcels))
}

/// What a worker says whose files are not the caller's.
const OTHER: &str = "a worker finds another study than the one whose table this is: its files, or its version of gyration, differ\n  \
     fix: give all workers the same scene files and the same version; a scene that was changed meanwhile makes another study";

/// Why a study cannot be opened again.
enum Wrong {
    File(LoadError),
    Other,
}

/// The study, from what was sent; workers are asked about one study over and over.
fn again(parts: StudyParts) -> Result<Arc<Study>, Wrong> {
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((known, study)) = &*last
        && *known == parts
    {
        return Ok(study.clone());
    }
    let (name, text, base, overrides, fingerprint) = parts.clone();
    let study = Arc::new(Study::again(&StudySource { name, text, base, overrides }).map_err(Wrong::File)?);
    if study.fingerprint() != fingerprint {
        return Err(Wrong::Other);
    }
    *last = Some((parts, study.clone()));
    Ok(study)
}
