//! Recordings as pandas, xarray and Matplotlib have them.

use super::Recording;
use crate::convert::{array, object};
use crate::errors;
use gyration_record::Array;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// The columns of the CSV as a DataFrame.
pub fn pandas<'py>(py: Python<'py>, recording: &Recording) -> PyResult<Bound<'py, PyAny>> {
    let columns = PyDict::new(py);
    columns.set_item("t", recording.read(py, "time")?)?;
    // Each array is read once.
    let mut read: HashMap<&str, Array> = HashMap::new();
    for (name, source, place) in recording.inner.column_places() {
        let whole = match read.entry(source) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => new.insert(py.detach(|| recording.inner.read(source)).map_err(errors::record)?),
        };
        let stride = whole.shape.iter().skip(1).product();
        let column: Vec<f64> = whole.data.iter().skip(place).step_by(stride).copied().collect();
        let rows = column.len();
        columns.set_item(name, array(py, column, &[rows])?)?;
    }
    py.import("pandas")?.call_method1("DataFrame", (columns,))
}

/// All arrays as a Dataset, with names of bodies and axes.
pub fn xarray<'py>(py: Python<'py>, recording: &Recording) -> PyResult<Bound<'py, PyAny>> {
    let (variables, coordinates) = (PyDict::new(py), PyDict::new(py));
    for info in recording.numbers() {
        let attributes = PyDict::new(py);
        attributes.set_item("units", &info.units)?;
        attributes.set_item("description", &info.description)?;
        let variable = (PyTuple::new(py, &info.dims)?, recording.read(py, &info.name)?, attributes);
        let into = if info.name == "time" { &coordinates } else { &variables };
        into.set_item(&info.name, variable)?;
        for (dim, size) in info.dims.iter().zip(&info.shape) {
            if *size == 3 && (dim == "row" || dim == "col") {
                coordinates.set_item(dim, ((dim,), ["x", "y", "z"]))?;
            }
        }
    }
    coordinates.set_item("body", (("body",), recording.body_names()?))?;
    let keywords = PyDict::new(py);
    keywords.set_item("data_vars", variables)?;
    keywords.set_item("coords", coordinates)?;
    keywords.set_item("attrs", object(py, recording.inner.attributes())?)?;
    py.import("xarray")?.call_method("Dataset", (), Some(&keywords))
}

/// Columns over time in axes of Matplotlib, those at hand if none are given.
pub fn draw<'py>(
    py: Python<'py>,
    recording: &Recording,
    columns: &[String],
    axes: Option<Bound<'py, PyAny>>,
    style: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut drawn = Vec::new();
    for column in columns {
        let place = recording.inner.column_places().find(|(name, ..)| name == column);
        let (_, source, _) = place.ok_or_else(|| recording.no_such(column))?;
        let units = recording.numbers().find(|info| info.name == source).map_or("", |info| info.units.as_str());
        let label = if units.is_empty() { column.clone() } else { format!("{column} [{units}]") };
        drawn.push((recording.column(py, column)?, label));
    }
    let axes = match axes {
        Some(axes) => axes,
        None => py.import("matplotlib.pyplot")?.call_method0("gca")?,
    };
    let time = recording.read(py, "time")?;
    for (values, label) in &drawn {
        let keywords = PyDict::new(py);
        keywords.set_item("label", label)?;
        if let Some(style) = style {
            keywords.update(style.as_mapping())?;
        }
        axes.call_method("plot", (&time, values), Some(&keywords))?;
    }
    axes.call_method1("set_xlabel", ("t [s]",))?;
    match drawn.as_slice() {
        [(_, label)] => axes.call_method1("set_ylabel", (label,))?,
        _ => axes.call_method0("legend")?,
    };
    Ok(axes)
}
