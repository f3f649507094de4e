//! Orbits: a point in a well with x⁴, by each choice; what is no orbit.

use gyration::state::State;
use gyration_scene::Scene;
use gyration_sim::complete;
use gyration_sim::orbit::{CellShift, NoShift, OrbitChoice, OrbitSurvey};
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
    // Symptom: it did not come back either.
    let still = orbit(&WELL.replace("[0.9, 0, 0]", "[0, 0, 0]"), &OrbitChoice::Nearest).unwrap_err();
    assert!(still.contains("has come to rest"), "{still}");
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
    assert_eq!(CellShift::of(built, [-4, 0, 0]), Err(NoShift::Round { vector: 1, cells: 3, by: -4 }));
    let well = Scene::parse("scene.toml", WELL, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let said = OrbitSurvey::of(&well, &OrbitChoice::Nearest, Some([1, 0, 0])).unwrap_err();
    assert!(said.contains("no `[lattice]`"), "{said}");
}

#[test]
fn multipliers_that_lie_evenly_on_a_circle_are_those_of_a_ring() {
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
    let scene = complete(scene).unwrap_or_else(|errors| panic!("{errors}"));
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

/// A box on a joint, 1 m long and 0.5 m below it, in gravity.
fn pendulum(joint: &str, start: &str, time: &str) -> String {
    format!(
        "time = {{ {time} }}\n[[body]]\nname = \"p\"\nshape = {{ box = {{ size = [0.1, 0.2, 1.0] }} }}\nmass = 2.7\n\
         {start}\n{joint}\n"
    )
}

/// Symptom: 39 of 654 conical pendulums had multipliers of 1.52 and were unstable, by how far from the origin they hung
/// and by the last digits of the period.
#[test]
fn a_conical_pendulum_is_stable_wherever_it_hangs() {
    for place in [0.0, 1.234, -57.3] {
        let start = format!(
            "orientation = {{ quaternion = [0.9887710779360422, 0.0, 0.14943813247359922, 0.0] }}\n\
             position = [{:?}, 0.0, -0.477668244562803]\nvelocity = [0, -0.5806342956203462, 0]\n\
             angular_velocity = [0, 0, 3.9295742391364925]",
            place - 0.147_760_103_330_669_7
        );
        let joint = format!(
            "[[joint]]\nname = \"h\"\nkind = \"ball\"\nbetween = [\"space\", \"p\"]\n\
             points = [[{place:?}, 0, 0], [0, 0, 0.5]]"
        );
        let text = pendulum(&joint, &start, "end = 32, sample = 0.08");
        let found = orbit(&text, &OrbitChoice::Period(1.598_948_111_121_649)).unwrap();
        let sizes: Vec<f64> = found.multipliers.iter().map(|[re, im]| re.hypot(*im)).collect();
        println!("{place}: {sizes:?}");
        assert!(found.stable && sizes.len() == 6, "{place}: {:?}", found.multipliers);
        assert!(sizes.iter().all(|size| (size - 1.0).abs() < 1e-6), "{place}: {sizes:?}");
    }
}

/// Symptom: at half of the period a body turned by −3 rad is near to where it was, at 3 rad.
#[test]
fn a_pendulum_that_swings_far_has_its_period() {
    let start = "pin = [0, 0, 0.5]\nkeep = { axis = [0, 1, 0] }\n\
                 orientation = { axis_angle = { axis = [0, 1, 0], angle = 3.0 } }";
    let text = pendulum("", start, "end = 25, sample = 0.1").replace("[0.1, 0.2, 1.0]", "[0.1, 0.1, 1.0]");
    let found = orbit(&text, &OrbitChoice::Nearest).unwrap();
    // 4 K(sin ½ 3)/ω, ω² = m g l/I.
    assert!((found.period - 4.216_805_012_730_777).abs() < 1e-9, "{}", found.period);
}

/// Symptom: what grows to a limit cycle does not come back to where it began, and nothing was found.
#[test]
fn a_limit_cycle_is_found_from_a_small_start() {
    let joint = "[[joint]]\nname = \"h\"\nkind = \"hinge\"\nbetween = [\"space\", \"p\"]\n\
                 axis = [0, 1, 0]\n\
                 drive = { torque = \"-angle+0.7*(1-4*angle^2)*rate\" }";
    let start = "orientation = { axis_angle = { axis = [0, 1, 0], angle = 0.3 } }";
    let text = pendulum(joint, start, "end = 60, sample = 0.05")
        .replace("[0.1, 0.2, 1.0]", "[1, 1, 1]")
        .replace("mass = 2.7", "mass = 6.0");
    let text = format!("world = {{ gravity = [0, 0, 0] }}\n{text}");
    let found = orbit(&text, &OrbitChoice::Nearest).unwrap();
    assert!((found.period - 6.472_832_473).abs() < 1e-8 && found.stable, "{found:?}");
}

/// Symptom: two equal multipliers were no numbers, and such an orbit was stable; of a smaller motion there were none.
#[test]
fn multipliers_that_are_equal_are_numbers() {
    let body = "[[body]]\nname = \"s\"\ndensity = 1000\naffine = { material = { neo_hookean = { shear = 3000 } } }\n";
    let (cuboid, ball) = ("box = { size = [1, 1, 1.3] }", "sphere = { radius = 1 }");
    for (shape, stretch) in [(cuboid, 1.2_f64), (ball, 1.001), (ball, 1.0001)] {
        let across = 1.0 / stretch.sqrt();
        let text = format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 12, sample = 0.05 }}\n{body}\
             shape = {{ {shape} }}\ngradient = [[{across:?}, 0, 0], [0, {across:?}, 0], [0, 0, {stretch:?}]]\n"
        );
        let found = orbit(&text, &OrbitChoice::Nearest).unwrap();
        assert!(found.multipliers.iter().flatten().all(|part| part.is_finite()), "{:?}", found.multipliers);
        assert!(found.stable, "{stretch}: {:?}", found.multipliers);
    }
}
