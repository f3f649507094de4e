//! `keep` of a body: what is refused, each at its exact place (`§`), with the fix; and starts that are put on it.

use crate::common::{BALL, BLOCK, TIME, assert_error, assert_resolves_to_itself, block, start};
use gyration::tensor::{Mat3, Vec3};

const SOFT: &str = "affine = { material = { neo_hookean_log = { mu = 1, lambda = 1 } } }\n";

#[test]
fn what_cannot_be_kept_to_is_refused_with_the_fix() {
    let soft = |lines: &str| format!("{SOFT}{lines}");
    let rows = [
        ("keep = { plane = §[0, 0, 0] }".to_owned(), "keep.plane", "the direction is zero", "[0, 0, 1]"),
        ("keep = §{ plane = [0, 0, 1], line = [1, 0, 0] }".to_owned(), "keep", "2", "one"),
        ("keep = { stretch_only = §false }".to_owned(), "keep.stretch_only", "to nothing", "write `true`"),
        (soft("keep = { axis = §[0, 0, 1] }"), "keep.axis", "no axis to turn about", "write `plane`"),
        (
            "pin = [0, 0, 1]\nkeep = { line = §[0, 0, 1] }".to_owned(),
            "keep.line",
            "goes where its turn",
            "leave out one",
        ),
        ("pin = [0, 0, 1]\nkeep = { stretch_only = §true }".to_owned(), "keep.stretch_only", "does not move", "leave"),
        (soft("pin = [0, 0, 1]\nkeep = { plane = §[0, 3, 4] }"), "keep.plane", "8e-1 m off the plane", "move the pin"),
        (
            "velocity = §[1, 1, 0]\nkeep = { plane = [1, 0, 0] }".to_owned(),
            "velocity",
            "at 1e0 m/s",
            "write velocity = [0.0, 1.0, 0.0]",
        ),
        (
            "angular_velocity = §[0, 3, 5]\nkeep = { axis = [0, 0, 7] }".to_owned(),
            "angular_velocity",
            "by 3e0 rad/s",
            "write angular_velocity = [0.0, 0.0, 5.0]",
        ),
        (
            soft("gradient_rate = §[[1, 1, 0], [1, 1, 3], [0, 3, 0]]\nkeep = { plane = [0, 0, 1] }"),
            "gradient_rate",
            "deform otherwise than `keep` lets it",
            "write gradient_rate = [[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0]]",
        ),
        (
            soft("angular_velocity = §[0, 0, 1]\nkeep = { stretch_only = true }"),
            "angular_velocity",
            "deform otherwise",
            "write gradient_rate = ",
        ),
    ];
    for (lines, key, message, help) in rows {
        assert_error(&format!("{BLOCK}{lines}\n"), &format!("body.b.{key}"), message, help);
    }
    let point = "[[body]]\nname = \"p\"\nshape = { points = [{ mass = 1, at = [0, 0, 0] }] }\n";
    let turned = format!("{TIME}{point}keep = {{ axis = §[0, 0, 1] }}\n");
    assert_error(&turned, "body.p.keep.axis", "does not turn", "some width");
    let fluid = "[fluid]\nviscosity = 1\ndensity = 1\n";
    let history = "keep = { line = [0, 0, 1] }\ninclusion = { history = §true }\n";
    assert_error(&format!("{TIME}{fluid}{BALL}{history}"), "body.ball.inclusion.history", "a `keep`", "leave out one");
}

#[test]
fn a_start_within_digits_of_its_guide_is_put_on_it() {
    let written = "velocity = [2, 1, 1.0000000003]\nangular_velocity = [0, 1, -1]\nkeep = { plane = [0, 1, -1] }";
    let scene = block(written);
    assert_resolves_to_itself(&scene);
    let (motion, normal) = (start(&scene), Vec3::new(0.0, 1.0, -1.0).normalize());
    assert!(motion.velocity.velocity.dot(&normal).abs() < 1e-15, "{motion:?}");
    let rate = "gradient_rate = [[1, 0.3000000001, 0], [0.3, 0, 0], [0, 0, -2]]\nkeep = { stretch_only = true }";
    let soft = block(&format!("{SOFT}{rate}"));
    assert_resolves_to_itself(&soft);
    let rate = start(&soft).velocity.gradient_rate;
    assert!((rate - rate.transpose()).norm() < 1e-15, "{rate}");
    // Turned at the start: P P₀⁻¹ is symmetric, not P.
    let turned = "orientation = { axis_angle = { axis = [1, 2, 3], angle = 0.7 } }\nkeep = { stretch_only = true }";
    let body = block(&format!("{SOFT}{turned}"));
    let strain = body.built().model.bodies[0].strain_guide().unwrap();
    let p = start(&body).placement.gradient;
    let shear = Mat3::new(0.1, 0.2, 0.0, 0.2, -0.3, 0.5, 0.0, 0.5, 0.4) * p;
    assert!((strain.within(&shear) - shear).norm() < 1e-15 && (strain.within(&p) - p).norm() < 1e-15);
}
