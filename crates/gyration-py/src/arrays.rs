//! The state of a simulation as arrays of NumPy, which each step writes into in place.
//!
//! Python cannot write to them: a controller that tried to set a state this way would be told, instead of being
//! ignored.

use gyration::tensor::{Mat3, Vec3};
use gyration_sim::{SteppedRun, Stop};
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The state of all bodies, an array a quantity.
pub struct Arrays {
    pub position: Py<PyArrayDyn<f64>>,
    pub gradient: Py<PyArrayDyn<f64>>,
    pub velocity: Py<PyArrayDyn<f64>>,
    pub gradient_rate: Py<PyArrayDyn<f64>>,
    pub contraction: Py<PyArrayDyn<f64>>,
    pub gap: Py<PyArrayDyn<f64>>,
}

impl Arrays {
    /// Arrays of zeros for so many bodies.
    pub fn new(py: Python<'_>, bodies: usize) -> PyResult<Self> {
        let zeros = |shape: &[usize]| -> PyResult<Py<PyArrayDyn<f64>>> {
            let array = PyArrayDyn::zeros(py, shape.to_vec(), false);
            let keywords = PyDict::new(py);
            keywords.set_item("write", false)?;
            array.call_method("setflags", (), Some(&keywords))?;
            Ok(array.unbind())
        };
        Ok(Self {
            position: zeros(&[bodies, 3])?,
            gradient: zeros(&[bodies, 3, 3])?,
            velocity: zeros(&[bodies, 3])?,
            gradient_rate: zeros(&[bodies, 3, 3])?,
            contraction: zeros(&[bodies, 3, 3])?,
            gap: zeros(&[bodies])?,
        })
    }

    /// Writes the state into the arrays.
    ///
    /// # Errors
    /// [`Stop`] if the state is outside the model, which an accepted one is not; gaps are then what they were.
    pub fn refresh(&self, py: Python<'_>, stepper: &SteppedRun) -> Result<(), Stop> {
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
        write(py, &self.position, &vectors(&|body| stepper.motion(body).placement.position));
        write(py, &self.gradient, &matrices(&|body| stepper.motion(body).placement.gradient));
        write(py, &self.velocity, &vectors(&|body| stepper.motion(body).velocity.velocity));
        write(py, &self.gradient_rate, &matrices(&|body| stepper.motion(body).velocity.gradient_rate));
        write(py, &self.contraction, &matrices(&|body| state.contraction(model, body).unwrap_or(no_matrix)));
        write(py, &self.gap, &stepper.gaps()?);
        Ok(())
    }
}

/// Copies numbers into an array that only we write to.
fn write(py: Python<'_>, array: &Py<PyArrayDyn<f64>>, numbers: &[f64]) {
    let array = array.bind(py);
    debug_assert_eq!(array.len(), numbers.len());
    // SAFETY: the array was made here, contiguous and of this length; the interpreter's lock is held, and Python cannot
    // write to it, so that nobody else has a reference into it while these numbers are copied.
    if let Ok(slice) = unsafe { array.as_slice_mut() } {
        slice.copy_from_slice(numbers);
    }
}
