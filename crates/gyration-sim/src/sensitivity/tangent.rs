//! The variational equations along the steps of a run.
//!
//!   S′ = J(y, t) S + ∂f/∂p,   S(0) = ∂y₀/∂p,   W′ = ∂g/∂y S + ∂g/∂p,   W(0) = 0
//!
//! a column for each number, and one without a number: a perturbation of the start in all directions, whose growth tells how
//! many digits the motion has left. y comes from the dense output of the run, whose error is that of its steps; the
//! linear equation takes steps of its own (`collocation`), so that it is resolved where the run is not: a body at rest
//! takes long steps, and what is varied about it may swing. Works are quadratures by the same nodes.

use super::collocation::{self, NODES, Rule, STAGES, Stages, Step};
use super::kinks::Kinks;
use super::quantity::Quantities;
use super::variation::{Fault, Variation};
use super::{GROWN, Meaningless};
use crate::adapter::{ModelSystem, Tolerance};
use crate::outcome::Stop;
use crate::plan::RunPlan;
use crate::ports::RunError;
use gyration::Inadmissible;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{Integrator, System as _};
use nalgebra::DMatrix;

/// Scales of the state, lengths being gaps: what changes by one of them has changed altogether. A thousandth of the
/// body's own size and speed counts at least.
const SCALES: Tolerance = Tolerance { rtol: 10.0, atol: 1e-2 };
/// The error of a step, as a part of rtol.
const SHARE: f64 = 0.1;
/// The error of a step in the perturbation, of which only the growth matters.
const GROWTH: f64 = 1e-2;
/// The error that the effect of a number, for a change by the whole of it, may have in a step in any case [scales]: the
/// differences by the number are no better.
const NEGLIGIBLE: f64 = 1e-10;
/// How the size of a step may change.
const CHANGE: (f64, f64) = (0.2, 4.0);
/// A step may not be smaller than this part of a step of the run.
const SMALLEST: f64 = 1e-6;
/// The equations at a node are those of a time earlier by this part of a step.
const INSIDE: f64 = 1e-10;
/// How far from a kink the rates on its sides are taken, as a part of its time: some roundings of it.
const BESIDE: f64 = 16.0 * f64::EPSILON;
/// The state is varied along S by this part of its scales.
const PROBE: f64 = 5e-4;

/// S and W after a time of the run.
pub(super) struct Tangent<'a> {
    system: ModelSystem<'a>,
    rule: Rule,
    /// The numbers, with what their kinks do; none for those without a derivative.
    variations: Vec<Result<(Variation, Kinks), Meaningless>>,
    /// S; the last column is the perturbation.
    state: DMatrix<f64>,
    /// W.
    works: DMatrix<f64>,
    time: f64,
    size: f64,
    tolerance: f64,
    follows_works: bool,
    /// The state at a node, and its scales.
    at: State,
    scales: Vec<f64>,
    /// The largest growth of the perturbation so far.
    growth: f64,
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
        variations: Vec<Result<Variation, Meaningless>>,
    ) -> Result<Self, RunError> {
        let outside = |left| RunError::Start(Stop::by_inadmissible(model, start.time, &left));
        let mut system = ModelSystem::new(model, start, SCALES).map_err(outside)?;
        let (n, columns) = (model.dimension(), variations.len() + 1);
        let mut scales = vec![0.0; n + model.works().len()];
        fill_scales(&mut system, start, &mut scales);
        let mut state = DMatrix::zeros(n, columns);
        let mut prepared = Vec::new();
        for (column, variation) in variations.into_iter().enumerate() {
            prepared.push(variation.and_then(|mut variation| {
                let found = variation.start(&scales[..n]).map_err(|fault| meaningless(model, 0.0, &fault))?;
                let kinks =
                    Kinks::of(model, plan.end, &mut variation).map_err(|fault| meaningless(model, 0.0, &fault))?;
                state.column_mut(column).copy_from_slice(&found);
                Ok((variation, kinks))
            }));
        }
        // Signs in no order, so that no mode is left out.
        let signs = (0..n).map(|i| if (i * i + i / 3) % 5 < 2 { 1.0 } else { -1.0 });
        for (row, sign) in signs.enumerate() {
            state[(row, columns - 1)] = sign * scales[row];
        }
        let works = DMatrix::zeros(model.works().len(), columns);
        Ok(Self {
            system,
            rule: Rule::new(),
            variations: prepared,
            state,
            works,
            time: start.time,
            size: f64::INFINITY,
            tolerance: SHARE * plan.tolerance.rtol,
            follows_works: false,
            at: start.clone(),
            scales,
            growth: 1.0,
        })
    }

    /// Follows the works as well from now on.
    pub fn follow_works(&mut self) {
        self.follows_works = true;
    }

    /// How many times the perturbation has grown.
    pub fn growth(&self) -> f64 {
        self.growth
    }

    /// How far the derivatives of the equations by each number are in doubt.
    pub fn doubts(&self) -> impl Iterator<Item = f64> {
        self.variations.iter().map(|variation| variation.as_ref().map_or(0.0, |(variation, _)| variation.doubt()))
    }

    /// Looks at the state that has been come to.
    pub fn look(&mut self, run: &Integrator) {
        self.at.time = self.time;
        self.look_at(run);
    }

    /// The derivatives of quantities by one of the numbers, in the state looked at.
    ///
    /// # Errors
    /// Why they mean nothing.
    pub fn derivative(&mut self, column: usize, quantities: &mut Quantities) -> Result<Vec<f64>, Meaningless> {
        let model = self.system.model();
        let (variation, _) = self.variations[column].as_mut().map_err(|lost| lost.clone())?;
        let direction: Vec<f64> = self.state.column(column).iter().chain(&self.works.column(column)).copied().collect();
        let found = quantities.derivative(model, &self.at, &direction, &self.scales, variation);
        found.map_err(|fault| meaningless(model, self.time, &fault))
    }

    /// Comes to a time within the last step of the run.
    pub fn follow(&mut self, run: &Integrator, until: f64) {
        let whole = until - self.time;
        while self.time < until && self.variations.iter().any(Result::is_ok) {
            let rest = until - self.time;
            let mut size = self.size.min(rest);
            // Two halves rather than a whole and a crumb.
            if size < rest && size > 0.7 * rest {
                size = 0.5 * rest;
            }
            let end = if size < rest { self.time + size } else { until };
            if size < SMALLEST * whole || self.time + size == self.time {
                return self.lose_all("it changes faster than can be followed".into());
            }
            match self.attempt(run, (self.time, end)) {
                Ok(next) => self.size = next,
                Err(left) => return self.lose_all(reason(self.system.model(), self.time, &left)),
            }
        }
        self.time = until;
    }

    /// Tries a step, and keeps it if its error is small; gives the size to go on with.
    fn attempt(&mut self, run: &Integrator, between: (f64, f64)) -> Result<f64, Inadmissible> {
        let size = between.1 - between.0;
        let (stages, states, forced_works) = self.stages(run, between)?;
        let blocks = self.system.blocks().to_vec();
        let Some(step) = self.rule.step(&blocks, &self.state, size, &stages) else { return Ok(CHANGE.0 * size) };
        let error = self.error(&step, size) / self.tolerance;
        if error > 1.0 || error.is_nan() {
            let factor = if error.is_finite() { 0.9 * error.powf(-0.1) } else { 0.0 };
            return Ok(size * factor.clamp(CHANGE.0, 0.9));
        }
        if self.follows_works {
            self.add_works(&step, size, &states, &forced_works)?;
        }
        self.state = step.values.into_iter().next_back().unwrap_or_default();
        self.time = between.1;
        self.note_growth();
        Ok(size * (0.9 * error.powf(-0.1)).clamp(CHANGE.0, CHANGE.1))
    }

    /// J and b at the nodes of a step, with the states there, and what forces the works.
    #[expect(clippy::type_complexity, reason = "three lists over the nodes, used once")]
    fn stages(
        &mut self,
        run: &Integrator,
        (from, to): (f64, f64),
    ) -> Result<(Stages, Vec<State>, Vec<DMatrix<f64>>), Inadmissible> {
        let model = self.system.model();
        let (mut stages, mut states, mut forced) = (Stages::default(), Vec::new(), Vec::new());
        for (node, part) in NODES.iter().enumerate() {
            self.at.time = if node + 1 == STAGES { to } else { from + part * (to - from) };
            self.look_at(run);
            let mut slopes: Vec<_> =
                model.blocks().iter().map(|block| DMatrix::zeros(block.len(), block.len())).collect();
            // A step may end at a kink, behind which the model is another one.
            let inside = self.at.time - INSIDE * (to - from);
            self.system.jacobian(inside, &self.at.bodies, &mut slopes)?;
            let (forcing, forcing_works) = self.forcing();
            stages.slopes.push(slopes);
            stages.forcing.push(forcing);
            forced.push(forcing_works);
            states.push(self.at.clone());
        }
        Ok((stages, states, forced))
    }

    /// The state of the run at the time of `at`, on its manifold, and its scales.
    fn look_at(&mut self, run: &Integrator) {
        let State { time, bodies, works } = &mut self.at;
        run.interpolate(*time, bodies, works);
        self.system.project(*time, bodies, works);
        fill_scales(&mut self.system, &self.at, &mut self.scales);
    }

    /// ∂f/∂p and ∂g/∂p in the state at hand; a number for which there is none loses its meaning.
    fn forcing(&mut self) -> (DMatrix<f64>, DMatrix<f64>) {
        let model = self.system.model();
        let (n, works) = (self.state.nrows(), self.works.nrows());
        let mut forcing = DMatrix::zeros(n, self.state.ncols());
        let mut forcing_works = DMatrix::zeros(works, self.state.ncols());
        for (column, variation) in self.variations.iter_mut().enumerate() {
            let Ok((varied, kinks)) = variation else { continue };
            for (time, weight) in kinks.beside(self.at.time).into_iter().filter(|(_, weight)| *weight != 0.0) {
                match varied.rates(time, &self.at.bodies, &self.scales) {
                    Ok(found) => {
                        let mut own = forcing.column_mut(column);
                        own.iter_mut().zip(&found[..n]).for_each(|(sum, value)| *sum += weight * value);
                        let mut own = forcing_works.column_mut(column);
                        own.iter_mut().zip(&found[n..]).for_each(|(sum, value)| *sum += weight * value);
                    }
                    Err(fault) => {
                        *variation = Err(meaningless(model, self.at.time, &fault));
                        self.state.column_mut(column).fill(0.0);
                        forcing.column_mut(column).fill(0.0);
                        break;
                    }
                }
            }
        }
        (forcing, forcing_works)
    }

    /// The largest error of a step over the columns, each relative to what it has grown to.
    fn error(&self, step: &Step, size: f64) -> f64 {
        let (n, columns) = self.state.shape();
        let scales = &self.scales[..n];
        let largest = |values: &DMatrix<f64>, column: usize| {
            let parts = scales.iter().enumerate().map(|(row, scale)| values[(row, column)].abs() / scale);
            // A sum, unlike a maximum, does not lose what is no number.
            parts.fold(0.0, |most: f64, part| if part > most || part.is_nan() { part } else { most })
        };
        let of_column = |column: usize| {
            let (least, weight, noise) = match self.variations.get(column) {
                Some(Err(_)) => return 0.0,
                Some(Ok((variation, _))) => (NEGLIGIBLE / (self.tolerance * variation.scale()), 1.0, variation.noise()),
                None => (0.0, self.tolerance / GROWTH, 0.0),
            };
            let end = largest(&step.values[STAGES - 1], column);
            let grown = largest(&self.state, column).max(end).max(least);
            let coefficients = self.rule.coefficients(step, column, scales);
            collocation::error(size, noise, coefficients) * weight / grown + 0.0 * end
        };
        let errors = (0..columns).map(of_column);
        errors.fold(0.0, |most: f64, error| if error > most || error.is_nan() { error } else { most })
    }

    /// W of a step: the derivative of the powers along S by differences, and their own.
    fn add_works(
        &mut self,
        step: &Step,
        size: f64,
        states: &[State],
        forced: &[DMatrix<f64>],
    ) -> Result<(), Inadmissible> {
        for (node, state) in states.iter().enumerate() {
            let weight = size * self.rule.weight(node);
            for column in 0..self.variations.len() {
                if self.variations[column].is_err() {
                    continue;
                }
                let direction: Vec<f64> = step.values[node].column(column).iter().copied().collect();
                let along = along(&direction, &self.scales, |part| {
                    let (mut rates, mut powers) = (vec![0.0; state.bodies.len()], vec![0.0; state.works.len()]);
                    let bodies: Vec<f64> = state.bodies.iter().zip(&direction).map(|(y, s)| y + part * s).collect();
                    self.system.rates(state.time, &bodies, &mut rates, &mut powers).map(|()| powers)
                })?;
                for (row, value) in along.iter().enumerate() {
                    self.works[(row, column)] += weight * (value + forced[node][(row, column)]);
                }
            }
        }
        Ok(())
    }

    /// Takes S over an instant at which the rates jump, and the instant moves: S⁺ = S⁻ + (f⁻ − f⁺) dt/dp.
    pub fn cross(&mut self, run: &Integrator) {
        let here = |variation: &Result<(Variation, Kinks), _>| {
            variation.as_ref().is_ok_and(|(_, kinks)| kinks.has_come(self.time))
        };
        if self.variations.iter().any(here) {
            self.look(run);
            if let Err(left) = self.jump() {
                self.lose_all(reason(self.system.model(), self.time, &left));
            }
        }
    }

    fn jump(&mut self) -> Result<(), Inadmissible> {
        for (column, variation) in self.variations.iter_mut().enumerate() {
            let Ok((_, kinks)) = variation else { continue };
            let Some(kink) = kinks.come_to(self.time) else { continue };
            let n = self.at.bodies.len();
            let mut sides =
                [-1.0, 1.0].map(|side| (kink.time + side * BESIDE * kink.time, vec![0.0; n + self.works.nrows()]));
            for (time, values) in &mut sides {
                let (slopes, powers) = values.split_at_mut(n);
                self.system.rates(*time, &self.at.bodies, slopes, powers)?;
            }
            let [before, after] = sides.map(|(_, values)| values);
            let jump = |i: usize| (before[i] - after[i]) * kink.moves;
            (0..n).for_each(|row| self.state[(row, column)] += jump(row));
            (0..self.works.nrows()).for_each(|row| self.works[(row, column)] += jump(n + row));
        }
        Ok(())
    }

    /// Follows the growth of the perturbation; beyond what the digits of the run bear, nothing has a meaning.
    fn note_growth(&mut self) {
        let column = self.state.ncols() - 1;
        let sizes = self.scales.iter().enumerate().take(self.state.nrows());
        let grown = sizes.map(|(row, scale)| self.state[(row, column)].abs() / scale).fold(0.0, f64::max);
        self.growth = self.growth.max(grown);
        let rtol = self.tolerance / SHARE;
        if self.growth * rtol > GROWN {
            self.lose_all(format!(
                "what is not known of the state has grown {:.1e} times: with rtol = {rtol:e}, less than a digit of the \
                 motion is left from here on",
                self.growth
            ));
        }
    }

    fn lose_all(&mut self, reason: String) {
        let time = self.time;
        for variation in self.variations.iter_mut().filter(|variation| variation.is_ok()) {
            *variation = Err(Meaningless { from: time, reason: reason.clone() });
        }
    }
}

/// The derivative of something along a direction of the state, by differences of fourth order; `evaluate` gives it at a
/// multiple of the direction.
pub(super) fn along<E>(
    direction: &[f64],
    scales: &[f64],
    mut evaluate: impl FnMut(f64) -> Result<Vec<f64>, E>,
) -> Result<Vec<f64>, E> {
    let size = direction.iter().zip(scales).map(|(part, scale)| part.abs() / scale).fold(0.0, f64::max);
    if size == 0.0 {
        return Ok(vec![0.0; evaluate(0.0)?.len()]);
    }
    let step = PROBE / size;
    let [a, b, c, d] = [evaluate(-2.0 * step)?, evaluate(-step)?, evaluate(step)?, evaluate(2.0 * step)?];
    let at = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * step);
    Ok((0..a.len()).map(at).collect())
}

/// The scales of state and works.
fn fill_scales(system: &mut ModelSystem<'_>, state: &State, scales: &mut [f64]) {
    let (bodies, works) = scales.split_at_mut(state.bodies.len());
    system.error_scales(state.time, &state.bodies, &state.works, bodies, works);
}

fn reason(model: &Model, time: f64, left: &Inadmissible) -> String {
    Stop::by_inadmissible(model, time, left).what
}

/// A fault in words.
pub(super) fn meaningless(model: &Model, time: f64, fault: &Fault) -> Meaningless {
    let reason = match fault {
        Fault::Reason(reason) => reason.clone(),
        Fault::Inadmissible(left) => format!("with a little more or less of it, {}", reason(model, time, left)),
    };
    Meaningless { from: time, reason }
}
