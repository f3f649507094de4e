//! What the user asks of an integrator and what the integrator says of its work.

/// Which stepper to use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Explicit or implicit, whichever advances further for its cost; decided anew as the solution changes.
    #[default]
    Auto,
    /// The explicit pair of order 9 only.
    Explicit,
    /// The implicit method only.
    Implicit,
}

/// The order of the implicit method: 2s − 1 with s stages, and s that of its error estimate.
///
/// The higher, the longer a step at a small error allowed, and the more a step costs: s evaluations an iteration, one
/// real and (s − 1)/2 complex factorizations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum ImplicitOrder {
    /// Three stages.
    #[default]
    Five,
    /// Five stages.
    Nine,
    /// Seven stages.
    Thirteen,
}

impl ImplicitOrder {
    /// The order that takes the least work at a relative error allowed, by curves of error against work:
    /// `bench/2026-11-25-orders.md`.
    pub fn at_tolerance(relative: f64) -> Self {
        match relative {
            _ if relative <= 3e-7 => Self::Thirteen,
            _ if relative <= 3e-4 => Self::Nine,
            _ => Self::Five,
        }
    }
}

/// The two steppers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stepper {
    /// Prince's pair 9(7).
    Explicit,
    /// Radau IIA.
    Implicit,
}

/// What the user may choose; the error allowed is the system's to say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Which stepper.
    pub method: Method,
    /// The order of the implicit one.
    pub order: ImplicitOrder,
    /// The longest step, in units of t; may be +∞.
    pub max_step: f64,
    /// The size of the first attempt; chosen from the first two rates if absent.
    pub initial_step: Option<f64>,
}

impl Default for Options {
    fn default() -> Self {
        Self { method: Method::Auto, order: ImplicitOrder::Five, max_step: f64::INFINITY, initial_step: None }
    }
}

/// What kept a step from being longer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// Accuracy; `component` of (y, w) has the largest error relative to its scale.
    Error {
        /// Index in (y, w).
        component: usize,
    },
    /// The stability of the explicit method: the problem is stiff here.
    Stability,
    /// A longer attempt left the domain.
    Domain,
    /// A longer attempt did not solve its nonlinear equations.
    Newton,
    /// `Options::max_step`.
    MaxStep,
    /// The end that was asked for.
    End,
}

/// One accepted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Where the step began.
    pub start: f64,
    /// Where it ended: the new time, equal to the end asked for if `limit` is `Limit::End`.
    pub end: f64,
    /// Which stepper made it.
    pub stepper: Stepper,
    /// What kept it from being longer.
    pub limit: Limit,
    /// The estimated error relative to the error allowed, at most 1.
    pub error: f64,
    /// The size of the correction by `System::project`.
    pub projection: f64,
    /// How many longer attempts were rejected.
    pub rejections: u32,
}

/// Counters since the first step; a continued run goes on counting.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    /// Accepted steps of the explicit stepper.
    pub explicit_steps: u64,
    /// Accepted steps of the implicit stepper.
    pub implicit_steps: u64,
    /// Attempts rejected for their error.
    pub rejected_error: u64,
    /// Attempts rejected because they left the domain, or numbers ceased to be finite.
    pub rejected_domain: u64,
    /// Attempts whose nonlinear equations were not solved.
    pub newton_failures: u64,
    /// Evaluations of the rates.
    pub rate_evaluations: u64,
    /// Evaluations of the Jacobian.
    pub jacobians: u64,
    /// Factorizations of the iteration matrices of a step.
    pub factorizations: u64,
    /// Changes of stepper.
    pub switches: u64,
    /// The smallest accepted step not cut short by the end asked for; 0 before there is one.
    pub smallest_step: f64,
    /// The largest accepted step.
    pub largest_step: f64,
}

impl Statistics {
    /// All accepted steps.
    pub fn accepted(&self) -> u64 {
        self.explicit_steps + self.implicit_steps
    }

    /// The numbers of a checkpoint: counters, and the smallest and the largest step.
    pub fn numbers(&self) -> ([u64; 9], [f64; 2]) {
        let counters = [
            self.explicit_steps,
            self.implicit_steps,
            self.rejected_error,
            self.rejected_domain,
            self.newton_failures,
            self.rate_evaluations,
            self.jacobians,
            self.factorizations,
            self.switches,
        ];
        (counters, [self.smallest_step, self.largest_step])
    }

    /// From the numbers of a checkpoint.
    pub fn of_numbers(counters: [u64; 9], [smallest_step, largest_step]: [f64; 2]) -> Self {
        let [
            explicit_steps,
            implicit_steps,
            rejected_error,
            rejected_domain,
            newton_failures,
            rate_evaluations,
            jacobians,
            factorizations,
            switches,
        ] = counters;
        Self {
            explicit_steps,
            implicit_steps,
            rejected_error,
            rejected_domain,
            newton_failures,
            rate_evaluations,
            jacobians,
            factorizations,
            switches,
            smallest_step,
            largest_step,
        }
    }

    /// The counters of two integrations together: sums, and the smallest and the largest step of both.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let smallest = [self.smallest_step, other.smallest_step].into_iter().filter(|step| *step > 0.0);
        Self {
            explicit_steps: self.explicit_steps + other.explicit_steps,
            implicit_steps: self.implicit_steps + other.implicit_steps,
            rejected_error: self.rejected_error + other.rejected_error,
            rejected_domain: self.rejected_domain + other.rejected_domain,
            newton_failures: self.newton_failures + other.newton_failures,
            rate_evaluations: self.rate_evaluations + other.rate_evaluations,
            jacobians: self.jacobians + other.jacobians,
            factorizations: self.factorizations + other.factorizations,
            switches: self.switches + other.switches,
            smallest_step: smallest.min_by(f64::total_cmp).unwrap_or(0.0),
            largest_step: self.largest_step.max(other.largest_step),
        }
    }
}

/// Why an attempt was rejected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Cause<I> {
    /// The state left the domain of the equations.
    #[error("the state is outside the domain: {0:?}")]
    Inadmissible(I),
    /// A component of the state or of its rate is infinite or not a number.
    #[error("component {index} of the state or of its rate is not finite")]
    NotFinite {
        /// Index in (y, w).
        index: usize,
    },
    /// The estimated error exceeds the error allowed.
    #[error("the error is {norm:.3e} times the error allowed, most of it in component {component}")]
    Error {
        /// Index in (y, w) of the component that is worst.
        component: usize,
        /// The error relative to the error allowed.
        norm: f64,
    },
    /// The nonlinear equations of the implicit method did not converge.
    #[error("the nonlinear equations of the step did not converge")]
    Newton,
}

/// The integration cannot go on; the integrator stays at its last accepted state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Failure<I> {
    /// The rates at the first state, or the Jacobian at an accepted one, cannot be had: no step size helps.
    #[error("at t = {time:e}: {cause}")]
    NoRates {
        /// The time of the state.
        time: f64,
        /// What is wrong with it.
        cause: Cause<I>,
    },
    /// The step has become too small to advance the time.
    #[error("at t = {time:e} the step fell to {step:e}: {cause}")]
    StepTooSmall {
        /// The time of the last accepted state.
        time: f64,
        /// The step that would have to be tried next.
        step: f64,
        /// Why the last attempt was rejected.
        cause: Cause<I>,
    },
}
