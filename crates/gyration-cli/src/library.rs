//! What the program knows how to say and draw, for callers that are not a terminal.
//!
//! ```text
//! Scene → check, modes, resistance (text or JSON)       Recording, Frame, Fitted → picture (SVG, PNG, PDF)
//! ```
//!
//! Texts and pictures are those of the commands, byte for byte: each function here is what stands between the arguments of a
//! command and its output. Nothing is printed and nothing is written, but for the picture that a run leaves.

use crate::arguments::{TRIANGLES, What};
use crate::commands;
use clap::ValueEnum;
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::replay::ReplayError;
use gyration_sim::{Provenance, RunSummary};
#[cfg(feature = "study")]
use gyration_study::{
    Frame,
    calibration::{Calibration, Fitted},
};
use serde_json::Value;
use std::path::{Path, PathBuf};

pub use crate::error::CliError;
pub use crate::plot::PlotError;
pub use crate::plot::draw::Format;

/// The program that runs: what recordings say of where they come from.
pub fn provenance() -> Provenance {
    commands::run::provenance()
}

/// What `gyration check` prints of a scene.
///
/// # Errors
/// [`CliError::Resolved`] if the resolved scene has no form in TOML.
pub fn check(scene: &Scene) -> Result<String, CliError> {
    commands::check::in_full(scene)
}

/// What `gyration modes --json` prints of a scene.
pub fn modes(scene: &Scene) -> Value {
    commands::modes::all_in_json(scene)
}

/// What of a resistance is asked: the options of `gyration resistance`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ResistanceOptions {
    /// The support that stands beside the body as a wall, by name.
    pub wall: Option<String>,
    /// How many triangles the surface of the body has at least.
    pub triangles: Option<u32>,
    /// Boundary elements, also where there is a closed form.
    pub elements: bool,
    /// Small vibrations at a frequency [Hz].
    pub frequency: Option<f64>,
}

/// What `gyration resistance --json` prints of a scene, of one body or of all.
///
/// # Errors
/// [`CliError::Arguments`] where there is no such body or wall, or no such resistance of it.
pub fn resistance(scene: &Scene, body: Option<&str>, options: &ResistanceOptions) -> Result<Value, CliError> {
    if let Some(triangles) = options.triangles.filter(|count| !TRIANGLES.contains(count)) {
        let fix = format!("give from {} to {}", TRIANGLES.start(), TRIANGLES.end());
        return Err(CliError::arguments(format!("{triangles} triangles are too few or too many"), fix));
    }
    if options.frequency.is_some() && (options.elements || options.triangles.is_some() || options.wall.is_some()) {
        let fix = "leave out the frequency, or what asks for boundary elements";
        return Err(CliError::arguments("a frequency is for spheres in closed form, far from walls", fix));
    }
    Ok(commands::resistance::of_bodies(scene, body, options)?.json)
}

/// The names of what [`picture`] can show.
pub fn quantities() -> Vec<String> {
    let values = What::value_variants().iter().filter_map(ValueEnum::to_possible_value);
    values.map(|value| value.get_name().to_owned()).collect()
}

/// What `gyration plot` draws of a recording: the quantities by name, the overview if there are none; `measures` are those of
/// `stroke`.
///
/// # Errors
/// [`CliError`] where a quantity is unknown or not in the recording.
pub fn picture(
    recording: &Recording,
    quantities: &[String],
    measures: &[String],
    format: Format,
) -> Result<Vec<u8>, CliError> {
    let mut what = quantities.iter().map(|name| known(name)).collect::<Result<Vec<_>, _>>()?;
    if what.is_empty() {
        what.push(What::Overview);
    }
    Ok(commands::plot::recorded(recording, &what, measures)?.draw().render(format))
}

/// What `gyration plot SCENE laws` draws.
///
/// # Errors
/// [`CliError::Plot`] where the scene has no laws.
pub fn laws(scene: &Scene, format: Format) -> Result<Vec<u8>, CliError> {
    Ok(commands::plot::laws(scene)?.draw().render(format))
}

/// What of a study's table is asked to be seen: the options of `gyration study STUDY plot`.
#[cfg(feature = "study")]
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StudyPicture {
    /// The column of the axis to the right.
    pub x: Option<String>,
    /// The column of the axis upwards; `NAME=VALUE,VALUE` is a share.
    pub y: Option<String>,
    /// The column that colours tell apart.
    pub colour: Option<String>,
    /// The kind of picture by its word.
    pub kind: Option<String>,
}

/// What `gyration study STUDY plot` draws of the table at a path: what is asked for, else what the study says, else what its columns suggest.
///
/// # Errors
/// [`CliError::Arguments`] where a column or a kind is unknown, or does not suit the picture.
#[cfg(feature = "study")]
pub fn study_picture(frame: &Frame, path: &Path, asked: &StudyPicture, format: Format) -> Result<Vec<u8>, CliError> {
    let drawn = commands::study::plot::drawn(frame, &commands::study::plot::stem(path), asked, None)?;
    Ok(drawn.draw().render(format))
}

/// What `gyration calibrate` prints of a fit.
#[cfg(feature = "study")]
pub fn fit_in_words(calibration: &Calibration, fitted: &Fitted) -> String {
    commands::calibrate::in_words(calibration, fitted)
}

/// What `gyration calibrate` draws of a fit.
#[cfg(feature = "study")]
pub fn fit_picture(calibration: &Calibration, fitted: &Fitted, format: Format) -> Vec<u8> {
    crate::plot::calibration::figure(calibration, fitted).draw().render(format)
}

fn known(name: &str) -> Result<What, CliError> {
    What::from_str(name, false).map_err(|_| {
        CliError::arguments(format!("there is no plot `{name}`"), format!("choose one of {}", quantities().join(", ")))
    })
}

/// The format that the ending of a file asks for.
///
/// # Errors
/// [`CliError::Arguments`] where it is none of svg, png, pdf.
pub fn format(path: &Path) -> Result<Format, CliError> {
    commands::plot::format(Some(path))
}

/// Writes a picture; no half of one is left behind.
///
/// # Errors
/// [`CliError::Write`].
pub fn write_picture(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    crate::output::write_file(path, bytes)
}

/// Says that the gallery has no such scene, and which it has.
pub fn no_such_scene(name: &str) -> CliError {
    commands::scenes::no_such_scene(name)
}

/// What `gyration run` says of a run that has ended.
///
/// # Errors
/// [`CliError::Record`] if the recording cannot be read.
pub fn summary(scene: &Scene, recording: &Path, summary: &RunSummary) -> Result<String, CliError> {
    let start = commands::run::starting_energies(recording, summary)?;
    Ok(crate::summary::in_words(scene, summary, &start))
}

/// What `gyration run` said of the run that left a recording, without the time that it took.
///
/// # Errors
/// [`CliError::Record`] if the recording cannot be read, [`CliError::Arguments`] if its scene cannot be built again: a file to which
/// it refers has moved or changed.
pub fn summary_of_recording(recording: &Recording) -> Result<String, CliError> {
    let (scene, told) = RunSummary::of_recording(recording).map_err(|error| match error {
        ReplayError::Record(error) => error.into(),
        error => CliError::arguments(error.to_string(), "put the file back, or record the scene anew"),
    })?;
    summary(&scene, recording.path(), &told)
}

/// Where `gyration run` puts the recording of a scene if it is not told: `NAME.gyr`, `NAME-2.gyr`, …, in a folder.
///
/// # Errors
/// [`CliError::Arguments`] if there are very many.
pub fn free_name(folder: &Path, scene: &str) -> Result<PathBuf, CliError> {
    commands::run::free_name(folder, scene)
}

/// Leaves `overview.svg` in a recording, as every run does; a warning if it cannot be drawn.
pub fn leave_overview(recording: &Path) -> Option<String> {
    commands::run::leave_overview(recording)
}
