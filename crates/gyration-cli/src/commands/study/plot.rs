//! `gyration study STUDY plot`: the picture of a table.

use crate::arguments::StudyPlot;
use crate::commands::plot::format;
use crate::error::{CliError, code};
use crate::output;
use crate::plot::study::{Kind, Request, Table, Unfit, figure};
use gyration_study::Frame;
use std::path::{Path, PathBuf};

/// Draws the table of a study: its folder, a Parquet file, or the folder that a run of the study has left here.
pub fn execute(study: &str, arguments: &StudyPlot, output: Option<&Path>) -> Result<u8, CliError> {
    let format = format(output)?;
    let path = table(study)?;
    let frame = Frame::read(&path)?;
    let stem = path.file_stem().map_or_else(|| "study".to_owned(), |stem| stem.to_string_lossy().into_owned());
    let asked = Request {
        kind: arguments.kind.as_deref().and_then(Kind::of_word),
        x: arguments.x.clone(),
        y: arguments.y.clone(),
        colour: arguments.colour.clone(),
        ..Request::default()
    };
    let request = asked.or(Request::of_frame(&frame).map_err(unfit)?);
    let figure = figure(&Table::of_frame(&frame, &stem), &request).map_err(unfit)?;
    let bytes = figure.draw().render(format);
    if output == Some(Path::new("-")) {
        output::print(&String::from_utf8_lossy(&bytes))?;
        return Ok(code::DONE);
    }
    let path = output.map_or_else(|| PathBuf::from(format!("{stem}.svg")), Path::to_path_buf);
    output::write_file(&path, &bytes)?;
    output::say(&format!("wrote {}", path.display()));
    Ok(code::DONE)
}

fn unfit(Unfit { problem, fix }: Unfit) -> CliError {
    CliError::Arguments { problem, fix }
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
