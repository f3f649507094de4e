//! Rest states and the small motions about them: the program's numbers, as arrays.

use crate::convert::{array, list, numbers, to_python};
use crate::monitor::interruptibly;
use crate::scene::Scene;
use gyration_sim::modes::PARTS;
use gyration_sim::survey::modes_in_json;
use gyration_sim::within_wall_time;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde_json::Value;

/// Rest states and the small motions about them, a dictionary for each body by its name, and one for each system by the
/// tuple of its names: ``modes(scene)["a"]``, ``modes(scene)["a", "b"]``.
///
/// What springs, bonds or contacts join is a system. Its members have no modes of their own: ``["system"]`` of one is
/// the tuple of the system's names, of a body alone None. Where there is no rest state ``["no_rest_state_because"]``
/// says why. Else there are, of n modes,
///
/// - ``frequency`` [rad/s], ``frequency_hz``, ``damping_ratio``: (n); ``decay_rates`` [1/s]: (n, 2), nan for the second
///   one of a motion that has one,
/// - ``motion``, ``in_words``: lists of n,
/// - ``shape``, ``quadrature``: ``translation`` (n, 3) and ``gradient`` (n, 3, 3); the latter is the part a quarter of a
///   period ahead; of a system one such dictionary a body, by name,
/// - ``participation``: (n, 5), shares of translation, rotation, shear, stretch, breathing in the kinetic energy,
///
/// and where a body rests, ``position`` [m], ``gradient``, ``stretches``, ``pressure`` [Pa], ``gap`` [m],
/// ``contraction``, ``left_out``; of a system in ``bodies``, by name.
#[pyfunction]
pub fn modes<'py>(py: Python<'py>, scene: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyDict>> {
    let scene = Scene::ready(scene)?;
    let all = interruptibly(py, || within_wall_time(&scene, || modes_in_json(&scene)))?;
    let systems = list(&all, "systems");
    let names = |system: &Value| PyTuple::new(py, members(system));
    let found = PyDict::new(py);
    for body in list(&all, "bodies") {
        let described = described(py, body)?;
        let system = body["system"].as_u64().and_then(|number| systems.get(usize::try_from(number).ok()?));
        described.set_item("system", system.map(names).transpose()?)?;
        let rest = &body["rest_state"];
        if !rest.is_null() {
            describe_place(&described, rest)?;
            describe_modes(&described, rest, shape)?;
        }
        found.set_item(body["name"].as_str(), described)?;
    }
    for system in systems {
        let described = described(py, system)?;
        let rest = &system["rest_state"];
        if !rest.is_null() {
            let bodies = PyDict::new(py);
            for (name, place) in rest["bodies"].as_object().into_iter().flatten() {
                let body = PyDict::new(py);
                describe_place(&body, place)?;
                bodies.set_item(name, body)?;
            }
            described.set_item("bodies", bodies)?;
            describe_modes(&described, rest, |py, shapes| {
                let each = PyDict::new(py);
                for name in members(system) {
                    each.set_item(name, shape(py, &shapes.iter().map(|all| &all[name]).collect::<Vec<_>>())?)?;
                }
                Ok(each)
            })?;
        }
        found.set_item(names(system)?, described)?;
    }
    Ok(found)
}

/// The names of the bodies of a system.
fn members(system: &Value) -> Vec<&str> {
    list(system, "bodies").iter().filter_map(Value::as_str).collect()
}

/// A dictionary that says why there is no rest state.
fn described<'py>(py: Python<'py>, of: &Value) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("no_rest_state_because", to_python(py, &of["no_rest_state_because"])?)?;
    Ok(described)
}

/// Place and form of a body at rest.
pub fn describe_place(into: &Bound<'_, PyDict>, place: &Value) -> PyResult<()> {
    let py = into.py();
    for (name, shape) in [("position", &[3_usize][..]), ("gradient", &[3, 3]), ("stretches", &[3])] {
        into.set_item(name, array(py, numbers(&place[name]), shape)?)?;
    }
    for name in ["pressure", "gap"] {
        into.set_item(name, place[name].as_f64())?;
    }
    let contraction = &place["contraction"];
    let contraction = (!contraction.is_null()).then(|| array(py, numbers(contraction), &[3, 3])).transpose()?;
    into.set_item("contraction", contraction)?;
    into.set_item("left_out", place["left_out"].as_str())
}

/// A row a mode; `shape` makes a dictionary of the shapes of all modes.
fn describe_modes<'py>(
    into: &Bound<'py, PyDict>,
    rest: &Value,
    shape: impl Fn(Python<'py>, &[&Value]) -> PyResult<Bound<'py, PyDict>>,
) -> PyResult<()> {
    let (py, modes) = (into.py(), list(rest, "modes"));
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
    let shares = gathered(&|mode| numbers(&mode["participation"]));
    into.set_item("participation", array(py, shares, &[count, PARTS])?)?;
    for part in ["shape", "quadrature"] {
        into.set_item(part, shape(py, &modes.iter().map(|mode| &mode[part]).collect::<Vec<_>>())?)?;
    }
    for name in ["motion", "in_words"] {
        into.set_item(name, modes.iter().map(|mode| mode[name].as_str().unwrap_or_default()).collect::<Vec<_>>())?;
    }
    Ok(())
}

/// The shapes of a body in all modes; one that a mode does not have is zero.
fn shape<'py>(py: Python<'py>, modes: &[&Value]) -> PyResult<Bound<'py, PyDict>> {
    let count = modes.len();
    let gathered = |name: &str, size: usize| -> Vec<f64> {
        let of = |mode: &&Value| if mode.is_null() { vec![0.0; size] } else { numbers(&mode[name]) };
        modes.iter().flat_map(of).collect()
    };
    let shape = PyDict::new(py);
    shape.set_item("translation", array(py, gathered("translation", 3), &[count, 3])?)?;
    shape.set_item("gradient", array(py, gathered("gradient", 9), &[count, 3, 3])?)?;
    Ok(shape)
}
