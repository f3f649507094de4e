//! Error-controlled one-step integrators with dense output and events. No mechanics: it can integrate a pendulum.
//!
//! A [`System`] says what dy/dt and dw/dt are, where its domain ends, what error it allows and how to return to its
//! manifold. An [`Integrator`] makes accepted steps, one a call, by an explicit pair of order 9, by an implicit
//! L-stable method of order 5 with the exact Jacobian, or by whichever of them advances further for its cost. Between
//! the ends of a step it interpolates; [`find_crossing`] looks there for events. Its [`Memory`] is a checkpoint.
//!
//! | to read | file |
//! |---|---|
//! | what a system must say | `system` |
//! | one accepted step | `integrator`, `step` |
//! | Prince's pair 9(7) | `explicit`, `prince`, `interpolant`, `combination` |
//! | Radau IIA of order 5 | `implicit`, `newton`, `radau`, `shifted`, `linear` |
//! | step sizes, norms | `control`, `norm` |
//! | which of the two | `auto` |
//!
//! Nothing is allocated after the first step, nothing is random, and no clock is read.

mod arrowhead;
mod auto;
mod combination;
mod control;
mod dense;
mod events;
mod explicit;
mod implicit;
mod integrator;
mod interpolant;
mod linear;
mod memory;
mod newton;
mod norm;
mod prince;
mod radau;
mod report;
mod shifted;
mod step;
mod system;
#[cfg(test)]
mod trees;

pub use events::{Direction, find_crossing};
pub use integrator::Integrator;
pub use memory::{Memory, MemoryError};
pub use report::{Cause, Failure, Limit, Method, Options, Statistics, StepReport, Stepper};
pub use system::System;
