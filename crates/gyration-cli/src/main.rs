//! The program `gyration`: arguments in, data to stdout, messages to stderr, an exit code for scripts.
//!
//! ```text
//! arguments → commands/{run, check, modes, resistance, scenes, export, plot, schema, completions}
//!                 check: what can be said before a run         plot: pictures of recordings and laws
//! ```
//!
//! No mechanics here: scenes are built by `gyration-scene`, run by `gyration-sim`, kept by `gyration-record`.

#![forbid(unsafe_code)]

mod arguments;
mod check;
mod commands;
mod error;
mod output;
mod plot;
mod progress;
mod summary;

use arguments::{Arguments, LATER};
use clap::Parser;
use clap::error::{ContextKind, ContextValue};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(refusal) => return refuse(&refusal),
    };
    match commands::execute(arguments.command) {
        Ok(code) => ExitCode::from(code),
        Err(error) if error.is_closed_pipe() => ExitCode::from(error::code::DONE),
        Err(error) => {
            output::report(&error.to_string());
            ExitCode::from(error.code())
        }
    }
}

/// Help and version go to stdout; what cannot be understood to stderr, with exit code 2.
fn refuse(refusal: &clap::Error) -> ExitCode {
    if let Some(ContextValue::String(name)) = refusal.get(ContextKind::InvalidSubcommand)
        && LATER.contains(&name.as_str())
    {
        output::report(&format!(
            "`gyration {name}` is not in this version yet\n  fix: see `gyration help` for what is"
        ));
        return ExitCode::from(error::code::BAD_INPUT);
    }
    // A closed pipe is no failure.
    let _ = refusal.print();
    ExitCode::from(if refusal.use_stderr() { error::code::BAD_INPUT } else { error::code::DONE })
}
