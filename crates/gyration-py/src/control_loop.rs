//! `simulate`: a simulation that a callback looks at and changes at the beginning of each control interval.

use crate::convert::says_stop;
use crate::errors;
use crate::monitor::PythonMonitor;
use crate::simulation::Simulation;
use pyo3::prelude::*;

/// Steps a scene with a callback at the beginning of each control interval; False from it, or from ``progress``, ends
/// the run.
#[pyfunction]
#[pyo3(signature = (scene, dt, callback, until=None, *, progress=None))]
pub fn simulate(
    py: Python<'_>,
    scene: &Bound<'_, PyAny>,
    dt: f64,
    callback: &Bound<'_, PyAny>,
    until: Option<f64>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Py<Simulation>> {
    if !(dt > 0.0 && dt.is_finite()) {
        return Err(errors::arguments(format!("the control interval `dt` is {dt} s\n  fix: give a time above zero")));
    }
    if let Some(end) = until.filter(|end| end.is_nan()) {
        return Err(errors::arguments(format!("`until` is {end}\n  fix: give a time in seconds")));
    }
    let simulation = Py::new(py, Simulation::new(py, scene)?)?;
    let end = until.unwrap_or_else(|| simulation.borrow(py).end());
    let mut monitor = PythonMonitor::new(progress)?.until(end);
    let done = Intervals { dt, end }.run(py, &simulation, callback, &mut monitor);
    monitor.finish(py)?;
    done.map(|()| simulation)
}

/// Control intervals of one length up to an end [s].
struct Intervals {
    dt: f64,
    end: f64,
}

impl Intervals {
    /// Goes from one to the next, until somebody has had enough.
    fn run(
        &self,
        py: Python<'_>,
        simulation: &Py<Simulation>,
        callback: &Bound<'_, PyAny>,
        monitor: &mut PythonMonitor,
    ) -> PyResult<()> {
        let Self { dt, end } = *self;
        // Multiplied, not accumulated; an interval that rounding alone keeps from the end is the last one.
        for interval in (0_u64..).take_while(|interval| (*interval as f64 * dt) < end * (1.0 - 1e-12)) {
            if says_stop(&callback.call1((simulation,))?)? {
                break;
            }
            let next = ((interval + 1) as f64 * dt).min(end);
            // What the callback left running may hold the simulation: that is an error, not a wait.
            if !simulation.bind(py).try_borrow_mut()?.go(py, Some(next), monitor)? {
                break;
            }
        }
        Ok(())
    }
}
