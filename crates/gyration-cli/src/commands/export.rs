//! `gyration export`: a recording as a table or as arrays.

use super::stem;
use crate::arguments::{Export, ExportFormat};
use crate::error::{CliError, code};
use crate::output;
use gyration_record::{Recording, export};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes the export.
pub fn execute(arguments: &Export) -> Result<u8, CliError> {
    let ending = match arguments.format {
        ExportFormat::Csv => "csv",
        ExportFormat::Npz => "npz",
        ExportFormat::Vtk | ExportFormat::Gltf => {
            let problem = "the formats vtk and gltf are not in this version yet";
            return Err(CliError::arguments(problem, "choose csv or npz"));
        }
    };
    let recording = Recording::open(&arguments.recording)?;
    let default = || PathBuf::from(format!("{}.{ending}", stem(&arguments.recording)));
    let path = arguments.output.clone().unwrap_or_else(default);
    let to_stdout = path == Path::new("-");
    match arguments.format {
        ExportFormat::Csv if to_stdout => {
            let mut out = BufWriter::new(io::stdout().lock());
            export::csv(&recording, &mut out)?;
            out.flush()?;
        }
        ExportFormat::Csv => output::in_place(&path, |partial| write_csv(&recording, partial))?,
        _ if to_stdout => {
            return Err(CliError::arguments("only csv can be written to stdout", "name a file with -o FILE.npz"));
        }
        _ => output::in_place(&path, |partial| Ok(export::npz(&recording, partial)?))?,
    }
    if !to_stdout {
        output::say(&format!("wrote {} ({} samples)", path.display(), recording.rows()));
    }
    Ok(code::DONE)
}

fn write_csv(recording: &Recording, path: &Path) -> Result<(), CliError> {
    let failed = output::cannot_write(path);
    let mut out = BufWriter::new(File::create(path).map_err(&failed)?);
    export::csv(recording, &mut out)?;
    out.flush().map_err(failed)
}
