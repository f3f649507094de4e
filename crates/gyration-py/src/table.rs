//! `Table`: the rows of a study, finished or not, for NumPy, pandas and polars.

use crate::convert::{array, object};
use crate::errors;
use crate::picture::{Picture, PictureSource};
use crate::recording::opener;
use gyration_plot::study::{PlotKind, PlotRequest};
use gyration_study::{Data, DataFrame, FrameColumn, studies as ready};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The rows of a study: one a run, with the parameters, the outcome and what was kept.
#[pyclass(frozen, module = "gyration", name = "Table")]
pub struct Table {
    path: PathBuf,
    frame: Arc<DataFrame>,
}

/// The names of the ready studies.
#[pyfunction]
pub fn studies() -> Vec<&'static str> {
    ready().iter().map(|(name, _)| *name).collect()
}

/// A cell of whatever kind; numbers that are not there are NaN in columns of numbers.
fn column<'py>(py: Python<'py>, column: &FrameColumn, rows: usize) -> PyResult<Bound<'py, PyAny>> {
    match &column.data {
        Data::Number(cells) => array(py, cells.iter().map(|cell| cell.unwrap_or(f64::NAN)).collect(), &[rows]),
        Data::Integer(cells) if cells.iter().all(Option::is_some) => {
            let whole: Vec<i64> = cells.iter().map(|cell| cell.unwrap_or_default()).collect();
            Ok(numpy::PyArray1::from_vec(py, whole).into_any())
        }
        Data::Integer(cells) => {
            array(py, cells.iter().map(|cell| cell.map_or(f64::NAN, |whole| whole as f64)).collect(), &[rows])
        }
        Data::Text(cells) => cells.clone().into_bound_py_any(py),
        Data::List(cells) => {
            let one = |cell: &Option<Vec<f64>>| match cell {
                Some(numbers) => array(py, numbers.clone(), &[numbers.len()]),
                None => Ok(py.None().into_bound(py)),
            };
            cells.iter().map(one).collect::<PyResult<Vec<_>>>()?.into_bound_py_any(py)
        }
    }
}

#[pymethods]
impl Table {
    /// Opens the table of a study, its folder or a Parquet file of it; a study may still be under way.
    #[classmethod]
    pub fn open(kind: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        let frame = kind.py().detach(|| DataFrame::read(&path)).map_err(errors::study)?;
        Ok(Self { path, frame: Arc::new(frame) })
    }

    /// The folder of the table.
    #[getter]
    fn path(&self) -> &Path {
        &self.path
    }

    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<&str> {
        self.frame.columns().iter().map(|column| column.column.name.as_str()).collect()
    }

    /// The SI units of the columns that have one, by name.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        for column in self.frame.columns() {
            if let Some(unit) = &column.column.unit {
                units.set_item(&column.column.name, unit)?;
            }
        }
        Ok(units)
    }

    /// What the table says of its study.
    #[getter]
    fn attrs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        object(py, &self.frame.description().as_object().cloned().unwrap_or_default())
    }

    fn __len__(&self) -> usize {
        self.frame.rows()
    }

    /// A column: an array of numbers, or a list of texts or of arrays.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match self.frame.column(name) {
            Some(found) => column(py, found, self.frame.rows()),
            None => {
                let names = self.columns().join(", ");
                Err(PyKeyError::new_err(format!("the table has no column `{name}`: it has {names}")))
            }
        }
    }

    /// All of it as a DataFrame of pandas.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("pandas")?.call_method1("DataFrame", (self.all(py)?,))
    }

    /// All of it as a DataFrame of polars.
    fn to_polars<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let polars = py.import("polars")?;
        let columns = PyDict::new(py);
        for found in self.frame.columns() {
            // In polars what is not there is null, not NaN.
            let cells = match &found.data {
                Data::Number(cells) => cells.clone().into_bound_py_any(py)?,
                Data::Integer(cells) => cells.clone().into_bound_py_any(py)?,
                Data::Text(cells) => cells.clone().into_bound_py_any(py)?,
                Data::List(cells) => cells.clone().into_bound_py_any(py)?,
            };
            columns.set_item(&found.column.name, cells)?;
        }
        polars.call_method1("DataFrame", (columns,))
    }

    /// A picture of the table, as ``gyration study STUDY plot`` draws it.
    ///
    /// ``x`` and ``y`` are columns, ``y`` also the share of the runs with one of some values: ``"face=+z,-z"``.
    /// ``colour`` is the column that colours tell apart, ``kind`` is ``"histogram"``, ``"curve"`` (means or shares with
    /// intervals of 95 %), ``"map"`` or ``"scatter"``. What is not given is what the study's ``[plot]`` says, else what
    /// suits its columns.
    #[pyo3(signature = (x=None, y=None, *, colour=None, color=None, kind=None))]
    fn plot(
        &self,
        py: Python<'_>,
        x: Option<String>,
        y: Option<String>,
        colour: Option<String>,
        color: Option<String>,
        kind: Option<String>,
    ) -> PyResult<Picture> {
        if colour.is_some() && color.is_some() {
            return Err(errors::arguments("`colour` and `color` are the same\n  fix: give one of them"));
        }
        let kind = kind.as_deref().map(PlotKind::of_word).transpose().map_err(errors::plot)?;
        let request = PlotRequest { x, y, colour: colour.or(color), kind, ..PlotRequest::default() };
        let source = PictureSource::Study(self.frame.clone(), self.path.clone(), request);
        py.detach(|| Picture::new(source))
    }

    /// For pickle: another process opens what is on disk.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (PathBuf,))> {
        opener(py, "Table", &self.path)
    }

    fn __repr__(&self) -> String {
        format!("<gyration.Table {}: {} rows>", self.path.display(), self.frame.rows())
    }
}

impl Table {
    fn all<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for found in self.frame.columns() {
            columns.set_item(&found.column.name, column(py, found, self.frame.rows())?)?;
        }
        Ok(columns)
    }
}
