//! Data to stdout, messages to stderr; neither passes on a control character, which texts of others may hold.

use crate::error::CliError;
use gyration_files::printable;
use std::io::{self, IsTerminal, Write};

/// Writes text to stdout.
///
/// # Errors
/// [`CliError::Stdout`]; a closed pipe is one of them.
pub fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(printable(text).as_bytes())?;
    Ok(out.flush()?)
}

/// Writes text to stdout, if there is still a reader: one that has gone changes nothing of what was done.
///
/// # Errors
/// [`CliError::Stdout`] for another reason than a closed pipe.
pub fn offer(text: &str) -> Result<(), CliError> {
    match print(text) {
        Err(error) if error.is_closed_pipe() => Ok(()),
        printed => printed,
    }
}

/// Writes a message to stderr; if that is closed, nobody wants it.
pub fn say(message: &str) {
    let _ = writeln!(io::stderr(), "{}", printable(message));
}

/// Reports a failure: program, message, fix.
pub fn report(message: &str) {
    let (bold, plain) = if colored() { ("\x1b[1;31m", "\x1b[0m") } else { ("", "") };
    let _ = writeln!(io::stderr(), "gyration: {bold}error{plain}: {}", printable(message));
}

/// Whether stderr is a terminal that is allowed colours.
pub fn colored() -> bool {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    io::stderr().is_terminal() && set("NO_COLOR").is_none() && set("TERM").is_none_or(|term| term != "dumb")
}
