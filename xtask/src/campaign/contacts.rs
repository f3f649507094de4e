//! Random supports and contact laws in proportion to the bodies.
//!
//! With weight W, area A ≈ size², rest gap δ and speed V,
//!
//!   repulsion  α A (δ/d₀)^−ν = W,      damping  β V = x α at the gap δ,      adhesion  pull-off ≈ a part of W

use super::draft::Draft;
use super::toml::{Vector, list, scaled};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Planes through the origin.
#[derive(Debug)]
pub struct Supports {
    /// Their tables.
    pub text: String,
    /// How many.
    pub count: usize,
    /// The height [m] above the origin at which a ball of 2.6 sizes and `reach` is clear of all.
    pub height: f64,
}

/// One plane at any slope up to 60°, a V-groove or a corner, some of which move; now and then none.
pub fn supports(draft: &mut Draft) -> Supports {
    let (sin, cos) = draft.stream.between(0.0, TAU).sin_cos();
    let tilted = |slope: f64| [slope.sin() * cos, slope.sin() * sin, slope.cos()];
    let normals = match draft.stream.index(10) {
        _ if draft.isolated => vec![],
        0 => vec![],
        1..=4 => vec![[0.0, 0.0, 1.0]],
        5 | 6 => vec![tilted(draft.stream.between(0.0, 1.05))],
        7 | 8 => {
            let slope = draft.stream.between(0.3, 1.2);
            vec![tilted(slope), tilted(-slope)]
        }
        _ => [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [0.0, -1.0, 1.0]].to_vec(),
    };
    let (mut text, mut reach, mut steepest) = (String::new(), 0.0_f64, 1.0_f64);
    for (index, normal) in normals.iter().enumerate() {
        let _ = writeln!(text, "[[support]]\nname = \"s{index}\"\nplane = {{ normal = {} }}", list(normal));
        if draft.stream.chance(0.2) {
            let amplitude = draft.size * draft.stream.decade(-3.0, -0.5);
            reach = reach.max(amplitude);
            let _ = writeln!(text, "motion = {{ oscillate = {} }}", oscillation(draft, amplitude));
        } else if draft.stream.chance(0.1) {
            let velocity = scaled(draft.stream.direction(), 0.3 * draft.speed());
            let _ = writeln!(text, "motion = {{ velocity = {} }}", list(&velocity));
        }
        text.push('\n');
        steepest = steepest.min(normal[2] / length(normal));
    }
    Supports { text, count: normals.len(), height: (2.6 * draft.size + reach) / steepest }
}

/// Accelerations from a tenth of gravity to ten times.
fn oscillation(draft: &mut Draft, amplitude: f64) -> String {
    let frequency = (draft.pull * draft.stream.decade(-1.0, 1.0) / amplitude).sqrt() / TAU;
    let (direction, phase) = (list(&draft.stream.direction()), draft.stream.between(0.0, 6.0));
    format!("{{ direction = {direction}, amplitude = {amplitude:?}, frequency = {frequency:?}, phase = {phase:?} }}")
}

fn length(vector: &Vector) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The contact of a body with a support; some laws are absent.
pub fn contact(draft: &mut Draft, support: usize, body: &str, rest_gap: f64) -> String {
    let measure = draft.stream.pick(&["deformed_area", "reference_area", "deformed_area_potential"]);
    let mut text = format!("[[contact]]\nsupport = \"s{support}\"\nbody = \"{body}\"\nmeasure = \"{measure}\"\n");
    let repels = draft.stream.chance(0.95);
    laws(draft, &mut text, rest_gap, repels);
    if !repels || draft.stream.chance(0.2) {
        adhesion(draft, &mut text, rest_gap);
    }
    text + "\n"
}

/// Repulsion, damping and friction of a contact; some are absent.
pub fn laws(draft: &mut Draft, text: &mut String, rest_gap: f64, repels: bool) {
    let pressure = draft.pressure();
    if repels {
        let (nu, d0) = (exponent(draft), reference(draft, rest_gap));
        let alpha = pressure * (rest_gap / d0).powf(nu);
        let _ = writeln!(text, "repulsion = {{ alpha = {alpha:?}, nu = {nu:?}, d0 = {d0:?} }}");
    }
    for (name, probability) in [("damping", 0.6), ("friction", 0.5)] {
        if draft.stream.chance(probability) {
            let (nu, d0) = (exponent(draft), reference(draft, rest_gap));
            // From hardly any loss to a body that sticks in the field.
            let number = draft.stream.decade(-2.0, 1.0);
            let beta = number * pressure / draft.speed() * (rest_gap / d0).powf(nu);
            // Both need a repulsion.
            let beyond = match name {
                "friction" if repels && draft.stream.chance(0.5) => {
                    format!(", mu = {:?}", draft.stream.between(0.05, 1.0))
                }
                "damping" if repels && draft.stream.chance(0.2) => ", one_sided = true".to_owned(),
                _ => String::new(),
            };
            let _ = writeln!(text, "{name} = {{ beta = {beta:?}, nu = {nu:?}, d0 = {d0:?}{beyond} }}");
        }
    }
}

fn adhesion(draft: &mut Draft, text: &mut String, rest_gap: f64) {
    let attractive = draft.stream.between(1.5, 8.0);
    let repulsive = attractive + draft.stream.between(0.5, 4.0);
    let beta = draft.pressure() * draft.stream.decade(-2.0, 1.0);
    let d0 = rest_gap * draft.stream.decade(-0.5, 0.5);
    let _ = writeln!(
        text,
        "adhesion = {{ beta = {beta:?}, nu_attractive = {attractive:?}, nu_repulsive = {repulsive:?}, d0 = {d0:?} }}"
    );
}

/// An exponent from 2.5 to 12, whole every other time.
fn exponent(draft: &mut Draft) -> f64 {
    if draft.stream.chance(0.5) { 3.0 + draft.stream.index(10) as f64 } else { draft.stream.between(2.5, 12.0) }
}

/// The reference gap: a metre, or one near the gaps in the scene.
fn reference(draft: &mut Draft, rest_gap: f64) -> f64 {
    if draft.stream.chance(0.3) { 1.0 } else { rest_gap * draft.stream.decade(-1.0, 1.0) }
}
