//! The program `gyration`: arguments in, data to stdout, messages to stderr, an exit code for scripts.
//!
//! It is a library, so that the Python package installs the same program: [`run`] and [`provenance`] are all of it.
//!
//! ```text
//! arguments → commands/{run, check, modes, resistance, study, calibrate, scenes, export, plot, schema, …} → output
//! ```
//!
//! No mechanics here: scenes are built by `gyration-scene`, run and surveyed by `gyration-sim`, kept by
//! `gyration-record`, drawn by `gyration-plot`, shown by `gyration-view`.

#![forbid(unsafe_code)]

mod arguments;
#[cfg(test)]
mod book;
mod commands;
mod error;
mod input;
mod output;
mod progress;
mod provenance;
mod waiting;

use arguments::Arguments;
use clap::Parser;
use std::ffi::OsString;

pub use provenance::provenance;

/// The program, from its arguments (the first is its name) to its exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    if commands::answer(&arguments) {
        return error::code::DONE;
    }
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(refusal) => return refuse(&refusal),
    };
    match commands::execute(arguments.command) {
        Ok(code) => code,
        Err(error) if error.is_closed_pipe() => error::code::DONE,
        Err(error) => {
            output::report(&error.to_string());
            error.code()
        }
    }
}

/// Help and version go to stdout; what cannot be understood to stderr, with exit code 2.
fn refuse(refusal: &clap::Error) -> u8 {
    // A closed pipe is no failure.
    let _ = refusal.print();
    if refusal.use_stderr() { error::code::BAD_INPUT } else { error::code::DONE }
}
