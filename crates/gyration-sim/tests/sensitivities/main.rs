//! Derivatives along runs: against closed forms, and against differences of runs.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bodies;
mod closed_forms;
mod drives;
mod fluid;
mod impacts;
mod meaningless;
mod samples;
mod support;
