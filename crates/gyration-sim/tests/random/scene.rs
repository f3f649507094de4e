//! A random scene: supports, bodies above them, springs, pins, tolerances; sizes and masses of seven decades and more.
//!
//! Times are drawn in units of √(size/g), lengths in sizes, speeds in √(g·size): so a scene is physically sensible at
//! any size. What it says is a scene file in JSON.

use super::laws::{Scales, contact};
use super::shapes::{quaternion, shape};
use super::stream::Stream;
use serde_json::{Map, Value, json};
use std::path::Path;

type Vector = [f64; 3];

/// The text of the scene of this number; meshes are written into `folder`.
pub fn scene(case: u64, folder: &Path) -> String {
    let stream = &mut Stream::of(case);
    let size = stream.decade(-4.0, 3.0);
    let gravity = if stream.chance(0.1) { 0.0 } else { 9.81 };
    let pull = if gravity > 0.0 { gravity } else { size * stream.decade(-1.0, 1.0) };
    let (speed, time) = ((pull * size).sqrt(), (size / pull).sqrt());
    let supports = supports(stream, size, speed, time);
    let bodies = 1 + usize::from(stream.chance(0.15));
    let mut contacts = Vec::new();
    let mut list = Vec::new();
    for index in 0..bodies {
        let mass = stream.decade(-6.0, 6.0);
        let scales = Scales { size, speed, weight: mass * pull, rest_gap: size * stream.decade(-3.0, -1.0) };
        let name = format!("b{index}");
        list.push(body(stream, &name, mass, &scales, &supports, folder));
        for support in &supports {
            let mut law = contact(stream, &support.name, &scales);
            law["body"] = json!(name);
            contacts.push(law);
        }
    }
    // Points have no surface and take no contact.
    let touches =
        |law: &Value| list.iter().any(|body| body["name"] == law["body"] && body["shape"].get("points").is_none());
    contacts.retain(touches);
    let rtol = 10_f64.powi(-4 - 2 * stream.index(4) as i32);
    let end = time * stream.between(2.0, 8.0);
    let mut clock = json!({ "end": end, "sample": end / 100.0 });
    if stream.chance(0.5) {
        clock["stop_at_rest"] = json!({ "speed": 1e-4 * speed, "hold": 0.2 * time });
    }
    let method = ["auto", "auto", "auto", "explicit", "implicit"][stream.index(5)];
    json!({
        "title": format!("case {case}"),
        "world": { "gravity": [0, 0, -gravity] },
        "time": clock,
        "solver": { "rtol": rtol, "atol": 1e-2 * rtol, "method": method },
        "support": supports.iter().map(Support::written).collect::<Value>(),
        "contact": contacts,
        "body": list,
        "spring": springs(stream, bodies, size, pull),
    })
    .to_string()
}

/// A spring between the first two bodies, if there are as many; drawn last, so that all else is what it was.
fn springs(stream: &mut Stream, bodies: usize, size: f64, pull: f64) -> Vec<Value> {
    if bodies < 2 || stream.chance(0.4) {
        return Vec::new();
    }
    let (mass, pull) = (stream.decade(-6.0, 6.0), pull / size * stream.decade(-1.0, 2.0));
    let points = [0, 1].map(|_| scaled(stream.direction(), 0.5 * size));
    let mut spring = json!({
        "between": ["b1", "b0"],
        "points": points,
        "stiffness": mass * pull,
    });
    if stream.chance(0.5) {
        spring["rest_length"] = json!(2.0 * size * stream.unit());
        spring["damping"] = json!(mass * pull.sqrt() * stream.decade(-2.0, 0.0));
    }
    vec![spring]
}

struct Support {
    name: String,
    normal: Vector,
    motion: Option<Value>,
    /// How far it comes forward along its normal [m].
    reach: f64,
}

impl Support {
    fn written(&self) -> Value {
        let mut table = Map::from_iter([
            ("name".to_owned(), json!(self.name)),
            ("plane".to_owned(), json!({ "normal": self.normal })),
        ]);
        if let Some(motion) = &self.motion {
            table.insert("motion".into(), motion.clone());
        }
        Value::Object(table)
    }
}

/// One plane at any slope up to 60°, a V-groove, or a corner, all through the origin; some move.
fn supports(stream: &mut Stream, size: f64, speed: f64, time: f64) -> Vec<Support> {
    let (sin, cos) = stream.between(0.0, std::f64::consts::TAU).sin_cos();
    let tilted = |slope: f64| [slope.sin() * cos, slope.sin() * sin, slope.cos()];
    let normals = match stream.index(4) {
        0 => vec![[0.0, 0.0, 1.0]],
        1 => vec![tilted(stream.between(0.0, 1.05))],
        2 => {
            let slope = stream.between(0.3, 1.2);
            vec![tilted(slope), tilted(-slope)]
        }
        _ => vec![[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [0.0, -1.0, 1.0]],
    };
    let support = |(index, normal)| {
        let (mut motion, mut reach) = (None, 0.0);
        if stream.chance(0.15) {
            reach = size * stream.decade(-3.0, -0.5);
            // Accelerations from a tenth of gravity to ten times.
            let pull = size / (time * time);
            let frequency = (pull * stream.decade(-1.0, 1.0) / reach).sqrt() / std::f64::consts::TAU;
            let (direction, phase) = (stream.direction(), stream.between(0.0, 6.0));
            let oscillation =
                json!({ "direction": direction, "amplitude": reach, "frequency": frequency, "phase": phase });
            motion = Some(json!({ "oscillate": oscillation }));
        } else if stream.chance(0.1) {
            motion = Some(json!({ "velocity": stream.direction().map(|x| 0.3 * speed * x) }));
        }
        Support { name: format!("s{index}"), normal, motion, reach }
    };
    normals.into_iter().enumerate().map(support).collect()
}

fn body(stream: &mut Stream, name: &str, mass: f64, scales: &Scales, supports: &[Support], folder: &Path) -> Value {
    let Scales { size, speed, weight, rest_gap } = *scales;
    let is_points = stream.chance(0.03);
    let shape = if is_points { points(stream, mass, size) } else { shape(stream, size, folder) };
    // High enough for the ball around the body, wherever its centre of mass lies, to be clear of every support.
    let clear = 2.0 * size + rest_gap * stream.decade(0.0, 2.0) + supports.iter().map(|s| s.reach).fold(0.0, f64::max);
    let steepest = supports.iter().map(|s| s.normal[2] / norm(&s.normal)).fold(1.0, f64::min);
    let height = clear / steepest;
    let position = [0.0, 0.0, height];
    let mut body = json!({
        "name": name,
        "shape": shape,
        "position": position,
        "orientation": { "quaternion": quaternion(stream) },
        "angular_velocity": scaled(stream.direction(), speed / size * stream.decade(-2.0, 0.5)),
    });
    if !is_points {
        body["mass"] = json!(mass);
    }
    if stream.chance(0.1) {
        body["pin"] = json!(scaled(stream.direction(), size * stream.unit()));
    } else {
        let mut velocity = scaled(stream.direction(), speed * stream.decade(-1.0, 0.5));
        // Towards the supports, or without gravity it may never come there.
        velocity[2] = -velocity[2].abs();
        body["velocity"] = json!(velocity);
    }
    if stream.chance(0.15) {
        let stiffness = weight / size * stream.decade(-1.0, 2.0);
        let mut spring = json!({
            "point": scaled(stream.direction(), 0.5 * size),
            "anchor": [0.0, 0.0, height + 3.0 * size],
            "stiffness": stiffness,
        });
        if stream.chance(0.5) {
            spring["rest_length"] = json!(2.0 * size * stream.unit());
            spring["damping"] = json!((stiffness * mass).sqrt() * stream.decade(-2.0, 0.0));
        }
        body["spring"] = json!([spring]);
    }
    body
}

/// Four points that do not lie in a plane, and as many as may be.
fn points(stream: &mut Stream, mass: f64, size: f64) -> Value {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let points =
        corners.map(|at: Vector| json!({ "mass": mass * (0.1 + stream.unit()), "at": scaled(at, 0.5 * size) }));
    json!({ "points": points })
}

fn scaled(vector: Vector, factor: f64) -> Vector {
    vector.map(|x| x * factor)
}

fn norm(vector: &Vector) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}
