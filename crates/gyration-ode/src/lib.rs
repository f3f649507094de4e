//! Error-controlled one-step integrators with dense output and events. No mechanics: it can integrate a pendulum.
//!
//! A [`System`] says what dy/dt and dw/dt are, where its domain ends, what error it allows and how to return to its
//! manifold. An [`Integrator`] makes accepted steps, one a call, by an explicit pair of order 9, by an implicit
//! L-stable method of order 5, 9 or 13 with the exact Jacobian, or by whichever of them advances further for its cost.
//! Between the ends of a step it interpolates; [`find_crossing`] looks there for events. Its [`Memory`] is a
//! checkpoint.
//!
//! | to read | file |
//! |---|---|
//! | what a system must say | `system` |
//! | one accepted step | `integrator`, `step`, `scratch`, `last_step` |
//! | Prince's pair 9(7) | `explicit`, `prince`, `interpolant`, `combination` |
//! | Radau IIA | `implicit`, `newton`, `radau`, `stages`, `linear_system` |
//! | which blocks couple | `layout`, the crate `gyration-blocks` |
//! | factors of one block | `shifted`, `arrowhead` |
//! | factors of several | `factor`, the crate `gyration-blocks` |
//! | step sizes, norms | `control`, `norm` |
//! | which of the two | `auto`, `spectrum` |
//!
//! Nothing is allocated after the first step while blocks and pattern stay, nothing is random, and no clock is read.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod arrowhead;
mod auto;
mod combination;
mod context;
mod control;
mod dense;
mod events;
mod explicit;
mod extended;
mod factor;
mod implicit;
mod integrator;
mod interpolant;
mod last_step;
mod layout;
mod linear_system;
mod memory;
mod newton;
mod norm;
mod prince;
mod radau;
mod report;
mod scratch;
mod shifted;
mod spectrum;
mod stages;
mod step;
mod system;
#[cfg(test)]
mod trees;

pub use gyration_blocks::{BlockMatrix, Components, Pattern};

pub use events::{CrossingDirection, find_crossing};
pub use extended::{Extended, ExtendedMut, add as extended_sum};
pub use integrator::Integrator;
pub use memory::{MOST_COUNTED, Memory, MemoryError};
pub use report::{Cause, Failure, ImplicitOrder, Limit, Method, Options, Statistics, StepReport, Stepper};
pub use scratch::Scratch;
pub use system::System;
