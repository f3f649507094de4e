//! `gyration resistance`: the resistances of bodies in a viscous fluid, as text or JSON.

use crate::arguments::{ResistanceArguments, SceneArguments};
use crate::error::{CliError, code};
use crate::input;
use crate::output;
use gyration_scene::Scene;
use gyration_sim::format::significant;
use gyration_sim::resistance::{FluidResponse, ResistanceMatrix, ResistanceOptions, Resistances, Vibration};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

/// What rows and columns of the matrix are.
const AXES: [&str; 3] = ["x", "y", "z"];
/// Entries below this part of the largest of their block are printed as zero: rounding.
const ROUNDING: f64 = 1e-13;

/// Prints the resistance of the bodies.
pub fn execute(arguments: &ResistanceArguments) -> Result<u8, CliError> {
    let (scene, only) = open(arguments)?;
    let options = ResistanceOptions {
        wall: arguments.wall.clone(),
        triangles: arguments.triangles,
        elements: arguments.elements,
        frequency: arguments.frequency,
    };
    let found = Resistances::of(&scene, only.as_deref(), &options)?;
    let text = if arguments.json { format!("{:#}\n", found.to_json(scene.name())) } else { in_words(&found) };
    output::print(&text)?;
    Ok(code::DONE)
}

/// The scene, and the body named behind a colon.
fn open(arguments: &ResistanceArguments) -> Result<(Scene, Option<String>), CliError> {
    let ResistanceArguments { scene, overrides, .. } = arguments;
    let open = |scene: &str| input::open(&SceneArguments { scene: scene.to_owned(), overrides: overrides.clone() });
    match scene.rsplit_once(':').filter(|_| !Path::new(scene).is_file()) {
        Some((before, body)) => Ok((open(before)?, Some(body.to_owned()))),
        None => Ok((open(scene)?, None)),
    }
}

fn in_words(found: &Resistances) -> String {
    let fluid = match found.has_fluid {
        true => format!("viscosity {} Pa s", significant(found.viscosity, 6)),
        false => "the scene has no fluid: for a viscosity of 1 Pa s".to_owned(),
    };
    let mut text = String::new();
    for body in &found.bodies {
        match &body.response {
            FluidResponse::Steady(matrix) => {
                // Writing to a string does not fail.
                let _ = writeln!(text, "body {}, {}, {fluid}", body.name, method(matrix));
                write_matrix(&mut text, matrix);
            }
            FluidResponse::Vibrating(frequency, vibration) => {
                let hertz = significant(*frequency, 6);
                let _ = writeln!(
                    text,
                    "body {}, a sphere, small vibrations of {hertz} Hz: load = −Z × velocity",
                    body.name
                );
                write_vibration(&mut text, TAU * frequency, vibration);
            }
        }
    }
    text
}

fn method(found: &ResistanceMatrix) -> String {
    found.elements.map_or("in closed form".to_owned(), |(triangles, error)| {
        format!("by boundary elements, {triangles} triangles, estimated error {:.1} % of the power", 100.0 * error)
    })
}

fn write_matrix(text: &mut String, found: &ResistanceMatrix) {
    let _ = writeln!(text, "(f; N) = −H (v − u∞; L − L∞), about the centre of mass, axes of space\n");
    let _ = writeln!(text, "force [N s/m]");
    write_block(text, found, 0..3, 0..3);
    let _ = writeln!(text, "force by velocity gradient [N s]");
    write_block(text, found, 0..3, 3..12);
    let _ = writeln!(text, "affine moment [N m s]");
    write_block(text, found, 3..12, 3..12);
}

/// Three rows or columns of a vector, or nine of a tensor, by name.
fn names(range: &Range<usize>, vector: &str, tensor: &str) -> Vec<String> {
    match range.len() {
        3 => AXES.map(|axis| format!("{vector}_{axis}")).to_vec(),
        _ => AXES.iter().flat_map(|a| AXES.map(|b| format!("{tensor}_{a}{b}"))).collect(),
    }
}

fn write_block(text: &mut String, found: &ResistanceMatrix, rows: Range<usize>, columns: Range<usize>) {
    // A mixed block is compared with the blocks that it couples.
    let own = |part: &Range<usize>| found.matrix.view((part.start, part.start), (part.len(), part.len())).amax();
    let scale = (own(&rows) * own(&columns)).sqrt();
    let heads: String = names(&columns, "v", "L").iter().map(|name| format!("{name:>12}")).collect();
    let _ = writeln!(text, "      {heads}");
    for (row, name) in rows.clone().zip(names(&rows, "f", "N")) {
        let cell = |column: usize| {
            let entry = found.matrix[(row, column)];
            let entry = if entry.abs() < ROUNDING * scale { 0.0 } else { entry };
            format!("{:>12}", significant(entry, 5))
        };
        let entries: String = columns.clone().map(cell).collect();
        let _ = writeln!(text, "{name:<6}{entries}");
    }
    let _ = writeln!(text);
}

/// The complex resistances at an angular frequency [rad/s].
fn write_vibration(text: &mut String, omega: f64, found: &Vibration) {
    let _ = writeln!(text, "\n{:<32}{:>14}{:>14}{:>16}", "", "Re Z", "Im Z", "Im Z/ω");
    let lines = [
        ("force by velocity [N s/m]", found.translation),
        ("torque by spin [N m s]", found.rotation),
        ("moment by strain rate [N m s]", found.strain),
        ("moment by expansion rate [N m s]", found.expansion),
    ];
    for (name, value) in lines {
        let inertia = if omega > 0.0 { value.im / omega } else { 0.0 };
        let [re, im, inertia] = [value.re, value.im, inertia].map(|part| significant(part, 6));
        let _ = writeln!(text, "{name:<32}{re:>14}{im:>14}{inertia:>16}");
    }
    let _ = writeln!(text);
}
