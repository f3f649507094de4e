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
mod shift;
mod survey;
mod trial;

pub use choice::{Choice, energy};
pub use shift::{CellShift, NoShift};
pub use survey::{OrbitChoice, OrbitStart, OrbitSurvey};

use crate::eigenvalues::eigenvalues;
use crate::plan::RunPlan;
use crate::sensitivity::each_state;
use chart::{change, largest_of_kind, scales};
use choice::{seen, wanted};
use gyration::Inadmissible;
use gyration::model::Model;
use gyration::state::State;
use nalgebra::{Complex, ComplexField as _, DVector};
use std::cmp::Ordering;
use trial::Trial;

/// Misfits, as parts of how far a motion goes, below which an orbit is found.
const FOUND: f64 = 1e-9;
/// Rates that differ by less than this part of the largest along an orbit are the same.
const SAME: f64 = 1e-6;
/// After so many periods what drives a scene is compared with what it was.
const REPETITIONS: [f64; 3] = [1.0, 2.0, 3.0];
/// So many returns are tried.
const MOST_RETURNS: usize = 4;
/// So many steps are tried, and each is halved so often.
const MOST_STEPS: usize = 40;
const MOST_HALVINGS: usize = 8;
/// Where nothing is found a motion that has losses goes on for so many periods first, which bring it to what attracts
/// it.
const SETTLING: [f64; 2] = [8.0, 64.0];
/// Multipliers this near to one are those of phase and symmetries.
const TRIVIAL: f64 = 1e-3;
/// Others may be this much above one in size and still be stable.
const STABLE: f64 = 1e-6;
/// An energy that changes by less than this part of the largest kinetic energy is kept.
const KEPT: f64 = 1e-4;
/// A number that changes by less than this part of its scale stands still.
const LEAST_SPAN: f64 = 1e-9;

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
    /// What is left of S⁻¹ φ_T(y₀) = y₀, as a part of how far the motion goes.
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
    #[error(
        "no start near by comes back to itself: after {period} s the nearest is {misfit:.1e} of how far it goes away"
    )]
    NotFound {
        /// The period of the last one tried \[s\].
        period: f64,
        /// What is left.
        misfit: f64,
    },
    /// Orbits were found, but none that was asked for.
    #[error("no orbit near the start has what was asked for: the nearest is off by {off:.1e} of it")]
    NotChosen {
        /// What is left.
        off: f64,
    },
    /// Something depends on time, and no period is given.
    #[error("something in the scene depends on time, and an orbit has the period of that: it must be given")]
    Driven,
    /// The period that is given is none of what depends on time.
    #[error(
        "{period} s is no period of what in the scene depends on time: rates along the motion are others by then, by \
         {difference:.1e} of the largest"
    )]
    NotPeriodic {
        /// The period \[s\].
        period: f64,
        /// The largest difference.
        difference: f64,
    },
    /// The fluid remembers how a body moved.
    #[error(
        "the fluid remembers how a body moved (`history`), which an orbit would have to come back to as well: write \
         history = false to leave that out"
    )]
    Remembers,
    /// No body can move.
    #[error("nothing in the scene can move")]
    NothingMoves,
    /// No body does.
    #[error("the motion has come to rest: there is none that could come back")]
    AtRest,
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

impl Orbit {
    /// Near a start, with a period to begin with; of a scene with a drive or with losses also near to what its motion
    /// comes to by itself.
    ///
    /// # Errors
    /// [`NoOrbit`].
    pub fn near(search: &OrbitSearch<'_>, start: &State, period: f64, choice: &Choice<'_>) -> Result<Self, NoOrbit> {
        let first = Self::about(search, start, period, choice);
        let may_settle = matches!(choice, Choice::Period | Choice::Alone);
        if !may_settle || !matches!(first, Err(NoOrbit::NotFound { .. })) || !search.settles(start, period)? {
            return first;
        }
        let mut start = start.clone();
        for periods in SETTLING {
            let Some(later) = search.after(&start, periods * period) else { break };
            start = later;
            if let Ok(found) = Self::about(search, &start, period, choice) {
                return Ok(found);
            }
        }
        first
    }

    /// Where Newton's steps from a start lead.
    fn about(search: &OrbitSearch<'_>, start: &State, period: f64, choice: &Choice<'_>) -> Result<Self, NoOrbit> {
        let model = search.model;
        if model.bodies.iter().any(|body| body.history().is_some()) {
            return Err(NoOrbit::Remembers);
        }
        let mut trial = Trial::of(search, start.clone(), period)?;
        let driven = model.is_driven() || search.is_carried(&mut trial)?;
        if driven && !matches!(choice, Choice::Period) {
            return Err(NoOrbit::Driven);
        }
        let mut off = wanted(model, choice, &trial.start)?;
        for _ in 0..MOST_STEPS {
            if trial.missed(0.0) <= FOUND * 1e-2 && off.abs() <= FOUND {
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
        let misfit = trial.missed(0.0);
        if misfit > FOUND {
            return Err(NoOrbit::NotFound { period: trial.period, misfit });
        }
        if off.abs() > FOUND {
            return Err(NoOrbit::NotChosen { off: off.abs() });
        }
        if driven {
            search.check_period(&mut trial)?;
        }
        let mut multipliers = eigenvalues(&trial.derivative).ok_or(NoOrbit::NotComputed("multipliers"))?;
        let order = |mu: &Complex<f64>| [mu.modulus(), mu.re, mu.im];
        multipliers.sort_by(|a, b| order(b).partial_cmp(&order(a)).unwrap_or(Ordering::Equal));
        let grows = |mu: &Complex<f64>| (mu - 1.0).modulus() > TRIVIAL && mu.modulus() > 1.0 + STABLE;
        let stable = !multipliers.iter().any(grows);
        Ok(Self { period: trial.period, start: trial.start, multipliers, stable, misfit })
    }

    /// After which times \[s\] a motion is near to its start, its cells moved on if that is asked for: when its
    /// distance, which had grown or is there from the beginning, is least for the first few times; and whether it has
    /// kept its energy until then. A body that turns far to both sides is near in between as well.
    ///
    /// # Errors
    /// `AtRest`, `NoReturn`, `Outside`, `Flow`.
    pub fn returns(search: &OrbitSearch<'_>, start: &State) -> Result<(Vec<f64>, bool), NoOrbit> {
        let OrbitSearch { model, plan, .. } = *search;
        let (mut times, mut changes) = (Vec::new(), Vec::<DVector<f64>>::new());
        let (first, mut most_lost, mut most_kinetic) = (energy(model, start)?, 0.0_f64, 0.0_f64);
        let ended = each_state(model, start, plan, |state| {
            times.push(state.time);
            changes.push(change(model, start, &search.back(state)));
            // A state that cannot be seen has no energy to compare.
            let [total, kinetic] = seen(model, state).unwrap_or([f64::NAN; 2]);
            most_lost = most_lost.max((total - first).abs());
            most_kinetic = most_kinetic.max(kinetic);
        });
        // Each number by how far those of its kind go: what hardly moves decides nothing.
        let least = LEAST_SPAN * scales(model, plan.end);
        let spans = changes.iter().fold(least, |spans, change| spans.sup(&change.abs()));
        let spans = largest_of_kind(model, &spans);
        let size = |change: &DVector<f64>| change.component_div(&spans).amax();
        let away: Vec<f64> = changes.iter().map(size).collect();
        let most = away.iter().copied().fold(0.0, f64::max);
        // Whose cells are to move on begins away from where it comes to.
        let left = match search.shift {
            Some(_) => 0,
            None => away.iter().position(|size| *size > 0.5 * most).unwrap_or(0),
        };
        let is_back = |k: &usize| away[*k] < 0.3 * most && away[*k] <= away[*k - 1] && away[*k] <= away[*k + 1];
        let back = (left.max(1)..away.len().saturating_sub(1)).filter(is_back);
        let returns: Vec<f64> = back.map(|k| times[k]).take(MOST_RETURNS).collect();
        match ended {
            // What becomes of it later is not asked.
            _ if !returns.is_empty() => Ok((returns, most_lost <= KEPT * most_kinetic)),
            // What moves most goes as far as it goes.
            Ok(()) if most < 1.0 => Err(NoOrbit::AtRest),
            Ok(()) => Err(NoOrbit::NoReturn { end: plan.end }),
            Err(error) => Err(NoOrbit::Flow { period: plan.end, reason: error.to_string() }),
        }
    }

    /// The same of a start or, where it does not come back and has losses, of what its motion comes to by the end of
    /// the plan; with the start that it is.
    ///
    /// # Errors
    /// As [`Orbit::returns`].
    pub fn returning(search: &OrbitSearch<'_>, start: &State) -> Result<(State, Vec<f64>, bool), NoOrbit> {
        let (error, end) = match Self::returns(search, start) {
            Ok((times, keeps)) => return Ok((start.clone(), times, keeps)),
            Err(NoOrbit::NoReturn { end }) => (NoOrbit::NoReturn { end }, end),
            Err(error) => return Err(error),
        };
        if search.model.is_driven() || !search.settles(start, end)? {
            return Err(error);
        }
        let Some(later) = search.after(start, end) else { return Err(error) };
        let Ok((times, keeps)) = Self::returns(search, &later) else { return Err(error) };
        Ok((later, times, keeps))
    }

    /// Near a start, with the first of some periods from which the search leads to one.
    ///
    /// # Errors
    /// [`NoOrbit`], from the first.
    pub fn near_one(
        search: &OrbitSearch<'_>,
        start: &State,
        periods: &[f64],
        choice: &Choice<'_>,
    ) -> Result<Self, NoOrbit> {
        let mut first = None;
        for period in periods {
            match Self::near(search, start, *period, choice) {
                Err(error @ NoOrbit::NotFound { .. }) => first = first.or(Some(error)),
                Err(error) => return Err(first.unwrap_or(error)),
                found => return found,
            }
        }
        Err(first.unwrap_or(NoOrbit::NoReturn { end: search.plan.end }))
    }
}

impl OrbitSearch<'_> {
    /// S⁻¹ y.
    fn back(&self, state: &State) -> State {
        self.shift.as_ref().map_or_else(|| state.clone(), |shift| shift.back(state))
    }

    /// Whether a motion is driven, or loses energy within a period.
    fn settles(&self, start: &State, period: f64) -> Result<bool, NoOrbit> {
        if self.model.is_driven() {
            return Ok(true);
        }
        let Some(later) = self.after(start, period) else { return Ok(false) };
        let [(before, kinetic), (after, later)] =
            [seen(self.model, start)?, seen(self.model, &later)?].map(|[total, kinetic]| (total, kinetic));
        Ok((before - after).abs() > KEPT * kinetic.max(later))
    }

    /// The state of a run after a time \[s\], as one to begin with; none where the run ends before.
    fn after(&self, start: &State, time: f64) -> Option<State> {
        let mut last = start.clone();
        let ended = each_state(self.model, start, &RunPlan { end: time, ..*self.plan }, |state| last.clone_from(state));
        last.time = 0.0;
        ended.ok().map(|()| last)
    }

    /// Whether rates along a motion are others at another time: supports that go on or turn change more than the
    /// velocity of a surface that stays where it is.
    fn is_carried(&self, trial: &mut Trial) -> Result<bool, NoOrbit> {
        let moves = self.model.supports.iter().any(|support| !support.motion.is_fixed())
            || self.model.solid_supports.iter().any(|support| !support.motion.is_fixed());
        let later = [0.131, 0.373, 0.719].map(|part| part * trial.period);
        Ok(moves && self.difference_later(trial, &later)? > 1e-12)
    }

    /// Refuses a period that is none of what drives the motion.
    fn check_period(&self, trial: &mut Trial) -> Result<(), NoOrbit> {
        let period = trial.period;
        let difference = self.difference_later(trial, &REPETITIONS.map(|times| times * period))?;
        if difference > SAME { Err(NoOrbit::NotPeriodic { period, difference }) } else { Ok(()) }
    }

    /// By how much the rates of the states of a motion over a period differ later, by times \[s\], from what they are:
    /// the largest difference in scales, as a part of the largest rate; infinite where a state is then outside the
    /// model.
    fn difference_later(&self, trial: &mut Trial, later: &[f64]) -> Result<f64, NoOrbit> {
        let (mut largest, mut difference) = (0.0_f64, 0.0_f64);
        let plan = RunPlan { end: trial.period, ..*self.plan };
        let Trial { start, chart, .. } = trial;
        let ended = each_state(self.model, start, &plan, |state| {
            // A state between the ends of a step may be outside of the model by itself.
            let Ok(here) = chart.rates(state.time, state) else { return };
            largest = largest.max(chart.size(&here));
            for later in later {
                let there = chart.rates(state.time + later, state);
                difference = there.map_or(f64::INFINITY, |there| difference.max(chart.size(&(there - &here))));
            }
        });
        ended.map_err(|error| NoOrbit::Flow { period: plan.end, reason: error.to_string() })?;
        Ok(if difference > 0.0 { difference / largest } else { 0.0 })
    }
}
