//! Random shapes of a given radius: every kind of the format, with proportions up to one to ten.

use super::stream::Stream;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

/// The kinds of shape, points apart, by index.
const KINDS: usize = 10;

/// A shape whose points lie within `radius` [m] of its origin. Files of meshes are written into `folder`.
pub fn shape(stream: &mut Stream, radius: f64, folder: &Path) -> Value {
    let kind = stream.index(KINDS);
    of_kind(stream, kind, radius, folder)
}

fn of_kind(stream: &mut Stream, kind: usize, radius: f64, folder: &Path) -> Value {
    // Proportions of at most one to ten.
    let mut part = |most: f64| most * stream.decade(-1.0, 0.0);
    // The half-diagonal of a box, cylinder or cone of these half-sizes is below the radius.
    let half = radius / 3_f64.sqrt();
    match kind {
        0 => json!({ "box": { "size": [2.0 * part(half), 2.0 * part(half), 2.0 * half] } }),
        1 => json!({ "sphere": { "radius": radius } }),
        2 => json!({ "ellipsoid": { "semi_axes": [part(radius), part(radius), radius] } }),
        3 => json!({ "cylinder": { "radius": part(half), "height": 2.0 * part(half) } }),
        4 => json!({ "cone": { "radius": part(half), "height": 2.0 * part(half) } }),
        5 => json!({ "capsule": { "radius": part(0.5 * radius), "height": part(radius) } }),
        6 => {
            let minor = part(0.45 * radius);
            json!({ "torus": { "major_radius": radius - minor, "minor_radius": minor } })
        }
        7 => json!({ "polyhedron": { "vertices": corners(stream, radius) } }),
        8 => json!({ "mesh": { "file": mesh(stream, folder), "scale": radius } }),
        _ => {
            let mut part = || {
                let kind = stream.index(KINDS - 3);
                let offset = stream.direction().map(|x| 0.5 * radius * x);
                let turn = json!({ "quaternion": quaternion(stream) });
                let density = stream.decade(-0.5, 0.5);
                let shape = of_kind(stream, kind, 0.5 * radius, folder);
                json!({ "shape": shape, "offset": offset, "orientation": turn, "density": density })
            };
            json!({ "union": { "parts": [part(), part()] } })
        }
    }
}

/// A turn in any direction.
pub fn quaternion(stream: &mut Stream) -> [f64; 4] {
    let angle = stream.between(0.0, std::f64::consts::PI);
    let [x, y, z] = stream.direction().map(|x| x * angle.sin());
    [angle.cos(), x, y, z]
}

/// The corners of a polyhedron: of a regular tetrahedron, so that it is never flat, and some more.
fn corners(stream: &mut Stream, radius: f64) -> Vec<[f64; 3]> {
    let regular = radius / 3_f64.sqrt();
    let mut corners: Vec<[f64; 3]> = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
        .map(|corner| corner.map(|x: f64| x * regular))
        .to_vec();
    for _ in 0..stream.index(12) {
        corners.push(stream.direction().map(|x| x * radius));
    }
    corners
}

/// The name of a file with a mesh of unit radius that is not convex: a cube with a dent or a spike on one side.
fn mesh(stream: &mut Stream, folder: &Path) -> String {
    let half = 1.0 / 3_f64.sqrt();
    let apex = half * stream.between(-0.5, 1.5);
    let mut text = String::new();
    for k in 0..8 {
        let sign = |bit: usize| if k >> bit & 1 == 1 { half } else { -half };
        writeln!(text, "v {} {} {}", sign(0), sign(1), sign(2)).unwrap();
    }
    writeln!(text, "v 0 0 {apex}").unwrap();
    text.push_str("f 1 3 4 2\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\nf 5 6 9\nf 6 8 9\nf 8 7 9\nf 7 5 9\n");
    let name = format!("mesh-{}.obj", text.len() as u64 ^ apex.to_bits());
    std::fs::write(folder.join(&name), text).unwrap();
    name
}
