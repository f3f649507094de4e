//! `gyration study STUDY plot`: the picture of a table.

use crate::arguments::{Study as Arguments, StudyPlot};
use crate::commands::plot::format;
use crate::error::{CliError, code};
use crate::library::StudyPicture;
use crate::output;
use crate::plot::chart::Figure;
use crate::plot::study::{Kind, Request, Table, Unfit, figure};
use gyration_study::{Frame, Study};
use std::path::{Path, PathBuf};

/// Draws the table of a study: its folder, a Parquet file, or the folder that a run of the study has left here.
pub fn execute(study: &str, arguments: &StudyPlot, beside: &Arguments) -> Result<u8, CliError> {
    let output = beside.output.as_deref();
    let format = format(output)?;
    let path = table(study)?;
    let frame = Frame::read(&path)?;
    let stem = stem(&path);
    let asked = StudyPicture {
        x: arguments.x.clone(),
        y: arguments.y.clone(),
        colour: arguments.colour.clone(),
        kind: arguments.kind.clone(),
    };
    let bytes = drawn(&frame, &stem, &asked, said_now(study, &beside.overrides)?)?.draw().render(format);
    if output == Some(Path::new("-")) {
        output::print(&String::from_utf8_lossy(&bytes))?;
        return Ok(code::DONE);
    }
    let path = output.map_or_else(|| PathBuf::from(format!("{stem}.svg")), Path::to_path_buf);
    output::write_file(&path, &bytes)?;
    output::say(&format!("wrote {}", path.display()));
    Ok(code::DONE)
}

/// What the file of a study says of its picture now, which may be more than when the table was made; none where only the table is there.
fn said_now(study: &str, overrides: &[String]) -> Result<Option<Request>, CliError> {
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
    wanted(&Study::open(study, overrides)?).map(Some)
}

/// What a study says of its picture, with its title.
///
/// # Errors
/// [`CliError::Arguments`] where its `[plot]` says what cannot be drawn from its columns.
pub(crate) fn wanted(study: &Study) -> Result<Request, CliError> {
    let request = match study.plot() {
        plot if plot.is_null() => Request::default(),
        plot => Request::of_study(plot).map_err(unfit)?,
    };
    let columns: Vec<&str> = study.columns().iter().map(|column| column.name.as_str()).collect();
    let asked = [&request.x, &request.y, &request.colour].into_iter().flatten();
    for name in asked.map(|name| name.split('=').next().unwrap_or(name).trim()) {
        if !columns.contains(&name) {
            let problem = format!("[plot] of {} names a column `{name}`, which it will not have", study.name());
            return Err(CliError::arguments(problem, format!("its columns are {}", columns.join(", "))));
        }
    }
    if let Some(axis) = request.logarithmic.iter().find(|axis| !Request::AXES.contains(&axis.as_str())) {
        let problem = format!("[plot] of {} has a logarithmic axis `{axis}`", study.name());
        return Err(CliError::arguments(problem, "write some of \"x\", \"y\", \"colour\""));
    }
    Ok(request)
}

/// The picture of a table, which is called `name` where its study has no title; `said` is what its study says of it, if not what it said
/// when the table was made.
pub(crate) fn drawn(
    frame: &Frame,
    name: &str,
    asked: &StudyPicture,
    said: Option<Request>,
) -> Result<Figure, CliError> {
    let kind = |word: &String| {
        let unknown = || {
            let fix = format!("choose one of {}", Kind::WORDS.join(", "));
            CliError::arguments(format!("there is no kind of picture `{word}`"), fix)
        };
        Kind::of_word(word).ok_or_else(unknown)
    };
    let asked = Request {
        kind: asked.kind.as_ref().map(kind).transpose()?,
        x: asked.x.clone(),
        y: asked.y.clone(),
        colour: asked.colour.clone(),
        ..Request::default()
    };
    let said = said.map_or_else(|| Request::of_frame(frame).map_err(unfit), Ok)?;
    let request = asked.or(said);
    figure(&Table::of_frame(frame, name), &request).map_err(unfit)
}

fn unfit(Unfit { problem, fix }: Unfit) -> CliError {
    CliError::Arguments { problem, fix }
}

/// What a table is called where nothing else names it.
pub(crate) fn stem(path: &Path) -> String {
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
