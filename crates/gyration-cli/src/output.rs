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

/// Writes a whole file: under another name first, so that no half of it is left behind.
///
/// # Errors
/// [`CliError::Write`].
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".part");
    let partial = Path::new(&partial);
    fs::write(partial, bytes).and_then(|()| fs::rename(partial, path)).map_err(|source| {
        let _ = fs::remove_file(partial);
        CliError::Write { path: path.to_path_buf(), source }
    })
}
