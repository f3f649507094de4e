//! `gyration continuum`: what a lattice is as a continuum, and where that ends.

use super::picture;
use crate::arguments::ContinuumArguments;
use crate::error::{CliError, code};
use crate::input::at_rest;
use crate::output;
use crate::waiting::waiting;
use gyration_sim::format::{significant, vector};
use gyration_sim::modes::bands::Tensor;
use gyration_sim::survey::ContinuumSurvey;
use gyration_sim::within_wall_time;
use std::fmt::Write as _;
use std::path::PathBuf;

const AXES: [char; 3] = ['x', 'y', 'z'];
/// So many coordinates are named.
const SHOWN: usize = 24;
/// An error below this is rounding.
const ROUNDING: f64 = 1e-12;

/// Prints moduli, how far waves of a model are off along a path, and where it ends.
pub fn execute(arguments: &ContinuumArguments) -> Result<u8, CliError> {
    let name = &arguments.scene.scene;
    let scene = waiting(format!("opening {name}"), true, || at_rest(&arguments.scene))?;
    let (path, points) = (arguments.path.as_deref(), arguments.points.get());
    let looking = format!("expanding the waves of {name}");
    let found = waiting(looking, true, || {
        within_wall_time(&scene, || ContinuumSurvey::of(&scene, arguments.model.model(), path, points))
    });
    let found = found.map_err(|reason| CliError::arguments(reason, "see `gyration continuum --help`"))?;
    found.warnings.iter().for_each(|warning| output::say(&format!("warning: {warning}")));
    if let Some(path) = &arguments.plot {
        let format = picture::format(Some(path))?;
        picture::write(&gyration_plot::continuum(scene.title(), &found), Some(path), format, PathBuf::new)?;
    }
    let text = match arguments.json {
        true => format!("{:#}\n", serde_json::json!(found)),
        false => in_words(scene.title(), &found),
    };
    output::print(&text)?;
    Ok(code::DONE)
}

fn in_words(title: &str, found: &ContinuumSurvey) -> String {
    let mut text = format!("{title}\n");
    // Writing to a string does not fail.
    let _ = write_moduli(&mut text, found);
    let _ = write_reach(&mut text, found);
    let _ = write_map(&mut text, found);
    text
}

/// Density and stiffnesses; those of other units than a solid's on a plane or a line.
fn write_moduli(text: &mut String, found: &ContinuumSurvey) -> std::fmt::Result {
    let [density, modulus] = match found.rest.cell.len() {
        1 => ["kg/m", "N"],
        2 => ["kg/m²", "N/m"],
        _ => ["kg/m³", "Pa"],
    };
    for (number, (cell, force)) in found.rest.cell.iter().zip(&found.rest.force).enumerate() {
        writeln!(text, "cell vector {}  {} m, force {} N", number + 1, vector(cell), vector(force))?;
    }
    let count = found.coordinates.len();
    let more = if count > SHOWN { " …" } else { "" };
    writeln!(text, "{count} coordinates a cell: {}{more}", found.coordinates[..count.min(SHOWN)].join(" "))?;
    writeln!(text, "density {} {density}", significant(found.mass[0][0], 6))?;
    let components = [("C", &found.macroscopic), ("C_e", &found.held)]
        .into_iter()
        .chain(found.micro.as_ref().map(|it| ("C_micro", it)));
    for (name, tensor) in components {
        let told = match name {
            "C" => "what long waves meet",
            "C_e" => "granules held",
            _ => "1/(1/C − 1/C_e)",
        };
        writeln!(text, "\n{name} [{modulus}], {told}")?;
        write_tensor(text, tensor)?;
    }
    Ok(())
}

/// The components above rounding, each pair of indices once where the tensor is symmetric.
fn write_tensor(text: &mut String, tensor: &Tensor) -> std::fmt::Result {
    let pairs = || (0..3).flat_map(|i| (0..3).map(move |a| (i, a)));
    let all = || pairs().flat_map(|one| pairs().map(move |other| (one, other)));
    let entry = |((i, a), (j, b)): ((usize, usize), (usize, usize))| tensor[i][a][j][b];
    let most = all().map(|at| entry(at).abs()).fold(0.0, f64::max);
    let same = |one: f64, other: f64| (one - other).abs() <= 1e-9 * most;
    let is_even = all().all(|((i, a), other)| same(entry(((i, a), other)), entry(((a, i), other))));
    let mut any = false;
    for ((i, a), (j, b)) in all() {
        let is_again = (i, a) > (j, b) || (is_even && (i > a || j > b));
        let value = tensor[i][a][j][b];
        if is_again || value.abs() <= 1e-9 * most {
            continue;
        }
        any = true;
        let [i, a, j, b] = [i, a, j, b].map(|axis| AXES[axis]);
        writeln!(text, "  {i}{a}{j}{b}{:>14}", significant(value, 6))?;
    }
    if any { Ok(()) } else { writeln!(text, "  none") }
}

/// Where the model ends.
fn write_reach(text: &mut String, found: &ContinuumSurvey) -> std::fmt::Result {
    writeln!(text, "\nwhere \"{}\" is off by 1 %, along", found.model.name())?;
    for reach in &found.reach {
        let wavelength = match reach.wavelength {
            Some(wavelength) => format!("wavelengths below {} m", significant(wavelength, 6)),
            None if reach.throughout => "however long waves are: it has other stiffnesses".to_owned(),
            None => "nowhere up to the boundary of the zone".to_owned(),
        };
        writeln!(text, "  {}  {wavelength}", vector(&reach.direction))?;
    }
    Ok(())
}

/// A line a wave vector: κ, then ω of each wave of the model; below it by how much it is off.
fn write_map(text: &mut String, found: &ContinuumSurvey) -> std::fmt::Result {
    let cell = |word: String| format!("{word:>12}");
    writeln!(text, "\n{:>8}{:>9}{:>9}   ω of the model [rad/s], below it by how much it is off [%]", "κ₁", "κ₂", "κ₃")?;
    let map = &found.map;
    for (row, [a, b, c]) in map.kappa.iter().enumerate() {
        if row > 0 && map.begins.contains(&row) {
            writeln!(text)?;
        }
        let label = map.labels.iter().find(|(at, _)| *at == row).map(|(_, name)| format!("  {name}"));
        let own: String = map.continuum[row].iter().map(|omega| cell(significant(*omega, 6))).collect();
        writeln!(text, "{a:>8.4}{b:>9.4}{c:>9.4}{own}{}", label.unwrap_or_default())?;
        let rounded = |error: f64| if error < ROUNDING { 0.0 } else { 100.0 * error };
        let percent =
            |error: &Option<f64>| error.map_or_else(|| "–".to_owned(), |error| significant(rounded(error), 4));
        let off: String = map.error[row].iter().map(|error| cell(percent(error))).collect();
        writeln!(text, "{:>26}{off}", "")?;
    }
    Ok(())
}
