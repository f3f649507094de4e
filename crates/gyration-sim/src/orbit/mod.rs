//! Periodic orbits by shooting: a start that comes back to itself, and what becomes of its neighbours.
//!
//!   S⁻¹ φ_T(y₀) = y₀,   ẏ₀·δy = 0,   E(y₀) = E or q(y₀) = q₀ or T as given,   μ: eigenvalues of S⁻¹ ∂φ_T/∂y₀
//!
//! S moves the cells of a ring on (`shift`), so that waves are found that run without a change; elsewhere it is one.
//! Newton's method with the exact derivative of the flow (`sensitivity/flow`), in coordinates of the states that the
//! model allows (`chart`). Directions along which nothing is determined, those of symmetries, are left as they are: the
//! step is the shortest. Where drives depend on time the period is given, and there is no freedom of phase. Multipliers
//! μ of a motion without losses come in pairs μ, 1/μ; two are one, and two more for each symmetry.

mod chart;
mod choice;
mod multipliers;
mod shift;
mod survey;
#[cfg(test)]
mod tests;

pub use choice::{Choice, energy};
pub use shift::{CellShift, NoShift};
pub use survey::{OrbitChoice, OrbitStart, OrbitSurvey};

use crate::adapter::Tolerance;
use crate::plan::RunPlan;
use crate::sensitivity::{Flow, NoFlow, each_state};
use chart::{Chart, align, change, largest_of_kind, scales};
use choice::{seen, value, wanted};
use gyration::Inadmissible;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{ImplicitOrder, Options};
use multipliers::eigenvalues;
use nalgebra::{Complex, ComplexField as _, DMatrix, DVector};
use std::cmp::Ordering;

/// The tolerance of its runs, if that of the scene is not smaller.
const RTOL: f64 = 1e-12;
/// Misfits, in scales, below which an orbit is found.
const FOUND: f64 = 1e-9;
/// So many steps are tried, and each is halved so often.
const MOST_STEPS: usize = 40;
const MOST_HALVINGS: usize = 8;
/// Singular values below this part of the largest determine nothing.
const UNDETERMINED: f64 = 1e-8;
/// Multipliers this near to one are those of phase and symmetries.
const TRIVIAL: f64 = 1e-3;
/// Others may be this much above one in size and still be stable.
const STABLE: f64 = 1e-6;
/// An energy that changes by less than this part of the largest kinetic energy is kept.
const KEPT: f64 = 1e-4;
/// A number that changes by less than this part of its scale stands still.
const LEAST_SPAN: f64 = 1e-9;
/// Sweeps of an iteration at most; a few for each row are the rule.
const SWEEPS: usize = 10_000;
/// A quantity is varied by this part of the scales.
const PROBE: f64 = 1e-5;

/// Motions of a model among which one is looked for.
#[derive(Debug, Clone)]
pub struct OrbitSearch<'a> {
    /// The model.
    pub model: &'a Model,
    /// How its runs are made.
    pub plan: &'a RunPlan,
    /// By what the cells of a ring have moved on after a period.
    pub shift: Option<CellShift>,
}

/// A motion that repeats itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// T \[s\].
    pub period: f64,
    /// y₀.
    pub start: State,
    /// μ, the largest first.
    pub multipliers: Vec<Complex<f64>>,
    /// Whether none but those of phase and symmetries is larger than one.
    pub stable: bool,
    /// What is left of S⁻¹ φ_T(y₀) = y₀, in the scales of the state.
    pub misfit: f64,
}

/// Why there is no orbit.
#[derive(Debug, thiserror::Error)]
pub enum NoOrbit {
    /// The start, or what a step of the search leads to, is outside the model.
    #[error("a start that was tried is outside the model: {0}")]
    Outside(#[from] Inadmissible),
    /// A run does not reach the period.
    #[error("a run over a period of {period} s ends early or has no derivative: {reason}")]
    Flow {
        /// The period \[s\].
        period: f64,
        /// Why.
        reason: String,
    },
    /// The search came to a stop.
    #[error("no start comes back to itself: after {period} s the nearest is {misfit:.1e} of its scales away")]
    NotFound {
        /// The period of the last one tried \[s\].
        period: f64,
        /// What is left.
        misfit: f64,
    },
    /// Something depends on time, and no period is given.
    #[error("something in the scene depends on time, and an orbit has the period of that: it must be given")]
    Driven,
    /// No body can move.
    #[error("nothing in the scene can move")]
    NothingMoves,
    /// Iterations of linear algebra do not end.
    #[error("the {0} of a period cannot be computed")]
    NotComputed(&'static str),
    /// The start does not come near itself within the time of the scene.
    #[error("within {end} s the motion does not come back near to its start")]
    NoReturn {
        /// The end of the scene \[s\].
        end: f64,
    },
}

/// A start that is tried, with what comes of it.
struct Trial {
    start: State,
    period: f64,
    /// S⁻¹ ∂φ_T/∂y₀ in coordinates.
    derivative: DMatrix<f64>,
    /// S⁻¹ y(T) − y₀ in coordinates, and ẏ at both.
    gap: DVector<f64>,
    rates: [DVector<f64>; 2],
    misfit: f64,
    chart: Chart,
}

impl Orbit {
    /// Near a start, with a period to begin with.
    ///
    /// # Errors
    /// [`NoOrbit`].
    pub fn near(search: &OrbitSearch<'_>, start: &State, period: f64, choice: &Choice<'_>) -> Result<Self, NoOrbit> {
        let model = search.model;
        let mut trial = Trial::of(search, start.clone(), period)?;
        if trial.gap.is_empty() {
            return Err(NoOrbit::NothingMoves);
        }
        let driven = trial.is_driven()?;
        if driven && !matches!(choice, Choice::Period) {
            return Err(NoOrbit::Driven);
        }
        let mut off = wanted(model, choice, &trial.start)?;
        for _ in 0..MOST_STEPS {
            if trial.misfit <= FOUND * 1e-2 * trial.path().min(1.0) && off.abs() <= FOUND {
                break;
            }
            let step = trial.step(model, choice, driven, off)?;
            let next = (0..MOST_HALVINGS).find_map(|halving| {
                let part = 0.5_f64.powi(halving as i32);
                let next = trial.moved(search, &(part * &step)).ok()?;
                let left = wanted(model, choice, &next.start).ok()?;
                (next.missed(left) < trial.missed(off)).then_some((next, left))
            });
            // Rounding keeps the last one from being improved.
            let Some((next, left)) = next else { break };
            (trial, off) = (next, left);
        }
        if trial.misfit > FOUND || off.abs() > FOUND {
            return Err(NoOrbit::NotFound { period: trial.period, misfit: trial.misfit.max(off.abs()) });
        }
        let mut multipliers = eigenvalues(&trial.derivative).ok_or(NoOrbit::NotComputed("multipliers"))?;
        let order = |mu: &Complex<f64>| [mu.modulus(), mu.re, mu.im];
        multipliers.sort_by(|a, b| order(b).partial_cmp(&order(a)).unwrap_or(Ordering::Equal));
        let grows = |mu: &Complex<f64>| (mu - 1.0).modulus() > TRIVIAL && mu.modulus() > 1.0 + STABLE;
        let stable = !multipliers.iter().any(grows);
        Ok(Self { period: trial.period, start: trial.start, multipliers, stable, misfit: trial.misfit })
    }

    /// How long a motion takes to come near to its start, its cells moved on if that is asked for: when its distance,
    /// which had grown or is there from the beginning, is least for the first time; and whether it has kept its energy
    /// until then.
    ///
    /// # Errors
    /// `NoReturn`, `Outside`, `Flow`.
    pub fn first_return(search: &OrbitSearch<'_>, start: &State) -> Result<(f64, bool), NoOrbit> {
        let OrbitSearch { model, plan, .. } = *search;
        let (mut times, mut changes) = (Vec::new(), Vec::<DVector<f64>>::new());
        let (first, mut most_lost, mut most_kinetic) = (energy(model, start)?, 0.0_f64, 0.0_f64);
        each_state(model, start, plan, |state| {
            times.push(state.time);
            changes.push(change(model, start, &search.back(state)));
            // A state that cannot be seen has no energy to compare.
            let [total, kinetic] = seen(model, state).unwrap_or([f64::NAN; 2]);
            most_lost = most_lost.max((total - first).abs());
            most_kinetic = most_kinetic.max(kinetic);
        })
        .map_err(|error| NoOrbit::Flow { period: plan.end, reason: error.to_string() })?;
        // Each number by how far those of its kind go: what hardly moves decides nothing.
        let least = LEAST_SPAN * scales(model, plan.end);
        let spans = changes.iter().fold(least, |spans, change| spans.sup(&change.abs()));
        let spans = largest_of_kind(model, &spans);
        let size = |change: &DVector<f64>| change.component_div(&spans).amax();
        let away: Vec<(f64, f64)> = times.iter().copied().zip(changes.iter().map(size)).collect();
        let most = away.iter().map(|(_, size)| *size).fold(0.0, f64::max);
        // Whose cells are to move on begins away from where it comes to.
        let left = match search.shift {
            Some(_) => 0,
            None => away.iter().position(|(_, size)| *size > 0.5 * most).unwrap_or(0),
        };
        let back = (left.max(1)..away.len().saturating_sub(1)).find(|k| {
            let size = |k: usize| away[k].1;
            size(*k) < 0.3 * most && size(*k) <= size(*k - 1) && size(*k) <= size(*k + 1)
        });
        let keeps = most_lost <= KEPT * most_kinetic;
        back.map(|k| (away[k].0, keeps)).ok_or(NoOrbit::NoReturn { end: plan.end })
    }
}

impl OrbitSearch<'_> {
    /// S⁻¹ y.
    fn back(&self, state: &State) -> State {
        self.shift.as_ref().map_or_else(|| state.clone(), |shift| shift.back(state))
    }
}

impl Trial {
    fn of(search: &OrbitSearch<'_>, start: State, period: f64) -> Result<Self, NoOrbit> {
        let OrbitSearch { model, plan, .. } = *search;
        let mut start = State { time: 0.0, ..start };
        let mut chart = Chart::about(model, &start, period)?;
        chart.project(&mut start);
        let tolerance = Tolerance { rtol: plan.tolerance.rtol.min(RTOL), ..plan.tolerance };
        let options = Options { order: ImplicitOrder::at_tolerance(tolerance.rtol), ..plan.options };
        let plan = RunPlan { end: period, tolerance, options, ..*plan };
        let flow = Flow::of(model, &start, &plan, &chart.directions());
        let flow = flow.map_err(|error: NoFlow| NoOrbit::Flow { period, reason: error.to_string() })?;
        let end = search.back(&flow.end);
        let mut derivative = match &search.shift {
            None => flow.derivative,
            Some(shift) => shift.rows_back(&flow.derivative),
        };
        align(model, &start, &end, &mut derivative);
        let left = change(model, &start, &end);
        let column = |change: &DVector<f64>, chart: &Chart| {
            chart.coordinates(&DMatrix::from_column_slice(change.len(), 1, change.as_slice())).column(0).into_owned()
        };
        let first = chart.rates(0.0, &start)?;
        let mut last = DMatrix::from_column_slice(first.len(), 1, chart.rates(period, &end)?.as_slice());
        align(model, &start, &end, &mut last);
        let rates = [column(&first, &chart), column(&last.column(0).into_owned(), &chart)];
        Ok(Self {
            misfit: chart.size(&left),
            gap: column(&left, &chart),
            derivative: chart.coordinates(&derivative),
            rates,
            start,
            period,
            chart,
        })
    }

    /// Whether the rates of one state change with time.
    fn is_driven(&mut self) -> Result<bool, NoOrbit> {
        let first = self.chart.rates(0.0, &self.start)?;
        for part in [0.131, 0.373, 0.719] {
            let later = self.chart.rates(part * self.period, &self.start)?;
            if (&later - &first).amax() > 1e-12 * first.amax().max(later.amax()) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// How far the motion goes in a period, about, in scales.
    fn path(&self) -> f64 {
        self.period * self.rates[0].amax()
    }

    /// By what it is no orbit: the misfit as a part of the path, and what it is chosen by.
    fn missed(&self, off: f64) -> f64 {
        let path = self.path();
        self.misfit / if path > 0.0 { path } else { 1.0 } + off.abs()
    }

    /// Newton's step of coordinates, in scales, and period, as a part of it.
    fn step(&mut self, model: &Model, choice: &Choice<'_>, driven: bool, off: f64) -> Result<DVector<f64>, NoOrbit> {
        let d = self.gap.len();
        let mut equations = DMatrix::zeros(d + 2, d + 1);
        let mut right = DVector::zeros(d + 2);
        equations.view_mut((0, 0), (d, d)).copy_from(&(&self.derivative - DMatrix::identity(d, d)));
        right.rows_mut(0, d).copy_from(&-&self.gap);
        let size = self.rates[0].norm();
        if !driven && size > 0.0 {
            equations.view_mut((d, 0), (1, d)).copy_from(&(self.rates[0].transpose() / size));
        }
        // The last unknown counts as how far the end moves with the period, and what an orbit is chosen by as how far a
        // start must move: all equations then are of one size, however short the path.
        let moves = self.period * self.rates[1].norm();
        if !matches!(choice, Choice::Period) && moves > 0.0 {
            equations.view_mut((0, d), (d, 1)).copy_from(&self.rates[1].normalize());
        }
        match choice {
            Choice::Period | Choice::Alone => {}
            Choice::Energy(_) | Choice::Quantity(..) => {
                let slope = self.slope(model, choice)?;
                let steepness = slope.norm();
                if steepness > 0.0 {
                    equations.view_mut((d + 1, 0), (1, d)).copy_from(&(slope.transpose() / steepness));
                    right[d + 1] = -off / steepness;
                }
            }
        }
        let found = equations.try_svd(true, true, f64::EPSILON, SWEEPS).ok_or(NoOrbit::NotComputed("step"))?;
        let least = UNDETERMINED * found.singular_values.max();
        let mut step = found.solve(&right, least).unwrap_or_else(|_| DVector::zeros(d + 1));
        // A part of the period.
        step[d] = if moves > 0.0 { step[d] / moves } else { 0.0 };
        Ok(step)
    }

    /// The derivative of what an orbit is chosen by, by differences.
    fn slope(&mut self, model: &Model, choice: &Choice<'_>) -> Result<DVector<f64>, NoOrbit> {
        let d = self.gap.len();
        let mut slope = DVector::zeros(d);
        for k in 0..d {
            let mut beside = |side: f64| {
                let mut coordinates = DVector::zeros(d);
                coordinates[k] = side * PROBE;
                let state = self.chart.moved(&self.start, &coordinates);
                Ok::<f64, NoOrbit>(value(model, choice, &state)?)
            };
            slope[k] = (beside(1.0)? - beside(-1.0)?) / (2.0 * PROBE);
        }
        Ok(slope)
    }

    /// What comes of a step.
    fn moved(&mut self, search: &OrbitSearch<'_>, step: &DVector<f64>) -> Result<Self, NoOrbit> {
        let d = self.gap.len();
        let start = self.chart.moved(&self.start, &step.rows(0, d).into_owned());
        let period = self.period * (1.0 + step[d].clamp(-0.5, 0.5));
        Self::of(search, start, period)
    }
}
