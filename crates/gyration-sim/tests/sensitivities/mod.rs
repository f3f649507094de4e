//! Derivatives along runs: against closed forms, and against differences of runs.

mod bodies;
mod closed_forms;
mod costs;
mod drives;
mod fluid;
mod held;
mod impacts;
mod meaningless;
mod random;
mod samples;
pub mod support;
mod switching;
mod walls;
