//! The variational equations along the steps of a run.
//!
//!   S′ = J(y, t) S + ∂f/∂p,   S(0) = ∂y₀/∂p,   W′ = ∂g/∂y S + ∂g/∂p,   W(0) = 0
//!
//! a column for each number or direction of the start, and one besides: a perturbation of the start in all directions,
//! whose growth tells how many digits the motion has left. y comes from the dense output of the run, whose error is
//! that of its steps; the linear equation takes steps of its own (`collocation`), shorter where the run does not
//! resolve it (a body at rest takes long steps, and what is varied about it may swing), and over several steps of the
//! run where these are short (`history`). Works are quadratures by the same nodes (`works`).

use super::blocks::{apart, together};
use super::collocation::{self, CollocationRule, CollocationStep, NODES, NodeValues};
use super::history::StepHistory;
use super::kinks::Kinks;
use super::last_powers::LastPowers;
use super::probe::{SCALES, fill_scales, meaningless, reason};
use super::quantity::Quantities;
use super::stage_equations::STAGES;
use super::switches::Switching;
use super::{GROWN, Meaningless, SensitivityCounts};
use crate::adapter::ModelSystem;
use crate::outcome::Stop;
use crate::plan::RunPlan;
use crate::ports::RunError;
use crate::variation::{BaseRates, SceneVariation};
use gyration::Inadmissible;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{BlockMatrix, Extended, ExtendedMut, Integrator, System as _};
use nalgebra::DMatrix;

/// The error of a step, as a part of rtol.
const SHARE: f64 = 0.1;
/// The error of a step in the perturbation, of which only the growth matters.
const GROWTH: f64 = 1e-2;
/// The error that the effect of a number, for a change by the whole of it, may have in a step in any case [scales]: the
/// differences by the number are no better.
const NEGLIGIBLE: f64 = 1e-10;
/// How the size of a step may change.
const CHANGE: (f64, f64) = (0.2, 4.0);
/// A step may be so many times as long as the shortest step of the run that it passes: several of its nodes then stand
/// where the run found something to look at.
const SPAN: f64 = 8.0;
/// The longest step of the run is forgotten at this rate with each step.
const FORGOTTEN: f64 = 0.95;
/// The run is kept for no more of its steps than that.
const MOST_STEPS: usize = 100;
/// A step may not be smaller than this part of a step of the run: of a body at rest that is long, but what is varied in
/// it may relax within no time.
const SMALLEST: f64 = 1e-13;
/// Nor may the error ask for one of so few digits of the time: its nodes could not be told apart.
const LEAST_DIGITS: f64 = 64.0 * f64::EPSILON;
/// So many steps are tried for each of the run, and so many besides: deep in a field of which the run has a few long
/// steps there may be no end of them.
const MOST_TRIED: (u64, u64) = (200, 100_000);
/// The equations at a node are those of a time earlier by this part of a step.
const INSIDE: f64 = 1e-10;

/// The equations at the nodes of a step.
#[derive(Default)]
pub(super) struct Nodes {
    stages: NodeValues,
    /// The sets of numbers whose equations are solved apart.
    sets: Vec<Vec<usize>>,
    /// The state there, just inside of the step.
    pub states: Vec<State>,
    /// ∂g/∂p, a column for each number.
    pub powers: Vec<DMatrix<f64>>,
}

/// What a column follows.
pub(super) enum Followed {
    /// A number, with what its kinks do.
    Number(Box<(SceneVariation, Kinks)>),
    /// A direction of the start.
    Direction,
}

/// S and W after a time of the run.
pub(super) struct Tangent<'a> {
    /// The model.
    pub(super) model: &'a Model,
    pub(super) system: ModelSystem,
    rule: CollocationRule,
    /// What the columns follow; none for those without a derivative.
    pub(super) columns: Vec<Result<Followed, Meaningless>>,
    /// S; the last column is the perturbation.
    pub(super) state: DMatrix<f64>,
    /// W.
    pub(super) works: DMatrix<f64>,
    pub(super) time: f64,
    size: f64,
    /// The longest step of the run lately [s]: about a jump they are short.
    pub(super) run_step: f64,
    tolerance: f64,
    /// rtol of the run.
    rtol: f64,
    follows_works: bool,
    pub(super) last_powers: LastPowers,
    /// f at the node at hand.
    base: BaseRates,
    pub(super) history: StepHistory,
    /// Where formulas go over to others.
    pub(super) switching: Switching,
    /// The state at a node, and its scales.
    pub(super) at: State,
    pub(super) scales: Vec<f64>,
    /// The largest growth of the perturbation so far.
    growth: f64,
    /// Steps tried, and steps of the run.
    tried: [u64; 2],
}

impl<'a> Tangent<'a> {
    /// Starts from the first state of a run.
    ///
    /// # Errors
    /// `RunError::Start` if the start is outside the model.
    pub fn new(
        model: &'a Model,
        start: &State,
        plan: &RunPlan,
        variations: Vec<Result<SceneVariation, Meaningless>>,
    ) -> Result<Self, RunError> {
        let mut this = Self::begun(model, start, plan, variations.len())?;
        let n = model.dimension();
        for (column, variation) in variations.into_iter().enumerate() {
            let followed = variation.and_then(|mut variation| {
                let found = variation.start(&this.scales[..n]).map_err(|fault| meaningless(model, 0.0, &fault))?;
                let kinks =
                    Kinks::of(model, plan.end, &mut variation).map_err(|fault| meaningless(model, 0.0, &fault))?;
                this.state.column_mut(column).copy_from_slice(&found);
                Ok(Followed::Number(Box::new((variation, kinks))))
            });
            this.columns.push(followed);
        }
        Ok(this)
    }

    /// Starts from a state, to follow directions of it: the columns of a matrix.
    ///
    /// # Errors
    /// As [`Tangent::new`].
    pub fn of_directions(
        model: &'a Model,
        start: &State,
        plan: &RunPlan,
        directions: &DMatrix<f64>,
    ) -> Result<Self, RunError> {
        let mut this = Self::begun(model, start, plan, directions.ncols())?;
        this.state.columns_mut(0, directions.ncols()).copy_from(directions);
        this.columns.extend((0..directions.ncols()).map(|_| Ok(Followed::Direction)));
        Ok(this)
    }

    /// With room for so many columns, and the perturbation behind them.
    fn begun(model: &'a Model, start: &State, plan: &RunPlan, columns: usize) -> Result<Self, RunError> {
        let outside = |left| RunError::at_start(Stop::by_inadmissible(model, start.time, &left));
        let mut system = ModelSystem::new(model.clone(), start, SCALES).map_err(outside)?;
        let n = model.dimension();
        let mut scales = vec![0.0; n + model.works().len()];
        fill_scales(&mut system, start, &mut scales);
        let mut state = DMatrix::zeros(n, columns + 1);
        // Signs in no order, so that no mode is left out.
        let signs = (0..n).map(|i| if (i * i + i / 3) % 5 < 2 { 1.0 } else { -1.0 });
        for (row, sign) in signs.enumerate() {
            state[(row, columns)] = sign * scales[row];
        }
        let works = DMatrix::zeros(model.works().len(), columns + 1);
        let mut this = Self {
            model,
            system,
            rule: CollocationRule::new(),
            columns: Vec::with_capacity(columns),
            state,
            works,
            time: start.time,
            size: f64::INFINITY,
            run_step: 0.0,
            tolerance: SHARE * plan.tolerance.rtol,
            rtol: plan.tolerance.rtol,
            follows_works: false,
            last_powers: LastPowers::default(),
            base: BaseRates::default(),
            history: StepHistory::default(),
            switching: Switching::default(),
            at: start.clone(),
            scales,
            growth: 1.0,
            tried: [0; 2],
        };
        this.begin_switching().map_err(outside)?;
        Ok(this)
    }

    /// Follows the works as well from now on.
    pub fn follow_works(&mut self) {
        self.follows_works = true;
        for followed in &mut self.columns {
            let Ok(Followed::Number(number)) = followed else { continue };
            if let Err(reason) = number.0.follow_works() {
                *followed = Err(Meaningless { from: self.time, reason });
            }
        }
    }

    /// Allows this error of a step, where rtol asks for a smaller one.
    pub fn allow(&mut self, error: f64) {
        self.tolerance = self.tolerance.max(error);
    }

    /// How many times the perturbation has grown.
    pub fn growth(&self) -> f64 {
        self.growth
    }

    /// What it has taken so far.
    pub fn counts(&self) -> SensitivityCounts {
        let of_number = |followed: &Result<Followed, Meaningless>| match followed {
            Ok(Followed::Number(number)) => number.0.evaluations(),
            Ok(Followed::Direction) | Err(_) => 0,
        };
        let [steps, run_steps] = self.tried;
        let evaluations = self.base.evaluations() + self.columns.iter().map(of_number).sum::<u64>();
        SensitivityCounts { run_steps, steps, evaluations }
    }

    /// How far the derivatives of the equations by each number are in doubt.
    pub fn doubts(&self) -> impl Iterator<Item = f64> {
        self.columns.iter().map(|followed| match followed {
            Ok(Followed::Number(number)) => number.0.doubt(),
            Ok(Followed::Direction) | Err(_) => 0.0,
        })
    }

    /// Looks at the state that has been come to, in the last step of the run.
    pub fn look(&mut self, run: &Integrator) {
        let State { time, bodies, low, works } = &mut self.at;
        *time = self.time;
        run.interpolate(*time, bodies, works);
        low.clear();
        self.project();
    }

    /// The derivatives of quantities by one of the numbers, in the state looked at.
    ///
    /// # Errors
    /// Why they mean nothing.
    pub fn derivative(&mut self, column: usize, quantities: &mut Quantities) -> Result<Vec<f64>, Meaningless> {
        let model = self.model;
        let followed = self.columns[column].as_mut().map_err(|lost| lost.clone())?;
        let Followed::Number(number) = followed else { unreachable!("quantities are differentiated by numbers") };
        let variation = &mut number.0;
        let direction: Vec<f64> = self.state.column(column).iter().chain(&self.works.column(column)).copied().collect();
        let found = quantities.derivative(model, &self.at, &direction, &self.scales, variation);
        found.map_err(|fault| meaningless(model, self.time, &fault))
    }

    /// Takes down the last step of the run.
    pub fn record(&mut self, run: &Integrator) {
        if self.is_followed() {
            self.history.record(run);
            self.tried[1] += 1;
            if let Some((from, to)) = run.last_step() {
                self.run_step = (FORGOTTEN * self.run_step).max(to - from);
                if let Err(left) = self.watch(from, to) {
                    self.lose_all(reason(self.model, to, &left));
                }
            }
        }
    }

    /// Goes on in whole steps as far as the run is known.
    pub fn go_on(&mut self) {
        let Some(known) = self.history.end() else { return };
        if self.history.len() >= MOST_STEPS {
            return self.reach(known);
        }
        while self.is_followed() && self.size <= known - self.time {
            self.step_to(self.time + self.size);
        }
        self.history.forget(self.time);
    }

    /// Comes to a time up to which the run is known.
    pub fn reach(&mut self, until: f64) {
        while self.time < until && self.is_followed() {
            let (rest, mut size) = (until - self.time, self.size);
            // Two halves rather than a whole and a crumb.
            if size < rest && size > 0.7 * rest {
                size = 0.5 * rest;
            }
            self.step_to(if size < rest { self.time + size } else { until });
        }
        self.time = self.time.max(until);
        self.history.forget(self.time);
    }

    fn is_followed(&self) -> bool {
        self.columns.iter().any(Result::is_ok)
    }

    /// Tries a step towards a time, to where a formula goes over to another at most; where it comes to none, all is
    /// lost.
    fn step_to(&mut self, wanted: f64) {
        let end = self.history.limit(self.time, wanted, SPAN);
        let switch = self.switch_by(end).map(|state| state.time);
        let end = switch.unwrap_or(end);
        let size = end - self.time;
        let least = SMALLEST * self.history.step_at(self.time);
        if switch.is_some() && size <= least.max(LEAST_DIGITS * end.abs()) {
            return self.switch_over();
        }
        if size <= least || self.size <= LEAST_DIGITS * self.time.abs() {
            return self.lose_all("it changes faster than can be followed".into());
        }
        let [tried, run] = self.tried;
        if tried > MOST_TRIED.0 * run + MOST_TRIED.1 {
            return self.lose_all(format!("{tried} steps, where the run took {run}, have not followed it farther"));
        }
        self.tried[0] += 1;
        match self.attempt(end) {
            // What kept it short may be over behind it.
            Ok(next) if self.time == end && end < wanted => self.size = self.size.max(next),
            Ok(next) => self.size = next,
            Err(left) => self.lose_all(reason(self.model, self.time, &left)),
        }
    }

    /// Tries a step to a time, and keeps it if its error is small; gives the size to go on with.
    fn attempt(&mut self, end: f64) -> Result<f64, Inadmissible> {
        let size = end - self.time;
        let nodes = self.nodes(self.time, end)?;
        let Some(step) = self.rule.step(&nodes.sets, &self.state, size, &nodes.stages) else {
            return Ok(CHANGE.0 * size);
        };
        let slopes = if self.follows_works { self.powers(&step, &nodes, size)? } else { None };
        if self.follows_works && slopes.is_none() {
            return Ok(CHANGE.0 * size);
        }
        let powers = slopes.as_ref().map_or(&[][..], |slopes| &slopes.nodes);
        let error = self.error(&step, powers, size) / self.tolerance;
        if error > 1.0 || error.is_nan() {
            let factor = if error.is_finite() { 0.9 * libm::pow(error, -0.1) } else { 0.0 };
            return Ok(size * factor.clamp(CHANGE.0, 0.9));
        }
        if let Some(slopes) = slopes {
            for (node, powers) in slopes.nodes.iter().enumerate() {
                self.works += powers * (size * self.rule.weight(node));
            }
            self.works += &slopes.shifted;
            self.last_powers.take(end, slopes);
        }
        self.state = step.values.into_iter().next_back().unwrap_or_default();
        self.time = end;
        self.note_growth();
        Ok(size * (0.9 * libm::pow(error, -0.1)).clamp(CHANGE.0, CHANGE.1))
    }

    /// The equations at the nodes of a step, and the states there.
    fn nodes(&mut self, from: f64, to: f64) -> Result<Nodes, Inadmissible> {
        let model = self.model;
        let mut nodes = Nodes::default();
        for (node, part) in NODES.iter().enumerate() {
            self.look_at(from, part * (to - from));
            // A step may end at a kink or a switch, behind which the equations are others.
            let mut inside = self.at.time - INSIDE * (to - from);
            if node + 1 == STAGES {
                match self.switch_by(to).cloned() {
                    Some(before) => (self.at, inside) = (before, to),
                    None => self.at.time = to,
                }
            }
            let mut slopes = BlockMatrix::new(model.blocks());
            let y = Extended { high: &self.at.bodies, low: &self.at.low };
            self.system.extended_jacobian(inside, y, &mut slopes)?;
            let (forcing, forcing_works) = self.forcing();
            nodes.sets = apart(self.system.components(), model.blocks());
            nodes.stages.slopes.push(together(&slopes, self.system.components(), model.blocks()));
            nodes.stages.forcing.push(forcing);
            nodes.powers.push(forcing_works);
            nodes.states.push(State { time: inside, ..self.at.clone() });
        }
        Ok(nodes)
    }

    /// Puts the state at hand on its manifold, and finds its scales.
    pub(super) fn project(&mut self) {
        let State { time, bodies, low, works } = &mut self.at;
        self.system.extended_project(*time, ExtendedMut { high: bodies, low }, works);
        fill_scales(&mut self.system, &self.at, &mut self.scales);
    }

    /// ∂f/∂p and ∂g/∂p in the state at hand; a number for which there is none loses its meaning.
    fn forcing(&mut self) -> (DMatrix<f64>, DMatrix<f64>) {
        let model = self.model;
        let (n, works) = (self.state.nrows(), self.works.nrows());
        let mut forcing = DMatrix::zeros(n, self.state.ncols());
        let mut forcing_works = DMatrix::zeros(works, self.state.ncols());
        self.base.leave();
        let beside: Vec<_> = (0..self.columns.len()).map(|column| self.beside_switches(column)).collect();
        for ((column, followed), beside) in self.columns.iter_mut().enumerate().zip(&beside) {
            let Ok(Followed::Number(number)) = followed else { continue };
            let (varied, kinks) = &mut **number;
            let places = match beside {
                Some(places) => places.each_ref().map(|(state, weight)| (state, state.time, *weight)),
                None => kinks.beside(self.at.time).map(|(time, weight)| (&self.at, time, weight)),
            };
            for (state, time, weight) in places.into_iter().filter(|(.., weight)| *weight != 0.0) {
                match varied.rates(model, &mut self.base, (time, state.numbers(), &self.scales)) {
                    Ok(found) => {
                        let mut own = forcing.column_mut(column);
                        own.iter_mut().zip(&found[..n]).for_each(|(sum, value)| *sum += weight * value);
                        let mut own = forcing_works.column_mut(column);
                        own.iter_mut().zip(&found[n..]).for_each(|(sum, value)| *sum += weight * value);
                    }
                    Err(fault) => {
                        *followed = Err(meaningless(model, self.at.time, &fault));
                        self.state.column_mut(column).fill(0.0);
                        forcing.column_mut(column).fill(0.0);
                        break;
                    }
                }
            }
        }
        (forcing, forcing_works)
    }

    /// The largest error of a step over the columns, each relative to what it has grown to; works by the energy in
    /// play.
    fn error(&self, step: &CollocationStep, powers: &[DMatrix<f64>], size: f64) -> f64 {
        let (n, columns) = self.state.shape();
        let (scales, energies) = self.scales.split_at(n);
        let of_column = |column: usize| {
            let (least, weight, noise) = match self.columns.get(column) {
                Some(Err(_)) => return 0.0,
                Some(Ok(Followed::Number(number))) => {
                    let variation = &number.0;
                    (NEGLIGIBLE / (self.tolerance * variation.scale()), 1.0, variation.noise())
                }
                Some(Ok(Followed::Direction)) => (0.0, 1.0, 0.0),
                None => (0.0, self.tolerance / GROWTH, 0.0),
            };
            let end = largest(&step.values[STAGES - 1], column, scales);
            let grown = largest(&self.state, column, scales).max(end).max(least);
            let grown = grown.max(largest(&self.works, column, energies));
            let of_state = self.rule.coefficients(&step.rates, column, scales);
            let of_works = self.rule.coefficients(powers, column, energies);
            let error = collocation::error(size, noise, of_state).max(collocation::error(size, noise, of_works));
            error * weight / grown + 0.0 * end
        };
        worst((0..columns).map(of_column))
    }

    /// Follows the growth of the perturbation; beyond what the digits of the run bear, nothing has a meaning.
    fn note_growth(&mut self) {
        let column = self.state.ncols() - 1;
        self.growth = self.growth.max(largest(&self.state, column, &self.scales[..self.state.nrows()]));
        let rtol = self.rtol;
        if self.growth * rtol > GROWN {
            self.lose_all(format!(
                "what is not known of the state has grown {:.1e} times: with rtol = {rtol:e}, less than a digit of the \
                 motion is left from here on",
                self.growth
            ));
        }
    }

    pub(super) fn lose_all(&mut self, reason: String) {
        let time = self.time;
        for followed in self.columns.iter_mut().filter(|followed| followed.is_ok()) {
            *followed = Err(Meaningless { from: time, reason: reason.clone() });
        }
    }
}

/// The largest entry of a column, in the scales of its rows; no number if there is one that is none.
fn largest(values: &DMatrix<f64>, column: usize, scales: &[f64]) -> f64 {
    worst(scales.iter().enumerate().map(|(row, scale)| values[(row, column)].abs() / scale))
}

/// The largest of some numbers; none if one of them is none, unlike a maximum.
fn worst(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |most, number| if number > most || number.is_nan() { number } else { most })
}
