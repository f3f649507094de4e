//! `Simulation`: a run that is stepped by hand, with its state as arrays, loads that can be applied and drives that can
//! be changed.
//!
//! The arrays belong to the simulation: each step writes into them, and they cannot be written to. Whoever keeps one
//! over a step sees the new state in it, and takes a copy for the old one.

use crate::arrays::{Arrays, StateNumbers};
use crate::convert::array;
use crate::errors;
use crate::load::{body_index, check_point, load_of, matrix, vector};
use crate::monitor::PythonMonitor;
use crate::recording::Recording;
use crate::run::{RecordOptions, exists, place};
use crate::saved;
use crate::scene::Scene;
use crate::start::GivenState;
use gyration::load::Loads;
use gyration_record::remove;
use gyration_scene::suggestion;
use gyration_sim::events::EVENT_KINDS;
use gyration_sim::{Reason, SteppedRun};
use numpy::PyArrayDyn;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyType};
use std::path::PathBuf;
use std::sync::Arc;
use tempfile::TempDir;

/// Of what another process makes a simulation again: scene and state.
type SimulationParts<'py> = (Scene, Bound<'py, PyBytes>);

/// A run stepped by hand.
#[pyclass(module = "gyration", name = "Simulation")]
pub struct Simulation {
    scene: Scene,
    /// Tells its states from those of other scenes.
    word: u64,
    stepper: SteppedRun,
    columns: Vec<(String, usize)>,
    arrays: Arrays,
    /// Where it was recorded last, and what removes the folder if nobody asked for it.
    recorded: Option<(PathBuf, Option<Arc<TempDir>>)>,
}

impl Simulation {
    fn of(py: Python<'_>, scene: Scene, stepper: SteppedRun) -> PyResult<Self> {
        let (word, columns) = (saved::scene_word(&scene), stepper.columns());
        let arrays = Arrays::new(py, &[stepper.model().bodies.len()])?;
        let this = Self { scene, word, stepper, columns, arrays, recorded: None };
        this.show(py)?;
        Ok(this)
    }

    /// Shows the state in the arrays.
    fn show(&self, py: Python<'_>) -> PyResult<()> {
        self.arrays.show(py, 0, StateNumbers::of(&self.stepper)).map_err(|stop| errors::stopped(&stop))
    }

    /// Goes on with another stepper; a recording ends.
    fn put(&mut self, py: Python<'_>, stepper: SteppedRun) -> PyResult<()> {
        self.stepper.stop_recording().map_err(errors::run)?;
        self.stepper = stepper;
        self.show(py)
    }

    /// Lets the stepper go on without the lock; then shows the new state, whether it came to its end or not. False if
    /// `progress` has stopped it before.
    pub fn go(&mut self, py: Python<'_>, until: Option<f64>, monitor: &mut PythonMonitor) -> PyResult<bool> {
        let stepper = &mut self.stepper;
        let stepped = py.detach(|| match until {
            Some(until) => stepper.advance(until, monitor),
            None => stepper.step(),
        });
        let shown = self.arrays.show(py, 0, StateNumbers::of(&self.stepper));
        if let Some(failure) = self.stepper.recording_failure() {
            return Err(errors::record(failure));
        }
        match stepped.and(shown) {
            Ok(()) => Ok(!monitor.is_over()),
            Err(stop) if stop.reason == Reason::Interrupted => Ok(false),
            Err(stop) => Err(errors::stopped(&stop)),
        }
    }
}

#[pymethods]
impl Simulation {
    #[new]
    pub fn new(py: Python<'_>, scene: &Bound<'_, PyAny>) -> PyResult<Self> {
        let scene = Scene::from_argument(scene)?.complete(py)?;
        let stepper = py.detach(|| SteppedRun::new(scene.inner.built())).map_err(errors::run)?;
        Self::of(py, scene, stepper)
    }

    /// The time reached [s].
    #[getter]
    fn time(&self) -> f64 {
        self.stepper.time()
    }

    /// The scene's end [s]; a simulation may go on past it.
    #[getter]
    pub fn end(&self) -> f64 {
        self.scene.inner.built().plan.end
    }

    /// The names of the bodies, in order.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.stepper.model().names().map(str::to_owned).collect()
    }

    /// Positions of the centres of mass in space [m], (bodies, 3). An array of its own at each access.
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        as_it_is(self.arrays.position.bind(py))
    }

    /// Placement gradients P, (bodies, 3, 3); rotations for rigid bodies.
    #[getter]
    #[pyo3(name = "P")]
    fn gradient<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        as_it_is(self.arrays.gradient.bind(py))
    }

    /// Velocities of the centres of mass [m/s], (bodies, 3).
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        as_it_is(self.arrays.velocity.bind(py))
    }

    /// Rates of the placement gradients [1/s], (bodies, 3, 3).
    #[getter]
    #[pyo3(name = "Pdot")]
    fn gradient_rate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        as_it_is(self.arrays.gradient_rate.bind(py))
    }

    /// Contractions G, (bodies, 3, 3); NaN for bodies that do not contract.
    #[getter]
    #[pyo3(name = "G")]
    fn contraction<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        as_it_is(self.arrays.contraction.bind(py))
    }

    /// Smallest gaps to anything that a body has a contact with [m], (bodies,); infinite without contact. Refreshed in
    /// place by each step.
    #[getter]
    fn gap<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        as_it_is(self.arrays.gap.bind(py))
    }

    /// The angular velocity of a body in axes of space [rad/s]; of one that deforms, that of its mean rotation.
    fn angular_velocity<'py>(&self, py: Python<'py>, body: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let spin = self.stepper.motion(body_index(self.stepper.model(), body)?).angular_velocity();
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
        if until < self.time() {
            let time = self.time();
            return Err(errors::arguments(format!(
                "`until` is {until} s, and the simulation is at {time} s\n  fix: `until` counts from the start; \
                 advance_by(dt) goes on by dt"
            )));
        }
        let mut monitor = PythonMonitor::new(progress)?;
        let gone = self.go(py, Some(until), &mut monitor);
        monitor.finish(py)?;
        gone?;
        Ok(self.time())
    }

    /// The same by a time [s] from where the simulation is.
    #[pyo3(signature = (dt, *, progress=None))]
    fn advance_by(&mut self, py: Python<'_>, dt: f64, progress: Option<&Bound<'_, PyAny>>) -> PyResult<f64> {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(errors::arguments(format!("`dt` is {dt}\n  fix: give a time in seconds, above zero")));
        }
        self.advance(py, self.time() + dt, progress)
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
        let index = body_index(self.stepper.model(), body)?;
        check_point(force, at)?;
        let given = |name, object: Option<&_>| object.map(|object| vector(name, object)).transpose();
        let force = given("force", force)?.unwrap_or_default();
        let moment = moment.map(|moment| matrix("moment", moment)).transpose()?.unwrap_or_default();
        let (torque, at) = (given("torque", torque)?.unwrap_or_default(), given("at", at)?);
        let load = load_of(force, moment, torque, at, &self.stepper.model().bodies[index].solid.mass.center);
        self.stepper.apply(index, load).map_err(|refusal| errors::arguments(refusal.to_string()))
    }

    /// Puts a constant drive Q [Pa], (3, 3), in the place of the drive that the scene gives in time; feedback stays.
    /// The work is ``works()["drive"]``.
    fn set_drive(&mut self, body: &Bound<'_, PyAny>, drive: &Bound<'_, PyAny>) -> PyResult<()> {
        let (index, drive) = (body_index(self.stepper.model(), body)?, matrix("drive", drive)?);
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
            let names = self.columns();
            let fix = suggestion(column, names.iter().map(String::as_str), "columns besides `t`");
            return Err(PyKeyError::new_err(format!("there is no column `{column}`: {fix}")));
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
        format!("<gyration.Simulation {} at t = {} s>", self.scene.inner.name(), self.time())
    }

    fn _ipython_key_completions_(&self) -> Vec<String> {
        std::iter::once("t".to_owned()).chain(self.columns()).collect()
    }

    /// All that its future depends on, as bytes: time, placements, velocities, G, what the fluid remembers, loads and
    /// drives that are held, memory of the solver; and works and events so far.
    ///
    /// Set to what it was once, of this simulation or another one of an equal scene, the simulation is there again, and
    /// goes on to the same bytes. Raises ``ArgumentError`` if it is a state of another scene.
    #[getter(state)]
    fn get_state<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &saved::state_of(&self.stepper, self.word))
    }

    #[setter(state)]
    fn put_state(&mut self, py: Python<'_>, state: &[u8]) -> PyResult<()> {
        let checkpoint = saved::checkpoint_of(state, self.word)?;
        let restored = py.detach(|| self.stepper.restored(checkpoint)).map_err(errors::run)?;
        self.put(py, restored)
    }

    /// Begins anew from a state, as if the scene started there: what is not given is as it is now.
    ///
    /// ``time`` [s]; ``position`` [m] and ``velocity`` [m/s], (bodies, 3); ``P``, ``Pdot`` [1/s] and ``G``, (bodies, 3,
    /// 3). ``P`` without ``Pdot`` keeps the velocity gradient Pdot P⁻¹. Applied loads and drives stay, and so does what
    /// the fluid remembers. Works count from here, events are forgotten, a recording ends.
    ///
    /// Raises ``ArgumentError`` for what a body cannot have (a P of a rigid body that is no rotation, what joints do
    /// not allow), ``RunError`` for a state outside the model; nothing has changed then.
    #[pyo3(signature = (*, time=None, position=None, P=None, velocity=None, Pdot=None, G=None))]
    #[expect(non_snake_case, clippy::too_many_arguments, reason = "keywords of Python")]
    fn set_state(
        &mut self,
        py: Python<'_>,
        time: Option<f64>,
        position: Option<&Bound<'_, PyAny>>,
        P: Option<&Bound<'_, PyAny>>,
        velocity: Option<&Bound<'_, PyAny>>,
        Pdot: Option<&Bound<'_, PyAny>>,
        G: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let given = GivenState { position, gradient: P, velocity, gradient_rate: Pdot, contraction: G };
        let starts = given.read(&[self.stepper.model().bodies.len()])?.of_member(&self.stepper, 0);
        let time = time.unwrap_or_else(|| self.time());
        let begun = py.detach(|| self.stepper.begun_anew(time, &starts)).map_err(errors::run)?;
        self.put(py, begun.map_err(|refusal| errors::arguments(refusal.to_string()))?)
    }

    /// Another simulation that stands where this one does; what is done to one is not done to the other. It is not
    /// recorded.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let stepper = py.detach(|| self.stepper.copy()).map_err(errors::run)?;
        Self::of(py, self.scene.clone(), stepper)
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.copy(py)
    }

    /// For pickle: the scene and the state.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, SimulationParts<'py>)> {
        let again = py.import("gyration._gyration")?.getattr("_simulation")?;
        Ok((again, (self.scene.clone(), self.get_state(py))))
    }

    /// Writes scene and state into a file, see :meth:`load`. Raises ``FileError`` if it cannot be written.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        saved::save(&path, &self.scene, &saved::state_of(&self.stepper, self.word))
    }

    /// A simulation from a file that :meth:`save` wrote: it goes on to the same bytes. Raises ``FileError`` if the file
    /// cannot be read or is none, ``ArgumentError`` if a mesh or another version of the package has made it unfit.
    #[classmethod]
    fn load(kind: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        let (scene, state) = saved::read(kind.py(), &path)?;
        simulation_again(kind.py(), scene, &state)
    }

    /// Records from now on: the present state, and samples at the multiples of ``time.sample`` of the scene.
    ///
    /// ``path`` is a new folder, replaced with ``force=True``; without it the recording lives in a temporary one, as
    /// long as it is in use. An earlier recording of this simulation ends. Raises ``FileError`` if nothing can be
    /// written there; an earlier one then goes on.
    #[pyo3(signature = (path=None, *, force=false))]
    fn record(&mut self, path: Option<PathBuf>, force: bool) -> PyResult<()> {
        // A recording that is there goes on as a run, not here.
        if let Some(path) = path.as_ref().filter(|path| !force && path.symlink_metadata().is_ok()) {
            return Err(exists(path, "replace it by force=True, or choose another name"));
        }
        let options = RecordOptions { output: path, resume: false, force };
        let (path, kept) = place(&options, self.scene.inner.name())?;
        // One that it takes the place of must not write there any more, however its folder is called.
        let is_own = |own: &PathBuf| matches!((own.canonicalize(), path.canonicalize()), (Ok(a), Ok(b)) if a == b);
        if self.recorded.take_if(|(own, _)| is_own(own)).is_some() {
            self.stepper.stop_recording().map_err(errors::run)?;
        }
        if path.symlink_metadata().is_ok() {
            remove(&path).map_err(errors::record)?;
        }
        self.stepper.record(&self.scene.inner, &gyration_cli::provenance(), &path).map_err(errors::run)?;
        self.recorded = Some((path, kept));
        Ok(())
    }

    /// What :meth:`record` has recorded so far, as it stands: plots, arrays and report of what was simulated by hand.
    /// Its outcome is ``unfinished``. Raises ``ArgumentError`` if nothing is recorded, ``FileError`` if that failed.
    #[getter]
    fn recording(&mut self) -> PyResult<Recording> {
        self.stepper.flush().map_err(errors::run)?;
        let nothing = || errors::arguments("nothing is recorded\n  fix: call record() before the steps");
        let (path, kept) = self.recorded.as_ref().ok_or_else(nothing)?;
        let told = format!("simulated by hand, recorded until now at t = {} s", self.stepper.time());
        Recording::of_run(path, kept.clone(), Some(told))
    }
}

/// A copy of what the simulation shows, which cannot be written to: a number that is set there would move nothing.
fn as_it_is<'py>(shown: &Bound<'py, PyArrayDyn<f64>>) -> PyResult<Bound<'py, PyAny>> {
    let copy = shown.call_method0("copy")?;
    copy.getattr("flags")?.setattr("writeable", false)?;
    Ok(copy)
}

/// A simulation again, from its scene and a state.
#[pyfunction]
#[pyo3(name = "_simulation")]
pub fn simulation_again(py: Python<'_>, scene: Scene, state: &[u8]) -> PyResult<Simulation> {
    let scene = scene.complete(py)?;
    let checkpoint = saved::checkpoint_of(state, saved::scene_word(&scene))?;
    let stepper = py.detach(|| SteppedRun::resume(scene.inner.built(), checkpoint)).map_err(errors::run)?;
    Simulation::of(py, scene, stepper)
}
