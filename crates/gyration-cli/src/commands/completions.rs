//! `gyration completions`: completions of a shell.

use crate::arguments::Arguments;
use crate::error::{CliError, code};
use crate::output;
use clap::CommandFactory;
use clap_complete::Shell;

/// Prints the completions.
pub fn execute(shell: Shell) -> Result<u8, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "gyration", &mut script);
    output::print(&String::from_utf8_lossy(&script))?;
    Ok(code::DONE)
}
