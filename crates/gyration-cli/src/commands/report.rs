//! `gyration report`: a recording as one HTML file that needs neither network nor this program.

use crate::arguments::ReportArguments;
use crate::error::{CliError, code};
use crate::input::stem;
use crate::output;
use gyration_record::write_file;
use gyration_view::{Stored, report};
use std::path::{Path, PathBuf};

/// Writes the report.
pub fn execute(arguments: &ReportArguments) -> Result<u8, CliError> {
    let stored = Stored::open(&arguments.recording)?;
    let made = report(&stored)?;
    if arguments.output.as_deref() == Some(Path::new("-")) {
        output::print(&made.html)?;
        return Ok(code::DONE);
    }
    let default = || PathBuf::from(format!("{}.html", stem(&arguments.recording)));
    let path = arguments.output.clone().unwrap_or_else(default);
    write_file(&path, made.html.as_bytes())?;
    let samples = match made.samples {
        (kept, all) if kept == all => format!("{all} samples"),
        (kept, all) => format!("{kept} of {all} samples, to keep it small"),
    };
    output::say(&format!("wrote {} ({samples}, {:.1} MB)", path.display(), made.html.len() as f64 / 1e6));
    Ok(code::DONE)
}
