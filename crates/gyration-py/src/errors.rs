//! Failures of the engine as exceptions of the package, with the messages of the program.
//!
//! The classes are Python's (`gyration/_errors.py`): an extension for all versions of Python cannot derive from
//! built-in exceptions.

use gyration_files::in_words;
use gyration_plot::PlotError;
use gyration_record::RecordError;
use gyration_scene::{LoadError, SceneError, SceneErrors};
use gyration_sim::{RunError, Stop};
use gyration_study::StudyError;
use gyration_threads::Threads;
use gyration_view::ViewError;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyList;

/// What is asked for by options of the program, and by arguments here.
const OPTIONS: [(&str, &str); 5] = [
    ("--set:", "edit:"),
    ("--resume", "resume=True"),
    ("--force", "force=True"),
    ("another -o", "another path"),
    ("by -o", "by a path"),
];

/// A message of the engine as it is said in Python.
fn in_python(message: &str) -> String {
    OPTIONS.iter().fold(message.to_owned(), |message, (option, argument)| message.replace(option, argument))
}

/// Makes an exception of the package.
fn raise(class: &str, message: &str, describe: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<()>) -> PyErr {
    let message = in_python(message);
    Python::attach(|py| {
        let make = || {
            let instance = py.import("gyration._errors")?.getattr(class)?.call1((message,))?;
            describe(&instance)?;
            Ok(PyErr::from_value(instance))
        };
        make().unwrap_or_else(|error: PyErr| error)
    })
}

fn nothing(_: &Bound<'_, PyAny>) -> PyResult<()> {
    Ok(())
}

/// Arguments that make no sense.
pub fn arguments(problem: impl AsRef<str>) -> PyErr {
    raise("ArgumentError", problem.as_ref(), nothing)
}

/// A number of threads that makes no sense.
pub fn threads(wrong: Threads) -> PyErr {
    arguments(format!("{wrong}\n  fix: {}", wrong.fix()))
}

/// A scene that is wrong, or cannot be read.
pub fn load(error: LoadError) -> PyErr {
    match error {
        LoadError::Read(error) => raise("FileError", &error.to_string(), nothing),
        LoadError::Content(errors) => content(&errors),
    }
}

/// A scene that is wrong.
pub fn content(errors: &SceneErrors) -> PyErr {
    raise("SceneError", &errors.to_string(), |instance| {
        instance.setattr("diagnostics", diagnostics(instance.py(), errors)?)
    })
}

fn diagnostics<'py>(py: Python<'py>, errors: &SceneErrors) -> PyResult<Bound<'py, PyList>> {
    let class = py.import("gyration._errors")?.getattr("Diagnostic")?;
    let one = |error: &SceneError| {
        let SceneError { file, line, column, key, message, help, .. } = error;
        class.call1((file, line, column, key, message, help))
    };
    PyList::new(py, errors.into_iter().map(one).collect::<PyResult<Vec<_>>>()?)
}

/// A recording that cannot be read or written.
pub fn record(error: RecordError) -> PyErr {
    raise("FileError", &error.to_string(), nothing)
}

/// A file that cannot be written.
pub fn write(path: &std::path::Path, error: &std::io::Error) -> PyErr {
    raise("FileError", &format!("cannot write {}: {}", path.display(), in_words(error)), nothing)
}

/// A file that cannot be read, or is not what it should be.
pub fn unreadable(path: &std::path::Path, why: &str) -> PyErr {
    raise("FileError", &format!("cannot read {}: {why}", path.display()), nothing)
}

/// A run that cannot begin or go on.
pub fn run(error: RunError) -> PyErr {
    match error {
        RunError::Record(error) => record(error),
        RunError::Start(stop) => stopped_with(&RunError::Start(stop.clone()).to_string(), &stop),
        error => raise("RunError", &error.to_string(), nothing),
    }
}

/// A run that had to stop.
pub fn stopped(stop: &Stop) -> PyErr {
    stopped_with(&gyration_sim::Outcome::Stopped(stop.clone()).in_words(), stop)
}

fn stopped_with(message: &str, stop: &Stop) -> PyErr {
    raise("RunError", message, |instance| {
        instance.setattr("reason", reason(stop))?;
        instance.setattr("time", stop.time)?;
        instance.setattr("body", stop.body.as_deref())
    })
}

/// The reason of a stop as it stands in recordings.
pub fn reason(stop: &Stop) -> String {
    serde_json::to_value(stop.reason).ok().and_then(|value| value.as_str().map(str::to_owned)).unwrap_or_default()
}

/// A picture that cannot be drawn or written.
pub fn plot(error: PlotError) -> PyErr {
    match error {
        PlotError::Arguments { .. } => arguments(error.to_string()),
        error => raise("PlotError", &error.to_string(), nothing),
    }
}

/// A study that is wrong, or whose file cannot be read.
pub fn study_file(error: LoadError) -> PyErr {
    match error {
        LoadError::Read(error) => raise("FileError", &error.to_string(), nothing),
        LoadError::Content(errors) => raise("StudyError", &errors.to_string(), |instance| {
            instance.setattr("diagnostics", diagnostics(instance.py(), &errors)?)
        }),
    }
}

/// A table that cannot be written, read or gone on with.
pub fn study(error: StudyError) -> PyErr {
    study_said(&error.to_string())
}

/// Something that is wrong with a study under way.
pub fn study_said(message: &str) -> PyErr {
    raise("StudyError", message, nothing)
}

/// Warns, if there is something to warn of; an error where warnings are made errors.
pub fn warn(py: Python<'_>, warning: Option<String>) -> PyResult<()> {
    let Some(warning) = warning else { return Ok(()) };
    py.import("warnings")?.call_method1("warn", (warning,)).map(drop)
}

/// Says how to go on after Ctrl-C.
pub fn interrupted(py: Python<'_>, error: PyErr, message: &str) -> PyErr {
    if error.is_instance_of::<PyKeyboardInterrupt>(py) {
        PyKeyboardInterrupt::new_err(message.to_owned())
    } else {
        error
    }
}

/// A recording that cannot be shown.
pub fn view(error: ViewError) -> PyErr {
    match error {
        ViewError::Record(error) => record(error),
        error => raise("PlotError", &error.to_string(), nothing),
    }
}
