//! `gyration plot`: pictures of a recording, or of the contact laws of a scene.

use super::stem;
use crate::arguments::{Plot, What};
use crate::error::{CliError, code};
use crate::output;
use crate::plot::chart::{Figure, Panel};
use crate::plot::draw::Format;
use crate::plot::recorded::Recorded;
use crate::plot::show::{self, Quantity};
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::replay::{Replay, ReplayError};
use std::path::{Path, PathBuf};

/// Draws the picture.
pub fn execute(arguments: &Plot) -> Result<u8, CliError> {
    let output = arguments.output.as_deref();
    let format = format(output)?;
    if !arguments.measures.is_empty() && !arguments.what.contains(&What::Stroke) {
        return Err(CliError::arguments(
            "--measures names those of `stroke`",
            "ask for it: `gyration plot DIR stroke --measures A,B`",
        ));
    }
    let is_recording = Path::new(&arguments.source).is_dir();
    let (what, figure, stem) = if is_recording { of_recording(arguments)? } else { of_scene(arguments)? };
    let bytes = figure.draw().render(format);
    if output == Some(Path::new("-")) {
        output::print(&String::from_utf8_lossy(&bytes))?;
        return Ok(code::DONE);
    }
    let names: Vec<&str> = what.iter().map(|what| name(*what)).collect();
    let default = || PathBuf::from(format!("{stem}-{}.svg", names.join("-")));
    let path = output.map_or_else(default, Path::to_path_buf);
    output::write_file(&path, &bytes)?;
    output::say(&format!("wrote {}", path.display()));
    Ok(code::DONE)
}

/// The format that the ending of the file asks for.
pub fn format(output: Option<&Path>) -> Result<Format, CliError> {
    let Some(path) = output.filter(|path| *path != Path::new("-")) else { return Ok(Format::Svg) };
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("svg") => Ok(Format::Svg),
        Some("png") => Ok(Format::Png),
        Some("pdf") => Ok(Format::Pdf),
        _ => Err(CliError::arguments(
            format!("the ending of {} names no format of pictures", path.display()),
            "let the file end in .svg, .png or .pdf",
        )),
    }
}

type Drawn = (Vec<What>, Figure, String);

fn of_scene(arguments: &Plot) -> Result<Drawn, CliError> {
    let what = if arguments.what.is_empty() { vec![What::Laws] } else { arguments.what.clone() };
    let scene = Scene::open(&arguments.source, &arguments.overrides)?;
    if let Some(other) = what.iter().find(|what| **what != What::Laws) {
        return Err(CliError::arguments(
            format!("`{}` is drawn from a recording, and {} is a scene", name(*other), arguments.source),
            format!("`gyration run {0}` first, then `gyration plot {1}.gyr`", arguments.source, scene.name()),
        ));
    }
    Ok((what, laws(&scene)?, scene.name().to_owned()))
}

/// The contact laws of a scene, at its start.
pub(crate) fn laws(scene: &Scene) -> Result<Figure, CliError> {
    let panels = show::law_panels(&scene.built().model, &scene.built().state)?;
    let title = scene.file().title.clone().unwrap_or_else(|| scene.name().to_owned());
    Ok(Figure { title, subtitle: "contact laws".to_owned(), panels })
}

fn of_recording(arguments: &Plot) -> Result<Drawn, CliError> {
    if !arguments.overrides.is_empty() {
        return Err(CliError::arguments("--set changes a scene, not a recording", "leave out --set"));
    }
    let what = if arguments.what.is_empty() { vec![What::Overview] } else { arguments.what.clone() };
    let path = Path::new(&arguments.source);
    let figure = recorded(&Recording::open(path)?, &what, &arguments.measures)?;
    Ok((what, figure, stem(path)))
}

/// What is asked of a recording, in one figure.
pub(crate) fn recorded(recording: &Recording, what: &[What], measures: &[String]) -> Result<Figure, CliError> {
    let recorded = Recorded::new(recording)?;
    let mut panels = Vec::new();
    for what in what {
        panels.extend(match quantity(*what) {
            Some(Quantity::Stroke) => show::strokes(&recorded, measures)?,
            Some(quantity) => show::panels(&recorded, quantity)?,
            None if *what == What::Overview => show::overview(&recorded)?,
            None => recorded_laws(recording)?,
        });
    }
    Ok(show::figure(&recorded, panels))
}

/// The contact laws of a recording, at its start.
fn recorded_laws(recording: &Recording) -> Result<Vec<Panel>, CliError> {
    let mut replay = Replay::open(recording).map_err(no_replay)?;
    let start = replay.state(0).map_err(no_replay)?;
    Ok(show::law_panels(replay.model(), &start)?)
}

fn no_replay(problem: ReplayError) -> CliError {
    match problem {
        ReplayError::Record(error) => error.into(),
        problem => CliError::arguments(
            problem.to_string(),
            "plot the scene file instead, which knows its folder: `gyration plot SCENE laws`",
        ),
    }
}

fn quantity(what: What) -> Option<Quantity> {
    match what {
        What::Strip => Some(Quantity::Strip),
        What::Stretch => Some(Quantity::Stretch),
        What::Height => Some(Quantity::Height),
        What::Gap => Some(Quantity::Gap),
        What::Forces => Some(Quantity::Forces),
        What::Energy => Some(Quantity::Energy),
        What::Stroke => Some(Quantity::Stroke),
        What::Distance => Some(Quantity::Distance),
        What::Cost => Some(Quantity::Cost),
        What::Drive => Some(Quantity::Drive),
        What::Overview | What::Laws => None,
    }
}

fn name(what: What) -> &'static str {
    match what {
        What::Overview => "overview",
        What::Strip => "strip",
        What::Stretch => "stretch",
        What::Height => "height",
        What::Gap => "gap",
        What::Forces => "forces",
        What::Energy => "energy",
        What::Stroke => "stroke",
        What::Distance => "distance",
        What::Cost => "cost",
        What::Drive => "drive",
        What::Laws => "laws",
    }
}
