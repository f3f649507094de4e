//! `Recording`: what a run left on disk, as arrays of NumPy, xarray and pandas, as pictures and as a page.

mod frames;

use crate::convert::{Names, array as numpy, object};
use crate::errors;
use crate::picture::{Picture, PictureSource};
use gyration_record::{ArrayInfo, Recording as Inner};
use gyration_scene::suggestion;
use gyration_sim::RunSummary;
use gyration_sim::replay::ReplayError;
use gyration_view::{Stored, report};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple, PyType};
use serde_json::Value;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// A recording on disk, as it stood when it was opened.
#[pyclass(frozen, module = "gyration", name = "Recording")]
pub struct Recording {
    pub inner: Inner,
    /// What the program said at the end of the run, if it was run here.
    told: Option<String>,
    /// Removes the folder when nobody needs it any more.
    kept: Option<Arc<TempDir>>,
}

impl Recording {
    /// The recording of a run that has just ended.
    pub fn of_run(path: &Path, kept: Option<Arc<TempDir>>, told: Option<String>) -> PyResult<Self> {
        Ok(Self { inner: Inner::open(path).map_err(errors::record)?, told, kept })
    }

    /// The names of the bodies.
    pub fn body_names(&self) -> PyResult<Vec<String>> {
        Ok(self.inner.labels("body").map_err(errors::record)?.unwrap_or_default())
    }

    /// A whole array.
    pub fn read<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let read = py.detach(|| self.inner.read(name)).map_err(errors::record)?;
        numpy(py, read.data, &read.shape)
    }

    pub fn column<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let column = py.detach(|| self.inner.column(name)).map_err(errors::record)?;
        let rows = column.len();
        numpy(py, column, &[rows])
    }

    /// The arrays of numbers.
    pub fn numbers(&self) -> impl Iterator<Item = &ArrayInfo> {
        // Labels have neither unit nor numbers.
        self.inner
            .arrays()
            .iter()
            .filter(|array| !(array.dims.len() == 1 && array.dims[0] == array.name && array.name != "time"))
    }

    /// `die.position`: the array of which a part belongs to a body, which of the bodies it is, and along which axis
    /// they stand.
    fn of_body<'a>(&self, name: &'a str) -> PyResult<Option<(&'a str, usize, usize)>> {
        let Some((body, name)) = name.rsplit_once('.') else { return Ok(None) };
        let (bodies, Ok(info)) = (self.body_names()?, self.inner.array(name)) else { return Ok(None) };
        let index = bodies.iter().position(|known| known == body);
        let axis = info.dims.iter().position(|dim| dim == "body");
        Ok(index.zip(axis).map(|(index, axis)| (name, index, axis)))
    }

    /// Quantities, and the measures of `stroke`; the recording stays on disk as long as its picture.
    fn picture(&self, quantities: Vec<String>, measures: Vec<String>) -> PyResult<Picture> {
        let (recording, kept) = (self.inner.clone(), self.kept.clone());
        Picture::new(PictureSource::Recording { recording, kept, quantities, measures })
    }

    pub fn no_such(&self, name: &str) -> PyErr {
        let columns: Vec<&str> = self.inner.columns().collect();
        let arrays: Vec<&str> = self.numbers().map(|array| array.name.as_str()).collect();
        // What has a point was meant as a column.
        let (first, second) = if name.contains('.') { (columns, arrays) } else { (arrays, columns) };
        let names = first.into_iter().chain(second);
        let fix = suggestion(name, names, "columns, and arrays (`BODY.ARRAY` for one body)");
        PyKeyError::new_err(format!("the recording has no `{name}`: {fix}"))
    }
}

#[pymethods]
impl Recording {
    /// Opens a recording on disk, finished or not.
    #[classmethod]
    fn open(_: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        Ok(Self { inner: Inner::open(&path).map_err(errors::record)?, told: None, kept: None })
    }

    /// The folder of the recording.
    #[getter]
    fn path(&self) -> &Path {
        self.inner.path()
    }

    /// All that the recording says of itself: scene, resolved form, version, bodies, outcome, statistics.
    #[getter]
    fn attrs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        object(py, self.inner.attributes())
    }

    /// The kind of end: completed, at_rest, the reason of a stop, or unfinished.
    #[getter]
    fn outcome(&self) -> String {
        match self.inner.attributes().get("outcome") {
            None => "unfinished".to_owned(),
            Some(Value::String(kind)) => kind.clone(),
            Some(outcome) => {
                let stop = outcome.get("stopped").and_then(|stop| stop.get("reason")).and_then(Value::as_str);
                let kind = || outcome.as_object().and_then(|entries| entries.keys().next()).cloned();
                stop.map(str::to_owned).or_else(kind).unwrap_or_default()
            }
        }
    }

    /// What the program says at the end of the run: outcome, steps, ledger, momenta, events. Of a recording that was
    /// opened it is the same, without the wall time, which nothing records; of one that has not ended, as far as it has
    /// come.
    #[getter]
    fn summary(&self, py: Python<'_>) -> String {
        if let Some(told) = &self.told {
            return told.clone();
        }
        let text = || -> Result<String, ReplayError> {
            let (scene, summary) = RunSummary::of_recording(&self.inner)?;
            Ok(summary.text(&scene, &summary.energies_at_start(&self.inner)?))
        };
        py.detach(text).unwrap_or_else(|error| {
            let words = self.inner.attributes().get("outcome_in_words").and_then(Value::as_str);
            let fix = match error {
                ReplayError::Record(_) => "",
                _ => "\n  fix: put the file back, or record the scene anew",
            };
            format!("{}\nthe rest cannot be told: {error}{fix}", words.unwrap_or("the run has not ended"))
        })
    }

    /// Times of the samples [s].
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.read(py, "time")
    }

    /// The names of the bodies, in order.
    #[getter]
    fn bodies(&self) -> PyResult<Vec<String>> {
        self.body_names()
    }

    /// The names of the columns of the table: ``t``, then ``BODY.x`` [m], ``BODY.P_xx``, ``BODY.vx`` [m/s], …, energies
    /// and works [J].
    #[getter]
    fn columns(&self) -> Vec<String> {
        std::iter::once("t").chain(self.inner.columns()).map(str::to_owned).collect()
    }

    /// The arrays by name, each with ``dims``, ``shape``, ``units`` and ``description``.
    #[getter]
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let arrays = PyDict::new(py);
        for info in self.numbers() {
            let described = PyDict::new(py);
            described.set_item("dims", PyTuple::new(py, &info.dims)?)?;
            described.set_item("shape", PyTuple::new(py, &info.shape)?)?;
            described.set_item("units", &info.units)?;
            described.set_item("description", &info.description)?;
            arrays.set_item(&info.name, described)?;
        }
        Ok(arrays)
    }

    /// Apexes, closest approaches and lift-offs, each with ``time`` [s], ``kind`` and ``body``.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let (names, kinds) = (self.body_names()?, self.inner.event_kinds());
        let one = |event: gyration_record::Event| {
            let described = PyDict::new(py);
            described.set_item("time", event.time)?;
            described.set_item("kind", kinds.get(event.kind))?;
            described.set_item("body", event.body.and_then(|body| names.get(body)))?;
            Ok(described)
        };
        self.inner.events().map_err(errors::record)?.into_iter().map(one).collect()
    }

    fn __len__(&self) -> usize {
        self.inner.rows()
    }

    /// A column (``"die.x"``), an array of all bodies (``"position"``) or of one (``"die.position"``).
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        if name == "t" || self.inner.columns().any(|column| column == name) {
            return self.column(py, name);
        }
        if self.numbers().any(|array| array.name == name) {
            return self.read(py, name);
        }
        let (array, index, axis) = self.of_body(name)?.ok_or_else(|| self.no_such(name))?;
        self.read(py, array)?.call_method1("take", (index, axis))
    }

    fn _ipython_key_completions_(&self) -> PyResult<Vec<String>> {
        let arrays: Vec<&ArrayInfo> = self.numbers().collect();
        let of_bodies = arrays.iter().filter(|array| array.dims.iter().any(|dim| dim == "body"));
        let bodies = self.body_names()?;
        let of_body = of_bodies.flat_map(|array| bodies.iter().map(move |body| format!("{body}.{}", array.name)));
        let names = self.columns().into_iter().chain(arrays.iter().map(|array| array.name.clone())).chain(of_body);
        // Some arrays of one body are columns too.
        let mut is_known = HashSet::new();
        Ok(names.filter(|name| is_known.insert(name.clone())).collect())
    }

    fn __contains__(&self, name: &str) -> PyResult<bool> {
        let known = name == "t" || self.inner.columns().any(|column| column == name);
        Ok(known || self.numbers().any(|array| array.name == name) || self.of_body(name)?.is_some())
    }

    /// The table as a DataFrame of pandas: the columns of the CSV.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        frames::pandas(py, self)
    }

    /// All arrays as a Dataset of xarray, with dimensions, units and descriptions; bodies have their names, and entries
    /// of vectors and matrices the axes ``x``, ``y``, ``z``.
    fn to_xarray<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        frames::xarray(py, self)
    }

    /// Draws columns over time with Matplotlib, into ``ax`` or the axes at hand; returns the axes. ``style`` are
    /// keywords of ``Axes.plot``. Raises ``KeyError`` for a column that the recording does not have.
    #[pyo3(signature = (*columns, ax=None, **style))]
    fn draw<'py>(
        &self,
        py: Python<'py>,
        columns: Vec<String>,
        ax: Option<Bound<'py, PyAny>>,
        style: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        frames::draw(py, self, &columns, ax, style)
    }

    /// A picture of quantities by name: ``overview``, ``strip``, ``motion``, ``height``, ``gap``, ``stretch``,
    /// ``forces``, ``energy``, ``stroke``, ``distance``, ``cost``, ``drive``, ``laws``; of all there is without a name.
    /// ``measures`` are the two of ``stroke``.
    #[pyo3(signature = (*what, measures=None))]
    fn plot(&self, py: Python<'_>, what: Vec<Names>, measures: Option<Names>) -> PyResult<Picture> {
        let what = what.into_iter().flat_map(Names::list).collect();
        py.detach(|| self.picture(what, measures.map(Names::list).unwrap_or_default()))
    }

    /// Writes the recording as one HTML page with a 3-D view, which needs neither network nor this package; returns its
    /// path, beside the recording if none is given, or in the current folder for one that is temporary.
    #[pyo3(signature = (path=None))]
    fn report(&self, py: Python<'_>, path: Option<PathBuf>) -> PyResult<PathBuf> {
        let beside = || {
            let path = self.inner.path().with_extension("html");
            match (&self.kept, path.file_name()) {
                (Some(_), Some(name)) => PathBuf::from(name),
                _ => path,
            }
        };
        let path = path.unwrap_or_else(beside);
        let html = self.page(py)?;
        std::fs::write(&path, html).map_err(|error| errors::write(&path, &error))?;
        Ok(path)
    }

    /// Shows the 3-D view: in a notebook in a frame, else in the browser. Raises ``PlotError`` where the package was
    /// built without the page.
    fn show(&self, py: Python<'_>) -> PyResult<()> {
        let html = self.page(py)?;
        let shell = py.import("sys")?.getattr("modules")?.call_method1("get", ("IPython",))?;
        let is_notebook = !shell.is_none() && shell.call_method0("get_ipython")?.hasattr("kernel")?;
        if is_notebook {
            let quoted = html.replace('&', "&amp;").replace('"', "&quot;");
            let style = "width: 100%; height: 600px; border: 0";
            let display = py.import("IPython.display")?;
            let frame =
                display.call_method1("HTML", (format!("<iframe style=\"{style}\" srcdoc=\"{quoted}\"></iframe>"),))?;
            return display.call_method1("display", (frame,)).map(drop);
        }
        // The browser reads it when it likes: it stays.
        let folder = py.import("tempfile")?.call_method1("mkdtemp", ("", "gyration-"))?;
        let path = py.import("pathlib")?.call_method1("Path", (folder, "report.html"))?;
        path.call_method1("write_bytes", (PyBytes::new(py, html.as_bytes()),))?;
        py.import("webbrowser")?.call_method1("open", (path.call_method0("as_uri")?,)).map(drop)
    }

    /// Heights over time, and how to see the 3-D view: a notebook keeps what it has shown, and a page weighs a
    /// megabyte.
    fn _repr_html_(&self) -> PyResult<String> {
        let heights = self.picture(vec!["height".to_owned()], Vec::new())?;
        Ok(format!("{}<p>The 3-D view: <code>recording.show()</code></p>", heights.svg()))
    }

    /// For pickle: another process opens what is on disk.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (PathBuf,))> {
        if self.kept.is_some() {
            let problem = "a recording in a temporary folder goes with this process";
            return Err(errors::arguments(format!("{problem}\n  fix: run the scene with `output`")));
        }
        opener(py, "Recording", self.inner.path())
    }

    fn __repr__(&self) -> String {
        let (rows, path) = (self.inner.rows(), self.inner.path().display());
        let temporary = if self.kept.is_some() { ", temporary" } else { "" };
        format!("<gyration.Recording {path}: {}, {rows} samples{temporary}>", self.outcome())
    }
}

/// How another process opens this again.
pub fn opener<'py>(py: Python<'py>, class: &str, path: &Path) -> PyResult<(Bound<'py, PyAny>, (PathBuf,))> {
    let path = std::path::absolute(path).map_err(|error| errors::write(path, &error))?;
    Ok((py.import("gyration._gyration")?.getattr(class)?.getattr("open")?, (path,)))
}

impl Recording {
    /// The report as one page.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let made = py.detach(|| report(&Stored::open(self.inner.path())?));
        Ok(made.map_err(errors::view)?.html)
    }
}
