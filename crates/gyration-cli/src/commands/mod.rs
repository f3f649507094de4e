//! The commands, a file each.

mod bands;
mod bench;
#[cfg(feature = "study")]
mod calibrate;
mod check;
mod completions;
mod continuum;
mod export;
mod fields;
mod import;
mod man;
mod modes;
mod new;
mod orbit;
mod picture;
mod plot;
#[cfg(feature = "view")]
mod report;
mod resistance;
mod run;
mod scenes;
mod schema;
mod spectrum;
#[cfg(feature = "study")]
mod study;
#[cfg(feature = "view")]
mod view;

pub use completions::answer;

use crate::arguments::Command;
use crate::error::CliError;

/// Does what was asked; returns the exit code.
///
/// # Errors
/// [`CliError`] with what kept it from being done.
pub fn execute(command: Command) -> Result<u8, CliError> {
    match command {
        Command::Run(arguments) => run::execute(&arguments),
        Command::Check(arguments) => check::execute(&arguments),
        Command::Modes(arguments) => modes::execute(&arguments),
        Command::Bands(arguments) => bands::execute(&arguments),
        Command::Bench(arguments) => bench::execute(&arguments),
        Command::Continuum(arguments) => continuum::execute(&arguments),
        Command::Fields(arguments) => fields::execute(&arguments),
        Command::Spectrum(arguments) => spectrum::execute(&arguments),
        Command::Orbit(arguments) => orbit::execute(&arguments),
        Command::Resistance(arguments) => resistance::execute(&arguments),
        Command::Scenes(arguments) => scenes::execute(&arguments),
        Command::New(arguments) => new::execute(&arguments),
        Command::Import(arguments) => import::execute(&arguments),
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
        Command::Schema { of } => schema::execute(of),
        Command::Completions { shell } => completions::execute(shell),
        Command::Man { folder } => man::execute(folder.as_deref()),
    }
}
