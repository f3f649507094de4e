//! `[[contact]] from`: laws that follow from what a contact does.

use crate::common::{TABLE, TIME, assert_error, assert_resolves_to_itself};
use gyration_scene::Scene;
use std::path::Path;

/// A cube of side 0.1 m and 2 kg over a table, both of a contact with these lines.
fn scene(lines: &str) -> String {
    format!(
        "{TIME}[world]\ngravity = [0, 0, -10]\n{TABLE}\
         [[body]]\nname = \"cube\"\nshape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\n\
         mass = 2\nposition = [0, 0, 1]\norientation = {{ axis_angle = {{ axis = [1, 2, 3], angle = 1 }} }}\n\
         [[contact]]\nsupport = \"table\"\n{lines}\n"
    )
}

/// A resolved number of the contact of that scene.
fn number(lines: &str, key: &str) -> f64 {
    let scene =
        Scene::parse("scene.toml", &scene(lines), Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_resolves_to_itself(&scene);
    let resolved = scene.resolved();
    resolved.pointer(&format!("/contact/0/{key}")).and_then(serde_json::Value::as_f64).unwrap()
}

#[track_caller]
fn assert_near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found / wanted - 1.0).abs() < tolerance, "{found:e} for {wanted:e}");
}

#[test]
fn the_repulsion_carries_the_weight_at_the_gap_of_rest() {
    // The face a² pushes, and of the four walls a d₀/(ν − 1) each.
    let alpha = |nu: f64| 20.0 / (0.01 + 4.0 * 0.1 * 1e-5 / (nu - 1.0));
    let rest = "from = { rest_gap = \"0.01 mm\" }";
    assert_eq!(number(rest, "repulsion/d0"), 1e-5);
    assert_eq!(number(rest, "repulsion/nu"), 6.0);
    assert_near(number(rest, "repulsion/alpha"), alpha(6.0), 1e-12);
    assert_near(number("from = { rest_gap = 1e-5, nu = 3.5 }", "repulsion/alpha"), alpha(3.5), 1e-9);
}

#[test]
fn of_a_group_the_body_that_presses_hardest_counts() {
    let ball = "[[body]]\nname = \"ball\"\nshape = { sphere = { radius = 0.1 } }\nmass = 2\nposition = [1, 0, 1]\n";
    let text = scene("from = { rest_gap = 1e-5 }") + ball;
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    let alpha = scene.resolved().pointer("/contact/0/repulsion/alpha").and_then(serde_json::Value::as_f64).unwrap();
    // Of a ball F₁ = 2π R d₀/(ν − 1) · (1 − …), with the far side beyond rounding.
    assert_near(alpha, 20.0 * 5.0 / (std::f64::consts::TAU * 0.1 * 1e-5), 1e-3);
}

#[test]
fn damping_and_friction_follow_from_a_repulsion_that_is_written_or_not() {
    let repulsion = "repulsion = { alpha = 500, nu = 5, d0 = 1e-4 }";
    let bounce = format!("{repulsion}\nfrom = {{ restitution = 0.593624260024, at_speed = \"2 m/s\" }}");
    // c v₀ = 1.
    assert_near(number(&bounce, "damping/beta"), 250.0, 1e-9);
    assert_eq!([number(&bounce, "damping/nu"), number(&bounce, "damping/d0")], [5.0, 1e-4]);
    let slide = "from = { rest_gap = 1e-5, friction_angle = \"45 deg\", sliding_speed = \"1 mm/s\" }";
    assert_near(number(slide, "friction/mu"), 1.0, 1e-15);
    assert_near(number(slide, "friction/beta"), 1e3 * number(slide, "repulsion/alpha"), 1e-15);
    let lossless = format!("{repulsion}\nfrom = {{ restitution = 1, at_speed = 1 }}");
    let lossless = Scene::parse("scene.toml", &scene(&lossless), Path::new(""), &[]).unwrap();
    assert_eq!(lossless.resolved().pointer("/contact/0/damping"), None);
}

#[test]
fn a_layer_gives_the_gap_or_the_exponent() {
    // M = 2 E of ν = 0.4 by M/E = 0.6/(1.4·0.2) = 15/7; M/h = 15/7·1e6/1e-3.
    let layer = "layer = { youngs_modulus = \"1 MPa\", poissons_ratio = 0.4, thickness = \"1 mm\" }";
    let stiffness = 15.0 / 7.0 * 1e9;
    let alone = format!("from = {{ {layer} }}");
    let [alpha, nu, d0] = ["alpha", "nu", "d0"].map(|key| number(&alone, &format!("repulsion/{key}")));
    assert_eq!(nu, 6.0);
    assert_near(nu * alpha / d0, stiffness, 1e-12);
    assert_near(alpha, 20.0 / (0.01 + 0.4 * d0 / 5.0), 1e-12);
    let both = format!("from = {{ {layer}, rest_gap = \"10 um\" }}");
    let [alpha, nu, d0] = ["alpha", "nu", "d0"].map(|key| number(&both, &format!("repulsion/{key}")));
    assert_near(d0, 1e-5, 1e-15);
    assert_near(nu * alpha / d0, stiffness, 1e-12);
    assert_near(nu, stiffness * 1e-5 / 2000.0, 1e-3);
}

#[test]
fn what_is_wrong_is_told_at_its_key() {
    let layer = "layer = { youngs_modulus = 1e6, poissons_ratio = 0.4, thickness = 1e-3 }";
    let rows: Vec<(String, &str, &str, &str)> = vec![
        ("from = §{ restitution = 0.5, at_speed = 1 }".into(), "contact.0.from", "how strongly", "`rest_gap`"),
        (
            "from = { rest_gap = 1e-5, restitution = §0.5 }".into(),
            "contact.0.from.restitution",
            "without",
            "`at_speed`",
        ),
        ("from = { rest_gap = 1e-5, sliding_speed = §1 }".into(), "contact.0.from.sliding_speed", "without", "add"),
        (
            "from = { rest_gap = 1e-5, restitution = §1.5, at_speed = 1 }".into(),
            "contact.0.from.restitution",
            "add energy",
            "at most 1",
        ),
        (
            "from = { rest_gap = 1e-5, friction_angle = §\"90 deg\", sliding_speed = 1 }".into(),
            "contact.0.from.friction_angle",
            "90 deg",
            "below 90",
        ),
        (
            "repulsion = { alpha = 1, nu = 6 }\nfrom = { rest_gap = §1e-5 }".into(),
            "contact.0.from.rest_gap",
            "written beside",
            "keep",
        ),
        (
            "damping = { beta = 1, nu = 6 }\nfrom = { rest_gap = 1e-5, restitution = §0.5, at_speed = 1 }".into(),
            "contact.0.from.restitution",
            "written beside",
            "keep `damping`",
        ),
        (
            "repulsion = { alpha = 0, nu = 6 }\nfrom = §{ restitution = 0.5, at_speed = 1 }".into(),
            "contact.0.from",
            "alpha is 0",
            "above 0",
        ),
        (
            format!("from = {{ rest_gap = 1e-5, {layer}, nu = §6 }}"),
            "contact.0.from.nu",
            "give the exponent",
            "leave out",
        ),
        (format!("from = {{ rest_gap = §1e-9, {layer} }}"), "contact.0.from.rest_gap", "less than 2", "larger"),
        (format!("from = {{ rest_gap = §1e-3, {layer} }}"), "contact.0.from.rest_gap", "above 95", "smaller"),
        (
            "from = { layer = { youngs_modulus = 1e6, poissons_ratio = §0.5, thickness = 1e-3 } }".into(),
            "contact.0.from.layer.poissons_ratio",
            "0.5",
            "below 0.5",
        ),
    ];
    for (lines, key, message, help) in rows {
        assert_error(&scene(&lines), key, message, help);
    }
}

#[test]
fn without_a_weight_no_gap_is_one_of_rest() {
    let text = scene("from = { rest_gap = §1e-5 }").replace("[0, 0, -10]", "[0, 0, 0]");
    assert_error(&text, "contact.0.from.rest_gap", "no body", "`repulsion`");
}
