//! `gyration completions`: completions of a shell, which asks the program for the words.

use crate::arguments::Arguments;
use crate::error::{CliError, code};
use crate::output;
use clap::CommandFactory;
use clap_complete::Shell;
use clap_complete::env::{CompleteEnv, Shells};

/// The variable by which a shell asks for words; its value is the name of the shell.
const ASKED_BY: &str = "GYRATION_COMPLETE";

/// Prints what makes the shell ask.
pub fn execute(shell: Shell) -> Result<u8, CliError> {
    let name = shell.to_string();
    let shells = Shells::builtins();
    let mut script = Vec::new();
    if let Some(asking) = shells.completer(&name) {
        asking
            .write_registration(ASKED_BY, "gyration", "gyration", "gyration", &mut script)
            .map_err(|fault| CliError::arguments(fault.to_string(), "name another shell"))?;
    }
    output::print(&String::from_utf8_lossy(&script))?;
    Ok(code::DONE)
}

/// Answers a shell that asks for words; false where none does.
///
/// A word that is not understood is answered by nothing: a message would stand in the line that is typed.
pub fn answer(arguments: &[std::ffi::OsString]) -> bool {
    let here = std::env::current_dir().ok();
    let asked = CompleteEnv::with_factory(Arguments::command).var(ASKED_BY);
    asked.try_complete(arguments.to_vec(), here.as_deref()).unwrap_or(true)
}
