//! Scenes on a table, and derivatives by differences of runs.

use gyration_scene::Scene;
use gyration_sim::complete;
use gyration_sim::sensitivity::{At, Sensitivities};
use std::path::Path;

pub fn scene(text: &str, overrides: &[String]) -> Scene {
    Scene::parse("scene.toml", text, Path::new("scenes"), overrides).and_then(complete).unwrap()
}

/// A table with the laws of its surface: repulsion, damping and friction, by their strength and exponent.
pub fn table(d0: &str, [repulsion, damping, friction]: [&str; 3]) -> String {
    format!(
        r#"
    [[support]]
    name = "table"
    plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
    [[contact]]
    support = "table"
    repulsion = {{ {repulsion}, d0 = {d0} }}
    damping = {{ {damping}, d0 = {d0} }}
    friction = {{ {friction}, d0 = {d0} }}
"#
    )
}

pub fn strings(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

pub fn at_end(scene: &Scene, keys: &[&str], quantities: &[&str]) -> Sensitivities {
    Sensitivities::along(scene, &strings(keys), &strings(quantities), At::End).unwrap()
}

/// Values of quantities at the end of a run.
pub fn values(text: &str, overrides: &[String], quantities: &[&str]) -> Vec<f64> {
    at_end(&scene(text, overrides), &[], quantities).values.pop().unwrap()
}

/// Differences of fourth order between runs, each quantity by one number; h relative to it, absolute where it is zero.
pub fn by_differences(text: &str, overrides: &[String], key: &str, quantities: &[&str], h: f64) -> Vec<f64> {
    let number = at_end(&scene(text, overrides), &[key], quantities).numbers[0];
    let step = if number == 0.0 { 0.1 * h } else { h * number };
    let set = |k: f64| {
        let all = [overrides, &[format!("{key}={:?}", number + k * step)]].concat();
        values(text, &all, quantities)
    };
    let points = [-2.0, -1.0, 1.0, 2.0].map(set);
    let at = |i: usize| (8.0 * (points[2][i] - points[1][i]) - (points[3][i] - points[0][i])) / (12.0 * step);
    (0..quantities.len()).map(at).collect()
}

/// The largest disagreement with differences of runs, relative to the larger of the derivative and a hundredth of the
/// value per number.
pub fn disagreement(text: &str, overrides: &[String], keys: &[&str], quantities: &[&str], h: f64) -> f64 {
    let found = at_end(&scene(text, overrides), keys, quantities);
    let mut worst: f64 = 0.0;
    for ((key, number), derivatives) in keys.iter().zip(&found.numbers).zip(&found.derivatives) {
        let derivatives = derivatives.at_end().unwrap();
        let expected = by_differences(text, overrides, key, quantities, h);
        for (((quantity, value), derivative), expected) in
            quantities.iter().zip(&found.values[0]).zip(derivatives).zip(expected)
        {
            // A quantity is known to some digits of itself, and so are its differences.
            let apart = (derivative - expected).abs() / expected.abs().max(1e-2 * (value / number).abs());
            println!("d {quantity} / d {key} = {derivative:.12e}, by runs {expected:.12e}: {apart:.1e}");
            worst = worst.max(apart);
        }
    }
    println!("growth {:.2e}, worst {worst:.1e}", found.growth);
    worst
}

pub const TIGHT: [&str; 2] = ["solver.rtol=1e-11", "solver.atol=1e-13"];

/// Tells a value beside what it should be, to a relative error.
pub fn close(what: &str, value: f64, expected: f64, tolerance: f64) {
    let off = (value - expected).abs() / expected.abs();
    println!("{what}: {value:.12e}, {expected:.12e}: {off:.1e}");
    assert!(off < tolerance, "{what}: {value:e} instead of {expected:e}, off by {off:e}");
}
