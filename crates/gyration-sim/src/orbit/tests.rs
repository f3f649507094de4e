//! Orbits: a point in a well with x⁴, by each choice; what is no orbit.

use super::{CellShift, NoShift, OrbitChoice, OrbitSurvey};
use gyration::state::State;
use gyration_scene::Scene;
use std::path::Path;

/// ẍ + x + x³ = 0; nothing holds it across.
const WELL: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 8, sample = 1 }
[[body]]
name = "a"
shape = { points = [{ mass = 1, at = [0, 0, 0] }] }
position = [0.9, 0, 0]
potential = "0.5*x^2 + 0.25*x^4"
"#;

/// 4 K(m = 1/4)/√2, from x = 1.
const PERIOD: f64 = 4.768022029;

fn orbit(text: &str, choice: &OrbitChoice) -> Result<OrbitSurvey, String> {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    OrbitSurvey::of(&scene, choice, None)
}

#[test]
fn an_orbit_has_its_period_whatever_chooses_it() {
    let amplitude = OrbitChoice::Amplitude("body.a.x".into(), 1.0, None);
    for choice in [amplitude, OrbitChoice::Energy(0.75, None), OrbitChoice::Period(PERIOD)] {
        let found = orbit(WELL, &choice).unwrap();
        assert!((found.period - PERIOD).abs() < 2e-9, "{choice:?}: {}", found.period);
        assert!((found.energy - 0.75).abs() < 1e-8 && found.misfit < 1e-9, "{choice:?}: {found:?}");
        assert!(found.stable, "{choice:?}: {:?}", found.multipliers);
    }
    let nearest = orbit(WELL, &OrbitChoice::Nearest).unwrap();
    assert!((nearest.start["a"].position[0] - 0.9).abs() < 1e-3, "{nearest:?}");
}

/// The same well a million times wider and narrower, beside a point whose size counts as a metre.
#[test]
fn an_orbit_has_its_period_however_far_it_goes() {
    let well = |scale: f64| {
        let text = WELL.replace("[0.9, 0, 0]", &format!("[{scale:e}, 0, 0]"));
        text.replace("0.25*x^4", &format!("0.25*x^4/{scale:e}^2"))
    };
    // Places have the digits of a metre.
    let said = orbit(&well(1e-9), &OrbitChoice::Nearest).unwrap_err();
    assert!(said.contains("no start near by comes back to itself"), "{said}");
    for scale in [1e6, 1e-3, 1e-4] {
        let well = well(scale);
        let found = orbit(&well, &OrbitChoice::Nearest).unwrap();
        assert!((found.period - PERIOD).abs() < 1e-7 && found.stable, "{scale}: {} {:?}", found.period, found);
        // Friction leaves nothing that comes back, however small the search makes it.
        let row = |k: usize| (0..12).map(|i| if i == k && k < 3 { 0.3 } else { 0.0 }).collect::<Vec<f64>>();
        let friction: Vec<_> = (0..12).map(row).collect();
        let damped = format!("{well}linear_friction = {{ matrix = {friction:?} }}\n");
        orbit(&damped, &OrbitChoice::Nearest).unwrap_err();
    }
}

/// A ball over a table that shakes, and which it meets but for a part of the time; a period that is none of its drive.
#[test]
fn a_drive_is_seen_wherever_it_is_felt() {
    let shaken = r#"
time = { end = 3, sample = 0.1 }
[[support]]
name = "table"
plane = {}
motion = { oscillate = { direction = [0, 0, 1], amplitude = 0.02, frequency = 1.5 } }
[[contact]]
support = "table"
repulsion = { alpha = "40 kPa", nu = 6, d0 = "2 mm" }
[[body]]
name = "a"
shape = { sphere = { radius = 0.05 } }
density = 1000
position = [0, 0, 0.5]
"#;
    let said = orbit(shaken, &OrbitChoice::Nearest).unwrap_err();
    assert!(said.contains("depends on time"), "{said}");
    let driven = WELL.replace("0.25*x^4", "0.25*x^4 - 0.1*x*cos(t/0.2)").replace("[0.9,", "[0,");
    orbit(&driven, &OrbitChoice::Period(0.4 * std::f64::consts::PI)).unwrap();
    let said = orbit(&driven, &OrbitChoice::Period(1.25)).unwrap_err();
    assert!(said.contains("no period of what in the scene depends on time"), "{said}");
}

#[test]
fn bodies_that_are_kept_have_the_multipliers_that_they_can_have() {
    // A rod on a hinge: an angle and its rate; a box without volume change: 2 · 11 numbers and its centre among them.
    let hinge = r#"
time = { end = 2, sample = 1 }
[[body]]
name = "a"
shape = { box = { size = [0.05, 0.05, 0.4] } }
density = 500
position = [0, 0, -0.2]
velocity = [-0.2, 0, 0]
angular_velocity = [0, 1, 0]
[[joint]]
name = "h"
between = ["space", "a"]
kind = "hinge"
points = [[0, 0, 0], [0, 0, 0.2]]
axis = [0, 1, 0]
"#;
    let found = orbit(hinge, &OrbitChoice::Nearest).unwrap();
    assert_eq!(found.multipliers.len(), 2, "{:?}", found.multipliers);
    assert!(found.stable && found.misfit < 1e-9, "{found:?}");
    // A swing to 0.27 rad takes longer than a small one, 1.037 s.
    assert!((1.037..1.06).contains(&found.period), "{}", found.period);
}

#[test]
fn what_is_no_orbit_is_told() {
    let driven = WELL.replace("0.25*x^4", "0.25*x^4 - 0.1*x*cos(t)");
    let said = orbit(&driven, &OrbitChoice::Amplitude("a.x".into(), 1.0, Some(6.0))).unwrap_err();
    assert!(said.contains("depends on time"), "{said}");
    let free = WELL.replace("potential = \"0.5*x^2 + 0.25*x^4\"", "velocity = [1, 0, 0]");
    let said = orbit(&free, &OrbitChoice::Nearest).unwrap_err();
    assert!(said.contains("does not come back"), "{said}");
    let weld = "[[joint]]\nname = \"w\"\nbetween = [\"space\", \"a\"]\nkind = \"weld\"\n";
    let held = format!("{WELL}{weld}points = [[0.9, 0, 0], [0, 0, 0]]\n")
        .replace("points = [{ mass = 1, at = [0, 0, 0] }]", "sphere = { radius = 0.1 }");
    let held = held.replace("position", "density = 1000\nposition");
    let said = orbit(&held, &OrbitChoice::Period(1.0)).unwrap_err();
    assert!(said.contains("nothing in the scene can move"), "{said}");
    let said = orbit(WELL, &OrbitChoice::Amplitude("body.b.x".into(), 1.0, None)).unwrap_err();
    assert!(said.contains("did you mean `a.x`?"), "{said}");
}

#[test]
fn cells_of_a_ring_move_on_and_those_of_no_ring_do_not() {
    let ring = r#"
world = { gravity = [0, 0, 0] }
time = { end = 2, sample = 1 }
lattice = { cell = [[0.1, 0, 0], [0, 0.1, 0]], repeat = [3, 2, 1], periodic = [true, false] }
[[body]]
name = "a"
shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
keep = { line = [1, 0, 0] }
[[body]]
name = "b"
position = [0, 0, 0.3]
shape = { sphere = { radius = 0.01 } }
density = 1000
[[spring]]
between = ["a", "a"]
cell = [1, 0, 0]
stiffness = 40
rest_length = 0.1
"#;
    let scene = Scene::parse("scene.toml", ring, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let built = scene.built();
    let state = &built.state;
    let numbered = State { bodies: (0..state.bodies.len()).map(|n| n as f64).collect(), ..state.clone() };
    let slots = |body: usize| built.model.slots(body).block();
    let back = CellShift::of(built, [1, 0, 0]).unwrap().back(&numbered);
    for (body, from) in [(0, 1), (1, 2), (2, 0), (3, 4), (5, 3), (6, 7), (11, 9)] {
        assert_eq!(back.bodies[slots(body)], numbered.bodies[slots(from)], "{body}");
    }
    let there = CellShift::of(built, [-1, 0, 0]).unwrap();
    assert_eq!((there.back(&back), CellShift::of(built, [3, 0, 0]).unwrap().back(&back)), (numbered, back.clone()));
    assert_eq!(CellShift::of(built, [0, 1, 0]), Err(NoShift::FreeEnds(2)));
    assert_eq!(CellShift::of(built, [0, 0, 1]), Err(NoShift::FreeEnds(3)));
    let well = Scene::parse("scene.toml", WELL, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let said = OrbitSurvey::of(&well, &OrbitChoice::Nearest, Some([1, 0, 0])).unwrap_err();
    assert!(said.contains("no `[lattice]`"), "{said}");
}

#[test]
fn multipliers_that_lie_evenly_on_a_circle_are_found() {
    // Cells that change places: the roots of one.
    let turned = |n: usize| nalgebra::DMatrix::from_fn(n, n, |i, j| f64::from(u8::from((i + 1) % n == j)));
    for n in [2, 3, 4, 6, 8] {
        let found = crate::eigenvalues::eigenvalues(&turned(n)).unwrap();
        let off = found.iter().map(|mu| (mu.powu(n as u32) - 1.0).norm()).fold(0.0, f64::max);
        assert!(found.len() == n && off < 1e-11, "{n}: {found:?}");
    }
    let ring = r#"
world = { gravity = [0, 0, 0] }
time = { end = 1, sample = 0.5 }
lattice = { cell = [[0.12, 0, 0]], repeat = [4, 1, 1], wave = { kappa = [0.25, 0, 0], branch = 0, amplitude = 1e-3 } }
[[body]]
name = "a"
shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
keep = { line = [1, 0, 0] }
[[spring]]
between = ["a", "a"]
cell = [1, 0, 0]
stiffness = 40
rest_length = 0.1
"#;
    let scene = Scene::parse("scene.toml", ring, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let scene = crate::complete(scene).unwrap_or_else(|errors| panic!("{errors}"));
    let found = OrbitSurvey::of(&scene, &OrbitChoice::Nearest, Some([1, 0, 0])).unwrap();
    // q/ω, ω² = 2k/m.
    assert!((found.period - 0.5 * std::f64::consts::PI / 160_f64.sqrt()).abs() < 1e-10, "{}", found.period);
    assert!(found.stable && found.multipliers.len() == 8, "{found:?}");
}

/// ẍ + 0.3 ẋ − x + x³ = 0.2 cos 1.2 t: from 3 and −2 Newton's steps lead nowhere, what the motion comes to is an orbit.
#[test]
fn a_driven_motion_with_losses_is_followed_to_what_it_comes_to() {
    let period = 2.0 * std::f64::consts::PI / 1.2;
    let duffing = |x: f64| {
        let text = WELL.replace("0.5*x^2 + 0.25*x^4", "-0.5*x^2 + 0.25*x^4 - 0.2*x*cos(1.2*t)");
        let row = |k: usize| (0..12).map(|i| if i == k && k < 3 { 0.3 } else { 0.0 }).collect::<Vec<f64>>();
        let friction: Vec<_> = (0..12).map(row).collect();
        format!("{}linear_friction = {{ matrix = {friction:?} }}\n", text.replace("[0.9,", &format!("[{x},")))
    };
    for x in [0.0, 0.3, 3.0, -2.0] {
        let found = orbit(&duffing(x), &OrbitChoice::Period(period)).unwrap();
        assert!(found.misfit < 1e-9, "{x}: {found:?}");
    }
}
