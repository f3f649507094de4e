//! What a figure shows: the quantities that a user may ask for, and the figure of several of them.

mod bodies;
mod columns;
mod component;
mod cost;
mod crowd;
mod distance;
mod drive;
mod effort;
mod energy;
mod forces;
mod intervals;
mod laws;
mod motion;
mod quantity;
mod stretch;
mod stroke;
mod trace;

use crate::draw::Format;
use crate::error::PlotError;
use crate::figure::{Figure, Panel};
use crate::recorded::{RecordedScene, TimeSpan};
use crate::strip::{Motion, Strip};
use gyration_record::{Recording, write_file};
use gyration_scene::Scene;
use gyration_sim::replay::{Replay, ReplayError};
use std::fs;
use std::path::Path;

pub use quantity::PlotQuantity;

/// The picture that every run leaves in its recording.
pub const OVERVIEW: &str = "overview.svg";

/// What is asked of a recording, in one figure.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Asked<'a> {
    /// Quantities, one below the other.
    pub quantities: &'a [PlotQuantity],
    /// The measures of strokes.
    pub measures: &'a [String],
    /// Columns of the CSV, in which `*` stands for any letters.
    pub columns: &'a [String],
    /// From when to when.
    pub span: TimeSpan,
}

/// What is asked of a recording.
///
/// # Errors
/// [`PlotError`] where the recording cannot be read or does not have it.
pub fn of_recording(recording: &Recording, asked: Asked) -> Result<Figure, PlotError> {
    let recorded = RecordedScene::new(recording)?.within(asked.span)?;
    let mut all = Vec::new();
    for quantity in asked.quantities {
        all.extend(panels(&recorded, *quantity, asked.measures)?);
    }
    if !asked.columns.is_empty() {
        all.extend(columns::charts(&recorded, asked.columns)?.into_iter().map(Panel::Chart));
    }
    Ok(figure(&recorded, all))
}

/// The bodies at the sample nearest to a time \[s\], or at the end; and the time of it.
///
/// # Errors
/// [`PlotError`] where the recording cannot be read or has no samples.
pub fn bodies_at(recording: &Recording, time: Option<f64>) -> Result<(Figure, f64), PlotError> {
    let recorded = RecordedScene::new(recording)?;
    let strip = Strip::at(&recorded, time)?;
    let time = strip.frames.first().map_or(f64::NAN, |shown| shown.time);
    Ok((figure(&recorded, vec![Panel::Strip(strip)]), time))
}

/// The contact laws of a scene, at its start.
///
/// # Errors
/// [`PlotError::Nothing`] without contacts.
pub fn laws(scene: &Scene) -> Result<Figure, PlotError> {
    let panels = laws::law_panels(&scene.built().model, &scene.built().state, &scene.resolved())?;
    Ok(Figure { title: scene.title().to_owned(), subtitle: "contact laws".to_owned(), panels })
}

/// Draws the overview into the recording; a picture that fails does not make the run fail, it gives a warning.
///
/// The picture that is there may be of an earlier part of the run, which was stopped: one that is the same is left
/// alone, be it where nothing can be written.
pub fn leave_overview(path: &Path) -> Option<String> {
    let draw = || -> Result<(), PlotError> {
        let figure =
            of_recording(&Recording::open(path)?, Asked { quantities: &[PlotQuantity::Overview], ..Asked::default() })?;
        let (file, picture) = (path.join(OVERVIEW), figure.render(Format::Svg));
        match fs::read(&file) {
            Ok(there) if there == picture => Ok(()),
            _ => Ok(write_file(&file, &picture)?),
        }
    };
    match draw() {
        Ok(()) | Err(PlotError::Empty { .. }) => None,
        Err(error) => Some(format!("warning: no {OVERVIEW}: {error}")),
    }
}

/// The panels of one quantity.
fn panels(recorded: &RecordedScene, quantity: PlotQuantity, measures: &[String]) -> Result<Vec<Panel>, PlotError> {
    let charts = match quantity {
        PlotQuantity::Overview => return overview(recorded),
        PlotQuantity::Strip => return Ok(vec![Panel::Strip(Strip::of(recorded)?)]),
        PlotQuantity::Motion => return Ok(vec![Panel::Motion(Motion::of(recorded)?)]),
        PlotQuantity::Laws => return laws_of(recorded.recording),
        PlotQuantity::Crowd => return crowd::panels(recorded),
        PlotQuantity::Height => vec![motion::height(recorded)?],
        PlotQuantity::Gap => vec![motion::gap(recorded)?],
        PlotQuantity::Stretch => stretch::charts(recorded)?,
        PlotQuantity::Forces => vec![match intervals::chart(recorded)? {
            Some(chart) => chart,
            None => forces::chart(recorded)?,
        }],
        PlotQuantity::Energy => energy::charts(recorded)?,
        PlotQuantity::Stroke => stroke::charts(recorded, measures)?,
        PlotQuantity::Distance => vec![distance::chart(recorded)?],
        PlotQuantity::Cost => vec![cost::chart(recorded)?],
        PlotQuantity::Drive => drive::charts(recorded)?,
    };
    Ok(charts.into_iter().map(Panel::Chart).collect())
}

/// The contact laws of a recording, at its start.
fn laws_of(recording: &Recording) -> Result<Vec<Panel>, PlotError> {
    let mut replay = Replay::open(recording).map_err(no_replay)?;
    let start = replay.state(0).map_err(no_replay)?;
    let resolved = recording.attributes().get("resolved").unwrap_or(&serde_json::Value::Null);
    laws::law_panels(replay.model(), &start, resolved)
}

fn no_replay(problem: ReplayError) -> PlotError {
    match problem {
        ReplayError::Record(error) => error.into(),
        changed @ ReplayError::OtherFiles { .. } => {
            PlotError::arguments(changed.to_string(), "put the file back as it was when the run was made")
        }
        problem => PlotError::arguments(
            problem.to_string(),
            "plot the scene file instead, which knows its folder: `gyration plot SCENE laws`",
        ),
    }
}

/// Everything that the recording has; how far bodies get where some drive themselves.
fn overview(recorded: &RecordedScene) -> Result<Vec<Panel>, PlotError> {
    let mut all = Vec::new();
    let order = [
        PlotQuantity::Strip,
        PlotQuantity::Height,
        PlotQuantity::Distance,
        PlotQuantity::Gap,
        PlotQuantity::Stretch,
        PlotQuantity::Forces,
        PlotQuantity::Energy,
        PlotQuantity::Stroke,
    ];
    let contracts = recorded.bodies.iter().any(|body| body.contracts());
    for quantity in order.into_iter().filter(|quantity| contracts || *quantity != PlotQuantity::Distance) {
        match panels(recorded, quantity, &[]) {
            Ok(panels) => all.extend(panels),
            Err(PlotError::Nothing { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(all)
}

/// A figure of a recording under its title and outcome.
fn figure(recorded: &RecordedScene, panels: Vec<Panel>) -> Figure {
    let subtitle = match word(recorded.recording, "outcome_in_words") {
        "" => "not finished".to_owned(),
        outcome => outcome.to_owned(),
    };
    Figure { title: title(recorded.recording).to_owned(), subtitle, panels }
}

/// The title of the scene of a recording, else its name.
pub fn title(recording: &Recording) -> &str {
    match word(recording, "title") {
        "" => word(recording, "scene_name"),
        title => title,
    }
}

/// An attribute of words; empty where there is none.
fn word<'a>(recording: &'a Recording, name: &str) -> &'a str {
    recording.attributes().get(name).and_then(serde_json::Value::as_str).unwrap_or_default()
}
