//! Random meetings: where bodies stand so as to meet, their groups, the contacts and springs between them.

use super::bodies::{Joinable, Place};
use super::contacts::laws;
use super::draft::Draft;
use super::toml::{list, scaled, solved};
use std::fmt::Write as _;

/// Sizes between the centres of two bodies: what is drawn reaches hardly farther than a size from its centre.
const APART: f64 = 2.6;

/// Places for so many bodies that meet: corners of a lattice about the middle, which each flies to.
pub fn places(draft: &Draft, count: usize, height: f64) -> Vec<Place> {
    let apart = APART * draft.size;
    let corner = |k: usize| [(k % 2) as f64, (k / 2 % 2) as f64, (k / 4) as f64];
    let at = |k| {
        let [x, y, z] = scaled(corner(k), apart);
        [x, y, height + z]
    };
    let sum = |axis: usize| (0..count).map(|k| at(k)[axis]).sum::<f64>();
    let towards = [0, 1, 2].map(|axis| sum(axis) / count as f64);
    // All are in one group, every other one in another as well.
    let groups = ["group = [\"all\", \"some\"]\n", "group = \"all\"\n"];
    (0..count).map(|k| Place { at: at(k), towards, groups: groups[k % 2], rests: false }).collect()
}

/// The contacts between so many bodies, and the springs.
pub fn meetings(draft: &mut Draft, count: usize, rest_gap: f64) -> Vec<String> {
    let mut tables = vec![between(draft, "\"all\", \"all\"", rest_gap)];
    if draft.stream.chance(0.3) {
        let names = draft.stream.pick(&["\"some\", \"all\"", "\"b0\", \"all\"", "\"b1\", \"b0\""]);
        tables.push(between(draft, names, rest_gap));
    }
    while draft.stream.chance(0.25) {
        let other = 1 + draft.stream.index(count - 1);
        tables.push(spring(draft, other));
    }
    tables
}

fn between(draft: &mut Draft, names: &str, rest_gap: f64) -> String {
    let measure = draft.stream.pick(&["deformed_area", "reference_area"]);
    let mut text = format!("[[contact]]\nbetween = [{names}]\nmeasure = \"{measure}\"\n");
    if draft.stream.chance(0.4) {
        let _ = writeln!(text, "reach = {:?}", rest_gap * draft.stream.decade(0.7, 1.7));
    }
    laws(draft, &mut text, rest_gap, true);
    text + "\n"
}

/// A spring between the first body and another one.
fn spring(draft: &mut Draft, other: usize) -> String {
    let stiffness = draft.mass * draft.pull / draft.size * draft.stream.decade(-1.0, 2.0);
    let points = [0, 1].map(|_| list(&scaled(draft.stream.direction(), 0.5 * draft.size)));
    let mut text = format!(
        "[[spring]]\nbetween = [\"b{other}\", \"b0\"]\npoints = [{}, {}]\nstiffness = {stiffness:?}\n",
        points[0], points[1]
    );
    if draft.stream.chance(0.6) {
        let damping = (stiffness * draft.mass).sqrt() * draft.stream.decade(-2.0, 0.0);
        let rest = APART * draft.size * draft.stream.unit();
        let _ = writeln!(text, "rest_length = {rest:?}\ndamping = {damping:?}");
    }
    text + "\n"
}

/// A joint between the first two bodies, about the middle between their centres.
pub fn joint(draft: &mut Draft, bodies: [Joinable; 2], places: [Place; 2]) -> String {
    let all = ["ball", "hinge", "distance", "slider", "weld"];
    // A body that deforms has no slider and no weld.
    let count = if bodies.iter().any(|body| body.deforms) { 3 } else { 5 };
    let kind = draft.stream.pick(&all[..count]);
    let beside = scaled(draft.stream.direction(), 0.5 * draft.size);
    let middle = [0, 1, 2].map(|axis| 0.5 * (places[0].at[axis] + places[1].at[axis]) + beside[axis]);
    let points = [0, 1].map(|end| {
        let arm = [0, 1, 2].map(|axis| middle[axis] - places[end].at[axis]);
        solved(&bodies[end].placement, arm)
    });
    // The distance is to the centre of the second.
    let second = if kind == "distance" { [0.0; 3] } else { points[1] };
    let mut text = format!(
        "[[joint]]\nname = \"joint\"\nbetween = [\"b0\", \"b1\"]\nkind = \"{kind}\"\npoints = [{}, {}]\n",
        list(&points[0]),
        list(&second)
    );
    if matches!(kind, "hinge" | "slider") {
        let _ = writeln!(text, "axis = {}", list(&draft.stream.direction()));
    }
    text + "\n"
}
