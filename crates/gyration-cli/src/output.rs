//! Data to stdout, messages to stderr; neither passes on a control character, which texts of others may hold.

use crate::error::CliError;
use gyration_files::printable;
use std::fs::File;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

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

/// Writes a scene to a file, which must not be there unless it may be replaced.
///
/// # Errors
/// [`CliError::Arguments`] with this fix if it is there; [`CliError::Write`].
pub fn write_scene(path: &Path, text: &str, is_forced: bool, fix: &str) -> Result<(), CliError> {
    let opened = if is_forced { File::create(path) } else { File::create_new(path) };
    match opened {
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
            Err(CliError::arguments(format!("{} is there already", path.display()), fix))
        }
        opened => opened
            .and_then(|mut file| file.write_all(text.as_bytes()))
            .map_err(|source| CliError::Write { path: path.to_owned(), source }),
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
