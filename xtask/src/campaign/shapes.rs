//! Random shapes: every kind of the scene format, with proportions up to one to ten.

use super::draft::Draft;
use super::toml::{list, scaled};
use std::fmt::Write as _;

/// The kinds of shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeKind {
    Sphere,
    Ellipsoid,
    Box,
    Cylinder,
    Cone,
    Capsule,
    Torus,
    Polyhedron,
    Mesh,
    Union,
    Points,
}

/// Those with one closed surface.
const CLOSED: [ShapeKind; 9] = [
    ShapeKind::Sphere,
    ShapeKind::Ellipsoid,
    ShapeKind::Box,
    ShapeKind::Cylinder,
    ShapeKind::Cone,
    ShapeKind::Capsule,
    ShapeKind::Torus,
    ShapeKind::Polyhedron,
    ShapeKind::Mesh,
];

/// Those with one convex surface, or closed ones made of such.
const MEETING: [ShapeKind; 9] = [
    ShapeKind::Sphere,
    ShapeKind::Ellipsoid,
    ShapeKind::Box,
    ShapeKind::Cylinder,
    ShapeKind::Cone,
    ShapeKind::Capsule,
    ShapeKind::Polyhedron,
    ShapeKind::Mesh,
    ShapeKind::Union,
];

/// A shape that meets others; of a body that deforms more often one whose moments are cheap.
pub fn meeting(draft: &mut Draft, deforms: bool) -> ShapeKind {
    one_of(draft, deforms, &MEETING)
}

/// One closed surface; of a body that deforms more often one whose moments are cheap.
pub fn closed(draft: &mut Draft, deforms: bool) -> ShapeKind {
    one_of(draft, deforms, &CLOSED)
}

fn one_of(draft: &mut Draft, deforms: bool, kinds: &[ShapeKind]) -> ShapeKind {
    let cheap = [ShapeKind::Sphere, ShapeKind::Ellipsoid, ShapeKind::Box, ShapeKind::Polyhedron];
    let is_cheap = deforms && draft.stream.chance(0.6);
    draft.stream.pick(if is_cheap { &cheap } else { kinds })
}

/// Any kind: points seldom, unions often.
pub fn any(draft: &mut Draft, deforms: bool) -> ShapeKind {
    match draft.stream.index(24) {
        0 => ShapeKind::Points,
        1..=4 => ShapeKind::Union,
        _ => closed(draft, deforms),
    }
}

/// A shape of this kind whose points lie within `radius` [m] of its origin.
pub fn shape(draft: &mut Draft, kind: ShapeKind, radius: f64) -> String {
    let mut part = |most: f64| most * draft.stream.decade(-1.0, 0.0);
    // The half-diagonal of a box, cylinder or cone of these half-sizes is below the radius.
    let half = radius / 3_f64.sqrt();
    match kind {
        ShapeKind::Sphere => format!("{{ sphere = {{ radius = {radius:?} }} }}"),
        ShapeKind::Ellipsoid => {
            format!("{{ ellipsoid = {{ semi_axes = {} }} }}", list(&[part(radius), part(radius), radius]))
        }
        ShapeKind::Box => {
            format!("{{ box = {{ size = {} }} }}", list(&[2.0 * part(half), 2.0 * part(half), 2.0 * half]))
        }
        ShapeKind::Cylinder => of_revolution("cylinder", part(half), 2.0 * part(half)),
        ShapeKind::Cone => of_revolution("cone", part(half), 2.0 * part(half)),
        ShapeKind::Capsule => of_revolution("capsule", part(0.5 * radius), part(radius)),
        ShapeKind::Torus => {
            let minor = part(0.45 * radius);
            format!("{{ torus = {{ major_radius = {:?}, minor_radius = {minor:?} }} }}", radius - minor)
        }
        ShapeKind::Polyhedron => polyhedron(draft, radius),
        ShapeKind::Mesh => mesh(draft, radius),
        ShapeKind::Union => union(draft, radius),
        ShapeKind::Points => points(draft, radius),
    }
}

fn of_revolution(name: &str, radius: f64, height: f64) -> String {
    format!("{{ {name} = {{ radius = {radius:?}, height = {height:?} }} }}")
}

/// The corners of a regular tetrahedron, so that nothing is flat.
fn tetrahedron(radius: f64) -> [[f64; 3]; 4] {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    corners.map(|corner| scaled(corner, radius / 3_f64.sqrt()))
}

fn polyhedron(draft: &mut Draft, radius: f64) -> String {
    let mut corners = tetrahedron(radius).to_vec();
    for _ in 0..draft.stream.index(12) {
        corners.push(scaled(draft.stream.direction(), radius));
    }
    format!("{{ polyhedron = {{ vertices = {corners:?} }} }}")
}

fn union(draft: &mut Draft, radius: f64) -> String {
    let count = 2 + draft.stream.index(2);
    let parts: Vec<String> = (0..count)
        .map(|_| {
            let kind = draft.stream.pick(if draft.meets { &MEETING[..8] } else { &CLOSED });
            let offset = list(&scaled(draft.stream.direction(), 0.5 * radius));
            let (turn, density) = (list(&draft.stream.turn()), draft.stream.decade(-0.5, 0.5));
            let shape = shape(draft, kind, 0.5 * radius);
            format!(
                "{{ shape = {shape}, offset = {offset}, orientation = {{ quaternion = {turn} }}, \
                 density = {density:?} }}"
            )
        })
        .collect();
    format!("{{ union = {{ parts = [{}] }} }}", parts.join(", "))
}

fn points(draft: &mut Draft, radius: f64) -> String {
    let mass = draft.mass;
    let points = tetrahedron(radius).map(|at| {
        let part = 0.1 + draft.stream.unit();
        format!("{{ mass = {:?}, at = {} }}", mass * part, list(&at))
    });
    format!("{{ points = [{}] }}", points.join(", "))
}

/// A cube with a spike on one side, or a dent where bodies do not meet, in a file of its own.
fn mesh(draft: &mut Draft, radius: f64) -> String {
    let half = 1.0 / 3_f64.sqrt();
    let apex = half * draft.stream.between(if draft.meets { 1.05 } else { -0.5 }, 1.5);
    let mut text = String::new();
    for k in 0..8 {
        let sign = |bit: usize| if k >> bit & 1 == 1 { half } else { -half };
        let _ = writeln!(text, "v {} {} {}", sign(0), sign(1), sign(2));
    }
    let _ = writeln!(text, "v 0 0 {apex}");
    text.push_str("f 1 3 4 2\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\nf 5 6 9\nf 6 8 9\nf 8 7 9\nf 7 5 9\n");
    let name = draft.file("mesh", "obj", text);
    format!("{{ mesh = {{ file = \"{name}\", scale = {radius:?} }} }}")
}
