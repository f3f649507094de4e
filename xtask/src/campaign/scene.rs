//! A random scene: a pure function of a seed and a number.

use super::bodies::body;
use super::contacts::{contact, supports};
use super::draft::Draft;
use super::meeting::Meeting;
use super::stream::Stream;
use super::toml::{deviator, list, rows, scaled, scaled_rows};
use std::f64::consts::PI;
use std::fmt::Write as _;

/// The samples of a run.
const SAMPLES: f64 = 60.0;

/// Half of the scenes are of bodies that meet: which, is drawn from a stream of this seed beside that of the campaign.
const MEETINGS: u64 = 0x6d65_6574;

/// A scene and the files that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct RandomScene {
    /// The text of the scene.
    pub text: String,
    /// Files beside it: name and text.
    pub files: Vec<(String, String)>,
    /// `time.end` [s].
    pub end: f64,
    /// `solver.rtol`.
    pub rtol: f64,
    /// Radius of the bodies [m].
    pub size: f64,
    /// Bodies that meet, if they do.
    pub meeting: Option<Meeting>,
}

impl RandomScene {
    /// The scene of this number.
    pub fn of(seed: u64, case: u64) -> Self {
        let draft = &mut Draft::of(seed, case);
        let title = format!("title = \"campaign {seed}, scene {case}\"\n\n");
        match Stream::of(seed ^ MEETINGS, case).chance(0.5) {
            true => Self::of_meeting(draft, title),
            false => Self::of_bodies(draft, title),
        }
    }

    /// Bodies that meet, free in space or above a table.
    fn of_meeting(draft: &mut Draft, mut head: String) -> Self {
        let Clock { end, rtol } = clock(draft, &mut head, [1.0, 4.0], [-6.0, -3.0]);
        let has_table = draft.stream.chance(0.4);
        let gravity = if has_table { -9.81 } else { 0.0 };
        let _ = writeln!(head, "[world]\ngravity = [0, 0, {gravity:?}]\n");
        if has_table {
            head.push_str("[[support]]\nname = \"s0\"\nplane = {}\n\n");
        }
        let meeting = Meeting::of(draft, head, has_table);
        let files = std::mem::take(&mut draft.files);
        Self { text: meeting.text(), files, end, rtol, size: draft.size, meeting: Some(meeting) }
    }

    /// Bodies alone with supports and a fluid.
    fn of_bodies(draft: &mut Draft, mut text: String) -> Self {
        let has_fluid = draft.stream.chance(0.3);
        let Clock { end, rtol } = clock(draft, &mut text, [2.0, 7.0], [-8.0, -3.0]);
        let weightless = draft.pull != 9.81 || has_fluid && draft.stream.chance(0.5);
        let _ = writeln!(text, "[world]\ngravity = {}\n", if weightless { "[0, 0, 0]" } else { "[0, 0, -9.81]" });
        let fluid_density = if has_fluid { fluid(draft, &mut text) } else { 0.0 };
        let supports = supports(draft);
        text.push_str(&supports.text);
        let (mut bodies, mut contacts) = (String::new(), String::new());
        for index in 0..draft.stream.pick(&[1, 1, 1, 1, 2, 3]) {
            let rest_gap = draft.size * draft.stream.decade(-3.0, -1.0);
            let name = format!("b{index}");
            let drawn = body(draft, &name, supports.height + rest_gap, has_fluid.then_some(fluid_density));
            bodies.push_str(&drawn.text);
            for support in 0..if drawn.has_surface { supports.count } else { 0 } {
                contacts.push_str(&contact(draft, support, Some(&name), rest_gap));
            }
        }
        text.push_str(&contacts);
        text.push_str(&bodies);
        Self { text, files: std::mem::take(&mut draft.files), end, rtol, size: draft.size, meeting: None }
    }
}

/// How long, how precisely.
struct Clock {
    end: f64,
    rtol: f64,
}

/// An end between so many units of time, a tolerance between powers of ten.
fn clock(draft: &mut Draft, text: &mut String, ends: [f64; 2], powers: [f64; 2]) -> Clock {
    let time = draft.time();
    let end = time * draft.stream.between(ends[0], ends[1]);
    let _ = writeln!(text, "[time]\nend = {end:?}\nsample = {:?}", end / SAMPLES);
    if draft.stream.chance(0.4) {
        let speed = 1e-3 * draft.speed();
        let _ = writeln!(text, "stop_at_rest = {{ speed = {speed:?}, hold = {:?} }}", 0.2 * time);
    }
    let rtol = draft.stream.decade(powers[0], powers[1]);
    let method = draft.stream.pick(&["auto", "auto", "auto", "explicit", "implicit"]);
    let _ = writeln!(text, "\n[solver]\nrtol = {rtol:?}\natol = {:?}\nmethod = \"{method}\"\n", 1e-2 * rtol);
    Clock { end, rtol }
}

/// A fluid that stops a body within a tenth of the unit of time to ten of them; its density [kg/m³].
fn fluid(draft: &mut Draft, text: &mut String) -> f64 {
    let viscosity = draft.mass / (6.0 * PI * draft.size * draft.time()) * draft.stream.decade(-1.0, 1.0);
    let density = if draft.stream.chance(0.3) { 0.0 } else { draft.density() * draft.stream.between(0.1, 1.5) };
    let velocity = scaled(draft.stream.direction(), 0.2 * draft.speed());
    let rate = draft.stream.decade(-1.0, 0.3) / draft.time();
    let gradient = match draft.stream.index(4) {
        0 => [[0.0; 3]; 3],
        1 => [[0.0, 0.0, rate], [0.0; 3], [0.0; 3]],
        2 => [[rate, 0.0, 0.0], [0.0, -rate, 0.0], [0.0; 3]],
        _ => scaled_rows(&deviator(&draft.stream.matrix()), rate),
    };
    let _ = writeln!(text, "[fluid]\nviscosity = {viscosity:?}\ndensity = {density:?}\nvelocity = {}", list(&velocity));
    let gradient = rows(&gradient);
    let _ = match draft.stream.chance(0.25) {
        true => writeln!(
            text,
            "velocity_gradient = {{ sine = {{ amplitude = {gradient}, frequency = {:?} }} }}\n",
            draft.stream.between(0.2, 2.0) / draft.time()
        ),
        false => writeln!(text, "velocity_gradient = {gradient}\n"),
    };
    density
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_depends_on_seed_and_number_alone() {
        assert_eq!(RandomScene::of(1, 7), RandomScene::of(1, 7));
        assert_ne!(RandomScene::of(1, 7), RandomScene::of(1, 8));
        assert_ne!(RandomScene::of(1, 7), RandomScene::of(2, 7));
    }

    #[test]
    fn every_kind_of_everything_is_drawn() {
        let all: String = (0..400).map(|case| RandomScene::of(1, case).text).collect();
        let words = [
            "rigid",
            "affine",
            "contractile",
            "sphere",
            "ellipsoid",
            "box",
            "cylinder",
            "cone",
            "capsule",
            "torus",
            "polyhedron",
            "mesh",
            "union",
            "points",
            "mooney_rivlin",
            "neo_hookean",
            "ogden",
            "fung",
            "neo_hookean_log",
            "hencky",
            "st_venant_kirchhoff",
            "orthogonality",
            "bulk",
            "repulsion",
            "damping",
            "friction",
            "adhesion",
            "reference_area",
            "deformed_area_potential",
            "oscillate",
            "motion = { velocity",
            "constant",
            "sine",
            "square",
            "ramp",
            "table",
            "sum",
            "prescribed",
            "feedback",
            "spring",
            "pin",
            "inertia = false",
            "history = true",
            "stop_at_rest",
            "explicit",
            "implicit",
            "couple",
            "linear_friction",
            "internal_friction",
            "gradient_rate",
            "density",
            "name = \"b2\"",
        ];
        for word in words {
            assert!(all.contains(word), "no scene has `{word}`");
        }
    }
}
