//! One accepted step, by whichever stepper is in charge.
//!
//!   attempt → judge → accept: next size, next stepper  |  reject: smaller, or the other stepper, or give up
//!
//! An attempt writes only to `other`; the accepted state is untouched until the two are swapped.

use crate::auto::{EXPLICIT_REACH, ImplicitEffort};
use crate::context::Context;
use crate::control::{ImplicitStep, StepControl, initial_step};
use crate::explicit::{Explicit, Trial};
use crate::extended::Extended;
use crate::integrator::{Integrator, LastStep};
use crate::layout::SystemLayout;
use crate::newton::{Ahead, Convergence, NewtonPlan};
use crate::report::{Cause, Failure, Limit, Method, StepReport, Stepper};
use crate::system::System;

/// An attempt shorter than this many ulp of the time cannot tell its nodes apart.
const LEAST_ULPS: f64 = 16.0;
/// A step that would leave less than this part of itself to the end takes it along.
const LAST_STRETCH: f64 = 0.01;

/// What is decided before an attempt.
#[derive(Debug, Clone, Copy)]
struct Attempt {
    h: f64,
    end: f64,
    /// Whether the attempt is as long as it is because of the end asked for.
    to_end: bool,
}

impl Integrator {
    /// Makes one accepted step, never past `end`; the step that reaches it lands on it exactly.
    ///
    /// # Errors
    /// `Failure` if the integration cannot go on; the state stays the last accepted one.
    ///
    /// # Panics
    /// If `end` is not after the time reached, or the system has not the size of the state.
    pub fn step<S: System>(&mut self, system: &mut S, end: f64) -> Result<StepReport, Failure<S::Inadmissible>> {
        assert!(end > self.current.t, "the end {end} is not after {}", self.current.t);
        self.prepare(system)?;
        self.last = LastStep::None;
        let mut h = self.progress.step;
        let (mut rejections, mut rejected_by) = (0, None);
        let (mut linearized, mut other_tried) = (false, false);
        loop {
            let attempt = self.fit(h, end);
            if self.progress.stepper == Stepper::Implicit && !linearized {
                let collocation_step = self.progress.collocation_step;
                self.linearize(system, Some(Ahead { h: attempt.h, collocation_step }))?;
                linearized = true;
            }
            let evaluations = self.progress.statistics.rate_evaluations;
            let cause = match self.attempt(system, attempt, rejections > 0) {
                Ok(trial) => {
                    let evaluations = self.progress.statistics.rate_evaluations - evaluations;
                    return Ok(self.accept(attempt, &trial, rejections, rejected_by, evaluations));
                }
                Err(cause) => cause,
            };
            rejections += 1;
            rejected_by = Some(self.count(&cause));
            if matches!(cause, Cause::Newton) {
                self.progress.control.refuse(attempt.h);
                // The next attempt is on safer ground.
                self.linearize(system, None)?;
            }
            h = attempt.h * StepControl::retreat(self.progress.stepper, self.implicit.stages.method, &cause);
            if h < self.least_step() {
                if self.options.method != Method::Auto || other_tried {
                    return Err(Failure::StepTooSmall { time: self.current.t, step: h, cause });
                }
                other_tried = true;
                h = self.progress.step;
                self.change_stepper();
            }
        }
    }

    /// Restarts after a discontinuity in time: the rates are evaluated anew at the state reached, and the errors of the
    /// steps before say nothing on those to come. The size of the next step stays: it is the error control that says
    /// whether it is too long.
    ///
    /// # Errors
    /// `Failure` if the system has no rates there.
    ///
    /// # Panics
    /// If the system has not the size of the state.
    pub fn restart<S: System>(&mut self, system: &mut S) -> Result<(), Failure<S::Inadmissible>> {
        self.prepare(system)?;
        let Self { layout, progress, current, .. } = self;
        let mut context = Context { system, layout, statistics: &mut progress.statistics };
        let time = current.t;
        let rates = context.evaluate(time, Extended { high: &current.u, low: &current.low }, &mut current.rate);
        rates.map_err(|cause| Failure::NoRates { time, cause })?;
        progress.control = StepControl::default();
        progress.contraction = 1.0;
        progress.collocation_step = 0.0;
        self.last = LastStep::None;
        Ok(())
    }

    /// Sizes the scratch, and at the very start evaluates the rates and chooses the first step.
    fn prepare<S: System>(&mut self, system: &mut S) -> Result<(), Failure<S::Inadmissible>> {
        if self.open && self.layout.fits(system) {
            if !self.fitted {
                self.size_scratch();
            }
            return Ok(());
        }
        let layout = SystemLayout::of(system);
        assert!(
            layout.dimension == self.layout.dimension && layout.width == self.layout.width,
            "the system has {} and {} components, the state {} and {}",
            layout.dimension,
            layout.width - layout.dimension,
            self.layout.dimension,
            self.layout.width - self.layout.dimension,
        );
        self.layout = layout;
        self.size_scratch();
        if self.open {
            return Ok(());
        }
        self.explicit = Explicit::new(self.layout.width);
        self.start(system)
    }

    /// Sizes the scratch of the implicit stepper.
    fn size_scratch(&mut self) {
        self.implicit.fit(&self.layout);
        self.fitted = true;
    }

    fn start<S: System>(&mut self, system: &mut S) -> Result<(), Failure<S::Inadmissible>> {
        let Self { layout, progress, current, other, .. } = self;
        if !progress.started {
            let mut context = Context { system, layout, statistics: &mut progress.statistics };
            let rates =
                context.evaluate(current.t, Extended { high: &current.u, low: &current.low }, &mut current.rate);
            rates.map_err(|cause| Failure::NoRates { time: current.t, cause })?;
            context.scales(current);
            let max_step = self.options.max_step;
            progress.step = match self.options.initial_step {
                Some(step) => step.min(max_step),
                None => initial_step(&mut context, current, other, max_step),
            };
            progress.started = true;
        }
        self.open = true;
        Ok(())
    }

    /// The attempt for a wanted size: within the longest step, not past the end, without a sliver left before it.
    fn fit(&self, wanted: f64, end: f64) -> Attempt {
        let (t, max_step) = (self.current.t, self.options.max_step);
        let h = wanted.min(max_step);
        let remaining = end - t;
        // One part in 10⁹ forgives the rounding of a time that is a sum of steps.
        if remaining <= h || remaining <= (h * (1.0 + LAST_STRETCH)).min(max_step * (1.0 + 1e-9)) {
            return Attempt { h: remaining, end, to_end: true };
        }
        let h = if remaining <= h * (1.0 + LAST_STRETCH) { 0.5 * remaining } else { h };
        let reached = t + h;
        // The size that the times can represent.
        Attempt { h: if reached > t { reached - t } else { h }, end: reached, to_end: false }
    }

    fn least_step(&self) -> f64 {
        (LEAST_ULPS * f64::EPSILON * self.current.t.abs()).max(f64::MIN_POSITIVE)
    }

    fn linearize<S: System>(&mut self, system: &mut S, ahead: Option<Ahead>) -> Result<(), Failure<S::Inadmissible>> {
        let statistics = &mut self.progress.statistics;
        let mut context = Context { system, layout: &self.layout, statistics };
        let time = self.current.t;
        self.implicit
            .stages
            .linearize(&mut context, &self.current, ahead)
            .map_err(|cause| Failure::NoRates { time, cause })
    }

    fn attempt<S: System>(
        &mut self,
        system: &mut S,
        attempt: Attempt,
        rejected: bool,
    ) -> Result<Trial, Cause<S::Inadmissible>> {
        let Self { layout, progress, current, other, .. } = self;
        let mut context = Context { system, layout, statistics: &mut progress.statistics };
        other.t = attempt.end;
        match progress.stepper {
            Stepper::Explicit => self.explicit.attempt(&mut context, current, attempt.h, other),
            Stepper::Implicit => {
                let plan = NewtonPlan {
                    h: attempt.h,
                    end: attempt.end,
                    collocation_step: progress.collocation_step,
                    contraction: progress.contraction,
                    filtered: rejected || progress.control.implicit_step == 0.0,
                };
                self.implicit.attempt(&mut context, current, &plan, other)
            }
        }
    }

    fn count<I>(&mut self, cause: &Cause<I>) -> Limit {
        let statistics = &mut self.progress.statistics;
        match *cause {
            Cause::Inadmissible(_) | Cause::NotFinite { .. } => {
                statistics.rejected_domain += 1;
                Limit::Domain
            }
            Cause::Newton => {
                statistics.newton_failures += 1;
                Limit::Newton
            }
            Cause::Error { component, .. } => {
                statistics.rejected_error += 1;
                Limit::Error { component }
            }
        }
    }

    fn accept(
        &mut self,
        attempt: Attempt,
        trial: &Trial,
        rejections: u32,
        rejected_by: Option<Limit>,
        evaluations: u64,
    ) -> StepReport {
        let limit = match rejected_by {
            _ if attempt.to_end => Limit::End,
            Some(limit) => limit,
            None if attempt.h >= self.options.max_step * (1.0 - 1e-9) => Limit::MaxStep,
            None if trial.stiffness > 1.0 => Limit::Stability,
            None => Limit::Error { component: trial.error.component },
        };
        let stepper = self.progress.stepper;
        self.choose_step(attempt, trial, rejections > 0);
        self.tally(attempt, stepper);
        if stepper == Stepper::Implicit {
            self.implicit.accept(&self.current, &self.other);
            self.last = LastStep::Collocation;
            self.progress.collocation_step = attempt.h;
        } else {
            self.explicit.accept(&self.other);
            self.last = LastStep::Explicit;
            self.progress.collocation_step = 0.0;
        }
        if self.options.method == Method::Auto {
            self.choose_stepper(trial.stiffness, evaluations);
        }
        std::mem::swap(&mut self.current, &mut self.other);
        self.last_size = attempt.h;
        StepReport {
            start: self.other.t,
            end: self.current.t,
            stepper,
            limit,
            error: trial.error.value,
            projection: trial.projection,
            rejections,
        }
    }

    /// The size of the next step. One cut short by the end asked for teaches little: the size wanted before stays.
    fn choose_step(&mut self, attempt: Attempt, trial: &Trial, rejected: bool) {
        let progress = &mut self.progress;
        let before = progress.control;
        let factor = match trial.convergence {
            None => progress.control.after_explicit(trial.error.value, attempt.h, rejected),
            Some(Convergence { iterations, contraction }) => {
                progress.contraction = contraction;
                let step = ImplicitStep { error: trial.error.value, h: attempt.h, iterations };
                progress.control.after_implicit(self.implicit.stages.method, &step, rejected)
            }
        };
        let next = attempt.h * factor;
        let cut_short = attempt.to_end && !rejected && attempt.h < progress.step;
        progress.step = if cut_short { next.max(progress.step) } else { next }.min(self.options.max_step);
        if cut_short {
            progress.control = before;
        }
    }

    fn tally(&mut self, attempt: Attempt, stepper: Stepper) {
        let statistics = &mut self.progress.statistics;
        match stepper {
            Stepper::Explicit => statistics.explicit_steps += 1,
            Stepper::Implicit => statistics.implicit_steps += 1,
        }
        statistics.largest_step = statistics.largest_step.max(attempt.h);
        if !attempt.to_end && (statistics.smallest_step == 0.0 || attempt.h < statistics.smallest_step) {
            statistics.smallest_step = attempt.h;
        }
    }

    /// Lets the other stepper take over if it promises to advance further for its cost.
    fn choose_stepper(&mut self, stiffness: f64, evaluations: u64) {
        match self.progress.stepper {
            Stepper::Explicit => {
                if self.progress.switch.leave_explicit(stiffness) {
                    self.change_stepper();
                }
            }
            Stepper::Implicit => {
                // Whoever asks for what is merely counted along gets the same steps.
                let evaluations = evaluations - self.implicit.free_evaluations(&self.layout);
                let stages = &mut self.implicit.stages;
                let (step, max_step) = (self.progress.step, self.options.max_step);
                let effort = ImplicitEffort { h: step, max_step, evaluations, linear: stages.linear.relative_cost() };
                let mut radius = stages.linear.least_spectral_radius();
                // In a stiff stretch the bound says enough.
                if effort.exceeds_explicit(radius) {
                    radius = stages.spectral_radius(&self.layout, &self.current.scale);
                }
                if self.progress.switch.leave_implicit(radius, &effort) {
                    self.change_stepper();
                    self.progress.step = step.min(EXPLICIT_REACH / radius);
                }
            }
        }
    }

    fn change_stepper(&mut self) {
        let progress = &mut self.progress;
        progress.stepper = match progress.stepper {
            Stepper::Explicit => Stepper::Implicit,
            Stepper::Implicit => Stepper::Explicit,
        };
        progress.switch.change(progress.stepper, &mut progress.statistics);
        // The errors of one method say nothing on the other.
        progress.control = StepControl::default();
        progress.contraction = 1.0;
    }
}
