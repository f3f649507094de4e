//! Data to stdout, messages to stderr.

use crate::error::CliError;
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// Writes text to stdout.
///
/// # Errors
/// [`CliError::Stdout`]; a closed pipe is one of them.
pub fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
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
    let _ = writeln!(io::stderr(), "{message}");
}

/// Reports a failure: program, message, fix.
pub fn report(message: &str) {
    let (bold, plain) = if colored() { ("\x1b[1;31m", "\x1b[0m") } else { ("", "") };
    say(&format!("gyration: {bold}error{plain}: {message}"));
}

/// Whether stderr is a terminal that is allowed colours.
pub fn colored() -> bool {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    io::stderr().is_terminal() && set("NO_COLOR").is_none() && set("TERM").is_none_or(|term| term != "dumb")
}

/// Writes a whole file.
///
/// # Errors
/// [`CliError::Write`].
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    in_place(path, |partial| fs::write(partial, bytes).map_err(cannot_write(path)))
}

/// Lets a file be written under another name first, `PATH.part`, so that no half of it is left behind.
///
/// A device or a pipe, `/dev/null`, is written to as it stands: there is nothing to replace. A link goes on to lead to
/// the same file.
///
/// # Errors
/// Those of `write`; [`CliError::Write`] if the file cannot be put in its place.
pub fn in_place(path: &Path, write: impl FnOnce(&Path) -> Result<(), CliError>) -> Result<(), CliError> {
    if path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return write(path);
    }
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let mut partial = target.clone().into_os_string();
    partial.push(".part");
    let partial = Path::new(&partial);
    let written = write(partial).and_then(|()| fs::rename(partial, &target).map_err(cannot_write(path)));
    if written.is_err() {
        let _ = fs::remove_file(partial);
    }
    written
}

/// The failure to write a file, with its name.
pub fn cannot_write(path: &Path) -> impl Fn(io::Error) -> CliError {
    move |source| CliError::Write { path: path.to_path_buf(), source }
}
