//! `Batch`: many simulations of one scene side by side, stepped on a pool of threads, with their states in one array a
//! quantity.
//!
//! Members know nothing of each other: each is a [`SteppedRun`] of its own, so that nothing depends on the number of
//! threads, and a member that cannot go on leaves the others alone.

use crate::arrays::{Arrays, StateNumbers};
use crate::convert::{array, numbers_of_members};
use crate::errors;
use crate::load::{body_index, check_point, load_of};
use crate::many::{Together, workers};
use crate::members::{chosen, on_threads};
use crate::monitor::PythonMonitor;
use crate::saved;
use crate::scene::Scene;
use crate::start::GivenState;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::suggestion;
use gyration_sim::{Reason, SteppedRun};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::num::NonZeroUsize;

/// A batch has no more members: each has a state, a stepper and a checkpoint of its own.
const MOST_MEMBERS: usize = 1_000_000;

/// Simulations of one scene.
#[pyclass(module = "gyration", name = "Batch")]
pub struct Batch {
    scene: Scene,
    word: u64,
    members: Vec<SteppedRun>,
    /// Why each came no further.
    reasons: Vec<Option<String>>,
    /// The checkpoint of the scene's start.
    first: Vec<u8>,
    threads: NonZeroUsize,
    columns: Vec<(String, usize)>,
    arrays: Arrays,
}

impl Batch {
    /// Does something to members, by their places in `which`, on the threads of the batch and without the lock; shows
    /// their states, and gives what came of it. Ctrl-C is raised when all have ended a step.
    fn each<T: Send>(
        &mut self,
        py: Python<'_>,
        which: &[usize],
        work: impl Fn(usize, &mut SteppedRun, &mut Together<'_>) -> T + Sync,
    ) -> PyResult<Vec<T>> {
        let mut monitor = PythonMonitor::new(None)?.of_runs();
        let (members, threads) = (&mut self.members, self.threads);
        let done = py.detach(|| {
            on_threads(members, which, threads, &mut monitor, |place, run, together| {
                let came = work(place, run, together);
                (came, StateNumbers::of(run))
            })
        });
        let mut all = Vec::with_capacity(which.len());
        for (member, (came, numbers)) in which.iter().zip(done) {
            self.arrays.show(py, *member, numbers).map_err(|stop| errors::stopped(&stop))?;
            all.push(came);
        }
        monitor.finish(py)?;
        Ok(all)
    }

    /// Puts others in the place of members, all or none of them.
    fn replace(
        &mut self,
        py: Python<'_>,
        which: &[usize],
        other: impl Fn(usize, &SteppedRun) -> PyResult<SteppedRun> + Sync,
    ) -> PyResult<()> {
        let others = self.each(py, which, |place, run, _| other(place, run))?;
        let others = others.into_iter().collect::<PyResult<Vec<_>>>()?;
        for (member, other) in which.iter().zip(others) {
            (self.members[*member], self.reasons[*member]) = (other, None);
            let numbers = StateNumbers::of(&self.members[*member]);
            self.arrays.show(py, *member, numbers).map_err(|stop| errors::stopped(&stop))?;
        }
        Ok(())
    }

    fn all(&self) -> Vec<usize> {
        (0..self.members.len()).collect()
    }

    /// Steps each member to a time of its own; whether each has come there.
    fn go<'py>(&mut self, py: Python<'py>, until: &[f64]) -> PyResult<Bound<'py, PyAny>> {
        if let Some(time) = until.iter().find(|time| !time.is_finite()) {
            return Err(errors::arguments(format!("a member is to go to {time} s\n  fix: give times in seconds")));
        }
        let came = self.each(py, &self.all(), |place, run, together| run.advance(until[place], together))?;
        let arrived: Vec<bool> = came.iter().map(Result::is_ok).collect();
        for (reason, came) in self.reasons.iter_mut().zip(came) {
            let stop = came.err().filter(|stop| stop.reason != Reason::Interrupted);
            *reason = stop.map(|stop| gyration_sim::Outcome::Stopped(stop).in_words());
        }
        Ok(PyArray1::from_vec(py, arrived).into_any())
    }
}

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (scene, n, *, threads=None))]
    fn new(py: Python<'_>, scene: &Bound<'_, PyAny>, n: i64, threads: Option<i64>) -> PyResult<Self> {
        let scene = Scene::from_argument(scene)?.complete(py)?;
        let count = usize::try_from(n).ok().and_then(NonZeroUsize::new);
        let count = count.filter(|count| count.get() <= MOST_MEMBERS);
        let count = count.ok_or_else(|| {
            errors::arguments(format!("a batch of {n}\n  fix: give a number of members from 1 to {MOST_MEMBERS}"))
        })?;
        let threads = workers(threads)?.min(count);
        let members = py.detach(|| {
            let first = SteppedRun::new(scene.inner.built())?;
            let others = (1..count.get()).map(|_| first.copy()).collect::<Result<Vec<_>, _>>()?;
            Ok(std::iter::once(first).chain(others).collect::<Vec<_>>())
        });
        let members = members.map_err(errors::run)?;
        let (word, first, columns) = (saved::scene_word(&scene), members[0].checkpoint(), members[0].columns());
        let arrays = Arrays::new(py, &[count.get(), members[0].model().bodies.len()])?;
        let reasons = vec![None; count.get()];
        let mut this = Self { scene, word, members, reasons, first, threads, columns, arrays };
        this.each(py, &this.all(), |_, _, _| ())?;
        Ok(this)
    }

    fn __len__(&self) -> usize {
        self.members.len()
    }

    /// The names of the bodies, in order.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.members[0].model().names().map(str::to_owned).collect()
    }

    /// The time that each member has reached [s], (members,).
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        array(py, self.members.iter().map(SteppedRun::time).collect(), &[self.members.len()])
    }

    /// Positions of the centres of mass in space [m], (members, bodies, 3). Refreshed in place: take a copy to keep
    /// one.
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.position.bind(py).clone()
    }

    /// Placement gradients P, (members, bodies, 3, 3). Refreshed in place.
    #[getter]
    #[pyo3(name = "P")]
    fn gradient<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.gradient.bind(py).clone()
    }

    /// Velocities of the centres of mass [m/s], (members, bodies, 3). Refreshed in place.
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.velocity.bind(py).clone()
    }

    /// Rates of the placement gradients [1/s], (members, bodies, 3, 3). Refreshed in place.
    #[getter]
    #[pyo3(name = "Pdot")]
    fn gradient_rate<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.gradient_rate.bind(py).clone()
    }

    /// Contractions G, (members, bodies, 3, 3); NaN for bodies that do not contract. Refreshed in place.
    #[getter]
    #[pyo3(name = "G")]
    fn contraction<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.contraction.bind(py).clone()
    }

    /// Smallest gaps to anything that a body has a contact with [m], (members, bodies); infinite without contact.
    /// Refreshed in place.
    #[getter]
    fn gap<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        self.arrays.gap.bind(py).clone()
    }

    /// Why each member came no further in the last advance, in words; None if it did.
    #[getter]
    fn reasons(&self) -> Vec<Option<&str>> {
        self.reasons.iter().map(Option::as_deref).collect()
    }

    /// Steps all members to a time [s], one for all or (members,), on which each ends a step; one that is there or
    /// beyond stays. Returns whether each has come there, (members,): one that cannot go on stays where it is, and
    /// :attr:`reasons` says why.
    fn advance<'py>(&mut self, py: Python<'py>, until: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let until = numbers_of_members("until", until, self.members.len(), &[])?;
        self.go(py, &until)
    }

    /// Steps each member by a time [s] from where it is, one for all or (members,); returns what :meth:`advance` does.
    fn advance_by<'py>(&mut self, py: Python<'py>, dt: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let by = numbers_of_members("dt", dt, self.members.len(), &[])?;
        if let Some(back) = by.iter().find(|by| **by < 0.0) {
            return Err(errors::arguments(format!("`dt` is {back}\n  fix: give times in seconds, zero or above")));
        }
        let until: Vec<f64> = self.members.iter().zip(by).map(|(member, by)| member.time() + by).collect();
        self.go(py, &until)
    }

    /// Applies a load to a body of members, as :meth:`Simulation.apply` does: ``force`` [N], ``torque`` [N m] and
    /// ``at`` [m], (3,) or (members, 3), ``moment`` [N m], (3, 3) or (members, 3, 3). ``members`` are numbers or a
    /// mask; all without it.
    #[pyo3(signature = (body, force=None, moment=None, torque=None, at=None, *, members=None))]
    fn apply(
        &mut self,
        body: &Bound<'_, PyAny>,
        force: Option<&Bound<'_, PyAny>>,
        moment: Option<&Bound<'_, PyAny>>,
        torque: Option<&Bound<'_, PyAny>>,
        at: Option<&Bound<'_, PyAny>>,
        members: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let model = self.members[0].model();
        let (index, which) = (body_index(model, body)?, chosen(members, self.members.len())?);
        let center = model.bodies[index].solid.mass.center;
        check_point(force, at)?;
        let read = |name: &str, object: Option<&Bound<'_, PyAny>>, of_one: &[usize]| {
            object.map(|object| numbers_of_members(name, object, which.len(), of_one)).transpose()
        };
        let vectors = |name, object| read(name, object, &[3]);
        let (force, torque, at) = (vectors("force", force)?, vectors("torque", torque)?, vectors("at", at)?);
        let moment = read("moment", moment, &[3, 3])?;
        let loads = (0..which.len()).map(|place| {
            let vector =
                |all: &Option<Vec<f64>>| all.as_ref().map(|all| Vec3::from_column_slice(&all[3 * place..][..3]));
            let moment = moment.as_ref().map(|all| Mat3::from_row_slice(&all[9 * place..][..9]));
            let (force, torque) = (vector(&force).unwrap_or_default(), vector(&torque).unwrap_or_default());
            load_of(force, moment.unwrap_or_default(), torque, vector(&at), &center)
        });
        let loads: Vec<_> = loads.collect();
        if !loads.iter().all(gyration::load::Applied::is_finite) {
            return Err(errors::arguments("a load has a number that is not finite\n  fix: give finite numbers"));
        }
        for (member, load) in which.iter().zip(loads) {
            self.members[*member].apply(index, load).map_err(|refusal| errors::arguments(refusal.to_string()))?;
        }
        Ok(())
    }

    /// Puts constant drives Q [Pa], (3, 3) or (members, 3, 3), in the place of what the scene gives in time, as
    /// :meth:`Simulation.set_drive` does.
    #[pyo3(signature = (body, drive, *, members=None))]
    fn set_drive(
        &mut self,
        body: &Bound<'_, PyAny>,
        drive: &Bound<'_, PyAny>,
        members: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let index = body_index(self.members[0].model(), body)?;
        let which = chosen(members, self.members.len())?;
        let drives = numbers_of_members("drive", drive, which.len(), &[3, 3])?;
        // Before any of them is set.
        if let Some(number) = drives.iter().find(|number| !number.is_finite()) {
            return Err(errors::arguments(format!("`drive` holds {number}\n  fix: give finite numbers [Pa]")));
        }
        for (member, drive) in which.iter().zip(drives.as_chunks::<9>().0) {
            let set = self.members[*member].set_drive(index, Mat3::from_row_slice(drive));
            set.map_err(|refusal| errors::arguments(refusal.to_string()))?;
        }
        Ok(())
    }

    /// Brings members, by numbers or a mask, back to the start of the scene, with nothing applied; all without them.
    #[pyo3(signature = (members=None))]
    fn reset(&mut self, py: Python<'_>, members: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let which = chosen(members, self.members.len())?;
        let first = std::mem::take(&mut self.first);
        let replaced = self.replace(py, &which, |_, run| run.restored(&first).map_err(errors::run));
        self.first = first;
        replaced
    }

    /// Begins members anew from states, as :meth:`Simulation.set_state` does; ``time`` [s] is one for all or
    /// (members,), the arrays are (members, bodies, …) of those members. Nothing has changed if it raises an error.
    #[pyo3(signature = (members=None, *, time=None, position=None, P=None, velocity=None, Pdot=None, G=None))]
    #[expect(non_snake_case, clippy::too_many_arguments, reason = "keywords of Python")]
    fn set_state(
        &mut self,
        py: Python<'_>,
        members: Option<&Bound<'_, PyAny>>,
        time: Option<&Bound<'_, PyAny>>,
        position: Option<&Bound<'_, PyAny>>,
        P: Option<&Bound<'_, PyAny>>,
        velocity: Option<&Bound<'_, PyAny>>,
        Pdot: Option<&Bound<'_, PyAny>>,
        G: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let which = chosen(members, self.members.len())?;
        let given = GivenState { position, gradient: P, velocity, gradient_rate: Pdot, contraction: G };
        let starts = given.read(&[which.len(), self.members[0].model().bodies.len()])?;
        let times = time.map(|time| numbers_of_members("time", time, which.len(), &[])).transpose()?;
        self.replace(py, &which, |place, run| {
            let time = times.as_ref().map_or_else(|| run.time(), |times| times[place]);
            let begun = run.begun_anew(time, &starts.of_member(run, place)).map_err(errors::run)?;
            begun.map_err(|refusal| errors::arguments(format!("member {}: {refusal}", which[place])))
        })
    }

    /// The states of all members, a list of bytes as :attr:`Simulation.state` has them, of this batch or of simulations
    /// of an equal scene.
    #[getter(states)]
    fn get_states<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyBytes>> {
        self.members.iter().map(|member| PyBytes::new(py, &saved::state_of(member, self.word))).collect()
    }

    #[setter(states)]
    fn put_states(&mut self, py: Python<'_>, states: Vec<Vec<u8>>) -> PyResult<()> {
        if states.len() != self.members.len() {
            let problem = format!("{} states for {} members", states.len(), self.members.len());
            return Err(errors::arguments(format!("{problem}\n  fix: give one for each member")));
        }
        let word = self.word;
        self.replace(py, &self.all(), |place, run| {
            run.restored(saved::checkpoint_of(&states[place], word)?).map_err(errors::run)
        })
    }

    /// The names of the columns that a recording would have.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.columns.iter().map(|(name, _)| name.clone()).collect()
    }

    /// The present value of a column of each member, (members,): ``batch["ball.z"]``.
    fn __getitem__<'py>(&mut self, py: Python<'py>, column: &str) -> PyResult<Bound<'py, PyAny>> {
        if column == "t" {
            return self.time(py);
        }
        let Some(place) = self.columns.iter().find(|(name, _)| name == column).map(|(_, place)| *place) else {
            let names = self.columns();
            let fix = suggestion(column, names.iter().map(String::as_str), "columns besides `t`");
            return Err(PyKeyError::new_err(format!("there is no column `{column}`: {fix}")));
        };
        let rows = self.each(py, &self.all(), |_, run, _| Ok(run.row()?[place]))?;
        let values = rows.into_iter().collect::<Result<Vec<f64>, _>>().map_err(|stop| errors::stopped(&stop))?;
        array(py, values, &[self.members.len()])
    }

    fn _ipython_key_completions_(&self) -> Vec<String> {
        std::iter::once("t".to_owned()).chain(self.columns()).collect()
    }

    fn __repr__(&self) -> String {
        format!("<gyration.Batch {}: {} members>", self.scene.inner.name(), self.members.len())
    }
}
