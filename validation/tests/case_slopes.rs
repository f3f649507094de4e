//! Bodies on a slope: the speed at which `check` says that a block slides, against its run; a ball and a cylinder roll,
//! and without friction all slide faster and faster.

use gyration_scene::Scene;
use gyration_sim::survey::Survey;
use gyration_validation::{Case, Experiment};
use serde_json::Value;
use std::path::Path;

const ANGLE: f64 = 0.2;

/// A body just over a slope on which friction has this exponent and coefficient.
fn scene(shape: &str, height: f64, (beta, nu): (f64, u32)) -> String {
    let (sin, cos) = ANGLE.sin_cos();
    let place = height + 1e-3;
    format!(
        r#"
        time = {{ end = 1, sample = 0.1 }}
        [[support]]
        name = "slope"
        plane = {{ normal = [{sin}, 0, {cos}] }}
        [[contact]]
        support = "slope"
        repulsion = {{ alpha = 245, nu = 6, d0 = 1e-3 }}
        damping = {{ beta = 1e4, nu = 6, d0 = 1e-3 }}
        friction = {{ beta = {beta}, nu = {nu}, d0 = 1e-3 }}
        [[body]]
        name = "it"
        shape = {{ {shape} }}
        density = 1000
        position = [{}, 0, {}]
        orientation = {{ axis_angle = {{ axis = [0, 1, 0], angle = {ANGLE} }} }}
        "#,
        place * sin,
        place * cos
    )
}

/// The first gap of rest, as `check --json` has it.
fn rest(text: &str) -> Value {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap();
    let survey = serde_json::to_value(Survey::of(&scene).unwrap()).unwrap();
    survey["bodies"][0]["supports"][0]["rests"][0].clone()
}

#[test]
fn a_block_slides_as_fast_as_is_told() {
    let case = Case { row: None, name: "block on a slope", source: "run to its terminal speed" };
    for (quantity, law) in [
        ("speed, friction steeper than repulsion [m/s]", (2e4, 8)),
        ("speed, friction flatter than repulsion [m/s]", (2e4, 3)),
    ] {
        let text = scene("box = { size = [0.1, 0.1, 0.02] }", 0.01, law);
        let told = rest(&text)["descent"]["slides"]["speed"].as_f64().unwrap();
        let run = Experiment::of_scene(&text).run();
        let last = |name: &str| run.column(name)[run.times.len() - 1];
        let speed = last("it.vx").hypot(last("it.vz"));
        // The couple of friction tilts the block, which changes the speed by the square of the tilt over the gap.
        case.check(quantity, speed, told, 1e-2);
    }
}

#[test]
fn what_is_round_rolls_and_without_friction_all_accelerate() {
    for (shape, height, rolls) in [
        ("sphere = { radius = 0.03 }", 0.03, true),
        ("ellipsoid = { semi_axes = [0.03, 0.05, 0.03] }", 0.03, true),
        ("box = { size = [0.1, 0.1, 0.02] }", 0.01, false),
    ] {
        let told = rest(&scene(shape, height, (2e4, 3)));
        assert_eq!(told["descent"] == "rolls", rolls, "{shape}: {told}");
        let acceleration = rest(&scene(shape, height, (0.0, 3)))["descent"]["accelerates"]["acceleration"].as_f64();
        assert!((acceleration.unwrap() / (9.81 * ANGLE.sin()) - 1.0).abs() < 1e-12, "{shape}: {acceleration:?}");
    }
    let cylinder = Scene::open("roll", &[]).unwrap();
    let survey = serde_json::to_value(Survey::of(&cylinder).unwrap()).unwrap();
    assert_eq!(survey["bodies"][0]["supports"][0]["rests"][0]["descent"], "rolls");
}
