//! A gas: balls of radius 1 m that fly about at 1 m/s between six planes, a tenth of the volume filled.
//!
//! Two that meet head-on turn back at a gap of 2 mm, U(d₀) = ½ m_r (2v)²; nothing is lost:
//!
//!   α = m v² (ν − 1)(ν − 2)/(4π d₀²)

use crate::random::Random;
use gyration_scene::Scene;
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

/// d₀ \[m\].
const GAP: f64 = 2e-3;
/// The part of the volume that is filled.
const FILLED: f64 = 0.1;
/// The key of the gas, before which dice have theirs.
const SEED: u64 = 1 << 33;

/// The scene of so many balls, up to a time \[s\].
///
/// # Panics
/// If the scene is not valid: a mistake in this file.
pub fn scene(count: usize, end: f64) -> Scene {
    let read = Scene::parse("gas.toml", &text(count, end), Path::new(""), &[]);
    read.unwrap_or_else(|errors| panic!("{errors}"))
}

fn text(count: usize, end: f64) -> String {
    let mass = 4.0 / 3.0 * PI;
    let side = libm::cbrt(count as f64 * mass / FILLED);
    let alpha = mass * 20.0 / (4.0 * PI * GAP * GAP);
    let law = format!("repulsion = {{ alpha = {alpha:?}, nu = 6, d0 = {GAP:?} }}");
    let mut text = format!(
        r#"
world = {{ gravity = [0, 0, 0] }}
time = {{ end = {end:?}, sample = {end:?} }}
solver = {{ rtol = 1e-7, atol = 1e-10 }}
[[contact]]
between = ["balls", "balls"]
reach = {:?}
{law}
"#,
        25.0 * GAP
    );
    for wall in 0..6 {
        let mut normal = [0, 0, 0];
        normal[wall / 2] = if wall % 2 == 0 { 1 } else { -1 };
        let origin = [if wall % 2 == 0 { 0.0 } else { side }; 3];
        // Writing to a string does not fail.
        let _ = write!(
            text,
            r#"
[[support]]
name = "wall-{wall}"
plane = {{ origin = {origin:?}, normal = {normal:?} }}
[[contact]]
support = "wall-{wall}"
{law}
"#
        );
    }
    let cells = (1..).find(|cells: &usize| cells.pow(3) >= count).unwrap_or(1);
    for ball in 0..count {
        let mut random = Random::new(SEED + ball as u64);
        let place = [ball % cells, ball / cells % cells, ball / (cells * cells)];
        let position = place.map(|cell| side * (cell as f64 + 0.5) / cells as f64);
        let way: [f64; 3] = std::array::from_fn(|_| random.normal());
        let size = way.iter().map(|part| part * part).sum::<f64>().sqrt();
        let velocity = way.map(|part| part / size);
        let _ = write!(
            text,
            r#"
[[body]]
name = "ball-{ball}"
group = "balls"
shape = {{ sphere = {{ radius = 1 }} }}
mass = {mass:?}
position = {position:?}
velocity = {velocity:?}
"#
        );
    }
    text
}
