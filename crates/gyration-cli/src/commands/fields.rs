//! `gyration fields`: micromorphic fields of a recording.

use super::export::explain;
use super::picture;
use crate::arguments::FieldArguments;
use crate::error::{CliError, code};
use crate::output;
use crate::waiting::waiting;
use gyration_plot::Format;
use gyration_record::export::vtk::{SeriesFile, pvd, vti};
use gyration_record::{Recording, cannot_write, replace_file};
use gyration_sim::fields::LocalFields;
use gyration_sim::format::{significant, vector};
use gyration_sim::{FieldPoints, FieldSurvey, NoFields};
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};

/// So many points are printed one by one.
const SHOWN: usize = 40;

/// Prints fields at points, or writes those of a grid.
pub fn execute(arguments: &FieldArguments) -> Result<u8, CliError> {
    // Before what takes long.
    let format = picture::format(arguments.plot.as_deref())?;
    let recording = Recording::open(&arguments.recording)?;
    let points = match (&arguments.at, arguments.grid) {
        (Some(points), _) => FieldPoints::At(points.0.clone()),
        (None, Some(counts)) => FieldPoints::Grid(counts),
        (None, None) => FieldPoints::Usual,
    };
    let reading = format!("averaging {}", arguments.recording.display());
    let found = waiting(reading, true, || FieldSurvey::of(&recording, arguments.width, &points, arguments.every.get()));
    let found = found.map_err(|error| refused(&recording, error))?;
    if let Some(path) = &arguments.plot {
        draw(&recording, &found, path, format)?;
    }
    match &arguments.output {
        Some(path) => write(&found, path)?,
        None if arguments.json => output::print(&format!("{}\n", serde_json::json!(found)))?,
        None => output::print(&in_words(&found))?,
    }
    Ok(code::DONE)
}

fn refused(recording: &Recording, error: NoFields) -> CliError {
    let fix = match &error {
        NoFields::Replay(_) | NoFields::Interrupted => None,
        NoFields::NoPairs | NoFields::Remembers => error.in_scene(),
        NoFields::Width(_) | NoFields::Extent { .. } | NoFields::Wide { .. } => {
            Some("write --width with a length in metres, about the distance of bodies")
        }
        NoFields::Many { .. } => Some("write a coarser --grid, or leave samples out with --every"),
        NoFields::EmptyGrid => Some("write --grid with three counts, as 64,64,1"),
    };
    match (error, fix) {
        (NoFields::Replay(error), _) => explain(recording, error),
        (error, fix) => CliError::arguments(error.to_string(), fix.unwrap_or_default()),
    }
}

/// The last sample in the file, and of several all of them in a folder beside it, with their list.
fn write(found: &FieldSurvey, path: &Path) -> Result<(), CliError> {
    let Some(last) = found.times.len().checked_sub(1) else {
        return Err(CliError::arguments("the recording has no samples", "run the scene further"));
    };
    if path.extension().is_none_or(|ending| ending != "vti") {
        let problem = format!("the name {} does not end in .vti", path.display());
        return Err(CliError::arguments(problem, "write -o FILE.vti"));
    }
    write_sample(found, last, path)?;
    if last == 0 {
        output::say(&format!("wrote {}", path.display()));
        return Ok(());
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let folder = path.with_file_name(format!("{stem}-vti"));
    std::fs::create_dir_all(&folder).map_err(cannot_write(&folder))?;
    let mut entries = Vec::new();
    for (sample, time) in found.times.iter().enumerate() {
        let name = format!("fields-{sample:06}.vti");
        write_sample(found, sample, &folder.join(&name))?;
        entries.push(SeriesFile { time: *time, part: 0, file: format!("{stem}-vti/{name}") });
    }
    let list = path.with_extension("pvd");
    replace_file(&list, |partial| {
        let failed = cannot_write(&list);
        let mut out = BufWriter::new(File::create(partial).map_err(&failed)?);
        pvd(&entries, &mut out).and_then(|()| out.flush()).map_err(failed)
    })?;
    let (file, list, count) = (path.display(), list.display(), entries.len());
    output::say(&format!("wrote {file} (the last of {count} samples) and {list} (all of them)"));
    Ok(())
}

/// The picture of the last sample.
fn draw(recording: &Recording, found: &FieldSurvey, path: &Path, format: Format) -> Result<(), CliError> {
    let Some(figure) = gyration_plot::fields(recording, found) else {
        return Err(CliError::arguments("the recording has no samples", "run the scene further"));
    };
    picture::write(&figure, Some(path), format, PathBuf::new).map(drop)
}

fn write_sample(found: &FieldSurvey, sample: usize, path: &Path) -> Result<(), CliError> {
    // Points that stand alone are refused beside -o.
    let Some(image) = found.image(sample) else { return Ok(()) };
    replace_file(path, |partial| {
        let failed = cannot_write(path);
        let mut out = BufWriter::new(File::create(partial).map_err(&failed)?);
        vti(&image, &mut out).and_then(|()| out.flush()).map_err(failed)
    })?;
    Ok(())
}

fn in_words(found: &FieldSurvey) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_samples(&mut text, found);
    if found.points.len() <= SHOWN {
        let _ = write_points(&mut text, found);
    }
    text
}

/// A line a sample: the largest of each field over all points, and how well the balances close.
fn write_samples(text: &mut String, found: &FieldSurvey) -> std::fmt::Result {
    let count = found.points.len();
    writeln!(
        text,
        "fields of bodies seen with a width of {} m, largest of {count} points",
        significant(found.width, 6)
    )?;
    let heads = ["t [s]", "ρ [kg/m³]", "speed [m/s]", "σ [Pa]", "micro [Pa]", "contact [Pa]", "power [W/m³]"];
    writeln!(text, "{}   left of the balances", heads.map(|head| format!("{head:>14}")).concat())?;
    for (time, fields) in found.times.iter().zip(&found.fields) {
        let most = |value: fn(&LocalFields) -> f64| fields.iter().map(value).fold(0.0, f64::max);
        let [linear, affine] = left(fields);
        let columns = [
            *time,
            most(|it| it.density),
            most(LocalFields::speed),
            most(|it| it.stress.amax()),
            most(|it| it.micro_stress.amax()),
            most(|it| it.contact_stress.amax()),
            most(|it| it.power.abs()),
        ];
        let columns = columns.map(|number| format!("{:>14}", significant(number, 6))).concat();
        writeln!(text, "{columns}   momentum {linear:.1e}, affine momentum {affine:.1e}")?;
    }
    Ok(())
}

/// The fields at each point in the last sample.
fn write_points(text: &mut String, found: &FieldSurvey) -> std::fmt::Result {
    let Some((time, fields)) = found.times.last().zip(found.fields.last()) else { return Ok(()) };
    for (point, fields) in found.points.iter().zip(fields) {
        writeln!(text, "\nat {} m, t = {} s", vector(&(*point).into()), significant(*time, 6))?;
        let matrix = |matrix: &gyration::tensor::Mat3| {
            let rows: Vec<String> = matrix.row_iter().map(|row| vector(&row.transpose().into())).collect();
            rows.join("; ")
        };
        writeln!(text, "  density          {} kg/m³", significant(fields.density, 6))?;
        writeln!(text, "  momentum         {} kg/(m² s)", vector(&fields.momentum.into()))?;
        writeln!(text, "  affine momentum  {} kg/(m s)", matrix(&fields.affine_momentum))?;
        writeln!(text, "  stress σ         {} Pa", matrix(&fields.stress))?;
        writeln!(text, "  micro-stress     {} Pa", matrix(&fields.micro_stress))?;
        writeln!(text, "  contact stress   {} Pa", matrix(&fields.contact_stress))?;
        let hyper = fields.hyperstress.iter().map(|part| part.amax()).fold(0.0, f64::max);
        writeln!(text, "  hyperstress      {} N/m at most", significant(hyper, 6))?;
        writeln!(text, "  power of pairs   {} W/m³", significant(fields.power, 6))?;
    }
    Ok(())
}

/// What is left of the balances of momentum and of affine momentum, as parts of their largest terms.
fn left(fields: &[LocalFields]) -> [f64; 2] {
    let scales = fields.iter().map(|it| it.scales).fold([0.0_f64; 2], |[a, b], [c, d]| [a.max(c), b.max(d)]);
    let most = |value: fn(&LocalFields) -> f64| fields.iter().map(value).fold(0.0, f64::max);
    let part = |left: f64, scale: f64| if scale > 0.0 { left / scale } else { 0.0 };
    [part(most(|it| it.momentum_residual), scales[1]), part(most(|it| it.residual), scales[0])]
}
