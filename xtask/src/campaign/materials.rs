//! Random bodies that deform: materials, friction, contraction, in proportion to the weight of the body.

use super::draft::Draft;
use super::toml::{UNIT, deviator, diagonal_rows, list, rows, scaled_rows};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// A table `affine` or `contractile`.
#[derive(Debug)]
pub struct Flesh {
    /// Its keys.
    pub text: String,
    /// Whether det P is held.
    pub is_incompressible: bool,
}

/// What an affine body is made of; without a volume it has no material.
pub fn affine(draft: &mut Draft, has_volume: bool) -> Flesh {
    let modulus = modulus(draft);
    let mut flesh = if has_volume && !draft.stream.chance(0.05) {
        material(draft, modulus)
    } else {
        Flesh { text: String::new(), is_incompressible: false }
    };
    if has_volume {
        friction(draft, modulus, &mut flesh.text);
    }
    if !draft.isolated && draft.stream.chance(0.1) {
        let part = draft.mass * draft.pull * draft.size * draft.stream.decade(-2.0, -0.5);
        let value = rows(&scaled_rows(&draft.stream.matrix(), part));
        let _ = writeln!(flesh.text, "couple = {{ value = {value} }}");
    }
    flesh
}

/// What a contractile body is made of, and what drives it.
pub fn contractile(draft: &mut Draft) -> Flesh {
    let modulus = modulus(draft);
    let mut flesh = material(draft, modulus);
    friction(draft, modulus, &mut flesh.text);
    let frequency = draft.stream.decade(-1.0, 0.5) / draft.time();
    if draft.stream.chance(0.35) {
        // Small enough for det G to stay positive.
        let amplitude = rows(&scaled_rows(&draft.stream.matrix(), 0.2 * draft.stream.unit()));
        let phase = draft.stream.between(0.0, TAU);
        let _ = writeln!(
            flesh.text,
            "prescribed = {{ sum = [{{ constant = {{ value = {} }} }}, \
             {{ sine = {{ amplitude = {amplitude}, frequency = {frequency:?}, phase = {phase:?} }} }}] }}",
            rows(&UNIT)
        );
    } else {
        let viscosity = modulus / frequency * draft.stream.decade(-1.0, 1.0);
        let isochoric = draft.stream.chance(0.3);
        let spin = draft.stream.pick(&["full", "symmetric"]);
        let drive = signal(draft, modulus, frequency);
        let _ = writeln!(
            flesh.text,
            "contraction_viscosity = {viscosity:?}\nisochoric = {isochoric}\nspin = \"{spin}\"\ndrive = {drive}"
        );
        if draft.stream.chance(0.25) {
            let _ = writeln!(flesh.text, "feedback = {}", feedback(draft, modulus, frequency));
        }
    }
    flesh
}

/// A shear modulus at which the body sags by some thousandths to a third under its weight [Pa].
fn modulus(draft: &mut Draft) -> f64 {
    draft.density() * draft.pull * draft.size * draft.stream.decade(0.5, 2.5)
}

fn material(draft: &mut Draft, modulus: f64) -> Flesh {
    let part = draft.stream.unit();
    let bulk = if draft.stream.chance(0.5) {
        format!(", bulk = {:?}", modulus * draft.stream.decade(0.3, 2.0))
    } else {
        String::new()
    };
    let volumetric = |keys: String| (format!("{keys}{bulk}"), bulk.is_empty());
    let (name, (keys, is_incompressible)) = match draft.stream.index(8) {
        0 | 1 => {
            let (c1, c2) = (0.5 * modulus * part, 0.5 * modulus * (1.0 - part));
            ("mooney_rivlin", volumetric(format!("c1 = {c1:?}, c2 = {c2:?}")))
        }
        2 => ("neo_hookean", volumetric(format!("shear = {modulus:?}"))),
        3 => {
            let mu = list(&[modulus * part, -modulus * (1.0 - part)]);
            let alpha = list(&[draft.stream.between(1.0, 6.0), -draft.stream.between(1.0, 4.0)]);
            ("ogden", volumetric(format!("mu = {mu}, alpha = {alpha}")))
        }
        4 => ("fung", volumetric(format!("shear = {modulus:?}, exponent = {:?}", 0.1 + part))),
        5 => ("neo_hookean_log", (format!("mu = {modulus:?}, lambda = {:?}", modulus * part), false)),
        6 => ("hencky", (format!("shear = {modulus:?}, bulk = {:?}", modulus * (0.5 + part)), false)),
        _ => match draft.stream.chance(0.5) {
            true => ("st_venant_kirchhoff", (format!("lambda = {:?}, mu = {modulus:?}", modulus * part), false)),
            false => ("orthogonality", (format!("kappa = {:?}", modulus * draft.stream.decade(0.0, 2.0)), false)),
        },
    };
    Flesh { text: format!("material = {{ {name} = {{ {keys} }} }}\n"), is_incompressible }
}

/// Damping times from a hundredth of the elastic period on.
fn friction(draft: &mut Draft, modulus: f64, text: &mut String) {
    let viscosity = draft.size * (draft.density() * modulus).sqrt() * draft.stream.decade(-2.0, 0.3);
    match draft.stream.index(6) {
        0..=2 => {
            let _ = writeln!(text, "viscosity = {viscosity:?}");
        }
        3 => {
            let bulk = viscosity * draft.stream.unit();
            let _ = writeln!(text, "internal_friction = {{ shear = {viscosity:?}, bulk = {bulk:?} }}");
        }
        4 if !draft.isolated => {
            let about = draft.mass / draft.time() * draft.stream.decade(-2.0, 0.0);
            let turning = about * draft.size * draft.size;
            let matrix = diagonal_rows(&[&[about; 3][..], &[turning; 9]].concat());
            let frame = draft.stream.pick(&["space", "body"]);
            let _ = writeln!(text, "linear_friction = {{ matrix = {matrix}, frame = \"{frame}\" }}");
        }
        _ => {}
    }
}

/// A drive of some hundredths to a third of the modulus.
fn signal(draft: &mut Draft, modulus: f64, frequency: f64) -> String {
    let mut strength = || {
        let size = modulus * draft.stream.decade(-2.0, -0.5);
        scaled_rows(&draft.stream.matrix(), size)
    };
    let (first, second) = (strength(), rows(&strength()));
    let (period, phase) = (1.0 / frequency, draft.stream.between(0.0, TAU));
    let amplitude = rows(&first);
    let sine = format!("amplitude = {amplitude}, frequency = {frequency:?}, phase = {phase:?}");
    match draft.stream.index(6) {
        0 => format!("{{ constant = {{ value = {amplitude} }} }}"),
        1 => format!("{{ sine = {{ {sine} }} }}"),
        2 => format!("{{ square = {{ {sine} }} }}"),
        3 => format!("{{ ramp = {{ to = {amplitude}, duration = {period:?} }} }}"),
        4 => {
            let interpolation = draft.stream.pick(&["linear", "cubic"]);
            let mut table = String::new();
            for k in 0..12 {
                // A table lasts longer than any run.
                let _ = write!(table, "{:?}", f64::from(k) * draft.time());
                let factor = draft.stream.between(-1.0, 1.0);
                for number in first.iter().flatten() {
                    let _ = write!(table, ", {:?}", factor * number);
                }
                table.push('\n');
            }
            let file = draft.file("drive", "csv", table);
            format!("{{ table = {{ file = \"{file}\", interpolation = \"{interpolation}\" }} }}")
        }
        _ => format!(
            "{{ sum = [{{ sine = {{ {sine} }} }}, \
             {{ sine = {{ amplitude = {second}, frequency = {:?} }} }}] }}",
            2.0 * frequency
        ),
    }
}

fn feedback(draft: &mut Draft, modulus: f64, frequency: f64) -> String {
    let direction = list(&draft.stream.direction());
    let (measure, unit) = match draft.stream.index(3) {
        0 if !draft.isolated => ("\"gap\"".to_owned(), draft.size),
        1 => (format!("{{ stretch = {direction} }}"), 1.0),
        _ => (format!("{{ rate = {direction} }}"), frequency),
    };
    let gain = scaled_rows(&deviator(&draft.stream.matrix()), modulus / unit * draft.stream.decade(-2.0, -0.5));
    format!("{{ measure = {measure}, gain = {}, limits = {} }}", rows(&gain), list(&[-3.0 * unit, 3.0 * unit]))
}
