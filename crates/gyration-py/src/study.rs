//! Studies: the table that one process keeps, and the rows that others may compute for it.
//!
//! `StudyWork` is what `gyration.study` is made of: on the threads of this machine it does all of it; an executor of
//! Python takes run numbers from it and hands back what `worker` makes of them (`python/gyration/_spread.py`). Rows are
//! those of `gyration-study` either way, so that the table has the same bytes.

use crate::convert::{elsewhere, json, overrides, shown};
use crate::errors;
use crate::many::workers;
use crate::monitor::PythonMonitor;
use crate::parcel::{Parcel, unpack};
use crate::worker::StudyParts;
use gyration_study::{Digest, Row, Shard, Study, StudySource, Table, TableLock, execute};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A study and its table while it is being made.
#[pyclass(module = "gyration", name = "_Work")]
pub struct StudyWork {
    study: Arc<Study>,
    /// None once it has been closed.
    table: Option<Table>,
    missing: Box<dyn Iterator<Item = u64> + Send + Sync>,
    folder: PathBuf,
}

/// Opens a study from a path, a name among the ready ones, or a dictionary.
fn open(source: &Bound<'_, PyAny>, changes: &[String], base: &Path) -> PyResult<Study> {
    let py = source.py();
    if let Ok(data) = source.cast::<PyDict>() {
        let text = json(data)?;
        return py.detach(|| Study::parse("study.json", &text, base, changes)).map_err(errors::study_file);
    }
    let path: PathBuf = source.extract().map_err(|_| {
        errors::arguments(format!(
            "{} is no study\n  fix: give a path, the name of a ready study, or a dictionary",
            shown(source)
        ))
    })?;
    py.detach(|| Study::open(&path.to_string_lossy(), changes)).map_err(errors::study_file)
}

#[pymethods]
impl StudyWork {
    #[new]
    #[pyo3(signature = (source, output, changes, resume, force, threads=None, progress=None))]
    fn new(
        source: &Bound<'_, PyAny>,
        output: Option<PathBuf>,
        changes: Option<&Bound<'_, PyDict>>,
        resume: &Bound<'_, PyAny>,
        force: bool,
        threads: Option<i64>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        // What is wrong with these must not cost a table that is there.
        workers(threads)?;
        PythonMonitor::new(progress)?;
        let study = open(source, &overrides(changes)?, Path::new(""))?;
        let folder = output.unwrap_or_else(|| PathBuf::from(format!("{}.study", study.name())));
        let resume = match resume.extract::<bool>() {
            Ok(resume) => resume,
            Err(_) if resume.extract::<&str>().is_ok_and(|word| word == "auto") => Table::is_begun(&folder),
            Err(_) => {
                return Err(errors::arguments(format!(
                    "`resume` is {}\n  fix: give True, False or \"auto\"",
                    shown(resume)
                )));
            }
        };
        let table = source.py().detach(|| match resume {
            true => Table::resume(&folder, &study, Shard::WHOLE),
            false => Table::create(&folder, &study, Shard::WHOLE, force),
        });
        let table = table.map_err(errors::study)?;
        let missing = Box::new(table.missing());
        Ok(Self { study: Arc::new(study), missing, table: Some(table), folder })
    }

    #[getter]
    fn source(&self) -> StudyParts {
        let StudySource { name, text, base, overrides } = self.study.source().clone();
        (name, text, elsewhere(&base), overrides, self.study.fingerprint().to_owned())
    }

    #[getter]
    fn path(&self) -> &Path {
        &self.folder
    }

    #[getter]
    fn done(&self) -> u64 {
        self.table.as_ref().map_or(0, Table::rows)
    }

    #[getter]
    fn total(&self) -> u64 {
        self.study.runs()
    }

    /// Makes what is missing on threads of this process.
    fn execute(&mut self, py: Python<'_>, threads: Option<i64>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let threads = workers(threads)?;
        let mut monitor = PythonMonitor::new(progress)?.of_runs();
        let Self { study, table, folder, .. } = self;
        let table = table.as_mut().ok_or_else(closed)?;
        let done = py.detach(|| execute(study, table, threads, &mut monitor));
        let message = format!(
            "finished rows are kept; go on with gyration.study(..., output={:?}, resume=True)",
            folder.display().to_string()
        );
        monitor.finish(py).map_err(|error| errors::interrupted(py, error, &message))?;
        done.map_err(errors::study)?;
        Ok(())
    }

    /// The next run numbers that are missing.
    fn take(&mut self, most: usize) -> Vec<u64> {
        self.missing.by_ref().take(most).collect()
    }

    /// Adds the rows of these runs, and before them their recordings: no row is there without its recording.
    fn append(
        &mut self,
        py: Python<'_>,
        numbers: Vec<u64>,
        lines: Vec<String>,
        recordings: Vec<Parcel<PyBackedBytes>>,
    ) -> PyResult<()> {
        let Self { study, table, .. } = self;
        let table = table.as_mut().ok_or_else(closed)?;
        let added = py.detach(|| {
            let rows: Option<Vec<Row>> = lines.iter().map(|line| Row::from_line(line, study.columns())).collect();
            // What has passed through somebody's hands is not what a worker made.
            let rows = rows.filter(|rows| rows.iter().map(Row::run).eq(numbers.iter().copied().map(Some)));
            let rows = rows.filter(|_| recordings.iter().all(|(run, _)| numbers.contains(run)));
            rows.map(|rows| {
                recordings.iter().try_for_each(|parcel| unpack(&table.recordings(), parcel))?;
                table.append(&rows)
            })
        });
        match added {
            Some(added) => added.map_err(errors::study),
            None => Err(errors::study_said(
                "a worker sent rows that were not asked for\n  fix: give it the version of gyration that is here",
            )),
        }
    }

    /// Writes the table, and warns of open ledgers; StudyError if rows are missing.
    fn finish(&mut self, py: Python<'_>) -> PyResult<()> {
        let table = self.table.as_mut().ok_or_else(closed)?;
        let finished = py.detach(|| table.finish()?.then(|| Digest::read(&table.file())).transpose());
        match finished.map_err(errors::study)? {
            Some(digest) => errors::warn(py, digest.open.warning()),
            None => Err(errors::study_said(&format!(
                "the study was stopped after {} of {} runs\n  fix: go on with gyration.study(..., output={:?}, \
                    resume=True)",
                self.done(),
                self.total(),
                self.folder.display().to_string()
            ))),
        }
    }

    /// Lets go of the table: another one may write to it.
    fn close(&mut self) {
        self.table = None;
    }

    /// Its lock, which can be asked for anything while the study is at work.
    #[getter]
    fn lock(&self) -> PyResult<Lock> {
        self.table.as_ref().map(|table| Lock(table.lock())).ok_or_else(closed)
    }
}

fn closed() -> PyErr {
    errors::study_said("the table has been closed")
}

/// The lock of a table.
#[pyclass(frozen, module = "gyration", name = "_Lock", weakref)]
pub struct Lock(TableLock);

#[pymethods]
impl Lock {
    /// Leaves it to the process from which this one was forked.
    fn leave(&self) {
        self.0.leave();
    }
}
