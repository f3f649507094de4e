//! Random bodies that meet: two or three, of all convex kinds, rigid and soft, that fly at each other.
//!
//! Lengths are of the order of a metre, masses of a kilogram, speeds of a metre a second.

use super::stream::Stream;
use std::fmt::Write;

/// Half the distance of two bodies at the start [m]; none of them is larger than 1 m across.
const APART: f64 = 0.6;

/// The text of the scene of this number.
pub fn scene(case: u64) -> String {
    let stream = &mut Stream::of(case);
    let rtol = 10_f64.powi(-5 - stream.index(4) as i32);
    let method = ["auto", "auto", "explicit", "implicit"][stream.index(4)];
    let mut text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1.2, sample = 0.2 }}\n\
         solver = {{ rtol = {rtol:e}, atol = {:e}, method = \"{method}\" }}\n",
        1e-2 * rtol
    );
    let has_reach = stream.chance(0.4);
    text += &contact(stream, has_reach);
    let is_soft = !has_reach && stream.chance(0.3);
    let count = if is_soft { 2 } else { 2 + stream.index(2) };
    for k in 0..count {
        text += &body(stream, k, is_soft && k == 1);
    }
    if stream.chance(0.25) {
        let points = [0, 1].map(|_| stream.direction().map(|x| 0.3 * x));
        let (stiffness, damping) = (stream.decade(-1.0, 2.0), stream.decade(-2.0, 0.0));
        let _ = writeln!(
            text,
            "[[spring]]\nbetween = [\"b1\", \"b0\"]\npoints = {points:?}\nstiffness = {stiffness}\n\
             rest_length = {}\ndamping = {damping}",
            stream.between(0.5, 2.0)
        );
    }
    text
}

/// Repulsion that turns a body back at some thousandths to hundredths of its size; now and then damping and friction.
fn contact(stream: &mut Stream, has_reach: bool) -> String {
    let (nu, gap) = (stream.between(3.0, 8.0), stream.decade(-3.0, -1.5));
    let mut text = format!(
        "[[contact]]\nbetween = [\"all\", \"all\"]\nmeasure = \"reference_area\"\n\
         repulsion = {{ alpha = 10, nu = {nu}, d0 = {gap} }}\n"
    );
    for (law, probability) in [("damping", 0.5), ("friction", 0.4)] {
        if stream.chance(probability) {
            let beta = stream.decade(-1.0, 1.0);
            let _ = writeln!(text, "{law} = {{ beta = {beta}, nu = {}, d0 = {gap} }}", stream.between(2.2, 8.0));
        }
    }
    if has_reach {
        let _ = writeln!(text, "reach = {}", 20.0 * gap);
    }
    text
}

/// Bodies about the corners of a triangle, each towards the middle and a little beside it.
fn body(stream: &mut Stream, k: usize, is_soft: bool) -> String {
    let angle = std::f64::consts::TAU * k as f64 / 3.0;
    let (x, y) = (2.0 / 3_f64.sqrt() * APART * angle.cos(), 2.0 / 3_f64.sqrt() * APART * angle.sin());
    let beside = stream.direction().map(|c| 0.2 * c);
    let velocity = [-1.2 * x + beside[0], -1.2 * y + beside[1], beside[2]];
    let spin = stream.direction().map(|c| 3.0 * c);
    let [z, w] = [0, 1].map(|_| stream.between(-1.0, 1.0));
    let (kind, motion) = match is_soft {
        true => (
            "affine = { material = { neo_hookean_log = { mu = 200, lambda = 300 } }, viscosity = 1 }",
            format!("gradient_rate = [[0, {z}, 0], [{w}, 0, 0], [0, 0, 0.3]]"),
        ),
        false => {
            ("rigid = {}", format!("angular_velocity = {spin:?}\norientation = {{ quaternion = [1, {z}, {w}, 0.3] }}"))
        }
    };
    format!(
        "[[body]]\nname = \"b{k}\"\ngroup = \"all\"\nshape = {{ {} }}\nmass = {}\n{kind}\n\
         position = [{x}, {y}, {}]\nvelocity = {velocity:?}\n{motion}\n",
        shape(stream, is_soft),
        stream.between(0.5, 2.0),
        0.1 * z
    )
}

/// A convex shape, or two in one; of a soft body one whose surface costs little. No point is 0.5 m from its centre.
fn shape(stream: &mut Stream, is_soft: bool) -> String {
    let mut part = || stream.between(0.15, 0.5);
    let [a, b, c] = [part(), part(), part()];
    match stream.index(if is_soft { 2 } else { 8 }) {
        0 => format!("box = {{ size = [{a}, {b}, {c}] }}"),
        1 => format!("ellipsoid = {{ semi_axes = [{}, {}, {c}] }}", 0.8 * a, 0.8 * b),
        2 => format!("sphere = {{ radius = {a} }}"),
        3 => format!("cylinder = {{ radius = {}, height = {b} }}", 0.5 * a),
        4 => format!("cone = {{ radius = {}, height = {b} }}", 0.5 * a),
        5 => format!("capsule = {{ radius = {}, height = {} }}", 0.4 * a, 0.5 * b),
        6 => {
            let mut corners = [[a, a, a], [a, -a, -a], [-a, a, -a], [-a, -a, a]].concat();
            corners.iter_mut().for_each(|x| *x *= 0.5);
            corners.extend(stream.direction().map(|x| 0.4 * x));
            format!("polyhedron = {{ vertices = {:?} }}", corners.as_chunks::<3>().0)
        }
        _ => format!(
            "union = {{ parts = [{{ shape = {{ box = {{ size = [{}, {}, {}] }} }} }}, \
             {{ shape = {{ sphere = {{ radius = {} }} }}, offset = [{}, 0, 0] }}] }}",
            0.5 * a,
            0.5 * b,
            0.5 * c,
            0.4 * b,
            0.4 * a
        ),
    }
}
