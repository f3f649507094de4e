//! What a scene says that would be measured.
//!
//! | measured | computed |
//! |---|---|
//! | rebound | h + n·(p₀ − p₀(0)) at the first apex behind the first closest approach, from rest at a gap h |
//! | gap | of the rest state, where the exact balance has no force left |
//! | speed on a slope θ | at which friction is m g sin θ, at rest under g cos θ; without a bound m g sin θ/c |
//! | slope where sliding begins | tan θ = F/(m g cos θ), F the most that friction holds at rest under g cos θ |
//! | frequency | that of the branch at κ, counted by ascending frequency (`dispersion`) |
//! | pull-off | the largest force towards the support over all gaps, in the attitude of the start |
//!
//! Viscous friction holds nothing: a body slides on every slope, v = (α/β) tan θ where both exponents are the same, and
//! a slope is measured together with a speed. A bound μ on friction lets it begin to slide at tan θ = μ, if nothing but
//! its weight presses.

use super::rebound::Drop;
use super::scene::{body, normal};
use super::{Calibration, Experiment, ExperimentKind};
use gyration::balance::observe;
use gyration::dynamics::{Workspace, gap_to_supports};
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_scene::Scene;
use gyration_sim::modes::rest;
use gyration_threads::Interruption;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Points of a look for the largest force, over gaps from [`NEAREST`] to [`FARTHEST`] sizes of the body.
const POINTS: usize = 160;
const NEAREST: f64 = 1e-5;
const FARTHEST: f64 = 10.0;
/// How often it is looked for: to 1e-11 sizes. Smaller gaps are rounding of the places of body and support.
const LOOKS: usize = 2;
/// Steps of the golden section behind that: the maximum is then known to half of the digits, the force to all.
const SECTIONS: usize = 45;
/// Step of differences, a part of the number.
const DIFFERENCE: f64 = 1e-4;

/// What would be measured, and its derivatives by the numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Prediction {
    pub value: f64,
    pub slopes: Vec<f64>,
}

impl Calibration {
    /// What would be measured in a row of a table.
    ///
    /// # Errors
    /// Why nothing would be, in words.
    pub(super) fn value_of_row(&self, table: &Experiment, row: usize, values: &[f64]) -> Result<f64, String> {
        match table.waves.get(row) {
            Some(wave) => Ok(self.frequencies(&table.of_wave(wave), values)?[0]),
            None => self.value(table, table.conditions[row], values),
        }
    }

    /// The same with derivatives by the numbers.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub(super) fn prediction_of_row(
        &self,
        table: &Experiment,
        row: usize,
        values: &[f64],
    ) -> Result<Prediction, String> {
        match table.waves.get(row) {
            Some(wave) => Ok(self.predicted_frequencies(&table.of_wave(wave), values)?.swap_remove(0)),
            None => self.predicted(table, table.conditions[row], values),
        }
    }

    /// What would be measured in every row.
    pub(super) fn values_of_rows(&self, values: &[f64]) -> Vec<Result<f64, String>> {
        let row = |table: &Experiment, row: usize| self.value(table, table.conditions[row], values);
        self.of_rows(row, |table| self.frequencies(table, values))
    }

    /// The same with derivatives by the numbers.
    pub(super) fn predictions_of_rows(&self, values: &[f64]) -> Vec<Result<Prediction, String>> {
        let row = |table: &Experiment, row: usize| self.predicted(table, table.conditions[row], values);
        self.of_rows(row, |table| self.predicted_frequencies(table, values))
    }

    /// Something of every row, in order: of a table of waves all at once, since they share a rest.
    fn of_rows<T: Send>(
        &self,
        row: impl Fn(&Experiment, usize) -> Result<T, String> + Sync,
        waves: impl Fn(&Experiment) -> Result<Vec<T>, String> + Sync,
    ) -> Vec<Result<T, String>> {
        let jobs = self.experiments.iter().flat_map(|table| match table.kind {
            ExperimentKind::Dispersion => vec![(table, None)],
            _ => (0..table.measured.len()).map(|row| (table, Some(row))).collect(),
        });
        let interruption = Interruption::in_force();
        let work = |(table, at): (&Experiment, Option<usize>)| match at {
            Some(at) => vec![interruption.within(|| row(table, at))],
            None => match interruption.within(|| waves(table)) {
                Ok(all) => all.into_iter().map(Ok).collect(),
                Err(reason) => table.waves.iter().map(|_| Err(reason.clone())).collect(),
            },
        };
        let found: Vec<Vec<_>> = jobs.collect::<Vec<_>>().into_par_iter().map(work).collect();
        found.into_iter().flatten().collect()
    }

    /// What would be measured under a condition.
    ///
    /// # Errors
    /// Why nothing would be, in words.
    pub(super) fn value(&self, experiment: &Experiment, condition: f64, values: &[f64]) -> Result<f64, String> {
        match experiment.kind {
            ExperimentKind::Drop => Drop::of(self, experiment, condition, values)?.rebound(),
            ExperimentKind::Gap => rest_gap(&self.scene(experiment, condition, values, &[])?, experiment),
            ExperimentKind::Slope => {
                let scene = self.scene(experiment, condition, values, &[])?;
                speed(&self.tilted(experiment, &scene, condition, values)?, experiment, condition)
            }
            ExperimentKind::Begins => self.begins(experiment, values),
            ExperimentKind::PullOff => pull_off(&self.scene(experiment, condition, values, &[])?, experiment),
            ExperimentKind::Dispersion => Err("a frequency is that of a wave, which no condition tells".to_owned()),
        }
    }

    /// The same with derivatives: along the run of a drop, else by differences of fourth order of what is known to
    /// rounding.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub(super) fn predicted(
        &self,
        experiment: &Experiment,
        condition: f64,
        values: &[f64],
    ) -> Result<Prediction, String> {
        let (value, known) = match experiment.kind {
            ExperimentKind::Drop => Drop::of(self, experiment, condition, values)?.predicted(self)?,
            _ => (self.value(experiment, condition, values)?, vec![None; values.len()]),
        };
        let slope = |index: usize| {
            let step =
                DIFFERENCE * if values[index] == 0.0 { self.numbers[index].scale.size } else { values[index].abs() };
            let at = |steps: f64| {
                let mut moved = values.to_vec();
                moved[index] += steps * step;
                self.value(experiment, condition, &moved)
            };
            Ok((8.0 * (at(1.0)? - at(-1.0)?) - (at(2.0)? - at(-2.0)?)) / (12.0 * step))
        };
        let slopes = known.into_iter().enumerate().map(|(index, known)| known.map_or_else(|| slope(index), Ok));
        Ok(Prediction { value, slopes: slopes.collect::<Result<_, String>>()? })
    }
}

fn rest_gap(scene: &Scene, experiment: &Experiment) -> Result<f64, String> {
    let built = scene.built();
    let index = body(&built.model, experiment)?;
    rest(&built.model, &built.state, index).map(|rest| rest.gap).map_err(|none| none.to_string())
}

/// The steady speed under the part of gravity along the slope, from the friction in the rest state.
fn speed(tilted: &Scene, experiment: &Experiment, slope: f64) -> Result<f64, String> {
    let drag = Drag::of(tilted, experiment)?;
    let name = &experiment.body;
    // |g| was multiplied by cos θ.
    let needed = drag.mass * drag.pressing * libm::tan(slope);
    let resistance = drag.at(1.0)?;
    if resistance <= 0.0 {
        return Err(format!("no friction acts on {name:?}: on a slope it gets faster for ever"));
    }
    if !drag.is_bounded {
        return Ok(needed / resistance);
    }
    let (mut low, mut high) = (-FASTEST, FASTEST);
    if drag.at(libm::exp(high))? <= needed {
        return Err(format!("the friction of {name:?} is bounded: on this slope it gets faster for ever"));
    }
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if drag.at(libm::exp(middle))? < needed { low = middle } else { high = middle }
    }
    Ok(libm::exp(0.5 * (low + high)))
}

/// The logarithm of a speed [m/s] that is far beyond all bounds.
const FASTEST: f64 = 30.0;
/// Halvings of that to rounding.
const BISECTIONS: usize = 70;
/// More steps than the secant takes, and when it ends.
const MOST_SECANTS: usize = 50;
const SECANT_ENDS: f64 = 1e-13;

impl Calibration {
    /// The slope at which friction holds no more than the weight's part along it.
    fn begins(&self, experiment: &Experiment, values: &[f64]) -> Result<f64, String> {
        let scene = self.scene(experiment, 0.0, values, &[])?;
        let off = |slope: f64| -> Result<f64, String> {
            let tilted = self.tilted(experiment, &scene, slope, values)?;
            let drag = Drag::of(&tilted, experiment)?;
            let most = drag.at(libm::exp(FASTEST))?;
            if !drag.is_bounded {
                let name = &experiment.body;
                return Err(format!("the friction of {name:?} is viscous: it slides on every slope; give it a `mu`"));
            }
            Ok(libm::atan(most / (drag.mass * drag.pressing)) - slope)
        };
        let mut before = off(0.0)?;
        let (mut last, mut here) = (0.0, before);
        for _ in 0..MOST_SECANTS {
            let now = off(here)?;
            if now.abs() <= SECANT_ENDS {
                return Ok(here);
            }
            if now == before {
                break;
            }
            let step = now * (here - last) / (before - now);
            (last, before) = (here, now);
            here += step;
        }
        Err(format!("no slope is found at which {:?} begins to slide", experiment.body))
    }
}

/// The friction of a body in its rest state.
struct Drag<'a> {
    model: &'a Model,
    index: usize,
    /// At rest.
    still: State,
    /// Across the normal of its support.
    along: Vec3,
    /// Where its velocity stands.
    at: usize,
    mass: f64,
    /// |g| [m/s²].
    pressing: f64,
    /// Whether friction of it has a bound.
    is_bounded: bool,
}

impl<'a> Drag<'a> {
    fn of(tilted: &'a Scene, experiment: &Experiment) -> Result<Self, String> {
        let built = tilted.built();
        let (model, index) = (&built.model, body(&built.model, experiment)?);
        let state = rest(model, &built.state, index).map_err(|none| none.to_string())?;
        let normal = normal(model, index)?;
        let level = [Vec3::x(), Vec3::y()].map(|axis| axis - normal * normal.dot(&axis));
        let along = if level[0].norm() > level[1].norm() { level[0] } else { level[1] }.normalize();
        let mut still = built.state.clone();
        still.bodies[model.blocks()[index].clone()].copy_from_slice(state.block());
        Ok(Self {
            model,
            index,
            still,
            along,
            at: velocity(model, index)?,
            mass: model.bodies[index].solid.mass.mass,
            pressing: model.gravity.norm(),
            is_bounded: model.contacts_of(index).any(|contact| contact.law_set.mu().is_some()),
        })
    }

    /// What holds it back at a speed along its support [N].
    fn at(&self, speed: f64) -> Result<f64, String> {
        let Self { model, index, still, along, at, .. } = self;
        let mut moving = still.clone();
        moving.bodies[*at..at + 3].copy_from_slice((speed * along).as_slice());
        Ok(-(force(model, &moving, *index)? - force(model, still, *index)?).dot(along))
    }
}

/// Where the velocity of a body's centre stands in the state.
fn velocity(model: &Model, index: usize) -> Result<usize, String> {
    let body = &model.bodies[index];
    if body.pin.is_some() || body.guide.is_some() || !body.has_inertia() {
        return Err(format!("{:?} is pinned, has a `keep` or has no inertia", model.name(index)));
    }
    Ok(model.slots(index).velocity().start)
}

fn force(model: &Model, state: &State, index: usize) -> Result<Vec3, String> {
    let seen = observe(model, &mut Workspace::default(), state, index);
    seen.map(|seen| seen.contact_force).map_err(|left| left.to_string())
}

/// The largest force towards the support over all gaps.
fn pull_off(scene: &Scene, experiment: &Experiment) -> Result<f64, String> {
    let built = scene.built();
    let (model, index) = (&built.model, body(&built.model, experiment)?);
    let (normal, at) = (normal(model, index)?, velocity(model, index)?);
    let start = model.blocks()[index].start;
    let mut state = built.state.clone();
    state.bodies[at..at + 3].fill(0.0);
    let gap = gap_to_supports(model, 0.0, index, &state.motion(model, index));
    let center = Vec3::from_column_slice(&state.bodies[start..start + 3]);
    let mut pull = |logarithm: f64| -> Result<f64, String> {
        let moved = center + normal * (libm::exp(logarithm) - gap);
        state.bodies[start..start + 3].copy_from_slice(moved.as_slice());
        Ok(-force(model, &state, index)?.dot(&normal))
    };
    let size = model.bodies[index].size;
    let (mut low, span) = (libm::log(NEAREST * size), libm::log(FARTHEST / NEAREST));
    let step = span / (POINTS - 1) as f64;
    let mut found = None;
    for _ in 0..LOOKS {
        let forces = (0..POINTS).map(|k| pull(low + k as f64 * step)).collect::<Result<Vec<_>, _>>()?;
        let best =
            (0..POINTS).fold(0, |best, k| if forces[best].is_nan() || forces[k] > forces[best] { k } else { best });
        if forces[best] <= 0.0 || forces[best].is_nan() {
            return Err(format!("nothing holds {:?} back: there is no adhesion", experiment.body));
        }
        if (1..POINTS - 1).contains(&best) {
            found = Some(low + best as f64 * step);
            break;
        }
        // Two points are looked at once more, lest the largest stand at the seam.
        low += if best == 0 { 2.0 * step - span } else { span - 2.0 * step };
    }
    let Some(best) = found else {
        let name = &experiment.body;
        return Err(format!(
            "the pull on {name:?} has no largest value between any gaps that it could be torn off from"
        ));
    };
    let (mut left, mut right) = (best - step, best + step);
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let [a, b] = [right - golden * (right - left), left + golden * (right - left)];
        if pull(a)? > pull(b)? { right = b } else { left = a }
    }
    pull(0.5 * (left + right))
}
