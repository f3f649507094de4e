//! A state as Python gives it, in arrays of what is to be other than it is.

use crate::convert::numbers_of_shape;
use gyration::tensor::{Mat3, Vec3};
use gyration_sim::{BodyStart, SteppedRun};
use pyo3::prelude::*;

/// The quantities that are given, as keywords of Python.
pub struct GivenState<'a, 'py> {
    pub position: Option<&'a Bound<'py, PyAny>>,
    pub gradient: Option<&'a Bound<'py, PyAny>>,
    pub velocity: Option<&'a Bound<'py, PyAny>>,
    pub gradient_rate: Option<&'a Bound<'py, PyAny>>,
    pub contraction: Option<&'a Bound<'py, PyAny>>,
}

/// The same in numbers, one body behind the other, one member behind the other.
pub struct Starts {
    position: Option<Vec<f64>>,
    gradient: Option<Vec<f64>>,
    velocity: Option<Vec<f64>>,
    gradient_rate: Option<Vec<f64>>,
    contraction: Option<Vec<f64>>,
}

impl GivenState<'_, '_> {
    /// Reads arrays of this shape for each entry of a quantity: (bodies,), or (members, bodies).
    pub fn read(&self, shape: &[usize]) -> PyResult<Starts> {
        let read = |name: &str, object: Option<&Bound<'_, PyAny>>, of_one: &[usize]| {
            object.map(|object| numbers_of_shape(name, object, &[shape, of_one].concat())).transpose()
        };
        Ok(Starts {
            position: read("position", self.position, &[3])?,
            gradient: read("P", self.gradient, &[3, 3])?,
            velocity: read("velocity", self.velocity, &[3])?,
            gradient_rate: read("Pdot", self.gradient_rate, &[3, 3])?,
            contraction: read("G", self.contraction, &[3, 3])?,
        })
    }
}

impl Starts {
    /// The starts of all bodies of a member: what is not given is as it is now. Where P is given without Ṗ the velocity
    /// gradient Ṗ P⁻¹ stays, and the centre of a pinned body follows its pin.
    pub fn of_member(&self, stepper: &SteppedRun, member: usize) -> Vec<BodyStart> {
        let count = stepper.model().bodies.len();
        (0..count).map(|body| self.of_body(stepper, body, member * count + body)).collect()
    }

    fn of_body(&self, stepper: &SteppedRun, body: usize, place: usize) -> BodyStart {
        let now = stepper.motion(body);
        let (mut placement, mut velocity) = (now.placement, now.velocity);
        let matrix = |all: &Option<Vec<f64>>| all.as_ref().map(|all| Mat3::from_row_slice(&all[9 * place..][..9]));
        let vector = |all: &Option<Vec<f64>>| all.as_ref().map(|all| Vec3::from_column_slice(&all[3 * place..][..3]));
        if let Some(gradient) = matrix(&self.gradient) {
            placement.gradient = gradient;
            if let Some(inverse) = now.placement.gradient.try_inverse() {
                velocity.gradient_rate = now.velocity.gradient_rate * inverse * gradient;
            }
        }
        velocity.gradient_rate = matrix(&self.gradient_rate).unwrap_or(velocity.gradient_rate);
        if let Some(pin) = &stepper.model().bodies[body].pin {
            placement.position = pin.anchor - placement.gradient * pin.point;
            velocity.velocity = -(velocity.gradient_rate * pin.point);
        }
        let in_cell = |place: Vec3| stepper.model().in_cell(body, &place);
        placement.position = vector(&self.position).map_or(placement.position, in_cell);
        velocity.velocity = vector(&self.velocity).unwrap_or(velocity.velocity);
        // What a body that does not contract shows of G is no number.
        let contracts = stepper.model().bodies[body].contraction().is_some();
        let contraction = matrix(&self.contraction).filter(|_| contracts);
        BodyStart { body, placement, velocity, contraction }
    }
}
