//! Forces that a scene writes for a body: what they are read as, and what is wrong with them at its place (`§`).

use crate::common::{BALL, TIME, assert_error, assert_resolves_to_itself};
use gyration::kinematics::Placement;
use gyration::load::SelfGravity;
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
fn gravity_of_their_own_is_that_of_ellipsoids_that_deform() {
    let world = "[world]\nself_gravity = { constant = \"2e-3 N m^2/kg^2\" }\n";
    let scene = |kind: &str| {
        let text = format!("{TIME}{world}{BALL}{kind}\n");
        Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let expected = SelfGravity::new(2e-3, 1.0, &Vec3::repeat(0.1));
    for (kind, gravity) in
        [("affine = {}", Some(expected)), ("contractile = { contraction_viscosity = 1 }", Some(expected)), ("", None)]
    {
        assert_eq!(scene(kind).built().model.bodies[0].own.self_gravity, gravity, "{kind}");
    }
    assert_resolves_to_itself(&scene("affine = {}"));
    let boxed = "[[body]]\nname = \"b\"\nmass = 1\n";
    let text = format!("{TIME}{world}{boxed}shape = §{{ box = {{ size = [1, 2, 3] }} }}\naffine = {{}}\n");
    assert_error(&text, "body.b.shape", "spheres and ellipsoids alone", "`rigid`");
    let given = "mass_properties = §{ mass = 1, euler_tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }\naffine = {}\n";
    let text = format!("{TIME}{world}[[body]]\nname = \"b\"\nshape = {{ sphere = {{ radius = 1 }} }}\n{given}");
    assert_error(&text, "body.b.mass_properties", "spread evenly", "`density`");
    let text = format!("{TIME}[world]\nself_gravity = {{ constant = §0 }}\n{BALL}");
    assert_error(&text, "world.self_gravity.constant", "greater than", "");
    let text = format!("{TIME}[world]\nself_gravity = {{ constant = §\"1 m/s^2\" }}\n{BALL}");
    assert_error(&text, "world.self_gravity.constant", "N m^2/kg^2", "");
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

/// H = diag(entry, 0, …), its first entry at the mark if there is one.
fn along_x(entry: &str) -> String {
    let zeros = ["0"; 11].join(", ");
    let others = vec![format!("[0, {zeros}]"); 11].join(", ");
    format!("[[{entry}, {zeros}], {others}]")
}

#[test]
fn body_forces_are_exact_where_they_are_polynomials() {
    let error = |force: &str| {
        let scene = scene(&format!("body_force = {force}"), &[]);
        scene.built().model.bodies[0].own.body_force.as_ref().unwrap().error()
    };
    assert_eq!(error("[\"-0.1*x\", 0, \"2*sin(3*t)\"]"), None);
    assert_eq!(error("[\"x^2*y\", \"z^3\", \"t*z\"]"), None);
    // A rule of degree nine over 0.2 m of a wave of 2π m.
    assert!(error("[\"sin(x)\", 0, 0]").unwrap() < 1e-14);
    assert!(error("[\"sin(30*x)\", 0, 0]").unwrap() > 1e-9);
}

#[test]
fn points_are_pulled_by_their_masses() {
    let lines = "[[body]]\nname = \"p\"\nbody_force = [\"2*x\", 0, 0]\naffine = {}\nshape = { points = [\
                 { mass = 1, at = [1, 0, 0] }, { mass = 3, at = [-1, 0, 0] }, { mass = 1, at = [0, 1, 0] }, \
                 { mass = 1, at = [0, 0, 1] }, { mass = 1, at = [0, -1, -1] }] }";
    let text = format!("{TIME}{lines}\n");
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    let force = scene.built().model.bodies[0].own.body_force.as_ref().unwrap();
    let place = Placement { position: Vec3::new(0.5, 0.0, 0.0), gradient: 2.0 * Mat3::identity() };
    // Σ m 2x: 2 m p₀, whatever P.
    let loads = force.loads(&place, 0.0, &mut Scratch::default()).unwrap();
    assert!((loads.force.x - 7.0).abs() < 1e-14, "{}", loads.force.x);
}

#[test]
fn frictions_of_any_body_may_change_with_its_place() {
    let constant = scene(&format!("linear_friction = {{ matrix = {} }}", along_x("2")), &[]);
    let own = &constant.built().model.bodies[0].own;
    assert!(own.resistance.is_some() && own.frictions.is_empty());
    for lines in [
        format!("linear_friction = {{ matrix = {}, scale = \"1 + x^2\", frame = \"body\" }}", along_x("2")),
        format!("linear_friction = {{ matrix = {} }}", along_x("\"2*(1 + x^2)\"")),
        format!("affine = {{ linear_friction = {{ matrix = {}, scale = \"2 + sin(t)\" }} }}", along_x("2")),
    ] {
        let scene = scene(&lines, &[]);
        let own = &scene.built().model.bodies[0].own;
        assert!(own.resistance.is_none() && own.frictions.len() == 1, "{lines}");
        assert_resolves_to_itself(&scene);
    }
    let scaled = scene(&format!("affine = {{ linear_friction = {{ matrix = {}, scale = 3 }} }}", along_x("2")), &[]);
    assert!(scaled.built().model.bodies[0].own.frictions.is_empty());
    assert_eq!(scaled.built().model.bodies[0].affine().unwrap().resistances.len(), 1);
}

#[test]
fn errors_of_body_forces_and_frictions_stand_at_their_place() {
    let friction = |entry: &str, more: &str| format!("linear_friction = {{ matrix = {}{more} }}", along_x(entry));
    let rows = [
        ("body_force = [\"x\", \"§q\", 0]".to_owned(), "body_force.1", "`q` is not known; variables: x, y, z, t"),
        ("body_force = [0, 0, \"1 +§\"]".to_owned(), "body_force.2", "missing before the end"),
        ("body_force = §[\"x\", \"y\"]".to_owned(), "body_force", "expected 3 items, found 2"),
        ("body_force = [§true, 0, 0]".to_owned(), "body_force.0", "expected a number or a string with an expression"),
        ("body_force = §[\"sqrt(x)\", 0, 0]".to_owned(), "body_force", "at the start `sqrt` has no"),
        (friction("\"1 + §w\"", ""), "linear_friction.matrix.0.0", "`w` is not known"),
        (friction("1", ", scale = \"§w\""), "linear_friction.scale", "`w` is not known"),
        (friction("\"x^2\"", ", scale = §\"x\""), "linear_friction.scale", "the matrix has expressions already"),
        (
            friction("1", ", scale = \"-1 - x^2\"").replace("= {", "= §{"),
            "linear_friction",
            "not positive semi-definite",
        ),
        (friction("\"-1\"", "").replace("= {", "= §{"), "linear_friction", "the pivot of row 0 is -1e0"),
        (friction("-1", "").replace("= [", "= §["), "linear_friction.matrix", "negative eigenvalue"),
        (
            friction("1", ", scale = \"1\"").replace("[[1, 0", "[[1, §1").replace("= [[1, §1", "= §[[1, 1"),
            "linear_friction.matrix",
            "not symmetric",
        ),
    ];
    for (lines, key, message) in rows {
        assert_error(&format!("{TIME}{BALL}{lines}\n"), &format!("body.ball.{key}"), message, "");
    }
    let bare = "[[body]]\nname = \"b\"\nbody_force = §[\"x\", 0, 0]\n\
                mass_properties = { mass = 1, euler_tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }\n";
    assert_error(&format!("{TIME}{bare}"), "body.b.body_force", "no shape over which", "potential");
}

#[test]
fn bodies_that_differ_in_their_forces_alone_keep_their_own() {
    // Symptom: of bodies alike in shape, mass and kind all felt the forces of the first.
    let other = BALL.replace("name = \"ball\"", "name = \"other\"");
    let scene = scene(&format!("potential = \"3*x\"\n{other}potential = \"5*x\""), &[]);
    let force = |body: usize| {
        let potential = scene.built().model.bodies[body].own.potential.as_ref().unwrap();
        let place = Placement { position: Vec3::zeros(), gradient: Mat3::identity() };
        potential.loads(&place, 0.0, &mut Scratch::default()).unwrap().force.x
    };
    assert_eq!([0, 1].map(force), [-3.0, -5.0]);
}

#[test]
fn all_constants_that_are_none_are_told_once() {
    let text = "time = { end = 1, sample = 1 }\nconstants = { sin = 1, max = 2, pi = 3, fine = 4 }\n";
    let body = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\ndensity = 10\n\
             position = [{x}, 0, 0]\npotential = \"x^2\"\n"
        )
    };
    let text = format!("{text}{}{}", body("a", 0.0), body("b", 1.0));
    let errors = Scene::parse("scene.toml", &text, std::path::Path::new(""), &[]).unwrap_err();
    let keys: Vec<&str> = (&errors).into_iter().map(|error| error.key.as_str()).collect();
    assert_eq!(keys, ["constants.sin", "constants.max", "constants.pi"], "{errors}");
}
