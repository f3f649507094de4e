//! `gyration resistance`: matrices of shapes, in a fluid or without one, near a wall, at a frequency.

use crate::common::Sandbox;
use serde_json::Value;
use std::f64::consts::PI;

const SCENE: &str = r#"
time = { end = 1, sample = 0.1 }
fluid = { viscosity = 2, density = 1000 }
[[support]]
name = "floor"
plane = {}
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
density = 1000
position = [0, 0, 0.4]
inclusion = {}
[[body]]
name = "brick"
shape = { box = { size = [0.1, 0.2, 0.3] } }
density = 1000
position = [1, 0, 1]
"#;

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    std::fs::write(sandbox.path("grains.toml"), SCENE).unwrap();
    sandbox
}

fn json(sandbox: &Sandbox, arguments: &[&str]) -> Value {
    let arguments: Vec<&str> = ["resistance"].iter().chain(arguments).copied().chain(["--json"]).collect();
    serde_json::from_str(&sandbox.done(&arguments).stdout).unwrap()
}

fn entry(value: &Value, body: usize, row: usize, column: usize) -> f64 {
    value["bodies"][body]["matrix"][row][column].as_f64().unwrap()
}

#[test]
fn a_sphere_has_the_drag_of_stokes_and_a_brick_one_of_its_size() {
    let sandbox = sandbox();
    let found = json(&sandbox, &["grains.toml"]);
    let drag = 6.0 * PI * 2.0 * 0.1;
    assert!((entry(&found, 0, 0, 0) / drag - 1.0).abs() < 1e-12);
    assert_eq!(found["bodies"][0]["method"], "closed form");
    assert_eq!(found["bodies"][1]["method"], "boundary elements");
    // Between the spheres in it and around it.
    let brick = entry(&found, 1, 0, 0) / (6.0 * PI * 2.0);
    assert!(brick > 0.05 && brick < 0.19, "{brick}");
    assert!(found["bodies"][1]["estimated_relative_error"].as_f64().unwrap() < 0.05);
    let text = sandbox.done(&["resistance", "grains.toml:ball"]).stdout;
    assert!(text.contains("in closed form") && text.contains("3.7699") && !text.contains("brick"), "{text}");
}

#[test]
fn elements_agree_with_the_closed_form_and_a_wall_holds_back() {
    let sandbox = sandbox();
    let exact = json(&sandbox, &["grains.toml:ball"]);
    let elements = json(&sandbox, &["grains.toml:ball", "--elements"]);
    let ratio = entry(&elements, 0, 2, 2) / entry(&exact, 0, 2, 2);
    assert!((ratio - 1.0).abs() < 2e-3, "{ratio}");
    let near = json(&sandbox, &["grains.toml:ball", "--wall", "floor", "--triangles", "320"]);
    // Brenner's series for h/a = 4, towards the wall; along it less.
    let towards = entry(&near, 0, 2, 2) / entry(&exact, 0, 2, 2);
    assert!((towards - 1.3837).abs() < 0.01, "{towards}");
    assert!(entry(&near, 0, 0, 0) < entry(&near, 0, 2, 2));
}

#[test]
fn a_vibrating_sphere_takes_fluid_along() {
    let found = json(&sandbox(), &["grains.toml:ball", "--frequency", "1e6"]);
    let inertia = found["bodies"][0]["translation"][1].as_f64().unwrap() / (2.0 * PI * 1e6);
    // Half of the mass displaced, and of the layer of vorticity a little.
    let displaced = 1000.0 * 4.0 / 3.0 * PI * 1e-3;
    assert!((inertia / displaced - 0.5).abs() < 0.01, "{inertia}");
}

#[test]
fn what_has_no_matrix_is_refused_with_the_fix() {
    let sandbox = sandbox();
    let refused = |arguments: &[&str]| {
        let arguments: Vec<&str> = ["resistance"].iter().chain(arguments).copied().collect();
        sandbox.refused(2, &arguments).stderr
    };
    assert!(refused(&["grains.toml:bull"]).contains("did you mean `ball`?"));
    assert!(refused(&["grains.toml", "--wall", "ceiling"]).contains("write one of floor"));
    assert!(refused(&["grains.toml:brick", "--frequency", "1"]).contains("is no sphere"));
    for frequency in ["0", "-1", "inf", "nan"] {
        let said = refused(&["grains.toml:ball", "--frequency", frequency]);
        assert!(said.contains("no finite number above zero"), "{said}");
    }
    assert!(refused(&["grains.toml:ball", "--frequency", "1", "--set", "fluid.density=0"]).contains("`density`"));
    assert!(refused(&["grains.toml:ball", "--triangles", "3"]).contains("80"));
    let touching = refused(&["grains.toml:ball", "--wall", "floor", "--set", "body.ball.position=[0, 0, 0.05]"]);
    assert!(touching.contains("wall") || touching.contains("support"), "{touching}");
}
