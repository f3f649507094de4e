//! `Simulation`: a run that is stepped by hand, with its state as arrays, loads that can be applied and drives that can
//! be changed.
//!
//! The arrays belong to the simulation: each step writes into them, and they cannot be written to. Whoever keeps one
//! over a step sees the new state in it, and takes a copy for the old one.

use crate::arrays::Arrays;
use crate::convert::{array, says_stop, shown};
use crate::errors;
use crate::monitor::PythonMonitor;
use crate::scene::Scene;
use gyration::load::{Applied, Loads};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::{Scene as Built, suggestion};
use gyration_sim::events::EVENT_KINDS;
use gyration_sim::{Reason, SteppedRun};
use numpy::PyArrayDyn;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// A run stepped by hand.
#[pyclass(module = "gyration", name = "Simulation")]
pub struct Simulation {
    scene: Arc<Built>,
    stepper: SteppedRun,
    /// What is applied to each body.
    applied: Vec<Applied>,
    columns: Vec<(String, usize)>,
    arrays: Arrays,
}

impl Simulation {
    /// The index of a body given by name or number.
    fn index(&self, body: &Bound<'_, PyAny>) -> PyResult<usize> {
        let model = self.stepper.model();
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

    /// Lets the stepper go on without the lock; then shows the new state, whether it came to its end or not. False if
    /// `progress` has stopped it before.
    fn go(&mut self, py: Python<'_>, until: Option<f64>, monitor: &mut PythonMonitor) -> PyResult<bool> {
        let stepper = &mut self.stepper;
        let stepped = py.detach(|| match until {
            Some(until) => stepper.advance(until, monitor),
            None => stepper.step(),
        });
        let refreshed = self.arrays.refresh(py, &self.stepper);
        match stepped.and(refreshed) {
            Ok(()) => Ok(!monitor.is_over()),
            Err(stop) if stop.reason == Reason::Interrupted => Ok(false),
            Err(stop) => Err(errors::stopped(&stop)),
        }
    }
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(py: Python<'_>, scene: &Bound<'_, PyAny>) -> PyResult<Self> {
        let scene = Scene::ready(scene)?;
        let stepper = py.detach(|| SteppedRun::new(scene.built())).map_err(errors::run)?;
        let bodies = stepper.model().bodies.len();
        let arrays = Arrays::new(py, bodies)?;
        arrays.refresh(py, &stepper).map_err(|stop| errors::stopped(&stop))?;
        Ok(Self { scene, columns: stepper.columns(), stepper, applied: vec![Applied::default(); bodies], arrays })
    }

    /// The time reached [s].
    #[getter]
    fn time(&self) -> f64 {
        self.stepper.time()
    }

    /// The scene's end [s]; a simulation may go on past it.
    #[getter]
    fn end(&self) -> f64 {
        self.scene.built().plan.end
    }

    /// The names of the bodies, in order.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.stepper.model().names().map(str::to_owned).collect()
    }

    /// Positions of the centres of mass [m], (bodies, 3). Refreshed in place by each step: take a copy to keep one.
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.position.bind(py).clone()
    }

    /// Placement gradients P, (bodies, 3, 3); rotations for rigid bodies. Refreshed in place by each step.
    #[getter]
    #[pyo3(name = "P")]
    fn gradient<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.gradient.bind(py).clone()
    }

    /// Velocities of the centres of mass [m/s], (bodies, 3). Refreshed in place by each step.
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.velocity.bind(py).clone()
    }

    /// Rates of the placement gradients [1/s], (bodies, 3, 3). Refreshed in place by each step.
    #[getter]
    #[pyo3(name = "Pdot")]
    fn gradient_rate<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.gradient_rate.bind(py).clone()
    }

    /// Contractions G, (bodies, 3, 3); NaN for bodies that do not contract. Refreshed in place by each step.
    #[getter]
    #[pyo3(name = "G")]
    fn contraction<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.contraction.bind(py).clone()
    }

    /// Smallest gaps to anything that a body has a contact with [m], (bodies,); infinite without contact. Refreshed in
    /// place by each step.
    #[getter]
    fn gap<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.gap.bind(py).clone()
    }

    /// The angular velocity of a body in axes of space [rad/s]; of one that deforms, that of its mean rotation.
    fn angular_velocity<'py>(&self, py: Python<'py>, body: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let spin = self.stepper.motion(self.index(body)?).angular_velocity();
        array(py, spin.as_slice().to_vec(), &[3])
    }

    /// Makes one step of the solver; returns the time reached [s].
    fn step(&mut self, py: Python<'_>) -> PyResult<f64> {
        self.go(py, None, &mut PythonMonitor::new(None)?)?;
        Ok(self.time())
    }

    /// Steps to a time [s], on which a step ends; returns the time reached. ``progress`` is True for a line on stderr,
    /// or a function of (time [s], until [s]) that stops by returning False; it cannot look at the simulation, which is
    /// under way.
    ///
    /// Raises ``RunError`` if the run cannot go on; the state stays that of the last step.
    #[pyo3(signature = (until, *, progress=None))]
    fn advance(&mut self, py: Python<'_>, until: f64, progress: Option<&Bound<'_, PyAny>>) -> PyResult<f64> {
        if !until.is_finite() {
            return Err(errors::arguments(format!("`until` is {until}\n  fix: give a time in seconds")));
        }
        let mut monitor = PythonMonitor::new(progress)?;
        let gone = self.go(py, Some(until), &mut monitor);
        monitor.finish(py)?;
        gone?;
        Ok(self.time())
    }

    /// Applies a load to a body, by name or number, in the place of what was applied before; it is held until the next
    /// call.
    ///
    /// ``force`` [N] in axes of space, at the centre of mass or at the material point ``at`` [m] (of the shape's frame,
    /// carried along with the body); ``moment`` the affine moment [N m], (3, 3), first index in space, second in the
    /// body, its entries held constant; ``torque`` [N m] in axes of space. Without arguments nothing is applied any
    /// more. The work is ``works()["load"]``.
    #[pyo3(signature = (body, force=None, moment=None, torque=None, at=None))]
    fn apply(
        &mut self,
        body: &Bound<'_, PyAny>,
        force: Option<&Bound<'_, PyAny>>,
        moment: Option<&Bound<'_, PyAny>>,
        torque: Option<&Bound<'_, PyAny>>,
        at: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let index = self.index(body)?;
        let given = |name, object: Option<&_>| object.map(|object| vector(name, object)).transpose();
        let force = given("force", force)?.unwrap_or_default();
        let center = self.stepper.model().bodies[index].solid.mass.center;
        let mut load = match given("at", at)? {
            None => Applied { force, ..Applied::default() },
            Some(at) => Applied::at_point(force, &(at - center)),
        };
        load.moment += moment.map(|moment| matrix("moment", moment)).transpose()?.unwrap_or_default();
        load.torque = given("torque", torque)?.unwrap_or_default();
        self.stepper.apply(index, load).map_err(|refusal| errors::arguments(refusal.to_string()))?;
        self.applied[index] = load;
        Ok(())
    }

    /// Puts a constant drive Q [Pa], (3, 3), in the place of the drive that the scene gives in time; feedback stays.
    /// The work is ``works()["drive"]``.
    fn set_drive(&mut self, body: &Bound<'_, PyAny>, drive: &Bound<'_, PyAny>) -> PyResult<()> {
        let (index, drive) = (self.index(body)?, matrix("drive", drive)?);
        self.stepper.set_drive(index, drive).map_err(|refusal| errors::arguments(refusal.to_string()))
    }

    /// Energies [J] by name, and the ``residual`` of the ledger.
    fn energies<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let ledger = self.stepper.ledger().map_err(|stop| errors::stopped(&stop))?;
        let found = PyDict::new(py);
        for (energy, value) in self.stepper.model().energies().iter().zip(ledger.energies) {
            found.set_item(energy.name(), value)?;
        }
        found.set_item("residual", ledger.residual)?;
        Ok(found)
    }

    /// Works done on the bodies since t = 0 [J], by name.
    fn works<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let ledger = self.stepper.ledger().map_err(|stop| errors::stopped(&stop))?;
        let found = PyDict::new(py);
        for (work, value) in self.stepper.model().works().iter().zip(ledger.works) {
            found.set_item(work.name(), value)?;
        }
        Ok(found)
    }

    /// Of each body the ``force`` [N] and the affine ``moment`` [N m], (3, 3), of its contacts.
    fn forces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for (index, name) in self.stepper.model().names().enumerate() {
            let Loads { force, moment } = self.stepper.contact_loads(index).map_err(|stop| errors::stopped(&stop))?;
            let contact = PyDict::new(py);
            contact.set_item("force", array(py, force.as_slice().to_vec(), &[3])?)?;
            contact.set_item("moment", array(py, moment.transpose().as_slice().to_vec(), &[3, 3])?)?;
            found.set_item(name, contact)?;
        }
        Ok(found)
    }

    /// The names of the columns that a recording would have.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.columns.iter().map(|(name, _)| name.clone()).collect()
    }

    /// The present value of a column: ``simulation["ball.z"]``.
    fn __getitem__(&mut self, column: &str) -> PyResult<f64> {
        if column == "t" {
            return Ok(self.time());
        }
        let Some((_, place)) = self.columns.iter().find(|(name, _)| name == column) else {
            let names = self.columns().join(", ");
            return Err(PyKeyError::new_err(format!("there is no column `{column}`: there are t, {names}")));
        };
        let row = self.stepper.row().map_err(|stop| errors::stopped(&stop))?;
        Ok(row[*place])
    }

    /// The events so far, each with ``time`` [s], ``kind`` and ``body``.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let model = self.stepper.model();
        let one = |event: &gyration_sim::events::Event| {
            let described = PyDict::new(py);
            described.set_item("time", event.time)?;
            described.set_item("kind", EVENT_KINDS[event.kind])?;
            described.set_item("body", model.name(event.body))?;
            Ok(described)
        };
        self.stepper.events().iter().map(one).collect()
    }

    /// Counters of the solver.
    #[getter]
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let counted = self.stepper.statistics();
        let found = PyDict::new(py);
        found.set_item("explicit_steps", counted.explicit_steps)?;
        found.set_item("implicit_steps", counted.implicit_steps)?;
        found.set_item("rejected", counted.rejected_error + counted.rejected_domain + counted.newton_failures)?;
        found.set_item("rate_evaluations", counted.rate_evaluations)?;
        Ok(found)
    }

    fn __repr__(&self) -> String {
        format!("<gyration.Simulation {} at t = {} s>", self.scene.name(), self.time())
    }
}

/// A vector in three numbers.
fn vector(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Vec3> {
    let numbers: PyResult<[f64; 3]> = object.extract();
    numbers.map(Vec3::from).map_err(|_| unfit(name, object, "three numbers"))
}

/// A matrix in three rows.
fn matrix(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Mat3> {
    let rows: PyResult<[[f64; 3]; 3]> = object.extract();
    rows.map(|rows| Mat3::from_fn(|row, column| rows[row][column]))
        .map_err(|_| unfit(name, object, "three rows of three numbers"))
}

fn unfit(name: &str, object: &Bound<'_, PyAny>, wanted: &str) -> PyErr {
    errors::arguments(format!("`{name}` is {}\n  fix: give {wanted}", shown(object)))
}

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
