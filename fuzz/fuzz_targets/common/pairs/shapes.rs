//! Shapes of bodies that meet: convex ones, unions of them, and now and then one that must be refused.

use super::numbers::Numbers;
use serde_json::{Value, json};

/// How deep unions are nested at most.
const DEPTH: usize = 2;

/// A shape of about so large a size [m], from needles to plates.
pub fn shape(numbers: &mut Numbers, size: f64) -> Value {
    nested(numbers, size, DEPTH)
}

/// The same for a body that deforms: mostly one whose surface costs little, since its moments are sums over facets.
pub fn soft_shape(numbers: &mut Numbers, size: f64) -> Value {
    if numbers.chance(1) {
        return shape(numbers, size);
    }
    let mut length = || size * numbers.decade(-2.0, 0.0);
    json!({ "box": { "size": [length(), length(), length()] } })
}

fn nested(numbers: &mut Numbers, size: f64, depth: usize) -> Value {
    let kind = numbers.index(16);
    let mut length = || size * numbers.decade(-2.0, 0.0);
    let [a, b, c] = [length(), length(), length()];
    match kind {
        0..=2 => json!({ "box": { "size": [a, b, c] } }),
        3..=4 => json!({ "sphere": { "radius": 0.5 * a } }),
        5..=6 => json!({ "ellipsoid": { "semi_axes": [0.5 * a, 0.5 * b, 0.5 * c] } }),
        7 => json!({ "cylinder": { "radius": 0.5 * a, "height": b } }),
        8 => json!({ "cone": { "radius": 0.5 * a, "height": b } }),
        9 => json!({ "capsule": { "radius": 0.5 * a, "height": b } }),
        10..=11 => {
            let count = 4 + numbers.index(5);
            let mut vertex = || numbers.vector().map(|x| 0.5 * a * x);
            json!({ "polyhedron": { "vertices": (0..count).map(|_| vertex()).collect::<Vec<_>>() } })
        }
        12..=14 if depth > 0 => {
            let count = 1 + numbers.index(3);
            json!({ "union": { "parts": (0..count).map(|_| part(numbers, a, depth - 1)).collect::<Vec<_>>() } })
        }
        // It is not convex.
        15 => json!({ "torus": { "major_radius": 0.4 * a, "minor_radius": 0.1 * a } }),
        _ => json!({ "sphere": { "radius": 0.5 * a } }),
    }
}

fn part(numbers: &mut Numbers, size: f64, depth: usize) -> Value {
    json!({
        "shape": nested(numbers, size, depth),
        "offset": numbers.vector().map(|x| 0.5 * size * x),
        "orientation": { "quaternion": quaternion(numbers) },
    })
}

/// A turn: none at all where there are no more bytes, and often one by a right angle.
pub fn quaternion(numbers: &mut Numbers) -> [f64; 4] {
    match numbers.index(4) {
        0 => [1.0, 0.0, 0.0, 0.0],
        1 => [1.0, 0.0, 0.0, 1.0],
        _ => {
            let [x, y, z] = numbers.vector();
            [1.0, 2.0 * x, 2.0 * y, 2.0 * z]
        }
    }
}
