//! `gyration bands`: the waves of a lattice.

use crate::arguments::Bands;
use crate::error::{CliError, code};
use crate::input::ready;
use crate::output;
use crate::waiting::waiting;
use gyration_sim::format::{significant, vector};
use gyration_sim::survey::{BandOptions, BandSurvey};
use std::fmt::Write as _;

/// Prints the bands of a lattice along a path.
pub fn execute(arguments: &Bands) -> Result<u8, CliError> {
    let name = &arguments.scene.scene;
    let scene = waiting(format!("opening {name}"), true, || ready(&arguments.scene))?;
    let options = BandOptions {
        points: arguments.points.get(),
        mesh: arguments.mesh.map(std::num::NonZero::get),
        shapes: arguments.shapes,
    };
    let found = waiting(format!("looking for the waves of {name}"), true, || {
        BandSurvey::of(&scene, arguments.path.as_deref(), options)
    });
    let found = found.map_err(|reason| CliError::arguments(reason, "see `gyration bands --help`"))?;
    found.warnings.iter().for_each(|warning| output::say(&format!("warning: {warning}")));
    let text = match arguments.json {
        true => format!("{:#}\n", serde_json::json!(found)),
        false => in_words(&scene.title(), &found),
    };
    output::print(&text)?;
    Ok(code::DONE)
}

fn in_words(title: &str, found: &BandSurvey) -> String {
    let mut text = format!("{title}\n");
    // Writing to a string does not fail.
    let _ = write_rest(&mut text, found);
    let _ = write_rows(&mut text, found);
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
