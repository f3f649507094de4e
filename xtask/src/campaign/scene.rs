//! A random scene: a pure function of a seed and a number.

use super::bodies::{Place, body};
use super::contacts::{contact, supports};
use super::draft::Draft;
use super::meetings::{joint, meetings, places};
use super::toml::{deviator, list, rows, scaled, scaled_rows};
use std::f64::consts::PI;
use std::fmt::Write as _;

/// The samples of a run.
const SAMPLES: f64 = 60.0;

/// A scene and the files that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct RandomScene {
    /// The text of the scene.
    pub text: String,
    /// Files beside it: name and text.
    pub files: Vec<(String, String)>,
    /// `time.end` [s].
    pub end: f64,
    /// The same scene with other names for its bodies, and bodies, contacts and springs in the reverse order; none of
    /// one body.
    pub exchanged: Option<String>,
    /// `solver.rtol`.
    pub rtol: f64,
    /// The radius of its bodies [m].
    pub size: f64,
}

/// What stands before the name of a body in the exchanged scene.
pub const EXCHANGED: &str = "x-";

impl RandomScene {
    /// The scene of this number.
    pub fn of(seed: u64, case: u64) -> Self {
        let draft = &mut Draft::of(seed, case);
        let has_fluid = !draft.isolated && draft.stream.chance(0.3);
        let mut text = format!("title = \"campaign {seed}, scene {case}\"\n\n");
        let (end, rtol) = clock(draft, &mut text);
        let weightless = draft.isolated || draft.pull != 9.81 || has_fluid && draft.stream.chance(0.5);
        let _ = writeln!(text, "[world]\ngravity = {}\n", if weightless { "[0, 0, 0]" } else { "[0, 0, -9.81]" });
        let fluid_density = if has_fluid { fluid(draft, &mut text) } else { 0.0 };
        let supports = supports(draft);
        text.push_str(&supports.text);
        let count = draft.stream.pick(if draft.meets { &[2, 2, 2, 3, 3, 4, 6] } else { &[1, 1, 1, 1, 1, 2, 3] });
        let rest_gap = draft.size * draft.stream.decade(-3.0, -1.0);
        let height = supports.height + rest_gap;
        let alone = Place { at: [0.0, 0.0, height], towards: [0.0; 3], groups: "", rests: false };
        let mut places = if draft.meets { places(draft, count, height) } else { vec![alone; count] };
        let is_joined = draft.meets && draft.stream.chance(0.25);
        places.iter_mut().take(2).for_each(|place| place.rests = is_joined);
        let (mut bodies, mut contacts, mut joinable) = (Vec::new(), Vec::new(), Vec::new());
        for (index, place) in places.iter().copied().enumerate() {
            let name = format!("b{index}");
            let drawn = body(draft, &name, place, has_fluid.then_some(fluid_density));
            joinable.push(drawn.joinable);
            bodies.push(drawn.text);
            for support in 0..if drawn.has_surface { supports.count } else { 0 } {
                contacts.push(contact(draft, support, &name, rest_gap));
            }
        }
        if draft.meets {
            contacts.extend(meetings(draft, count, rest_gap));
        }
        if let (true, [Some(one), Some(other), ..]) = (is_joined, &joinable[..]) {
            contacts.push(joint(draft, [*one, *other], [places[0], places[1]]));
        }
        let exchanged = (count > 1).then(|| {
            let reversed = contacts.iter().chain(&bodies).rev().cloned().collect::<String>();
            let renamed = (0..count).fold(reversed, |text, index| {
                text.replace(&format!("\"b{index}\""), &format!("\"{EXCHANGED}b{index}\""))
            });
            format!("{text}{renamed}")
        });
        text.extend(contacts);
        text.extend(bodies);
        let size = draft.size;
        Self { text, files: std::mem::take(&mut draft.files), end, exchanged, rtol, size }
    }
}

/// How long, how precisely; the end [s] and the tolerance.
fn clock(draft: &mut Draft, text: &mut String) -> (f64, f64) {
    let time = draft.time();
    let end = time * draft.stream.between(2.0, 7.0);
    let _ = writeln!(text, "[time]\nend = {end:?}\nsample = {:?}", end / SAMPLES);
    if draft.stream.chance(0.4) {
        let speed = 1e-3 * draft.speed();
        let _ = writeln!(text, "stop_at_rest = {{ speed = {speed:?}, hold = {:?} }}", 0.2 * time);
    }
    let rtol = draft.stream.decade(-8.0, -3.0);
    let method = draft.stream.pick(&["auto", "auto", "auto", "explicit", "implicit"]);
    let _ = writeln!(text, "\n[solver]\nrtol = {rtol:?}\natol = {:?}\nmethod = \"{method}\"\n", 1e-2 * rtol);
    (end, rtol)
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
            "mu = ",
            "one_sided = true",
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
            "name = \"b5\"",
            "between",
            "reach",
            "[[spring]]",
            "[[joint]]",
            "kind = \"ball\"",
            "kind = \"hinge\"",
            "kind = \"slider\"",
            "kind = \"weld\"",
            "kind = \"distance\"",
            "group = [",
        ];
        for word in words {
            assert!(all.contains(word), "no scene has `{word}`");
        }
    }
}
