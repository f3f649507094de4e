//! What a run is asked for: the plan of a scene in the terms of the run loop and the stepper.

use crate::adapter::Tolerance;
use crate::rows::Extras;
use gyration::Team;
use gyration::model::Model;
use gyration_ode::{ImplicitOrder, Method, Options};
use gyration_scene::Built;
use gyration_threads::{each_on_threads, processors};
use std::num::NonZeroUsize;

/// How long to run, how finely to sample, how precisely to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunPlan {
    /// The end [s].
    pub end: f64,
    /// Spacing of recorded samples [s].
    pub sample: f64,
    /// When to end early, at rest.
    pub stop_at_rest: Option<RestCriterion>,
    /// Errors allowed per step.
    pub tolerance: Tolerance,
    /// Stepper and longest step.
    pub options: Options,
    /// What is recorded beyond the usual.
    pub extras: Extras,
    /// Whether what acts between two is recorded.
    pub pairs: bool,
    /// How many threads share the bodies out, one if that is not said; of no consequence to any number.
    pub threads: Option<NonZeroUsize>,
}

/// More bodies than that are shared out among all processors.
const FEW: usize = 7;

impl RunPlan {
    /// How many quadratures a run of a model has: works and, where they are asked for, impulses, three a body.
    pub(crate) fn count_quadratures(&self, model: &Model) -> usize {
        model.works().len() + if self.extras.impulses() { 3 * model.bodies.len() } else { 0 }
    }

    /// The time of sample k [s]; one within 1e-9·sample of the end is the end.
    pub(crate) fn sample_time(&self, k: u64) -> f64 {
        let time = k as f64 * self.sample;
        if (time - self.end).abs() <= 1e-9 * self.sample { self.end } else { time }
    }

    /// The number of the first sample behind a time [s], which ends the interval that the time is in.
    pub(crate) fn next_sample(&self, time: f64) -> u64 {
        if self.sample.is_infinite() {
            return 1;
        }
        // A quotient is off by its rounding.
        let near = ((time / self.sample) as u64).max(1);
        let first = (near.saturating_sub(1).max(1)..=near).find(|k| self.sample_time(*k) > time);
        first.unwrap_or_else(|| (near + 1..).find(|k| self.sample_time(*k) > time).unwrap_or(u64::MAX))
    }

    /// The threads among which an evaluation of many bodies is shared out, if there are several: no more than there are
    /// processors, since they look for work all the time.
    pub(crate) fn team(&self) -> Option<Team> {
        let threads = self.threads?.min(processors());
        Team::new(threads.get(), each_on_threads)
    }

    /// The plan of a run that has the machine to itself: with as many threads as its scene asks for, else with one for
    /// each processor if there are more than a few bodies.
    pub fn alone(built: &Built) -> Self {
        let default = || (built.model.bodies.len() > FEW).then(processors);
        Self { threads: built.plan.threads.or_else(default), ..built.into() }
    }
}

/// Rest: every body's fastest material point slower than `speed` for `hold`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestCriterion {
    /// Speed of the fastest material point [m/s].
    pub speed: f64,
    /// For how long [s].
    pub hold: f64,
}

impl From<&Built> for RunPlan {
    fn from(built: &Built) -> Self {
        let plan = &built.plan;
        let method = match plan.method {
            gyration_scene::Method::Auto => Method::Auto,
            gyration_scene::Method::Explicit => Method::Explicit,
            gyration_scene::Method::Implicit => Method::Implicit,
        };
        let max_step = plan.max_step.unwrap_or(f64::INFINITY);
        Self {
            end: plan.end,
            sample: plan.sample,
            stop_at_rest: plan.stop_at_rest.map(|rest| RestCriterion { speed: rest.speed, hold: rest.hold }),
            tolerance: Tolerance { rtol: plan.rtol, atol: plan.atol },
            options: Options { method, order: ImplicitOrder::at_tolerance(plan.rtol), max_step, initial_step: None },
            extras: Extras::new(built.record.quantities.iter().copied(), built.record.origin),
            pairs: built.record.pairs,
            threads: None,
        }
    }
}
