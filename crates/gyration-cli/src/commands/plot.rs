//! `gyration plot`: pictures of a recording, or of the contact laws of a scene.

use super::picture::{format, write};
use crate::arguments::Plot;
use crate::error::CliError;
use crate::input::stem;
use gyration_plot::{Asked, Figure, PlotQuantity, TimeSpan};
use gyration_record::Recording;
use gyration_scene::Scene;
use std::path::{Path, PathBuf};

/// Draws the picture.
pub fn execute(arguments: &Plot) -> Result<u8, CliError> {
    let output = arguments.output.as_deref();
    let format = format(output)?;
    if !arguments.measures.is_empty() && !arguments.what.contains(&PlotQuantity::Stroke) {
        return Err(CliError::arguments(
            "--measures names those of `stroke`",
            "ask for it: `gyration plot DIR stroke --measures A,B`",
        ));
    }
    #[cfg(feature = "study")]
    if is_table(Path::new(&arguments.source)) {
        return of_table(arguments);
    }
    let is_recording = Path::new(&arguments.source).is_dir();
    let (figure, name) = if is_recording { of_recording(arguments)? } else { of_scene(arguments)? };
    write(&figure, output, format, || PathBuf::from(format!("{name}.svg")))
}

/// Whether a path is that of the table of a study.
#[cfg(feature = "study")]
fn is_table(path: &Path) -> bool {
    let ending = |ending: &str| path.extension().is_some_and(|own| own == ending);
    (path.is_dir() && ending("study")) || (path.is_file() && ending("parquet"))
}

/// The picture that `gyration study … plot` draws without options.
#[cfg(feature = "study")]
fn of_table(arguments: &Plot) -> Result<u8, CliError> {
    let is_of_a_run = !arguments.columns.is_empty() || arguments.span() != TimeSpan::default();
    if is_of_a_run || !arguments.what.is_empty() || !arguments.measures.is_empty() || !arguments.overrides.is_empty() {
        return Err(CliError::arguments(
            format!("{} is the table of a study, which has columns", arguments.source),
            format!("`gyration study {} plot` with --x, --y, --colour, --kind", arguments.source),
        ));
    }
    super::study::draw_table(&arguments.source, arguments.output.as_deref())
}

/// The figure, and what its file is called.
fn of_scene(arguments: &Plot) -> Result<(Figure, String), CliError> {
    if !arguments.columns.is_empty() || arguments.span() != TimeSpan::default() {
        let problem = format!("--columns, --from and --to are of a recording, and {} is a scene", arguments.source);
        return Err(CliError::arguments(problem, format!("`gyration run {}` first", arguments.source)));
    }
    let scene = Scene::open(&arguments.source, &arguments.overrides)?;
    if let Some(other) = arguments.what.iter().find(|what| **what != PlotQuantity::Laws) {
        return Err(CliError::arguments(
            format!("`{}` is drawn from a recording, and {} is a scene", other.name(), arguments.source),
            format!("`gyration run {0}` first, then `gyration plot {1}.gyr`", arguments.source, scene.name()),
        ));
    }
    Ok((gyration_plot::laws(&scene)?, named(scene.name(), &arguments.what, PlotQuantity::Laws)))
}

/// The figure, and what its file is called.
fn of_recording(arguments: &Plot) -> Result<(Figure, String), CliError> {
    if !arguments.overrides.is_empty() {
        return Err(CliError::arguments("--set changes a scene, not a recording", "leave out --set"));
    }
    let path = Path::new(&arguments.source);
    let Plot { measures, columns, .. } = arguments;
    let all = [PlotQuantity::Overview];
    let what = if arguments.what.is_empty() && columns.is_empty() { &all } else { &arguments.what[..] };
    let asked = Asked { quantities: what, measures, columns, span: arguments.span() };
    let figure = gyration_plot::of_recording(&Recording::open(path)?, asked)?;
    let name = if what.is_empty() {
        format!("{}-columns", stem(path))
    } else {
        named(&stem(path), what, PlotQuantity::Overview)
    };
    Ok((figure, name))
}

/// `STEM-WHAT`
fn named(stem: &str, what: &[PlotQuantity], default: PlotQuantity) -> String {
    let names = what.iter().map(|quantity| quantity.name()).collect::<Vec<_>>();
    if names.is_empty() { format!("{stem}-{}", default.name()) } else { format!("{stem}-{}", names.join("-")) }
}
