//! Where a picture goes: to stdout, or to a file whose ending is its format.

use crate::error::{CliError, code};
use crate::output;
use gyration_plot::{Figure, Format};
use gyration_record::write_file;
use std::path::{Path, PathBuf};

/// The format that the ending of the file asks for; SVG for stdout and without a file.
pub fn format(output: Option<&Path>) -> Result<Format, CliError> {
    match output.filter(|path| *path != Path::new("-")) {
        Some(path) => Ok(Format::of_path(path)?),
        None => Ok(Format::Svg),
    }
}

/// Writes a picture to stdout, to a file, or to the file that it is called without one.
pub fn write(
    figure: &Figure,
    output: Option<&Path>,
    format: Format,
    default: impl FnOnce() -> PathBuf,
) -> Result<u8, CliError> {
    let bytes = figure.render(format);
    if output == Some(Path::new("-")) {
        output::print(&String::from_utf8_lossy(&bytes))?;
        return Ok(code::DONE);
    }
    let path = output.map_or_else(default, Path::to_path_buf);
    write_file(&path, &bytes)?;
    output::say(&format!("wrote {}", path.display()));
    Ok(code::DONE)
}
