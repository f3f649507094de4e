//! `gyration study STUDY plot`: the picture of a table.

use crate::arguments::{StudyArguments, StudyPlot};
use crate::commands::picture::{format, write};
use crate::error::CliError;
use gyration_plot::study::{PlotKind, PlotRequest, of_table};
use gyration_study::{DataFrame, Study};
use std::path::{Path, PathBuf};

/// Draws the table of a study: its folder, a Parquet file, or the folder that a run of the study has left here.
pub fn execute(study: &str, arguments: &StudyPlot, beside: &StudyArguments) -> Result<u8, CliError> {
    let output = beside.output.as_deref();
    let format = format(output)?;
    let path = table(study)?;
    let frame = DataFrame::read(&path)?;
    let stem = stem(&path);
    let asked = PlotRequest {
        kind: arguments.kind.as_deref().map(PlotKind::of_word).transpose()?,
        x: arguments.x.clone(),
        y: arguments.y.clone(),
        colour: arguments.colour.clone(),
        ..PlotRequest::default()
    };
    let figure = of_table(&frame, &stem, asked, opened(study, &beside.overrides)?.as_ref())?;
    write(&figure, output, format, || PathBuf::from(format!("{stem}.svg")))
}

/// Draws a table as its study says, or by its columns.
pub fn draw_table(table: &str, output: Option<&Path>) -> Result<u8, CliError> {
    let (path, format) = (Path::new(table), format(output)?);
    let stem = stem(path);
    let figure = of_table(&DataFrame::read(path)?, &stem, PlotRequest::default(), None)?;
    write(&figure, output, format, || PathBuf::from(format!("{stem}.svg")))
}

/// The study, whose file may say more of its picture now than when the table was made; none where only the table is
/// there.
fn opened(study: &str, overrides: &[String]) -> Result<Option<Study>, CliError> {
    let path = Path::new(study);
    let is_table = path.is_dir() || path.extension().is_some_and(|ending| ending == "parquet");
    if overrides.is_empty() && (is_table || !path.is_file()) {
        return Ok(None);
    }
    if is_table {
        return Err(CliError::arguments(
            "a table has nothing to set",
            "name the study, or say it by --x, --y, --colour, --kind",
        ));
    }
    Ok(Some(Study::open(study, overrides)?))
}

/// What a table is called where nothing else names it.
fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "study".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Where the table is.
fn table(study: &str) -> Result<PathBuf, CliError> {
    let path = Path::new(study);
    let is_table = path.is_dir() || path.extension().is_some_and(|ending| ending == "parquet");
    if is_table && path.exists() {
        return Ok(path.to_path_buf());
    }
    let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    let folder = PathBuf::from(format!("{stem}.study"));
    if folder.is_dir() {
        return Ok(folder);
    }
    Err(CliError::arguments(
        format!("there is no table of {study} in this folder"),
        format!("`gyration study {study}` first, or name the folder that it made"),
    ))
}
