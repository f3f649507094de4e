//! Bodies and what is applied to them, as Python gives them.

use crate::convert::shown;
use crate::errors;
use gyration::load::Applied;
use gyration::model::Model;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::suggestion;
use pyo3::prelude::*;

/// The index of a body given by name or number.
pub fn body_index(model: &Model, body: &Bound<'_, PyAny>) -> PyResult<usize> {
    let fix = |name: &str| suggestion(name, model.names(), "bodies");
    if let Ok(name) = body.extract::<String>() {
        return model
            .find_body(&name)
            .ok_or_else(|| errors::arguments(format!("the scene has no body {name:?}\n  fix: {}", fix(&name))));
    }
    let index = body.extract().ok().filter(|index| *index < model.bodies.len());
    index.ok_or_else(|| {
        let problem = format!("the scene has no body {}", shown(body));
        errors::arguments(format!("{problem}\n  fix: write a name or a number from 0; {}", fix("")))
    })
}

/// Refuses a point without the force that acts there.
///
/// # Errors
/// An `ArgumentError`.
pub fn check_point(force: Option<&Bound<'_, PyAny>>, at: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    match (force, at) {
        (None, Some(_)) => Err(errors::arguments(
            "`at` is where `force` acts, and there is none\n  fix: give `force`, or leave `at` out",
        )),
        _ => Ok(()),
    }
}

/// A load on a body with its centre of mass there in the frame of its shape [m].
pub fn load_of(force: Vec3, moment: Mat3, torque: Vec3, at: Option<Vec3>, center: &Vec3) -> Applied {
    let mut load = match at {
        None => Applied { force, ..Applied::default() },
        Some(at) => Applied::at_point(force, &(at - center)),
    };
    load.moment += moment;
    load.torque = torque;
    load
}

/// A vector in three numbers.
pub fn vector(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Vec3> {
    let numbers: PyResult<[f64; 3]> = object.extract();
    numbers.map(Vec3::from).map_err(|_| unfit(name, object, "three numbers"))
}

/// A matrix in three rows.
pub fn matrix(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Mat3> {
    let rows: PyResult<[[f64; 3]; 3]> = object.extract();
    rows.map(|rows| Mat3::from_fn(|row, column| rows[row][column]))
        .map_err(|_| unfit(name, object, "three rows of three numbers"))
}

fn unfit(name: &str, object: &Bound<'_, PyAny>, wanted: &str) -> PyErr {
    errors::arguments(format!("`{name}` is {}\n  fix: give {wanted}", shown(object)))
}
