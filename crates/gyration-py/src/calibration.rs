//! `calibrate`: numbers of a scene from measurements, with what is known of them.

use crate::convert::{array, json, object};
use crate::errors;
use crate::monitor::interruptibly;
use crate::picture::{Picture, PictureSource};
use gyration_study::calibration::{Calibration, CalibrationError, Fitted};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The numbers that explain measurements best.
#[pyclass(frozen, module = "gyration", name = "Fit")]
pub struct Fit {
    calibration: Arc<Calibration>,
    fitted: Arc<Fitted>,
}

/// Finds numbers of a scene from measurements, as ``gyration calibrate`` does.
///
/// ``source`` is a file of measurements or a dictionary of its keys, whose paths are relative to the current folder.
#[pyfunction]
pub fn calibrate(source: &Bound<'_, PyAny>) -> PyResult<Fit> {
    let py = source.py();
    let fit = |opened: Result<Calibration, _>| -> Result<Fit, CalibrationError> {
        let calibration = opened?;
        let fitted = Arc::new(calibration.fit()?);
        Ok(Fit { calibration: Arc::new(calibration), fitted })
    };
    let found = if let Ok(data) = source.cast::<PyDict>() {
        let text = json(data)?;
        interruptibly(py, || fit(Calibration::parse("measurements.json", &text, Path::new(""))))?
    } else {
        let path: PathBuf = source.extract().map_err(|_| {
            errors::arguments(format!(
                "{source} is no calibration\n  fix: give a path, or a dictionary of measurements"
            ))
        })?;
        interruptibly(py, || fit(Calibration::load(&path)))?
    };
    found.map_err(|error| match error {
        CalibrationError::Load(error) => errors::study_file(error),
        error => errors::study_said(&error.to_string()),
    })
}

#[pymethods]
impl Fit {
    /// The numbers by name, in SI units.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for number in &self.fitted.numbers {
            values.set_item(&number.name, number.value)?;
        }
        Ok(values)
    }

    /// Their standard errors; None where the measurements do not tell.
    #[getter]
    fn errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for number in &self.fitted.numbers {
            values.set_item(&number.name, number.error)?;
        }
        Ok(values)
    }

    /// The numbers by the keys of the scene: what ``Scene.edit`` takes.
    #[getter]
    fn changes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let changes = PyDict::new(py);
        for number in &self.fitted.numbers {
            for key in &number.keys {
                changes.set_item(key, number.value)?;
            }
        }
        Ok(changes)
    }

    /// Correlations of the errors, in the order of the numbers; NaN with what is not determined.
    #[getter]
    fn correlations<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let cells = self.fitted.correlations.iter().flatten().map(|cell| cell.unwrap_or(f64::NAN)).collect();
        let count = self.fitted.numbers.len();
        array(py, cells, &[count, count])
    }

    /// Σ ((fitted − measured)/deviation)².
    #[getter]
    fn chi_squared(&self) -> f64 {
        self.fitted.chi_squared
    }

    /// Measurements less directions in which numbers were fitted.
    #[getter]
    fn degrees_of_freedom(&self) -> usize {
        self.fitted.degrees_of_freedom
    }

    /// What cannot be told apart, in sentences.
    #[getter]
    fn undetermined(&self) -> Vec<&str> {
        self.fitted.undetermined.iter().map(|open| open.in_words.as_str()).collect()
    }

    /// Each measurement and what was found for it, as dictionaries.
    #[getter]
    fn residuals<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let row = |residual| {
            object(py, &serde_json::to_value(residual).ok().and_then(|v| v.as_object().cloned()).unwrap_or_default())
        };
        self.fitted.residuals.iter().map(row).collect()
    }

    /// The measurements, the curves that fit them and the bands in which they lie with 95 %.
    fn plot(&self, py: Python<'_>) -> PyResult<Picture> {
        let source = PictureSource::Fit(Arc::clone(&self.calibration), Arc::clone(&self.fitted));
        py.detach(|| Picture::new(source))
    }

    /// What the program prints.
    fn __str__(&self) -> String {
        self.fitted.text(&self.calibration)
    }

    fn __repr__(&self) -> String {
        let numbers: Vec<String> =
            self.fitted.numbers.iter().map(|number| format!("{}={:.6e}", number.name, number.value)).collect();
        format!("<gyration.Fit: {}>", numbers.join(", "))
    }
}
