//! The integrator: its state, its start, its checkpoint. How it steps is in `step`.
//!
//! Size and stepper of the next step, the error history and everything else that is carried along is in `StepperState`,
//! so that a checkpoint can hold it. The vectors are sized at the first step and stay; nothing is allocated after it,
//! unless many share what `scratch` has.

use crate::context::Point;
use crate::control::StepControl;
use crate::explicit::Explicit;
use crate::implicit::Implicit;
use crate::layout::SystemLayout;
use crate::memory::{CheckpointVectors, Memory, MemoryError, StepperState, decode, encode};
use crate::radau::Radau;
use crate::report::{Method, Options, Statistics, Stepper};

/// Integrates a system step by step from a first state.
#[derive(Debug, Clone)]
pub struct Integrator {
    pub(crate) options: Options,
    pub(crate) layout: SystemLayout,
    pub(crate) progress: StepperState,
    /// The accepted state.
    pub(crate) current: Point,
    /// The start of the last step; while stepping, the state attempted.
    pub(crate) other: Point,
    pub(crate) last: LastStep,
    /// The size of the last step.
    pub(crate) last_size: f64,
    pub(crate) explicit: Explicit,
    pub(crate) implicit: Implicit,
    pub(crate) event_scratch: Vec<f64>,
    /// Whether scratch is ready, and rates, scales and step are known.
    pub(crate) open: bool,
    /// Whether the scratch of the implicit stepper has the size of the system.
    pub(crate) fitted: bool,
}

/// What the last accepted step has left to interpolate with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum LastStep {
    /// No step yet, or none since a checkpoint or an attempt that failed.
    #[default]
    None,
    /// Explicit: the rates of its stages.
    Explicit,
    /// Implicit: the collocation polynomial.
    Collocation,
}

impl Integrator {
    /// Starts from the state y and the quadratures w at time t.
    ///
    /// # Panics
    /// If the longest step is not positive.
    pub fn new(t: f64, y: &[f64], w: &[f64], options: Options) -> Self {
        let stages = Radau::of(options.order).stages();
        let vectors = CheckpointVectors {
            t,
            u: [y, w].concat(),
            low: vec![0.0; y.len() + w.len()],
            rate: vec![0.0; y.len() + w.len()],
            scale: vec![0.0; y.len() + w.len()],
            collocation: vec![0.0; stages * (y.len() + w.len())],
            stages,
        };
        let progress = StepperState {
            dimension: y.len(),
            started: false,
            step: 0.0,
            stepper: Stepper::Explicit,
            control: StepControl::default(),
            contraction: 1.0,
            collocation_step: 0.0,
            switch: Default::default(),
            statistics: Statistics::default(),
        };
        Self::assemble(progress, vectors, options)
    }

    /// The same after other integrations, whose parts are its own: what the numbers of y lack of twice their digits,
    /// and the stepper in charge with the votes on it. The widest of those before decides, of those that are implicit
    /// if there are any: a whole is as stiff as the stiffest of its parts.
    ///
    /// # Panics
    /// If `low` has not the size of y.
    #[must_use]
    pub fn succeeding<'a>(mut self, low: &[f64], before: impl IntoIterator<Item = &'a Self>) -> Self {
        self.current.low[..self.progress.dimension].copy_from_slice(low);
        let weight = |of: &&Self| (of.progress.stepper == Stepper::Implicit, of.progress.dimension);
        if let Some(leading) = before.into_iter().max_by_key(weight) {
            (self.progress.stepper, self.progress.switch) = (leading.progress.stepper, leading.progress.switch);
        }
        self
    }

    /// Continues from a checkpoint, as if there had been none.
    ///
    /// # Errors
    /// `MemoryError` if the numbers are not those of a checkpoint, or of one with another order of the implicit method.
    pub fn resume(memory: &Memory, options: Options) -> Result<Self, MemoryError> {
        let (progress, vectors) = decode(memory)?;
        if vectors.stages != Radau::of(options.order).stages() {
            return Err(MemoryError::Order { found: 2 * vectors.stages - 1 });
        }
        Ok(Self::assemble(progress, vectors, options))
    }

    fn assemble(mut progress: StepperState, vectors: CheckpointVectors, options: Options) -> Self {
        assert!(options.max_step > 0.0, "the longest step must be positive");
        progress.stepper = match options.method {
            Method::Auto => progress.stepper,
            Method::Explicit => Stepper::Explicit,
            Method::Implicit => Stepper::Implicit,
        };
        let width = vectors.u.len();
        let mut current = Point::new(vectors.t, vectors.u);
        (current.low, current.rate, current.scale) = (vectors.low, vectors.rate, vectors.scale);
        Self {
            options,
            layout: SystemLayout { dimension: progress.dimension, width, ..SystemLayout::default() },
            progress,
            other: current.clone(),
            current,
            last: LastStep::None,
            last_size: 0.0,
            explicit: Explicit::default(),
            implicit: Implicit::holding(Radau::of(options.order), vectors.collocation),
            event_scratch: vec![0.0; width],
            open: false,
            fitted: false,
        }
    }

    /// The checkpoint of the accepted state; the interpolant of the last step is not in it.
    pub fn memory(&self) -> Memory {
        let mut memory = Memory::default();
        self.remember(&mut memory);
        memory
    }

    /// [`Integrator::memory`] in the place of what stands in a memory, whose room is used again.
    pub fn remember(&self, memory: &mut Memory) {
        encode(memory, &self.progress, &self.current, &self.implicit.stages.collocation);
    }

    /// The size that the next step is tried with, before it is cut to the end asked for; 0 before the first.
    pub fn next_size(&self) -> f64 {
        self.progress.step
    }

    /// The time reached.
    pub fn time(&self) -> f64 {
        self.current.t
    }

    /// The state y reached.
    pub fn state(&self) -> &[f64] {
        &self.current.u[..self.progress.dimension]
    }

    /// What the numbers of the state reached lack of twice their digits.
    pub fn state_low(&self) -> &[f64] {
        &self.current.low[..self.progress.dimension]
    }

    /// The quadratures w reached.
    pub fn quadratures(&self) -> &[f64] {
        &self.current.u[self.progress.dimension..]
    }

    /// The rates dy/dt and dw/dt at the state reached; zeros before the first step.
    pub fn rates(&self) -> (&[f64], &[f64]) {
        self.current.rate.split_at(self.progress.dimension)
    }

    /// The ends of the last step, over which `interpolate` works; none before a step, after `resume` or a failure.
    pub fn last_step(&self) -> Option<(f64, f64)> {
        (self.last != LastStep::None).then_some((self.other.t, self.current.t))
    }

    /// How many numbers the factors of the blocks that couple are, real and imaginary parts and those of the real
    /// matrix together; 0 where none couple, or before a step of the implicit method.
    pub fn entries_of_factors(&self) -> usize {
        self.implicit.stages.linear.entries_of_factors()
    }

    /// The counters so far.
    pub fn statistics(&self) -> &Statistics {
        &self.progress.statistics
    }
}
