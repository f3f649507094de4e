//! Shows a model to a stepper: the only place where mechanics and integration meet.
//!
//! The errors allowed per step are scale-free. rtol is relative to what the forces depend on: lengths to the gap (or
//! the size, if that is smaller), velocities to the speed of the fastest material point, works to the energy in play.
//! atol is a fraction of the body's size, of 1 for a rotation, for P and for G, and of the body's own speed scale. One
//! step may spend a tenth of either.

use crate::projection::project;
use crate::resistance::check_resistances;
use crate::scales::{elastic_frequency, energy_scale, speed_scales, spring_frequency};
use gyration::balance::fastest_speed;
use gyration::body::{Body, NEAR};
use gyration::dynamics::{Blocks, Workspace, acting, gap_to_supports, jacobian, rates};
use gyration::extended::Numbers;
use gyration::instant::PairGaps;
use gyration::model::Model;
use gyration::state::{BodyMotion, State};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use gyration::{Inadmissible, Quantity};
use gyration_ode::{BlockMatrix, Components, Extended, ExtendedMut, Pattern, System};
use nalgebra::DMatrix;
use std::ops::Range;
use std::sync::Arc;

/// rtol and atol of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Relative error allowed per step.
    pub rtol: f64,
    /// Error allowed per step as a fraction of the body's scales.
    pub atol: f64,
}

/// The share of the tolerances that one step may spend. Errors of thousands of bounces add up, most of them in one
/// sense; with a tenth each, the ledger of a long run stays within a hundred times rtol.
const SHARE: f64 = 0.1;

/// A model with its scratch and scales, as a stepper sees it.
#[derive(Debug, Clone)]
pub struct ModelSystem {
    model: Model,
    /// The sets of bodies that may act on one another.
    components: Components,
    pattern: BodyPattern,
    workspace: OwnWorkspace,
    tolerance: Tolerance,
    speeds: Vec<f64>,
    /// √(Σk/m) of the springs and bonds at each body, where they start [1/s].
    frequencies: Vec<f64>,
    /// The rounding of velocities by stresses of each body [m/s].
    stirred: Vec<f64>,
    energy: f64,
    radii: Vec<f64>,
    /// What the fluid turns into heat while bodies without inertia move by their size [J].
    viscous: f64,
    /// The rates of the bodies at the start.
    first_rates: Vec<f64>,
    /// Whether impulses of the contacts are integrated, and scratch for their forces.
    impulses: Option<Box<State>>,
    /// Whether something was asked for that was given up.
    interrupted: bool,
}

/// Scratch of the mechanics that is made when it is first needed: most islands are lent one.
#[derive(Debug, Clone, Default)]
pub(crate) struct OwnWorkspace(Option<Box<Workspace>>);

impl OwnWorkspace {
    fn get(&mut self) -> &mut Workspace {
        self.0.get_or_insert_default()
    }
}

impl ModelSystem {
    /// Prepares a model for a run that starts from `start`.
    ///
    /// # Errors
    /// [`Inadmissible`] if the start is outside the model.
    pub fn new(model: Model, start: &State, tolerance: Tolerance) -> Result<Self, Inadmissible> {
        check_resistances(&model)?;
        let slopes = first_rates(&model, start)?;
        let speeds = speed_scales(&model, start, &slopes)?;
        Ok(Self::assemble(model, start, tolerance, (slopes, speeds)))
    }

    /// The same for some bodies of a run, given their speed scales in it [m/s].
    ///
    /// # Errors
    /// [`Inadmissible`] if the start is outside the model.
    pub(crate) fn of_run(
        model: Model,
        start: &State,
        tolerance: Tolerance,
        speeds: Vec<f64>,
    ) -> Result<Self, Inadmissible> {
        check_resistances(&model)?;
        let slopes = first_rates(&model, start)?;
        Ok(Self::assemble(model, start, tolerance, (slopes, speeds)))
    }

    fn assemble(
        model: Model,
        start: &State,
        tolerance: Tolerance,
        (first_rates, speeds): (Vec<f64>, Vec<f64>),
    ) -> Self {
        let energy = model.bodies.iter().zip(&speeds).map(|(body, speed)| energy_scale(&model, body, *speed)).sum();
        // |X| is the speed of X under the unit gradient rate.
        let radius = |surface: &Surface| surface.fastest_point(&Vec3::zeros(), &Mat3::identity());
        let radii = model.bodies.iter().map(|body| body.solid.surface.as_ref().map_or(0.0, radius)).collect();
        let frequencies = (0..model.bodies.len()).map(|body| spring_frequency(&model, start, body)).collect();
        let stirred = |body: &Arc<Body>| f64::EPSILON * body.size * elastic_frequency(body);
        let stirred = model.bodies.iter().map(stirred).collect();
        let inertialess = model.bodies.iter().zip(&speeds).filter(|(body, _)| !body.has_inertia());
        let viscous = inertialess.map(|(body, speed)| energy_scale(&model, body, *speed)).sum();
        let workspace = OwnWorkspace::default();
        let components = Components::joined(model.bodies.len(), model.chain());
        let pattern = BodyPattern::of(&model);
        Self {
            model,
            components,
            pattern,
            workspace,
            tolerance,
            speeds,
            frequencies,
            stirred,
            energy,
            radii,
            viscous,
            first_rates,
            impulses: None,
            interrupted: false,
        }
    }

    /// The same with ∫ f dt of the contacts of each body, as quadratures behind the works that have no part in the
    /// errors of a step.
    #[must_use]
    pub(crate) fn with_impulses(self, asked: bool) -> Self {
        let bodies = vec![0.0; self.model.dimension()];
        let scratch = State { time: 0.0, bodies, low: Vec::new(), works: Vec::new() };
        Self { impulses: asked.then(|| Box::new(scratch)), ..self }
    }

    /// The contact forces of all bodies [N], one behind the other.
    fn contact_forces(&mut self, t: f64, y: Numbers, forces: &mut [f64]) -> Result<(), Inadmissible> {
        let Self { model, workspace, impulses: Some(state), .. } = self else { return Ok(()) };
        state.time = t;
        state.bodies.copy_from_slice(y.high);
        state.low.clear();
        state.low.extend_from_slice(y.low);
        let (instant, scratch) = workspace.get().read(model, state)?;
        for (index, force) in forces.as_chunks_mut::<3>().0.iter_mut().enumerate() {
            *force = acting(&instant.at(index), scratch)?.contact.force.into();
        }
        Ok(())
    }

    /// Rates, powers of the works and, behind them, contact forces.
    fn all_rates(&mut self, t: f64, y: Numbers, dy: &mut [f64], dw: &mut [f64]) -> Result<(), Inadmissible> {
        let (powers, forces) = dw.split_at_mut(self.model.works().len());
        let found = rates(&self.model, self.workspace.get(), t, y, dy, powers);
        let found = found.and_then(|()| self.contact_forces(t, y, forces));
        self.noted(found)
    }

    /// The switching functions of its formulas, as [`Workspace::switching`].
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub(crate) fn switching(&mut self, t: f64, y: Extended) -> Result<Vec<f64>, Inadmissible> {
        self.workspace.get().switching(&self.model, t, Numbers { high: y.high, low: y.low })
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The model, whose loads and drives may be changed between two steps.
    pub(crate) fn model_mut(&mut self) -> &mut Model {
        &mut self.model
    }

    /// The radius of each body's surface about its centre of mass [m].
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// The rates of the bodies at the start of the run, laid out as the state.
    pub fn first_rates(&self) -> &[f64] {
        &self.first_rates
    }

    /// The model and the scratch of its mechanics, for observations between steps.
    pub fn observed(&mut self) -> (&Model, &mut Workspace) {
        (&self.model, self.workspace.get())
    }

    /// The slabs between bodies at the end of the last step; none where no plane was found there.
    pub(crate) fn step_end_gaps(&self) -> Option<&PairGaps> {
        self.workspace.0.as_ref()?.remembered_gaps()
    }

    /// The slabs between bodies at a time and state, beside the system; none where no plane is found.
    pub(crate) fn gaps_at(&mut self, time: f64, bodies: &[f64]) -> (&Self, Option<&PairGaps>) {
        let is_known = self.workspace.get().pair_gaps(&self.model, time, bodies.into()).is_ok();
        let found = self.workspace.0.as_ref().filter(|_| is_known).map(|workspace| workspace.found_gaps());
        (self, found)
    }

    /// Puts scratch of the mechanics in the place of its own.
    pub(crate) fn exchange_workspace(&mut self, workspace: &mut OwnWorkspace) {
        std::mem::swap(&mut self.workspace, workspace);
    }

    /// Gives its scratch of the mechanics up, until it needs some again.
    pub(crate) fn forget_workspace(&mut self) {
        self.workspace = OwnWorkspace::default();
    }

    /// The energy in play of bodies without inertia, which have no kinetic energy [J].
    pub fn viscous_energy(&self) -> f64 {
        self.viscous
    }

    /// Whether something was asked for that was given up, so that what has come of the last step is none of the run.
    pub(crate) fn was_interrupted(&self) -> bool {
        self.interrupted
    }

    /// What was asked for; notes whether it was given up.
    pub(crate) fn noted<T>(&mut self, found: Result<T, Inadmissible>) -> Result<T, Inadmissible> {
        found.inspect_err(|left| self.interrupted |= left.quantity == Quantity::Interruption)
    }

    /// Whether what was observed since the last step may have been given up, which is then noted.
    pub(crate) fn may_be_given_up(&mut self) -> bool {
        self.interrupted |= self.model.is_given_up();
        self.interrupted
    }

    /// The speed scale of a body [m/s].
    pub fn speed_scale(&self, body: usize) -> f64 {
        self.speeds[body]
    }
}

/// The rates of the bodies at the start of a run, laid out as the state.
///
/// # Errors
/// [`Inadmissible`] if the start is outside the model.
pub(crate) fn first_rates(model: &Model, start: &State) -> Result<Vec<f64>, Inadmissible> {
    let mut slopes = vec![0.0; model.dimension()];
    let mut powers = vec![0.0; model.works().len()];
    rates(model, &mut Workspace::default(), start.time, start.numbers(), &mut slopes, &mut powers)?;
    Ok(slopes)
}

/// Which bodies act on which others at a state. They do so by forces, which the rates of places do not feel.
#[derive(Debug, Clone, Default)]
struct BodyPattern {
    /// How many of the first rates of each body only the body itself enters.
    local: Vec<usize>,
    /// The pairs of the pattern.
    pairs: Vec<(usize, usize)>,
    pattern: Pattern,
    /// Scratch: the pairs that are asked for.
    asked: Vec<(usize, usize)>,
}

impl BodyPattern {
    fn of(model: &Model) -> Self {
        let local = |(index, body): (usize, &Arc<Body>)| match body.has_inertia() {
            true => model.slots(index).places().len(),
            false => 0,
        };
        Self { local: model.bodies.iter().enumerate().map(local).collect(), ..Self::default() }
    }

    /// The pattern of these pairs: made anew where they have changed.
    fn of_pairs(&mut self, pairs: &mut dyn Iterator<Item = (usize, usize)>) -> &Pattern {
        self.asked.clear();
        self.asked.extend(pairs);
        if self.asked != self.pairs {
            self.pairs.clone_from(&self.asked);
            let pattern = Pattern::new(self.local.len(), self.pairs.iter().copied());
            self.pattern = pattern.with_local_rates(self.local.clone());
        }
        &self.pattern
    }
}

/// The blocks of a matrix, as the mechanics writes them.
struct Written<'a> {
    matrix: &'a mut BlockMatrix,
    pattern: &'a mut BodyPattern,
}

impl Blocks for Written<'_> {
    fn arrange(&mut self, pairs: &mut dyn Iterator<Item = (usize, usize)>) {
        self.matrix.arrange(self.pattern.of_pairs(pairs));
    }

    fn block(&mut self, row: usize, column: usize) -> Option<&mut DMatrix<f64>> {
        self.matrix.block_mut(row, column)
    }
}

impl System for ModelSystem {
    type Inadmissible = Inadmissible;

    fn dimension(&self) -> usize {
        self.model.dimension()
    }

    fn quadratures(&self) -> usize {
        self.model.works().len() + self.free_quadratures()
    }

    fn free_quadratures(&self) -> usize {
        if self.impulses.is_some() { 3 * self.model.bodies.len() } else { 0 }
    }

    fn blocks(&self) -> &[Range<usize>] {
        self.model.blocks()
    }

    fn components(&self) -> &Components {
        &self.components
    }

    fn rates(&mut self, t: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), Inadmissible> {
        self.all_rates(t, y.into(), dy, dw)
    }

    fn extended_rates(&mut self, t: f64, y: Extended, dy: &mut [f64], dw: &mut [f64]) -> Result<(), Inadmissible> {
        self.all_rates(t, Numbers { high: y.high, low: y.low }, dy, dw)
    }

    fn jacobian(&mut self, t: f64, y: &[f64], slopes: &mut BlockMatrix) -> Result<(), Inadmissible> {
        self.extended_jacobian(t, Extended { high: y, low: &[] }, slopes)
    }

    fn extended_jacobian(&mut self, t: f64, y: Extended, slopes: &mut BlockMatrix) -> Result<(), Inadmissible> {
        let numbers = Numbers { high: y.high, low: y.low };
        let mut written = Written { matrix: slopes, pattern: &mut self.pattern };
        let found = jacobian(&self.model, self.workspace.get(), t, numbers, &mut written);
        self.noted(found)
    }

    fn error_scales(&mut self, t: f64, y: &[f64], _w: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]) {
        let (rtol, atol) = (SHARE * self.tolerance.rtol, SHARE * self.tolerance.atol);
        let (mut energy, mut rounding_of_work) = (self.energy, 0.0);
        let gaps = self.workspace.get().pair_gaps(&self.model, t, y.into()).ok();
        for (index, body) in self.model.bodies.iter().enumerate() {
            let slots = self.model.slots(index);
            let motion = BodyMotion::read(body, slots, y);
            let apart = match (gaps, self.model.has_pairs(index)) {
                (_, false) => f64::INFINITY,
                (Some(gaps), true) => gaps.of(index).map(|slab| slab.gap).fold(f64::INFINITY, f64::min),
                (None, true) => 0.0,
            };
            let gap = gap_to_supports(&self.model, t, index, &motion).min(apart).max(0.0);
            let speed = fastest_speed(body, &motion);
            energy += 0.5 * body.solid.mass.mass * speed * speed;
            let length = atol * body.size + rtol * gap.min(body.size);
            // The rounding of the places from which the gap is computed is all that can be had, unless their numbers
            // have twice the digits: then that of the body's own lengths, or of the gap.
            let lengths = motion.placement.position.norm() + body.size;
            let keeps = || body.solid.surface.as_ref().is_some_and(|surface| body.keeps_digits(surface));
            let near = NEAR * body.size;
            // A gap of a pair has the digits of one number.
            let is_extended = gap < near && apart > near;
            let known = match is_extended {
                true if keeps() => gap,
                true => body.height_scale(&motion.placement.position),
                false => lengths,
            };
            let rounding = 4.0 * f64::EPSILON * known;
            // Springs make velocities of the rounding of places.
            let shaken = 4.0 * f64::EPSILON * lengths * self.frequencies[index];
            // So do pairs, whose forces are off by some ν ε size/gap: velocities by that part of themselves.
            let exponents = self.model.pair_laws_of(index).map(|laws| laws.repulsion.exponent);
            let lost = if apart > 0.0 { exponents.fold(0.0, f64::max) * body.size / apart } else { 0.0 };
            let shaken = shaken + 4.0 * f64::EPSILON * lost * speed.max(self.speeds[index]);
            let velocity = atol * self.speeds[index] + (rtol + 4.0 * f64::EPSILON) * speed + shaken;
            let velocity = velocity.max(self.stirred[index]);
            // Forces that are off by rounding do work that is.
            rounding_of_work += body.solid.mass.mass * speed.max(self.speeds[index]) * (shaken + self.stirred[index]);
            y_scale[slots.position()].fill(length + rounding);
            y_scale[slots.attitude()].fill((length + rounding) / body.size);
            y_scale[slots.velocity()].fill(velocity);
            y_scale[slots.rate()].fill(velocity / body.size);
            if let Some(history) = body.history() {
                let (trailing, turning) = y_scale[slots.extra()].split_at_mut(3 * history.translation.rates.len());
                trailing.fill(velocity);
                turning.fill(velocity / body.size);
            } else {
                // G is a number of order one, on which forces depend as they do on P.
                let size = y[slots.extra()].iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
                y_scale[slots.extra()].fill(atol + (rtol + 4.0 * f64::EPSILON) * size);
            }
        }
        let (of_works, free) = w_scale.split_at_mut(self.model.works().len());
        of_works.fill(((atol + rtol) * energy).max(rounding_of_work));
        free.fill(f64::INFINITY);
    }

    fn project(&mut self, t: f64, y: &mut [f64], w: &mut [f64]) -> f64 {
        self.extended_project(t, ExtendedMut { high: y, low: &mut [] }, w)
    }

    fn extended_project(&mut self, t: f64, y: ExtendedMut, w: &mut [f64]) -> f64 {
        project(&self.model, self.workspace.get(), t, y, w)
    }
}
