//! `[[contact]] from`: bodies do what is said of the contact.

use gyration_sim::modes::{modes, rest};
use gyration_validation::{Case, Experiment};

const GRAVITY: f64 = 9.81;

/// A scene with a table, this gravity, a contact with these lines, and a body.
fn on_a_table(gravity: [f64; 3], end: f64, contact: &str, body: &str) -> Experiment {
    Experiment::of_scene(&format!(
        "world = {{ gravity = {gravity:?} }}\ntime = {{ end = {end:?}, sample = {end:?} }}\n\
         solver = {{ rtol = 1e-9, atol = 1e-12 }}\n[[support]]\nname = \"table\"\nplane = {{ }}\n\
         [[contact]]\nsupport = \"table\"\n{contact}\n[[body]]\nname = \"body\"\n{body}\n"
    ))
}

#[test]
fn bodies_come_to_rest_at_the_gap_that_is_said() {
    let case = |name| Case { row: None, name, source: "α = m g/F₁(d₀)" };
    let contact = "from = { rest_gap = \"0.2 mm\", restitution = 0.2, at_speed = \"10 cm/s\", friction_angle = 0.4, \
                   sliding_speed = 1e-3 }";
    let ball = "shape = { sphere = { radius = 0.05 } }\nmass = 0.3\nposition = [0, 0, 0.051]";
    let run = on_a_table([0.0, 0.0, -GRAVITY], 3.0, contact, ball).run();
    case("ball dropped on `from = { rest_gap }`").check("gap at rest [m]", 2e-4, run.column("body.gap")[1], 1e-9);
    // It falls on an edge, and comes to lie on its largest face.
    let book = "shape = { box = { size = [0.03, 0.2, 0.15] } }\nmass = 0.6\nposition = [0, 0, 0.09]\n\
                orientation = { axis_angle = { axis = [0, 1, 0], angle = 0.6 } }";
    let run = on_a_table([0.0, 0.0, -GRAVITY], 6.0, contact, book).run();
    case("book tipped over on `from = { rest_gap }`").check("gap at rest [m]", 2e-4, run.column("body.gap")[1], 1e-7);
}

#[test]
fn impacts_return_the_speed_that_is_said() {
    let contact = "repulsion = { alpha = 800, nu = 6, d0 = 1e-3 }\nfrom = { restitution = 0.7, at_speed = \"2 m/s\" }";
    let source = "x − ln(1 + x) = −y − ln(1 − y)";
    for (name, shape) in [
        ("ball on `from = { restitution = 0.7 }`", "sphere = { radius = 0.05 }"),
        ("flat box on `from = { restitution = 0.7 }`", "box = { size = [0.2, 0.1, 0.1] }"),
    ] {
        let body = format!("shape = {{ {shape} }}\nmass = 0.3\nposition = [0, 0, 0.2]\nvelocity = [0, 0, -2]");
        let run = on_a_table([0.0; 3], 0.5, contact, &body).run();
        Case { row: None, name, source }.check("restitution", 0.7, run.column("body.vz")[1] / 2.0, 1e-6);
    }
}

#[test]
fn a_block_creeps_as_the_sliding_speed_says() {
    // Where tan of the slope is μ/√2 it creeps with v.
    let (mu, speed) = (0.5_f64, 0.003);
    let slope = (mu * 0.5_f64.sqrt()).atan();
    let contact = format!(
        "from = {{ rest_gap = 1e-4, restitution = 0.1, at_speed = 1, friction_angle = {:?}, \
         sliding_speed = {speed:?} }}",
        mu.atan()
    );
    let body = "shape = { box = { size = [0.1, 0.1, 0.02] } }\nmass = 0.5\nposition = [0, 0, 0.0101]";
    let run = on_a_table([GRAVITY * slope.sin(), 0.0, -GRAVITY * slope.cos()], 2.0, &contact, body).run();
    let case =
        Case {
            row: None, name: "block on a slope of tan θ = μ/√2, `sliding_speed`", source: "v tan θ/√(μ² − tan² θ)"
        };
    case.check("speed [m/s]", speed, run.column("body.vx")[1], 1e-6);
}

#[test]
fn a_layer_is_as_stiff_as_it_is_said() {
    let (side, mass, modulus, thickness) = (0.1_f64, 2.0_f64, 1e4_f64, 0.01_f64);
    let contact = format!(
        "from = {{ layer = {{ youngs_modulus = {modulus:?}, poissons_ratio = 0.25, thickness = {thickness:?} }} }}"
    );
    // M = 1.2 E; beside the face the four walls push, 4 a d₀/(ν − 1) of α, with the stiffness 4 a α.
    let stiffness = 1.2 * modulus / thickness;
    let weight = mass * GRAVITY;
    let (nu, face, walls) = (6.0, side * side, 4.0 * side);
    // ν α h/M = d₀ and α (face + walls d₀/(ν − 1)) = m g: a quadratic in α.
    let per = nu / stiffness;
    let bend = walls * per / (nu - 1.0);
    let alpha = ((face * face + 4.0 * bend * weight).sqrt() - face) / (2.0 * bend);
    let gap = per * alpha;
    let frequency = ((stiffness * face + walls * alpha) / mass).sqrt();
    let body = format!(
        "shape = {{ box = {{ size = [{side:?}, {side:?}, {side:?}] }} }}\nmass = {mass:?}\nposition = [0, 0, {:?}]",
        0.5 * side + gap
    );
    let experiment = on_a_table([0.0, 0.0, -GRAVITY], 1.0, &contact, &body);
    let at_rest = rest(&experiment.model, &experiment.start, 0).unwrap_or_else(|error| panic!("{error}"));
    let found = modes(&experiment.model, &experiment.start, 0, &at_rest).unwrap_or_else(|error| panic!("{error}"));
    let off = |mode: &f64| (mode - frequency).abs();
    let nearest = found.iter().map(|mode| mode.frequency()).min_by(|a, b| off(a).total_cmp(&off(b)));
    let case = Case { row: None, name: "cube on `from = { layer }`", source: "ω² = (M/h A + 4 a α)/m" };
    case.check("frequency along the normal [rad/s]", frequency, nearest.unwrap_or(f64::NAN), 1e-6);
    case.by("ν α h/M").check("gap at rest [m]", gap, at_rest.placement.position.z - 0.5 * side, 1e-6);
}
