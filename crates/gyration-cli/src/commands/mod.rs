//! The commands, a file each.

#[cfg(feature = "study")]
pub(crate) mod calibrate;
pub(crate) mod check;
mod completions;
mod export;
pub(crate) mod modes;
pub(crate) mod plot;
#[cfg(feature = "view")]
mod report;
pub(crate) mod resistance;
pub(crate) mod run;
pub(crate) mod scenes;
mod schema;
#[cfg(feature = "study")]
pub mod study;
#[cfg(feature = "view")]
mod view;

use crate::arguments::{Command, SceneArguments};
use crate::error::CliError;
use gyration_scene::Scene;
use std::path::Path;

/// Does what was asked; returns the exit code.
///
/// # Errors
/// [`CliError`] with what kept it from being done.
pub fn execute(command: Command) -> Result<u8, CliError> {
    match command {
        Command::Run(arguments) => run::execute(&arguments),
        Command::Check(arguments) => check::execute(&arguments),
        Command::Modes(arguments) => modes::execute(&arguments),
        Command::Resistance(arguments) => resistance::execute(&arguments),
        Command::Scenes(arguments) => scenes::execute(&arguments),
        Command::Export(arguments) => export::execute(&arguments),
        Command::Plot(arguments) => plot::execute(&arguments),
        #[cfg(feature = "view")]
        Command::Report(arguments) => report::execute(&arguments),
        #[cfg(feature = "view")]
        Command::View(arguments) => view::execute(&arguments),
        #[cfg(feature = "study")]
        Command::Study(arguments) => study::execute(&arguments),
        #[cfg(feature = "study")]
        Command::Calibrate(arguments) => calibrate::execute(&arguments),
        Command::Schema => schema::execute(),
        Command::Completions { shell } => completions::execute(shell),
    }
}

/// Opens the scene of the arguments.
fn open(arguments: &SceneArguments) -> Result<Scene, CliError> {
    Ok(Scene::open(&arguments.scene, &arguments.overrides)?)
}

/// Opens the scene of the arguments, ready to run: with the resistances that boundary elements tell.
fn ready(arguments: &SceneArguments) -> Result<Scene, CliError> {
    Ok(gyration_sim::open(&arguments.scene, &arguments.overrides)?)
}

/// The name of a file or directory without folder and ending.
fn stem(path: &Path) -> String {
    // `.` and `..` have no name of their own.
    let named = path.canonicalize().ok().filter(|_| path.file_name().is_none());
    let name = named.as_deref().unwrap_or(path).file_stem();
    name.map_or_else(|| "recording".to_owned(), |name| name.to_string_lossy().into_owned())
}
