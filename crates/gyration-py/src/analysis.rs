//! What can be said of a scene without running it: modes about rest, resistances in a fluid; the program's numbers, as
//! arrays.

use crate::convert::{array, object, to_python};
use crate::errors;
use crate::monitor::interruptibly;
use crate::scene::Scene;
use gyration_sim::resistance::{ResistanceOptions, Resistances};
use gyration_sim::survey::modes_in_json;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyComplex, PyDict};
use serde_json::{Map, Value};

/// The rest state of each body and the small motions about it, a dictionary a body.
#[pyfunction]
pub fn modes<'py>(py: Python<'py>, scene: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
    let scene = Scene::ready(scene)?;
    let all = interruptibly(py, || modes_in_json(&scene))?;
    let found = PyDict::new(py);
    for body in list(&all, "bodies") {
        let described = PyDict::new(py);
        described.set_item("no_rest_state_because", to_python(py, &body["no_rest_state_because"])?)?;
        if let Some(rest) = body["rest_state"].as_object() {
            describe_rest(py, &described, rest)?;
        }
        found.set_item(body["name"].as_str(), described)?;
    }
    Ok(found)
}

/// Place and form at rest, and a row a mode.
fn describe_rest(py: Python<'_>, into: &Bound<'_, PyDict>, rest: &Map<String, Value>) -> PyResult<()> {
    let all = Value::Object(rest.clone());
    for (name, shape) in [("position", &[3_usize][..]), ("gradient", &[3, 3]), ("stretches", &[3])] {
        into.set_item(name, array(py, numbers(&all[name]), shape)?)?;
    }
    for name in ["pressure", "gap"] {
        into.set_item(name, all[name].as_f64())?;
    }
    let modes = list(&all, "modes");
    let count = modes.len();
    let gathered = |of: &dyn Fn(&Value) -> Vec<f64>| -> Vec<f64> { modes.iter().flat_map(of).collect() };
    for name in ["frequency", "frequency_hz", "damping_ratio"] {
        into.set_item(name, array(py, gathered(&|mode| vec![mode[name].as_f64().unwrap_or(f64::NAN)]), &[count])?)?;
    }
    // A motion that the contraction adds has one rate.
    let rates = |mode: &Value| {
        let mut rates = numbers(&mode["decay_rates"]);
        rates.resize(2, f64::NAN);
        rates
    };
    into.set_item("decay_rates", array(py, gathered(&rates), &[count, 2])?)?;
    for part in ["shape", "quadrature"] {
        // A shape that a mode does not have is zero.
        let of = |mode: &Value, name: &str, size: usize| {
            let found = numbers(&mode[part][name]);
            if found.is_empty() { vec![0.0; size] } else { found }
        };
        let shape = PyDict::new(py);
        shape.set_item("translation", array(py, gathered(&|mode| of(mode, "translation", 3)), &[count, 3])?)?;
        shape.set_item("gradient", array(py, gathered(&|mode| of(mode, "gradient", 9)), &[count, 3, 3])?)?;
        into.set_item(part, shape)?;
    }
    for name in ["motion", "in_words"] {
        into.set_item(name, modes.iter().map(|mode| mode[name].as_str().unwrap_or_default()).collect::<Vec<_>>())?;
    }
    Ok(())
}

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

fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value[name].as_array().map_or(&[], Vec::as_slice)
}

/// All numbers in a value, in their order.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::Number(number) => number.as_f64().into_iter().collect(),
        _ => Vec::new(),
    }
}
