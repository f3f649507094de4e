//! `gyration man`: manual pages, one of the program and one a command.

use crate::arguments::Arguments;
use crate::error::{CliError, code};
use crate::output;
use clap::CommandFactory;
use clap_mangen::Man;
use gyration_record::write_file;
use std::path::Path;

/// Prints the main page, or writes all of them.
pub fn execute(folder: Option<&Path>) -> Result<u8, CliError> {
    let mut program = Arguments::command();
    program.build();
    let Some(folder) = folder else {
        output::print(&String::from_utf8_lossy(&page(program)))?;
        return Ok(code::DONE);
    };
    let commands: Vec<clap::Command> = program.get_subcommands().filter(|it| !it.is_hide_set()).cloned().collect();
    for command in std::iter::once(program).chain(commands) {
        let name = command.get_display_name().unwrap_or_else(|| command.get_name()).to_owned();
        write_file(&folder.join(format!("{name}.1")), &page(command))?;
    }
    output::say(&format!("wrote the manual pages into {}", folder.display()));
    Ok(code::DONE)
}

/// A page in roff.
fn page(command: clap::Command) -> Vec<u8> {
    let mut page = Vec::new();
    // Writing into memory does not fail.
    let _ = Man::new(command).render(&mut page);
    page
}
