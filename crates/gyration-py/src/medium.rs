//! Bodies as a medium, and motions that repeat themselves: the program's numbers, as arrays.

use crate::convert::with_arrays;
use crate::errors;
use crate::monitor::interruptibly;
use crate::recording::Recording;
use crate::scene::Scene;
use gyration::tensor::Vec3;
use gyration_sim::modes::bands::ContinuumModel;
use gyration_sim::orbit::{OrbitChoice, OrbitSurvey};
use gyration_sim::survey::ContinuumSurvey;
use gyration_sim::{FieldPoints, FieldSurvey, RingSpectrum, within_wall_time};
use pyo3::prelude::*;
use serde_json::json;

/// What a lattice is as a continuum, as ``gyration continuum`` has it: ``coordinates``, ``volume``, ``mass``, ``D0``,
/// ``D1``, ``D2``, ``macro``, ``held``, ``micro``, ``map`` and ``reach``, nested lists of numbers as arrays.
#[pyfunction]
#[pyo3(signature = (scene, path=None, *, model="mindlin", points=101))]
pub fn continuum<'py>(
    py: Python<'py>,
    scene: &Bound<'py, PyAny>,
    path: Option<&str>,
    model: &str,
    points: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let scene = Scene::ready(scene)?;
    let known = ContinuumModel::ALL.into_iter().find(|known| known.name() == model);
    let model = known.ok_or_else(|| {
        let names = ContinuumModel::ALL.map(ContinuumModel::name).join(", ");
        errors::arguments(format!("{model:?} is no model of a continuum\n  fix: give one of {names}"))
    })?;
    let found =
        interruptibly(py, || within_wall_time(&scene, || ContinuumSurvey::of(&scene, model, path, points.max(1))))?;
    let found = found.map_err(errors::arguments)?;
    found.warnings.iter().try_for_each(|warning| errors::warn(py, Some(warning.clone())))?;
    with_arrays(py, &json!(found))
}

/// Micromorphic fields of a recording, as ``gyration fields`` has them: arrays over samples and points of ``density``,
/// ``momentum``, ``affine_momentum``, ``stress``, ``micro_stress`` and so on, at points ``at`` or on a ``grid`` of so
/// many along each axis, seen with a Gaussian of this ``width`` [m].
#[pyfunction]
#[pyo3(signature = (recording, width, *, at=None, grid=None, every=1))]
pub fn fields<'py>(
    py: Python<'py>,
    recording: &Recording,
    width: f64,
    at: Option<Vec<[f64; 3]>>,
    grid: Option<[usize; 3]>,
    every: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let points = match (at, grid) {
        (Some(_), Some(_)) => return Err(errors::arguments("`at` and `grid` do not go together")),
        (Some(at), None) => FieldPoints::At(at.into_iter().map(Vec3::from).collect()),
        (None, Some(counts)) => FieldPoints::Grid(counts),
        (None, None) => FieldPoints::Usual,
    };
    if let FieldPoints::At(points) = &points
        && points.iter().flat_map(|point| point.iter()).any(|number| !number.is_finite())
    {
        return Err(errors::arguments("`at` holds a number that is not finite\n  fix: give points in metres"));
    }
    if every == 0 {
        return Err(errors::arguments("`every` is 0\n  fix: give a number from 1"));
    }
    let inner = recording.inner.clone();
    let found = interruptibly(py, || FieldSurvey::of(&inner, width, &points, every))?;
    with_arrays(py, &json!(found.map_err(|error| errors::arguments(error.to_string()))?))
}

/// How the energy of a ring is shared out among the waves of its cell, as ``gyration spectrum`` has it: ``kappa`` (n,
/// 3), ``omega``, ``decay``, ``energy`` and ``change`` (n, branches), ``t``, ``total`` and ``run`` (samples), and
/// ``branches`` with what is measured of each; ``energies`` (samples, n, branches) if they are asked for.
#[pyfunction]
#[pyo3(signature = (recording, *, energies=false))]
pub fn spectrum<'py>(py: Python<'py>, recording: &Recording, energies: bool) -> PyResult<Bound<'py, PyAny>> {
    let inner = recording.inner.clone();
    let found = interruptibly(py, || RingSpectrum::of(&inner, energies))?;
    let found = found.map_err(|error| errors::arguments(error.to_string()))?;
    found.warnings.iter().try_for_each(|warning| errors::warn(py, Some(warning.clone())))?;
    with_arrays(py, &json!(found))
}

/// Cells along the first vector of a lattice, or along each.
#[derive(FromPyObject)]
pub enum Cells {
    /// Along the first.
    Along(i32),
    /// Along each.
    Each([i32; 3]),
}

/// A motion of a scene that repeats itself, as ``gyration orbit`` has it: ``period``, ``energy``, ``start`` by body,
/// ``multipliers`` (n, 2), ``stable``, ``misfit``; by its ``period`` [s], its ``energy`` [J], or an ``amplitude``, a
/// column of the start and its value. Of a ring, ``shift`` tells by how many cells it has moved on after the period: a
/// number, or three along its cell vectors.
#[pyfunction]
#[pyo3(signature = (scene, *, period=None, energy=None, amplitude=None, shift=None))]
pub fn orbit<'py>(
    py: Python<'py>,
    scene: &Bound<'py, PyAny>,
    period: Option<f64>,
    energy: Option<f64>,
    amplitude: Option<(String, f64)>,
    shift: Option<Cells>,
) -> PyResult<Bound<'py, PyAny>> {
    let chosen = energy.or(amplitude.as_ref().map(|(_, value)| *value));
    if chosen.is_some_and(|value| !value.is_finite()) {
        return Err(errors::arguments("an energy or amplitude that is not finite\n  fix: give it in SI units"));
    }
    let choice = match (energy, amplitude, period) {
        (Some(_), Some(_), _) => {
            return Err(errors::arguments("`energy` and `amplitude` do not go together"));
        }
        (Some(energy), None, _) => OrbitChoice::Energy(energy, period),
        (None, Some((column, value)), _) => OrbitChoice::Amplitude(column, value, period),
        (None, None, Some(period)) => OrbitChoice::Period(period),
        (None, None, None) => OrbitChoice::Nearest,
    };
    if period.is_some_and(|period| !(period.is_finite() && period > 0.0)) {
        return Err(errors::arguments("`period` is no time above zero\n  fix: give seconds"));
    }
    let shift = shift.map(|cells| match cells {
        Cells::Along(first) => [first, 0, 0],
        Cells::Each(all) => all,
    });
    let scene = Scene::ready(scene)?;
    let found = interruptibly(py, || within_wall_time(&scene, || OrbitSurvey::of(&scene, &choice, shift)))?
        .map_err(errors::arguments)?;
    with_arrays(py, &json!(found))
}
