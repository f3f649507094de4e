//! Forces that a scene writes for a body: what they are read as, and what is wrong with them at its place (`§`).

use crate::common::{BALL, TIME, assert_error, assert_resolves_to_itself};
use gyration::kinematics::Placement;
use gyration::tensor::{Mat3, Vec3};
use gyration_expression::Scratch;
use gyration_scene::Scene;
use std::path::Path;

fn scene(lines: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let text = format!("{TIME}{BALL}{lines}\n");
    Scene::parse("scene.toml", &text, Path::new(""), &overrides).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The force of the potential at x = 2 m [N].
fn force(scene: &Scene) -> f64 {
    let potential = scene.built().model.bodies[0].own.potential.as_ref().unwrap();
    let place = Placement { position: Vec3::new(2.0, 0.0, 0.0), gradient: Mat3::identity() };
    potential.loads(&place, 0.0, &mut Scratch::default()).unwrap().force.x
}

#[test]
fn potentials_have_constants_of_the_body_before_those_of_the_scene() {
    let lines = "potential = \"0.5*k*x^2 + g*x\"\nconstants = { k = \"2 N/cm\" }\n[constants]\nk = 7\ng = \"3 N\"";
    assert_eq!(force(&scene(lines, &[])), -403.0);
    assert_eq!(force(&scene(lines, &["body.ball.constants.k=10", "constants.g=1"])), -21.0);
    let bare = "potential = \"0.5*k*x^2\"\n[constants]\nk = 7";
    assert_eq!(force(&scene(bare, &[])), -14.0);
    assert_eq!(force(&scene(bare, &["body.ball.constants.k=10"])), -20.0);
    assert_eq!(force(&scene(bare, &["constants.k=\"1 kN/m\""])), -2000.0);
}

#[test]
fn scenes_with_own_forces_resolve_to_themselves() {
    let lines = "potential = \"0.5*k*x^2\"\naffine = {}\nconstants = { k = \"2 N/cm\" }\n[constants]\nk = 7";
    let scene = scene(lines, &[]);
    assert_resolves_to_itself(&scene);
    assert_eq!(scene.resolved()["body"][0]["constants"]["k"], 200.0);
}

#[test]
fn errors_of_expressions_stand_at_their_column() {
    let rows = [
        ("x^2 + §q", "column 7: `q` is not known; variables: x, y, z, P_xx", "scene reference"),
        ("2§x", "an operator is missing before `x`", ""),
        ("x^2 + §", "a number, a name or ( is missing before the end", ""),
        ("§(x", "never closed", ""),
        ("x + 1§/0", "no finite value", ""),
        ("x§**2", "a power is written with ^", ""),
    ];
    for (expression, message, help) in rows {
        let text = format!("{TIME}{BALL}potential = \"{expression}\"\n");
        assert_error(&text, "body.ball.potential", message, help);
    }
}

#[test]
fn constants_that_mean_something_else_are_refused() {
    let rows = [
        ("constants = { x = §1 }", "body.ball.constants.x", "has the name of a variable"),
        ("constants = { P_xy = §1 }", "body.ball.constants.P_xy", "has the name of a variable"),
        ("constants = { sin = §1 }", "body.ball.constants.sin", "has the name of a function"),
        ("[constants]\npi = §3", "constants.pi", "has the name of the number pi"),
        ("[constants]\n\"a b\" = §3", "constants.a b", "is no name"),
        ("[constants]\nk = §\"3 quarks\"", "constants.k", "unknown unit"),
        ("[constants]\nk = §true", "constants.k", "expected a number"),
        ("[constants]\nk = §inf", "constants.k", "finite"),
    ];
    for (lines, key, message) in rows {
        assert_error(&format!("{TIME}{BALL}potential = \"x^2\"\n{lines}\n"), key, message, "");
    }
}

#[test]
fn a_potential_is_defined_where_the_body_starts() {
    let text = format!("{TIME}{BALL}potential = §\"abs(x)\"\n");
    assert_error(&text, "body.ball.potential", "at the start `abs` has no derivative at 0", "smooth");
}

#[test]
fn errors_of_expressions_come_with_those_of_the_rest() {
    let text = format!("{TIME}{BALL}potential = \"x +\"\ncolour = 3\n");
    let found = crate::common::errors("scene.toml", &text, &[]);
    let keys: Vec<&str> = found.as_slice().iter().map(|error| error.key.as_str()).collect();
    assert_eq!(keys, ["body.ball.potential", "body.ball.colour"]);
}
