//! The states of simulations as arrays of NumPy, which each step writes into in place.
//!
//! Python cannot write to them: a controller that tried to set a state this way would be told, instead of being
//! ignored.

use gyration::tensor::{Mat3, Vec3};
use gyration_sim::{SteppedRun, Stop};
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The state of all bodies of one simulation: vectors, matrices row by row.
pub struct StateNumbers {
    position: Vec<f64>,
    gradient: Vec<f64>,
    velocity: Vec<f64>,
    gradient_rate: Vec<f64>,
    contraction: Vec<f64>,
    /// None if the state is outside the model, which an accepted one is not.
    gap: Result<Vec<f64>, Stop>,
}

impl StateNumbers {
    /// The state of a simulation.
    pub fn of(stepper: &SteppedRun) -> Self {
        let state = stepper.state();
        let model = stepper.model();
        let bodies = 0..model.bodies.len();
        let no_matrix = Mat3::from_element(f64::NAN);
        let vectors = |of: &dyn Fn(usize) -> Vec3| -> Vec<f64> {
            bodies.clone().flat_map(|body| <[f64; 3]>::from(of(body))).collect()
        };
        // nalgebra stores columns, NumPy rows.
        let matrices = |of: &dyn Fn(usize) -> Mat3| -> Vec<f64> {
            bodies.clone().flat_map(|body| of(body).transpose().as_slice().to_vec()).collect()
        };
        Self {
            position: vectors(&|body| model.in_space(body, &stepper.motion(body).placement.position)),
            gradient: matrices(&|body| stepper.motion(body).placement.gradient),
            velocity: vectors(&|body| stepper.motion(body).velocity.velocity),
            gradient_rate: matrices(&|body| stepper.motion(body).velocity.gradient_rate),
            contraction: matrices(&|body| state.contraction(model, body).unwrap_or(no_matrix)),
            gap: stepper.gaps(),
        }
    }
}

/// The states of simulations, an array a quantity.
pub struct Arrays {
    pub position: Py<PyArrayDyn<f64>>,
    pub gradient: Py<PyArrayDyn<f64>>,
    pub velocity: Py<PyArrayDyn<f64>>,
    pub gradient_rate: Py<PyArrayDyn<f64>>,
    pub contraction: Py<PyArrayDyn<f64>>,
    pub gap: Py<PyArrayDyn<f64>>,
}

impl Arrays {
    /// Arrays of zeros of this shape for each entry of a quantity: (bodies,), or (members, bodies).
    pub fn new(py: Python<'_>, shape: &[usize]) -> PyResult<Self> {
        let zeros = |of_one: &[usize]| -> PyResult<Py<PyArrayDyn<f64>>> {
            let array = PyArrayDyn::zeros(py, [shape, of_one].concat(), false);
            let keywords = PyDict::new(py);
            keywords.set_item("write", false)?;
            array.call_method("setflags", (), Some(&keywords))?;
            Ok(array.unbind())
        };
        Ok(Self {
            position: zeros(&[3])?,
            gradient: zeros(&[3, 3])?,
            velocity: zeros(&[3])?,
            gradient_rate: zeros(&[3, 3])?,
            contraction: zeros(&[3, 3])?,
            gap: zeros(&[])?,
        })
    }

    /// Writes the state of a member into the arrays; that of a simulation alone is number 0.
    ///
    /// # Errors
    /// [`Stop`] if the gaps are not known: they are then what they were.
    pub fn show(&self, py: Python<'_>, member: usize, numbers: StateNumbers) -> Result<(), Stop> {
        write(py, &self.position, member, &numbers.position);
        write(py, &self.gradient, member, &numbers.gradient);
        write(py, &self.velocity, member, &numbers.velocity);
        write(py, &self.gradient_rate, member, &numbers.gradient_rate);
        write(py, &self.contraction, member, &numbers.contraction);
        write(py, &self.gap, member, &numbers.gap?);
        Ok(())
    }
}

/// Copies the numbers of a member into an array that only we write to.
fn write(py: Python<'_>, array: &Py<PyArrayDyn<f64>>, member: usize, numbers: &[f64]) {
    let array = array.bind(py);
    let place = member * numbers.len()..(member + 1) * numbers.len();
    debug_assert!(place.end <= array.len());
    // SAFETY: the array was made here, contiguous and of this length; the interpreter's lock is held, and Python cannot
    // write to it, so that nobody else has a reference into it while these numbers are copied.
    if let Ok(slice) = unsafe { array.as_slice_mut() } {
        slice[place].copy_from_slice(numbers);
    }
}
