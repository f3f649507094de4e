//! `gyration export`: a recording as a table, as arrays, as surfaces for ParaView, as an animation, as a film.

mod film;
mod surfaces;

pub use surfaces::explain;

use crate::arguments::{Export, ExportFormat};
use crate::error::{CliError, code};
use crate::input::stem;
use crate::output;
use clap::ValueEnum as _;
use gyration_plot::TimeSpan;
use gyration_record::{RecordError, Recording, cannot_write, export, replace_file};
use gyration_sim::pairs_csv;
use gyration_sim::replay::particles_xyz;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes the export.
pub fn execute(arguments: &Export) -> Result<u8, CliError> {
    let Export { recording: source, every, pairs, at, output, .. } = arguments;
    let name = output.as_deref();
    let format = arguments.format.map_or_else(|| by_name(name), |format| asked(format, name))?;
    if every.is_some() && !matches!(format, ExportFormat::Vtk | ExportFormat::Xyz) {
        return Err(CliError::arguments(
            "--every is for vtk and xyz",
            "leave it out; films and gltf are thinned to what is seen",
        ));
    }
    if *pairs && format != ExportFormat::Csv {
        let fix = "leave it out: npz has the pairs of a recording by itself, as pairs/first, pairs/force, …";
        return Err(CliError::arguments("--pairs is for csv only", fix));
    }
    if at.is_some() && format != ExportFormat::Png {
        return Err(CliError::arguments("--at is for png only", "leave it out: the other formats have all times"));
    }
    if arguments.span() != TimeSpan::default() && !matches!(format, ExportFormat::Gif | ExportFormat::Mp4) {
        return Err(CliError::arguments("--from and --to are for gif and mp4", "leave them out"));
    }
    let recording = Recording::open(source)?;
    if *pairs && recording.ragged().is_none() {
        let fix = "write record = { pairs = true } in the scene, and run it anew";
        return Err(CliError::arguments("the recording does not have what acts between two", fix));
    }
    let table = if *pairs { Table::Pairs } else { Table::Samples };
    let ending = if *pairs { "pairs.csv" } else { ending(format) };
    let path = output.clone().unwrap_or_else(|| PathBuf::from(format!("{}.{ending}", stem(source))));
    if path == Path::new("-") {
        return to_stdout(&recording, format, table);
    }
    let what = match format {
        ExportFormat::Csv => {
            replace_file(&path, |partial| written(partial, |out| table.write(&recording, out)))?;
            format!("{} samples", recording.rows())
        }
        ExportFormat::Npz => {
            replace_file(&path, |partial| export::npz(&recording, partial))?;
            format!("{} samples", recording.rows())
        }
        ExportFormat::Gltf => {
            let mut made = None;
            replace_file(&path, |partial| {
                made = Some(written(partial, |out| export::gltf(&recording, out))?);
                Ok(())
            })?;
            let keys = made.map_or(0, |motion| motion.samples);
            let origin = made.and_then(|motion| motion.origin);
            let from = origin.map(|[x, y, z]| format!(", places from ({x:?}, {y:?}, {z:?}) m"));
            format!("{keys} of {} samples{}", recording.rows(), from.unwrap_or_default())
        }
        ExportFormat::Gif => film::gif(&recording, arguments.span(), &path)?,
        ExportFormat::Mp4 => film::mp4(&recording, arguments.span(), &path)?,
        ExportFormat::Png => film::png(&recording, *at, &path)?,
        ExportFormat::Vtk => surfaces::write(&recording, &path, every.map_or(1, usize::from))?,
        ExportFormat::Xyz => particles(&recording, every.map_or(1, usize::from), &path)?,
    };
    output::say(&format!("wrote {} ({what})", path.display()));
    Ok(code::DONE)
}

/// Writes each `every`-th sample and the last as particles; tells how many.
fn particles(recording: &Recording, every: usize, path: &Path) -> Result<String, CliError> {
    let (mut samples, mut failed) = (0, None);
    let replaced = replace_file(path, |partial| {
        samples = written(partial, |out| {
            particles_xyz(recording, every, out).map_err(|error| {
                let reason = error.to_string();
                failed = Some(error);
                RecordError::Corrupt { path: recording.path().to_path_buf(), reason }
            })
        })?;
        Ok(())
    });
    match (replaced, failed) {
        (_, Some(error)) => Err(surfaces::explain(recording, error)),
        (Err(error), None) => Err(error.into()),
        (Ok(()), None) => Ok(format!("{samples} of {} samples", recording.rows())),
    }
}

/// Endings of files that are not written here.
const FOREIGN: [&str; 8] = ["gltf", "vtp", "vtu", "vtk", "svg", "pdf", "json", "parquet"];

/// The format that is asked for, unless the name of the file is that of another one.
fn asked(format: ExportFormat, output: Option<&Path>) -> Result<ExportFormat, CliError> {
    let Some(path) = output else { return Ok(format) };
    let foreign = FOREIGN.iter().any(|end| path.extension() == Some(end.as_ref()));
    if foreign || ending_of(path).is_some_and(|other| other != format) {
        let problem = format!("the name {} is that of another format", path.display());
        return Err(CliError::arguments(problem, format!("let it end in .{}", ending(format))));
    }
    Ok(format)
}

/// The format that a name ends in.
fn ending_of(path: &Path) -> Option<ExportFormat> {
    let ends = |format: &ExportFormat| path.extension() == Some(ending(*format).as_ref());
    ExportFormat::value_variants().iter().copied().find(ends)
}

/// The format that the name of a file asks for; what goes to stdout is a table.
fn by_name(output: Option<&Path>) -> Result<ExportFormat, CliError> {
    if output == Some(Path::new("-")) {
        return Ok(ExportFormat::Csv);
    }
    output.and_then(ending_of).ok_or_else(|| {
        let problem = match output {
            Some(path) => format!("the name {} does not tell a format", path.display()),
            None => "no format is given".to_owned(),
        };
        CliError::arguments(
            problem,
            "give --format csv, npz, vtk, xyz, gltf, gif, mp4 or png, or -o with .csv, .npz, .pvd, .xyz, .glb, .gif, \
             .mp4 or .png",
        )
    })
}

fn ending(format: ExportFormat) -> &'static str {
    match format {
        ExportFormat::Csv => "csv",
        ExportFormat::Npz => "npz",
        ExportFormat::Vtk => "pvd",
        ExportFormat::Xyz => "xyz",
        ExportFormat::Gltf => "glb",
        ExportFormat::Gif => "gif",
        ExportFormat::Mp4 => "mp4",
        ExportFormat::Png => "png",
    }
}

/// What a CSV has.
#[derive(Clone, Copy)]
enum Table {
    /// A row a sample.
    Samples,
    /// A row a sample and pair.
    Pairs,
}

impl Table {
    fn write(self, recording: &Recording, out: &mut impl Write) -> Result<(), RecordError> {
        match self {
            Self::Samples => export::csv(recording, out),
            Self::Pairs => pairs_csv(recording, out),
        }
    }
}

fn to_stdout(recording: &Recording, format: ExportFormat, table: Table) -> Result<u8, CliError> {
    if format != ExportFormat::Csv {
        let fix = format!("name a file with -o FILE.{}", ending(format));
        return Err(CliError::arguments("only csv can be written to stdout", fix));
    }
    let mut out = BufWriter::new(io::stdout().lock());
    table.write(recording, &mut out)?;
    out.flush()?;
    Ok(code::DONE)
}

/// Writes a file; what the writing gives.
fn written<T>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> Result<T, RecordError>,
) -> Result<T, RecordError> {
    let failed = cannot_write(path);
    let mut out = BufWriter::new(File::create(path).map_err(&failed)?);
    let given = write(&mut out)?;
    out.flush().map_err(failed)?;
    Ok(given)
}
