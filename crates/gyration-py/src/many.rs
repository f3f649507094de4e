//! `run_many`: many scenes at once, on all cores, and what they ended with as arrays.
//!
//! Runs know nothing of each other: the results are in the order of the scenes and the same on any number of threads.
//! Nothing is written to disk. A run that cannot begin or has to stop is an entry with its reason.

use crate::convert::{Names, array};
use crate::errors::{self, reason};
use crate::monitor::PythonMonitor;
use crate::scene::Scene;
use gyration_record::RecordError;
use gyration_scene::{Scene as Built, suggestion};
use gyration_sim::rows::Fields;
use gyration_sim::{
    Job, Monitor, OpenLedgers, Outcome, Progress, Reason, RunError, RunPlan, Simulation, Sink, Verdict,
};
use gyration_threads::{Interruption, Threads, share};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::{HashMap, HashSet};
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What many runs ended with, an array a quantity.
#[pyclass(frozen, module = "gyration", name = "Runs")]
pub struct Runs {
    endings: Vec<RunEnd>,
    /// The columns kept, in the order in which they came up.
    columns: Vec<String>,
}

/// How one run ended.
struct RunEnd {
    outcome: String,
    reason: Option<String>,
    time: f64,
    steps: u64,
    rejected: u64,
    evaluations: u64,
    residual: f64,
    /// None if there is no ledger.
    ledger: Option<Verdict>,
    /// The last row by column.
    last: Vec<(String, f64)>,
}

/// Runs scenes and keeps what they ended with: of `keep` the columns at the end, of all columns if it is not given.
#[pyfunction]
#[pyo3(signature = (scenes, *, threads=None, keep=None, progress=None))]
pub fn run_many(
    py: Python<'_>,
    scenes: &Bound<'_, PyAny>,
    threads: Option<i64>,
    keep: Option<Names>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Runs> {
    let keep = keep.map(Names::list);
    // A scene and a dictionary of one go through their keys.
    if scenes.is_instance_of::<Scene>() || scenes.is_instance_of::<PyDict>() {
        return Err(errors::arguments("one scene in the place of many\n  fix: give a list of scenes"));
    }
    let scenes = scenes.try_iter()?.map(|scene| Scene::ready(&scene?)).collect::<PyResult<Vec<Arc<Built>>>>()?;
    let threads = workers(threads)?.min(NonZeroUsize::new(scenes.len()).unwrap_or(NonZeroUsize::MIN));
    if let Some(keep) = &keep {
        check_columns(&scenes, keep)?;
    }
    let mut monitor = PythonMonitor::new(progress)?.of_runs();
    let endings = py.detach(|| all(&scenes, threads, keep.as_deref(), &mut monitor));
    monitor.finish(py)?;
    let mut open = OpenLedgers::default();
    let runs = (0..).zip(&endings).filter(|(_, ending)| ending.ledger == Some(Verdict::Open));
    runs.for_each(|(run, _)| open.add(run));
    errors::warn(py, open.warning())?;
    let mut columns = keep.unwrap_or_default();
    if columns.is_empty() {
        let mut known = HashSet::new();
        let names = endings.iter().flat_map(|ending| ending.last.iter().map(|(name, _)| name));
        columns = names.filter(|name| known.insert(*name)).cloned().collect();
    }
    Ok(Runs { endings, columns })
}

/// How many threads are asked for, all cores if that is left open; fewer than none are none.
pub fn workers(threads: Option<i64>) -> PyResult<NonZeroUsize> {
    Threads::asked(threads.map(|count| usize::try_from(count).unwrap_or(0))).map_err(errors::threads)
}

/// Refuses columns that no scene has.
fn check_columns(scenes: &[Arc<Built>], keep: &[String]) -> PyResult<()> {
    let mut all: Vec<String> = Vec::new();
    for scene in scenes {
        if keep.iter().all(|name| all.contains(name)) {
            return Ok(());
        }
        let (model, plan) = (&scene.built().model, RunPlan::from(scene.built()));
        let (_, order) = Fields::new(model, &plan.extras).arrays(model);
        let known: HashSet<&String> = all.iter().collect();
        let new: Vec<String> = order.into_iter().filter(|name| !known.contains(name)).collect();
        all.extend(new);
    }
    match keep.iter().find(|name| !all.contains(*name)) {
        Some(name) if !scenes.is_empty() => {
            let fix = suggestion(name, all.iter().map(String::as_str), "columns");
            Err(errors::arguments(format!("no scene has the column `{name}`\n  fix: {fix}")))
        }
        _ => Ok(()),
    }
}

/// Runs all on so many threads, while this one looks at signals; those that are not begun when all are to stop are told
/// as such.
fn all(
    scenes: &[Arc<Built>],
    threads: NonZeroUsize,
    keep: Option<&[String]>,
    monitor: &mut PythonMonitor,
) -> Vec<RunEnd> {
    let stop = Arc::new(AtomicBool::new(false));
    let interruption = Interruption::in_force().raised_by(stop.clone());
    let mut endings: Vec<Option<RunEnd>> = scenes.iter().map(|_| None).collect();
    let mut done = 0;
    let run = |(index, scene): (usize, &Arc<Built>)| Some((index, interruption.within(|| run_one(scene, keep, &stop))));
    share(scenes.iter().enumerate(), threads, &stop, run, |ended| {
        for (index, ending) in ended {
            endings[index] = Some(ending);
            done += 1;
        }
        if !monitor.ask(f64::from(done), scenes.len() as f64) {
            stop.store(true, Ordering::Relaxed);
        }
    });
    let not_begun = || RunEnd::nothing("interrupted", "stopped before it began".to_owned());
    endings.into_iter().map(|ending| ending.unwrap_or_else(not_begun)).collect()
}

/// Keeps the last row.
#[derive(Default)]
struct Last(Vec<f64>);

impl Sink for Last {
    fn row(&mut self, _: f64, row: &[f64]) -> Result<(), RecordError> {
        self.0.clear();
        self.0.extend_from_slice(row);
        Ok(())
    }
}

/// Stops when all are to stop.
pub struct Together<'a>(pub &'a AtomicBool);

impl Monitor for Together<'_> {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        self.0.load(Ordering::Relaxed).then_some(Reason::Interrupted)
    }
}

fn run_one(scene: &Built, keep: Option<&[String]>, stop: &AtomicBool) -> RunEnd {
    ended(scene, keep, stop).unwrap_or_else(|error| RunEnd::nothing("failed", error.to_string()))
}

impl RunEnd {
    /// That of a run that did not take place.
    fn nothing(outcome: &str, reason: String) -> Self {
        Self {
            outcome: outcome.to_owned(),
            reason: Some(reason),
            time: f64::NAN,
            steps: 0,
            rejected: 0,
            evaluations: 0,
            residual: f64::NAN,
            ledger: None,
            last: Vec::new(),
        }
    }
}

fn ended(scene: &Built, keep: Option<&[String]>, stop: &AtomicBool) -> Result<RunEnd, RunError> {
    let job = Job::of(scene, &gyration_cli::provenance());
    let mut last = Last::default();
    // The other threads have other runs.
    let plan = RunPlan { threads: None, ..job.plan };
    let mut simulation = Simulation::new(job.model, job.start, plan)?;
    simulation.begin(&mut last)?;
    let outcome = simulation.run(&mut last, &mut Together(stop))?;
    // What is stopped has no last row of its own.
    simulation.record_last(&mut last)?.ok();
    let (statistics, run_state) = (simulation.statistics(), simulation.run_state());
    let (kind, why) = match &outcome {
        Outcome::Completed => ("completed".to_owned(), None),
        Outcome::AtRest { .. } => ("at_rest".to_owned(), None),
        Outcome::Stopped(stop) => (reason(stop), Some(outcome.in_words())),
    };
    Ok(RunEnd {
        outcome: kind,
        reason: why,
        time: simulation.state().time,
        steps: statistics.accepted(),
        rejected: statistics.rejected_error + statistics.rejected_domain + statistics.newton_failures,
        evaluations: statistics.rate_evaluations,
        residual: run_state.largest_residual / simulation.energy_in_play(),
        ledger: Some(Verdict::of(job.model, &simulation)),
        last: by_column(&job, &last.0, keep),
    })
}

/// The numbers of a row by their columns, in the order of the CSV.
fn by_column(job: &Job, row: &[f64], keep: Option<&[String]>) -> Vec<(String, f64)> {
    let (arrays, order) = Fields::new(job.model, &job.plan.extras).arrays(job.model);
    let mut places = HashMap::new();
    let mut at = 0;
    for array in &arrays {
        places.extend(array.columns.iter().zip(at..));
        at += array.row_len();
    }
    let wanted = order.iter().filter(|name| keep.is_none_or(|keep| keep.contains(name)));
    wanted.filter_map(|name| Some((name.clone(), *row.get(*places.get(name)?)?))).collect()
}

#[pymethods]
impl Runs {
    fn __len__(&self) -> usize {
        self.endings.len()
    }

    /// How each run ended: ``completed``, ``at_rest``, the reason of a stop, or ``failed``.
    #[getter]
    fn outcome(&self) -> Vec<&str> {
        self.endings.iter().map(|ending| ending.outcome.as_str()).collect()
    }

    /// Why each run ended early or failed, in words; None if it did not.
    #[getter]
    fn reason(&self) -> Vec<Option<&str>> {
        self.endings.iter().map(|ending| ending.reason.as_deref()).collect()
    }

    /// Whether the energy balance of each run is ``closed`` or ``open``; None of one that could not begin.
    #[getter]
    fn ledger(&self) -> Vec<Option<&str>> {
        self.endings.iter().map(|ending| ending.ledger.map(Verdict::name)).collect()
    }

    /// What there is of each run: end ``time`` [s], counters, ``residual`` of the ledger over the energy in play, and
    /// columns at the end.
    #[getter]
    fn columns(&self) -> Vec<String> {
        let told = ["time", "steps", "rejected", "evaluations", "residual"].map(str::to_owned);
        told.into_iter().chain(self.columns.iter().cloned()).collect()
    }

    /// A column as an array, a number a run: NaN where a run does not have it; counters are whole numbers.
    fn __getitem__<'py>(&self, py: Python<'py>, column: &str) -> PyResult<Bound<'py, PyAny>> {
        let counter = |of: fn(&RunEnd) -> u64| {
            let counts: Vec<i64> = self.endings.iter().map(|ending| of(ending) as i64).collect();
            Ok(PyArray1::from_vec(py, counts).into_any())
        };
        match column {
            "steps" => return counter(|ending| ending.steps),
            "rejected" => return counter(|ending| ending.rejected),
            "evaluations" => return counter(|ending| ending.evaluations),
            _ => {}
        }
        let of = |ending: &RunEnd| match column {
            "time" => ending.time,
            "residual" => ending.residual,
            _ => ending.last.iter().find(|(name, _)| name == column).map_or(f64::NAN, |(_, value)| *value),
        };
        if !self.columns().iter().any(|known| known == column) {
            let names = self.columns();
            let fix = suggestion(column, names.iter().map(String::as_str), "columns");
            return Err(PyKeyError::new_err(format!("there is no column `{column}`: {fix}")));
        }
        array(py, self.endings.iter().map(of).collect(), &[self.endings.len()])
    }

    /// All of it as a DataFrame of pandas.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = PyDict::new(py);
        columns.set_item("outcome", self.outcome())?;
        columns.set_item("reason", self.reason())?;
        columns.set_item("ledger", self.ledger())?;
        for name in self.columns() {
            columns.set_item(&name, self.__getitem__(py, &name)?)?;
        }
        py.import("pandas")?.call_method1("DataFrame", (columns,))
    }

    fn __repr__(&self) -> String {
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for outcome in self.outcome() {
            match counts.iter_mut().find(|(known, _)| *known == outcome) {
                Some((_, count)) => *count += 1,
                None => counts.push((outcome, 1)),
            }
        }
        let counts: Vec<String> = counts.iter().map(|(outcome, count)| format!("{count} {outcome}")).collect();
        format!("<gyration.Runs {}: {}>", self.endings.len(), counts.join(", "))
    }
}
