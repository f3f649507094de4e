//! Resistances of bodies in a viscous fluid: the program's numbers, as arrays.

use crate::convert::{array, list, numbers, object};
use crate::errors;
use crate::monitor::interruptibly;
use crate::scene::Scene;
use gyration_sim::resistance::{ResistanceOptions, Resistances};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyComplex, PyDict};
use serde_json::Value;

/// The resistance of a body in a viscous fluid, or of all bodies by name.
#[pyfunction]
#[pyo3(signature = (scene, body=None, *, wall=None, triangles=None, elements=false, frequency=None))]
pub fn resistance<'py>(
    py: Python<'py>,
    scene: &Bound<'py, PyAny>,
    body: Option<String>,
    wall: Option<String>,
    triangles: Option<i64>,
    elements: bool,
    frequency: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let scene = Scene::of(scene)?;
    let counted = |count: i64| {
        let problem = || format!("{count} is no number of triangles\n  fix: give a whole number above zero");
        u32::try_from(count).map_err(|_| errors::arguments(problem()))
    };
    let triangles = triangles.map(counted).transpose()?;
    let options = ResistanceOptions { wall, triangles, elements, frequency };
    let found = interruptibly(py, || Resistances::of(&scene, body.as_deref(), &options))?;
    let all = found.map_err(|error| errors::arguments(error.to_string()))?.to_json(scene.name());
    let found = PyDict::new(py);
    for described in list(&all, "bodies") {
        let told = describe_resistance(py, described)?;
        if body.is_some() {
            return Ok(told);
        }
        found.set_item(described["name"].as_str(), told)?;
    }
    found.into_bound_py_any(py)
}

fn describe_resistance<'py>(py: Python<'py>, described: &Value) -> PyResult<Bound<'py, PyAny>> {
    let entries = described.as_object().cloned().unwrap_or_default();
    let told = object(py, &entries)?;
    if described.get("matrix").is_some() {
        told.set_item("matrix", array(py, numbers(&described["matrix"]), &[12, 12])?)?;
    }
    for name in ["translation", "rotation", "strain", "expansion"] {
        if let [re, im] = numbers(&described[name])[..] {
            told.set_item(name, PyComplex::from_doubles(py, re, im))?;
        }
    }
    Ok(told)
}
