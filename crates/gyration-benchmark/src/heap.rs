//! Dice of 2 cm poured into a bin of five planes, 8 cm wide, four to a layer, each turned and spinning in its own way.

use crate::random::Random;
use gyration_scene::Scene;
use std::fmt::Write as _;
use std::path::Path;

/// The laws of dice and walls.
const LAWS: &str = r#"repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
damping = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
friction = { beta = 3e4, nu = 3, d0 = "0.6 mm" }
"#;
/// Floor and walls: a point \[m\], and the normal into the bin.
const PLANES: [(&str, [f64; 3], [i8; 3]); 5] = [
    ("floor", [0.0, 0.0, 0.0], [0, 0, 1]),
    ("left", [-0.04, 0.0, 0.0], [1, 0, 0]),
    ("right", [0.04, 0.0, 0.0], [-1, 0, 0]),
    ("front", [0.0, -0.04, 0.0], [0, 1, 0]),
    ("back", [0.0, 0.04, 0.0], [0, -1, 0]),
];
/// Half the distance of neighbours in a layer, and the distance of layers \[m\]: whatever their attitude, dice are
/// clear of one another and of the walls.
const APART: (f64, f64) = (0.0205, 0.041);
/// The key of the heap, before which balls of a gas have theirs.
const SEED: u64 = 1 << 34;

/// The scene of so many dice, up to a time \[s\].
///
/// # Panics
/// If the scene is not valid: a mistake in this file.
pub fn scene(count: usize, end: f64) -> Scene {
    let read = Scene::parse("heap.toml", &text(count, end), Path::new(""), &[]);
    read.unwrap_or_else(|errors| panic!("{errors}"))
}

fn text(count: usize, end: f64) -> String {
    let mut text = format!("time = {{ end = {end:?}, sample = 0.01 }}\nsolver = {{ rtol = 1e-4, atol = 1e-6 }}\n");
    for (name, origin, normal) in PLANES {
        // Writing to a string does not fail.
        let _ = write!(
            text,
            "[[support]]\nname = \"{name}\"\nplane = {{ origin = {origin:?}, normal = {normal:?} }}\n\
             [[contact]]\nsupport = \"{name}\"\n{LAWS}"
        );
    }
    let _ = write!(text, "[[contact]]\nbetween = [\"dice\", \"dice\"]\nreach = \"5 mm\"\n{LAWS}");
    for die in 0..count {
        let mut random = Random::new(SEED + die as u64);
        let (layer, place) = (die / 4, die % 4);
        let side = |odd: usize| if odd == 0 { -APART.0 } else { APART.0 };
        let position = [side(place % 2), side(place / 2), 0.03 + APART.1 * layer as f64];
        let attitude: [f64; 4] = std::array::from_fn(|_| random.normal());
        let spin: [f64; 3] = std::array::from_fn(|_| 10.0 * random.normal());
        let _ = write!(
            text,
            r#"
[[body]]
name = "die-{die}"
group = "dice"
shape = {{ box = {{ size = ["2 cm", "2 cm", "2 cm"] }} }}
density = 1250
position = {position:?}
orientation = {{ quaternion = {attitude:?} }}
velocity = [0, 0, -0.5]
angular_velocity = {spin:?}
"#
        );
    }
    text
}
