//! Supports with a shape: what is read, and what is wrong with them.

use crate::common::{BALL, TABLE, TIME, assert_error, assert_resolves_to_itself};
use gyration_scene::Scene;
use std::path::Path;

const REPULSION: &str = "repulsion = { alpha = 1, nu = 6, d0 = 0.01 }";

/// A peg below the ball, with these lines.
fn peg(lines: &str) -> String {
    format!("[[support]]\nname = \"peg\"\nshape = {{ box = {{ size = [0.2, 0.4, 0.6] }} }}\n{lines}\n")
}

fn contact(lines: &str) -> String {
    format!("[[contact]]\n{lines}\n{REPULSION}\n")
}

#[test]
fn motions_add_up_and_all_bodies_meet_a_support() {
    let motion = "motion = [{ velocity = [\"10 cm/s\", 0, 0] }, { rotate = { axis = [0, 0, 2], point = [0.1, 0, 0], \
                  rate = \"30 rpm\" } }]";
    let turned = "orientation = { axis_angle = { axis = [1, 0, 0], angle = \"90 deg\" } }\nposition = [0.2, 0, 0.1]";
    let text = [
        TIME.to_owned(),
        peg(&format!("{turned}\n{motion}")),
        TABLE.to_owned(),
        BALL.to_owned(),
        contact("support = \"peg\""),
        contact("between = [\"peg\", \"ball\"]\nreach = \"5 cm\""),
        contact("between = [\"table\", \"ball\"]"),
    ]
    .concat();
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_resolves_to_itself(&scene);
    let model = &scene.built().model;
    assert_eq!((model.supports.len(), model.solid_supports.len(), model.contacts().len()), (1, 1, 1));
    let reaches: Vec<_> = model.pairs_with_supports().iter().map(|pair| pair.form.reach).collect();
    assert_eq!(reaches, [None, Some(0.05)]);
    // Half a turn a second about (0.1, 0, 0), and 10 cm/s along x.
    let motion = model.solid_supports[0].at(1.0);
    let place = motion.placement.position;
    assert!((place - gyration::tensor::Vec3::new(0.1, 0.0, 0.1)).norm() < 1e-15, "{place}");
    assert!((motion.placement.gradient.column(1)[2] - 1.0).abs() < 1e-15);
    let single = "motion = { rotate = { axis = [0, 1, 0], rate = 1 } }";
    let text = format!("{TIME}{}{BALL}", peg(single));
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_resolves_to_itself(&scene);
}

#[test]
fn what_is_wrong_with_a_support_is_told_at_its_key() {
    let support = |lines: &str| format!("[[support]]\nname = \"peg\"\n{lines}\n");
    let rows = [
        (format!("§{}", support("")), "support.peg.plane", "\"shape\", is missing", "`plane` or `shape`"),
        (
            support("plane = {}\nshape = §{ sphere = { radius = 1 } }"),
            "support.peg.shape",
            "beside a plane",
            "leave out",
        ),
        (support("plane = {}\nposition = §[0, 0, 0]"), "support.peg.position", "a plane has none", "origin"),
        (
            support("plane = {}\norientation = §{ quaternion = [1, 0, 0, 0] }"),
            "support.peg.orientation",
            "a plane has none",
            "normal",
        ),
        (
            peg("motion = [{ velocity = [0, 0, 0] }, { rotate = { axis = §[0, 0, 0], rate = 1 } }]"),
            "support.peg.motion.1.rotate.axis",
            "the axis is zero",
            "direction",
        ),
        (
            peg("motion = { oscillate = { direction = §[0, 0, 0], amplitude = 1, frequency = 1 } }"),
            "support.peg.motion.oscillate.direction",
            "the direction is zero",
            "direction",
        ),
        (
            support("shape = §{ torus = { major_radius = 0.3, minor_radius = 0.1 } }"),
            "support.peg.shape",
            "a torus is not convex",
            "union of capsules",
        ),
        (
            support("shape = §{ points = [{ mass = 1, at = [0, 0, 0] }] }"),
            "support.peg.shape",
            "no surface",
            "with a surface",
        ),
        (
            format!("{}{}", peg("position = [0, 0, 0.65]"), contact("support = §\"peg\"")),
            "contact.0.support",
            "\"ball\" and \"peg\" reach each other at the start, by 5.0",
            "move \"ball\"",
        ),
        (
            format!("{}{}", peg("position = [0, 0, 0.65]"), contact("between = §[\"peg\", \"ball\"]")),
            "contact.0.between",
            "reach each other",
            "along [0.000000, 0.000000, 1.000000]",
        ),
        (
            format!("{}[[contact]]\nsupport = \"peg\"\nrepulsion = {{ alpha = 1, nu = §1.5, d0 = 0.01 }}\n", peg("")),
            "contact.0.repulsion.nu",
            "less than 2",
            "2 or more",
        ),
        (
            format!("[world]\ngravity = [0, 0, 0]\n{}{}", peg(""), contact("support = \"peg\"\nreach = §\"auto\"")),
            "contact.0.reach",
            "none of them moves",
            "write a length",
        ),
        (
            "[world]\ngravity = [0, 0, 0]\n[lattice]\ncell = [[1, 0, 0]]\n[[support]]\nname = \"peg\"\n\
             shape = §{ sphere = { radius = 0.1 } }\n"
                .to_owned(),
            "support.peg.shape",
            "do not see a support with a shape alike",
            "a plane",
        ),
    ];
    let fixed = "[[body]]\nname = \"floor\"\nshape = { box = { size = [2, 1, \"5 cm\"] } }\nmass = 1\n\
                 position = [0, 0, -1]\n§fixed = true\n";
    let rows = rows.into_iter().chain([(
        fixed.to_owned(),
        "body.floor.fixed",
        "a body that does not move is a support",
        "[[support]] with name = \"floor\", shape = { box = { size = [2.0, 1.0, \"5 cm\"] } }, position = [0.0, \
         0.0, -1.0]",
    )]);
    for (text, key, message, help) in rows {
        assert_error(&format!("{TIME}{text}{BALL}"), key, message, help);
    }
    let free = fixed.replace("fixed = true", "fixed = false");
    assert_error(&format!("{TIME}{free}{BALL}"), "body.floor.fixed", "", "a body is free to move");
}
