//! A scene into a recording, as `gyration run` does it.

use crate::errors::{self, warn};
use crate::monitor::{Asker, PythonMonitor, watched};
use crate::recording::Recording;
use gyration_plot::leave_overview;
use gyration_record::{Recording as Stored, remove};
use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, RecordingEnd, RunSummary, Simulation};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// Where a recording is to go.
pub struct RecordOptions {
    /// The folder; none: one that lives as long as the recording is in use.
    pub output: Option<PathBuf>,
    /// Go on with what is there.
    pub resume: bool,
    /// Replace what is there.
    pub force: bool,
}

/// Runs a scene; the lock is not held.
pub fn run(
    py: Python<'_>,
    scene: &Scene,
    options: RecordOptions,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Recording> {
    let (path, kept) = place(&options, scene.name())?;
    let mut monitor = PythonMonitor::new(progress)?;
    let done = py.detach(|| watched(&mut monitor, |asker| record(scene, &options, &path, asker)));
    monitor.finish(py).map_err(|error| errors::interrupted(py, error, &how_to_go_on(&options, &path)))?;
    let told = done?;
    warn(py, options.output.as_ref().and_then(|_| leave_overview(&path)))?;
    for warning in told.iter().flat_map(|told| &told.warnings) {
        warn(py, Some(warning.clone()))?;
    }
    Recording::of_run(&path, kept, told.map(|told| told.summary))
}

/// The folder of the recording, and what removes it if nobody asked for it.
pub fn place(options: &RecordOptions, name: &str) -> PyResult<(PathBuf, Option<Arc<TempDir>>)> {
    if options.resume && options.force {
        let fix = "go on with what is there by resume=True, or replace it by force=True";
        return Err(errors::arguments(format!("`resume` and `force` at once\n  fix: {fix}")));
    }
    let Some(path) = &options.output else {
        if options.resume {
            return Err(errors::arguments(
                "there is nothing to resume\n  fix: say with `output` which recording is to go on",
            ));
        }
        let folder = TempDir::with_prefix("gyration-")
            .map_err(|error| errors::write(Path::new("a temporary folder"), &error))?;
        return Ok((folder.path().join(format!("{name}.gyr")), Some(Arc::new(folder))));
    };
    if path.symlink_metadata().is_ok() && !options.resume && !options.force {
        return Err(exists(path, "go on with it by resume=True, replace it by force=True, or choose another name"));
    }
    Ok((path.clone(), None))
}

/// What to do about a folder that is there.
pub fn exists(path: &Path, fix: &str) -> PyErr {
    errors::arguments(format!("{} exists already\n  fix: {fix}", path.display()))
}

/// What the program would say of a run.
struct Told {
    summary: String,
    /// What it leaves out, or cannot mean; that its ledger is open.
    warnings: Vec<String>,
}

/// The run itself, and what is told of it; nothing if it had ended before.
fn record(scene: &Scene, options: &RecordOptions, path: &Path, monitor: &mut Asker) -> PyResult<Option<Told>> {
    let job = Job::of(scene, &gyration_cli::provenance());
    let recorded = if options.resume {
        job.resume(path, monitor)
    } else {
        // What is there goes only if the new run has a start.
        let start = Simulation::new(job.model, job.start, job.plan);
        start.and_then(|mut simulation| simulation.begin(&mut MemorySink::default())).map_err(errors::run)?;
        if options.force && path.symlink_metadata().is_ok() {
            remove(path).map_err(errors::record)?;
        }
        job.record(path, monitor)
    };
    match recorded.map_err(errors::run)? {
        RecordingEnd::Ran(summary) => Ok(Some(told(scene, path, &summary)?)),
        RecordingEnd::AlreadyFinished(_) => Ok(None),
    }
}

fn told(scene: &Scene, path: &Path, summary: &RunSummary) -> PyResult<Told> {
    let start = Stored::open(path).and_then(|stored| summary.energies_at_start(&stored)).map_err(errors::record)?;
    let warnings = summary.warnings.iter().cloned().chain(summary.ledger.warning()).collect();
    Ok(Told { summary: summary.text(scene, &start), warnings })
}

/// What to do after Ctrl-C.
fn how_to_go_on(options: &RecordOptions, path: &Path) -> String {
    match &options.output {
        Some(_) => {
            format!("the recording is closed; go on with scene.run({:?}, resume=True)", path.display().to_string())
        }
        None => "the run was stopped; with `output` it could be resumed".to_owned(),
    }
}
