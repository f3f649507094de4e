//! `gyration bands`: the waves of a lattice.

mod derived;
mod phonopy;
mod special;

use super::picture;
use crate::arguments::Bands;
use crate::error::{CliError, code};
use crate::input::at_rest;
use crate::output;
use crate::waiting::waiting;
use gyration_record::write_file;
use gyration_scene::Scene;
use gyration_sim::format::{significant, vector};
use gyration_sim::modes::bands::StrainPath;
use gyration_sim::survey::{
    BandOptions, BandSurvey, ComplexBandOptions, ComplexBandSurvey, StrainSurvey, TopologySurvey, USUAL_MESH, unit_cell,
};
use gyration_sim::within_wall_time;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Prints the bands of a lattice along a path, all wave vectors of frequencies, its phases, or what becomes of it under
/// strain.
pub fn execute(arguments: &Bands) -> Result<u8, CliError> {
    let name = &arguments.scene.scene;
    let scene = waiting(format!("opening {name}"), true, || at_rest(&arguments.scene))?;
    let looking = format!("looking for the waves of {name}");
    let text = if let Some(along) = &arguments.along {
        let path = strains(along)?;
        if arguments.steps.get() == 1 {
            return Err(refused("a path of strains has two values at least: write --steps 2 or more".to_owned()));
        }
        let mesh = arguments.mesh.map(std::num::NonZero::get);
        let found = waiting(looking, true, || {
            within_wall_time(&scene, || StrainSurvey::of(&scene, &path, arguments.steps.get(), mesh))
        });
        let found = found.map_err(refused)?;
        let words = || special::strained(scene.title(), &found);
        if arguments.json { json(&serde_json::json!(found)) } else { words() }
    } else if arguments.complex {
        let (path, options, complex) = (arguments.path.as_deref(), options(arguments)?, complex(arguments)?);
        let found = waiting(looking, true, || {
            within_wall_time(&scene, || ComplexBandSurvey::of(&scene, path, options, complex))
        });
        let found = found.map_err(refused)?;
        let words = || special::complex(scene.title(), &found);
        if arguments.json { json(&serde_json::json!(found)) } else { words() }
    } else if arguments.topology {
        let (path, strain) = (arguments.path.as_deref(), options(arguments)?.strain);
        let mesh = arguments.mesh.map_or(USUAL_MESH, std::num::NonZero::get);
        let found = waiting(looking, true, || {
            within_wall_time(&scene, || TopologySurvey::of(&scene, path, mesh, strain.as_ref()))
        });
        let found = found.map_err(refused)?;
        found.warnings.iter().for_each(|warning| output::say(&format!("warning: {warning}")));
        let words = || special::topology(scene.title(), &found);
        if arguments.json { json(&serde_json::json!(found)) } else { words() }
    } else {
        let (path, options) = (arguments.path.as_deref(), options(arguments)?);
        let found = waiting(looking, true, || within_wall_time(&scene, || BandSurvey::of(&scene, path, options)))
            .map_err(refused)?;
        found.warnings.iter().for_each(|warning| output::say(&format!("warning: {warning}")));
        write_files(arguments, &scene, &found)?;
        if arguments.json { json(&serde_json::json!(found)) } else { in_words(scene.title(), &found) }
    };
    output::print(&text)?;
    Ok(code::DONE)
}

/// The picture and the file for other programs.
fn write_files(arguments: &Bands, scene: &Scene, found: &BandSurvey) -> Result<(), CliError> {
    if let Some(path) = &arguments.plot {
        let format = picture::format(Some(path))?;
        picture::write(&gyration_plot::bands(scene.title(), found), Some(path), format, PathBuf::new)?;
    }
    if let Some(path) = &arguments.yaml {
        let cell = unit_cell(scene).map_err(refused)?;
        write_file(path, phonopy::band_yaml(found, cell).as_bytes())?;
        output::say(&format!("wrote {}", path.display()));
    }
    Ok(())
}

fn json(found: &serde_json::Value) -> String {
    format!("{found:#}\n")
}

fn refused(reason: String) -> CliError {
    CliError::arguments(reason, "see `gyration bands --help`")
}

fn strains(text: &str) -> Result<StrainPath, CliError> {
    StrainPath::parse(text).map_err(|error| refused(error.to_string()))
}

fn strain(text: &str) -> Result<StrainPath, CliError> {
    StrainPath::parse_value(text).map_err(|error| refused(error.to_string()))
}

fn options(arguments: &Bands) -> Result<BandOptions, CliError> {
    let keys = arguments.derivatives.iter().flat_map(|keys| keys.split_whitespace());
    Ok(BandOptions {
        points: arguments.points.get(),
        mesh: arguments.mesh.map(std::num::NonZero::get),
        shapes: arguments.shapes,
        strain: arguments.strain.as_deref().map(strain).transpose()?,
        derivatives: keys.map(str::to_owned).collect(),
        bound: arguments.bound,
    })
}

fn complex(arguments: &Bands) -> Result<ComplexBandOptions, CliError> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite() && *value >= 0.0);
    let omega = match &arguments.omega {
        None => None,
        Some(text) => {
            let ends = text.split_once("..").and_then(|(from, to)| Some([number(from)?, number(to)?]));
            let wrong = || refused(format!("\"{text}\" is no range of frequencies: write 0..20"));
            Some(ends.ok_or_else(wrong)?)
        }
    };
    Ok(ComplexBandOptions { direction: usize::from(arguments.direction) - 1, omega })
}

fn in_words(title: &str, found: &BandSurvey) -> String {
    let mut text = format!("{title}\n");
    // Writing to a string does not fail.
    let _ = write_rest(&mut text, found);
    let _ = write_rows(&mut text, found);
    let _ = derived::write_bound(&mut text, found);
    let _ = derived::write_derivatives(&mut text, found);
    let _ = write_gaps(&mut text, found);
    text
}

/// What the cell carries.
fn write_rest(text: &mut String, found: &BandSurvey) -> std::fmt::Result {
    for (number, (cell, force)) in found.rest.cell.iter().zip(&found.rest.force).enumerate() {
        writeln!(text, "cell vector {}  {} m, force {} N", number + 1, vector(cell), vector(force))?;
    }
    writeln!(text)
}

/// A line a wave vector: κ, then ω of each branch; below it decay rates, where there are any.
fn write_rows(text: &mut String, found: &BandSurvey) -> std::fmt::Result {
    let cells =
        |values: &[f64]| values.iter().map(|value| format!("{:>12}", significant(*value, 6))).collect::<String>();
    writeln!(text, "{:>8}{:>9}{:>9}   ω [rad/s], below it decay rates [1/s]", "κ₁", "κ₂", "κ₃")?;
    for (row, [a, b, c]) in found.kappa.iter().enumerate() {
        let label = found.labels.iter().find(|(at, _)| *at == row).map(|(_, name)| format!("  {name}"));
        if row > 0 && found.begins.contains(&row) {
            writeln!(text)?;
        }
        writeln!(text, "{a:>8.4}{b:>9.4}{c:>9.4}{}{}", cells(&found.omega[row]), label.unwrap_or_default())?;
        if found.decay[row].iter().any(|decay| *decay != 0.0) {
            writeln!(text, "{:>26}{}", "", cells(&found.decay[row]))?;
        }
    }
    Ok(())
}

/// Frequencies at which no wave runs.
fn write_gaps(text: &mut String, found: &BandSurvey) -> std::fmt::Result {
    let Some(zone) = &found.zone else { return Ok(()) };
    writeln!(text)?;
    if zone.gaps.is_empty() {
        return writeln!(text, "no gaps between branches");
    }
    for gap in &zone.gaps {
        let (from, to) = (significant(gap.from, 6), significant(gap.to, 6));
        let width = significant(100.0 * gap.width_over_middle, 4);
        writeln!(text, "gap {from} … {to} rad/s above branch {}, {width} % of its middle", gap.below)?;
    }
    Ok(())
}
