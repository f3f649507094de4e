//! Colours: of bodies those of Okabe and Ito, which all eyes tell apart; supports are grey.
//!
//! glTF wants linear light: c = ((s + 0.055)/1.055)^2.4 of a component s of sRGB above 0.04045, s/12.92 below.

use serde_json::{Value, json};

const BODIES: [[u8; 3]; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [240, 228, 66]];
const SHEET: [u8; 3] = [225, 228, 232];
const GRID: [u8; 3] = [150, 156, 164];

/// The materials of a body and of its wireframe, which is half as bright.
pub(super) fn body(index: usize, name: &str) -> [Value; 2] {
    let color = BODIES[index % BODIES.len()];
    [material(name, color, 0.6), material(&format!("{name}, lines"), color.map(|component| component / 2), 1.0)]
}

/// The material of a support.
pub(super) fn sheet() -> Value {
    material("sheet", SHEET, 0.9)
}

/// The material of its grid.
pub(super) fn grid() -> Value {
    material("grid", GRID, 1.0)
}

fn material(name: &str, color: [u8; 3], roughness: f64) -> Value {
    let [red, green, blue] = color.map(linear);
    json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness,
        },
    })
}

fn linear(component: u8) -> f64 {
    let s = f64::from(component) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { libm::pow((s + 0.055) / 1.055, 2.4) }
}
