//! Derivatives of recorded quantities by numbers of a scene, as arrays.

use crate::convert::{Names, array};
use crate::errors;
use crate::monitor::interruptibly;
use crate::scene::Scene;
use gyration_sim::sensitivity::{At, Derivatives, Sensitivities, SensitivityError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Runs a scene and follows the derivatives of quantities by numbers of it.
///
/// ``keys`` are dotted keys down to a number, ``"contact.0.repulsion.alpha"``; ``quantities`` are columns, ``"die.z"``;
/// ``at`` is ``"end"`` or ``"samples"``. Returns ``time`` [s], ``values``, ``derivatives``, ``reasons`` and ``growth``:
/// at the end, the derivatives are (quantities, keys), at samples (times, quantities, keys), in SI units. Where a
/// derivative means nothing it is NaN, and ``reasons[key]`` says why; it is None for the others.
#[pyfunction]
#[pyo3(signature = (scene, keys, quantities, at="end"))]
pub fn sensitivities<'py>(
    py: Python<'py>,
    scene: &Bound<'py, PyAny>,
    keys: Names,
    quantities: Names,
    at: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let (scene, keys, quantities) = (Scene::ready(scene)?, keys.list(), quantities.list());
    let when = match at {
        "end" => At::End,
        "samples" => At::Samples,
        other => return Err(errors::arguments(format!("`at` is {other:?}\n  fix: give \"end\" or \"samples\""))),
    };
    let found = interruptibly(py, || Sensitivities::along(&scene, &keys, &quantities, when))?.map_err(refused)?;
    let (columns, reasons) = (quantities.len(), PyDict::new(py));
    for (key, derivatives) in keys.iter().zip(&found.derivatives) {
        reasons.set_item(key, derivatives.lost.as_ref().map(ToString::to_string))?;
    }
    let times = match when {
        At::End => found.times.len().saturating_sub(1)..found.times.len(),
        At::Samples => 0..found.times.len(),
    };
    let cell = |derivatives: &Derivatives, time: usize, column: usize| -> f64 {
        let means_something = when == At::Samples || derivatives.lost.is_none();
        let row = derivatives.rows.get(time).filter(|_| means_something);
        row.and_then(|row| row.get(column).copied()).unwrap_or(f64::NAN)
    };
    let mut numbers = Vec::new();
    for time in times.clone() {
        for column in 0..columns {
            numbers.extend(found.derivatives.iter().map(|derivatives| cell(derivatives, time, column)));
        }
    }
    let rows = times.len();
    let values: Vec<f64> = found.values[times.clone()].concat();
    let told = PyDict::new(py);
    told.set_item("reasons", reasons)?;
    told.set_item("growth", found.growth)?;
    if when == At::End {
        told.set_item("time", found.times.last())?;
        told.set_item("values", array(py, values, &[columns])?)?;
        told.set_item("derivatives", array(py, numbers, &[columns, keys.len()])?)?;
    } else {
        told.set_item("time", array(py, found.times, &[rows])?)?;
        told.set_item("values", array(py, values, &[rows, columns])?)?;
        told.set_item("derivatives", array(py, numbers, &[rows, columns, keys.len()])?)?;
    }
    Ok(told)
}

fn refused(error: SensitivityError) -> PyErr {
    match error {
        SensitivityError::Run(error) => errors::run(error),
        error => errors::arguments(error.to_string()),
    }
}
