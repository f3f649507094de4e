//! Bands as `band.yaml` of phonopy, which its plots, sumo and pymatgen read.
//!
//! What they need stands there, in their conventions: reciprocal vectors without 2π, frequencies in 1e12 Hz, those of
//! waves that grow negative, a vertex that two segments share in both. A body is an atom `X` of its mass; eigenvectors
//! are √m δp₀, whatever else moves.

use gyration::lattice::Lattice;
use gyration::tensor::Mat3;
use gyration_scene::UnitCell;
use gyration_sim::survey::BandSurvey;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// The text of the file.
pub fn band_yaml(found: &BandSurvey, cell: &UnitCell) -> String {
    let vectors = found.rest.cell.iter().map(|vector| (*vector).into()).collect();
    let lattice = Lattice::new(vectors).map_or_else(|_| Mat3::identity(), |lattice| lattice.completed());
    let reciprocal = lattice.try_inverse().unwrap_or_else(Mat3::identity).transpose();
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_head(&mut text, found, [&lattice, &reciprocal]);
    let _ = write_points(&mut text, found, cell, &lattice);
    let _ = write_rows(&mut text, found, cell, &reciprocal);
    text
}

/// A segment of the path: its rows, both ends included.
fn segments(found: &BandSurvey) -> Vec<[usize; 2]> {
    let ends = found.vertices.windows(2).filter(|pair| !found.begins.contains(&pair[1]));
    let segments: Vec<[usize; 2]> = ends.map(|pair| [pair[0], pair[1]]).collect();
    if segments.is_empty() { vec![[0, found.kappa.len().saturating_sub(1)]] } else { segments }
}

/// A number that every reader of YAML takes for a real one.
fn number(value: f64) -> String {
    let text = format!("{value:.14e}");
    match text.split_once('e') {
        Some((digits, power)) if !power.starts_with('-') => format!("{digits}e+{power}"),
        _ => text,
    }
}

fn triple(values: [f64; 3]) -> String {
    format!("[ {} ]", values.map(number).join(", "))
}

fn label(found: &BandSurvey, row: usize) -> String {
    let named = found.labels.iter().find(|(at, _)| *at == row).map(|(_, name)| name.replace('\'', ""));
    named.unwrap_or_else(|| found.kappa[row].map(|kappa| format!("{kappa}")).join(" "))
}

fn write_head(text: &mut String, found: &BandSurvey, [lattice, reciprocal]: [&Mat3; 2]) -> std::fmt::Result {
    let segments = segments(found);
    let rows = |segment: &[usize; 2]| segment[1] - segment[0] + 1;
    writeln!(
        text,
        "# lengths in m, masses in kg; frequencies in 1e12 Hz, as phonopy has them: ω/2π in Hz, times 1e-12"
    )?;
    writeln!(text, "nqpoint: {}\nnpath: {}", segments.iter().map(rows).sum::<usize>(), segments.len())?;
    writeln!(text, "segment_nqpoint:")?;
    segments.iter().try_for_each(|segment| writeln!(text, "- {}", rows(segment)))?;
    writeln!(text, "labels:")?;
    for [from, to] in &segments {
        writeln!(text, "- [ '{}', '{}' ]", label(found, *from), label(found, *to))?;
    }
    writeln!(text, "reciprocal_lattice:")?;
    (0..3).try_for_each(|a| writeln!(text, "- {}", triple(reciprocal.column(a).into_owned().into())))?;
    writeln!(text, "natom: {}", found.rest.bodies.0.len())?;
    writeln!(text, "lattice:")?;
    (0..3).try_for_each(|a| writeln!(text, "- {}", triple(lattice.column(a).into_owned().into())))
}

fn write_points(text: &mut String, found: &BandSurvey, cell: &UnitCell, lattice: &Mat3) -> std::fmt::Result {
    writeln!(text, "points:")?;
    let inverse = lattice.try_inverse().unwrap_or_else(Mat3::identity);
    for ((name, rest), body) in found.rest.bodies.0.iter().zip(&cell.model.bodies) {
        let parts = inverse * gyration::tensor::Vec3::from(rest.position);
        writeln!(text, "- symbol: X # {name}\n  coordinates: {}", triple(parts.into()))?;
        writeln!(text, "  mass: {}", number(body.solid.mass.mass))?;
    }
    Ok(())
}

fn write_rows(text: &mut String, found: &BandSurvey, cell: &UnitCell, reciprocal: &Mat3) -> std::fmt::Result {
    writeln!(text, "phonon:")?;
    let mut distance = 0.0;
    for [from, to] in segments(found) {
        for row in from..=to {
            if row > from {
                let place = |row: usize| reciprocal * gyration::tensor::Vec3::from(found.kappa[row]);
                distance += (place(row) - place(row - 1)).norm();
            }
            writeln!(text, "- q-position: {}\n  distance: {}", triple(found.kappa[row]), number(distance))?;
            if row == from || row == to {
                writeln!(text, "  label: '{}'", label(found, row))?;
            }
            writeln!(text, "  band:")?;
            for branch in 0..found.omega[row].len() {
                let rate = match (found.omega[row][branch], found.decay[row][branch]) {
                    (0.0, growth) if growth < 0.0 => growth,
                    (omega, _) => omega,
                };
                writeln!(text, "  - # {}\n    frequency: {}", branch + 1, number(1e-12 * rate / TAU))?;
                let Some(shapes) = &found.shapes else { continue };
                writeln!(text, "    eigenvector:")?;
                for ((name, shape), body) in shapes[row][branch].0.iter().zip(&cell.model.bodies) {
                    writeln!(text, "    - # {name}")?;
                    let root = body.solid.mass.mass.sqrt();
                    for [re, im] in shape.translation {
                        writeln!(text, "      - [ {}, {} ]", number(root * re), number(root * im))?;
                    }
                }
            }
        }
    }
    Ok(())
}
