//! `[[joint]]`: what is refused, each at its exact place (`§`), with the fix; starts that are put right; forms.

use crate::common::{TABLE, TIME, assert_error, assert_resolves_to_itself};
use gyration_scene::Scene;
use std::path::Path;

/// Two boxes of 1 kg, 0.2 m long, one above the other.
const BOXES: &str = "[[body]]\nname = \"a\"\nshape = { box = { size = [0.1, 0.1, 0.2] } }\nmass = 1\n\
    [[body]]\nname = \"b\"\nshape = { box = { size = [0.1, 0.1, 0.2] } }\nmass = 1\nposition = [0, 0, -0.2]\n";

const BALL: &str =
    "[[joint]]\nname = \"j\"\nbetween = [\"a\", \"b\"]\nkind = \"ball\"\npoints = [[0, 0, -0.1], [0, 0, 0.1]]\n";

fn joint(lines: &str) -> String {
    format!("{TIME}{BOXES}[[joint]]\nname = \"j\"\n{lines}\n")
}

#[test]
fn what_cannot_be_joined_is_refused_with_the_fix() {
    let rows = [
        ("between = [\"a\", §\"c\"]\nkind = \"ball\"", "between.1", "no body or support \"c\"", "a, b, space"),
        ("between = [\"a\", §\"a\"]\nkind = \"ball\"", "between.1", "closes nothing", "two different"),
        ("between = [\"space\", §\"space\"]\nkind = \"ball\"", "between.1", "closes nothing", "name a body"),
        ("between = [\"a\", \"b\"]\nkind = §\"rope\"", "kind", "rope", "ball"),
        ("between = [\"a\", \"b\"]\nkind = \"ball\"\naxis = §[0, 0, 1]", "axis", "has no axis", "leave it out"),
        (
            "between = [\"a\", \"space\"]\nkind = \"ball\"\ndrive = §{ torque = 1 }",
            "drive",
            "leaves no one motion",
            "hinge",
        ),
        ("between = [\"a\", \"b\"]\nkind = \"hinge\"\naxis = §[0, 0, 0]", "axis", "is zero", "[0, 0, 1]"),
        (
            "between = [\"a\", \"b\"]\nkind = \"ball\"\npoints = §[[0, 0, -0.1], [0, 0, 0.2]]",
            "points",
            "apart by 1e-1 m",
            "write position = [0.0, 0.0, 0.1",
        ),
        (
            "between = [\"a\", \"space\"]\nkind = \"distance\"\npoints = §[[0, 0, 0.1], [0, 0, 0.1]]",
            "points",
            "a distance of zero",
            "\"ball\"",
        ),
        (
            "between = [\"a\", \"space\"]\nkind = \"slider\"\naxis = [1, 0, 0]\npoints = §[[0, 0, 0], [1, 0, 0.5]]",
            "points",
            "beside the axis, by 5e-1 m",
            "position",
        ),
    ];
    let stop = "stop = { repulsion = { alpha = 1, nu = 2, d0 = 0.1 } }";
    for (lines, key, message, help) in [
        ("limits = §[-1, 1]".to_owned(), "limits", "need a `stop`", "repulsion"),
        ("stop = §{ repulsion = { alpha = 1, nu = 2, d0 = 0.1 } }".to_owned(), "stop", "no", "limits"),
        (format!("limits = §[0.5, 1]\n{stop}"), "limits", "starts at 0.0", "around"),
        (format!("limits = §[-4, 1]\n{stop}"), "limits", "from −π to π", "180 deg"),
        (format!("limits = [§\"-3 cm\", 1]\n{stop}"), "limits.0", "is an angle", "\"30 deg\""),
        (format!("limits = §[1, -1]\n{stop}"), "limits", "nothing between them", "the least first"),
        (
            format!("limits = [-1, 1]\n{}", stop.replace("alpha = 1", "alpha = §\"3 N\"")),
            "stop.repulsion.alpha",
            "is a torque",
            "\"0.1 N m\"",
        ),
        ("drive = { force = §1 }".to_owned(), "drive.force", "driven by a torque", "`torque`"),
        ("drive = §{}".to_owned(), "drive", "no `torque`", "torque = 1"),
        ("drive = { torque = \"2*§speed\" }".to_owned(), "drive.torque", "speed", "Expressions"),
    ] {
        let hinge = format!("between = [\"a\", \"space\"]\nkind = \"hinge\"\naxis = [0, 1, 0]\n{lines}");
        assert_error(&joint(&hinge), &format!("joint.j.{key}"), message, help);
    }
    for (lines, key, message, help) in rows {
        assert_error(&joint(lines), &format!("joint.j.{key}"), message, help);
    }
    let missing = format!("{TIME}{BOXES}§[[joint]]\nname = \"j\"\nbetween = [\"a\", \"b\"]\nkind = \"slider\"\n");
    assert_error(&missing, "joint.j.axis", "is missing", "axes of the first");
    let support =
        format!("{TIME}{TABLE}{BOXES}[[joint]]\nname = \"j\"\nbetween = [\"space\", §\"table\"]\nkind = \"ball\"\n");
    assert_error(&support, "joint.j.between.1", "is a body: the joint closes nothing", "name a body");
    let space = BOXES.replacen("name = \"b\"", "name = \"space\"", 1);
    let text = format!("{TIME}{space}[[joint]]\nname = \"j\"\nbetween = [\"a\", §\"space\"]\nkind = \"ball\"\n");
    assert_error(&text, "joint.j.between.1", "is space itself", "another name");
    let twice = format!("{TIME}{BOXES}{BALL}{}", BALL.replace("\"j\"", "§\"j\""));
    assert_error(&twice, "joint.j.name", "occurs twice", "a name of its own");
    let again = format!("{TIME}{BOXES}{BALL}§{}", BALL.replace("\"j\"", "\"k\""));
    assert_error(&again, "joint.k", "3 of its 3 equations follow", "leave it out");
    let moving = BOXES.replacen("mass = 1\n", "mass = 1\nvelocity = [1, 0, 0]\n", 1);
    let parting = format!("{TIME}{moving}§{BALL}");
    assert_error(&parting, "joint.j", "would part at 1e0", "angular_velocity = [0.0, ");
}

#[test]
fn what_bodies_cannot_be_joined_by_is_refused() {
    let soft = BOXES.replacen("mass = 1\n", "mass = 1\naffine = {}\n", 1);
    let weld = format!("{TIME}{soft}[[joint]]\nname = \"j\"\nbetween = [§\"a\", \"b\"]\nkind = \"weld\"\n");
    assert_error(&weld, "joint.j.between.0", "deforms", "balls");
    let point = "[[body]]\nname = \"p\"\nshape = { points = [{ mass = 1, at = [0, 0, 0] }] }\n";
    let hinge = "[[joint]]\nname = \"j\"\nbetween = [§\"p\", \"space\"]\nkind = \"hinge\"\naxis = [0, 0, 1]\n";
    assert_error(&format!("{TIME}{point}{hinge}"), "joint.j.between.0", "mass point", "\"distance\"");
    let lattice = "[lattice]\ncell = [[1, 0, 0]]\n[world]\ngravity = [0, 0, 0]\n";
    assert_error(&format!("{TIME}{lattice}{BOXES}§{BALL}"), "joint.j", "in a lattice", "leave out");
    let fluid = "[fluid]\nviscosity = 1\ndensity = 1\n";
    let immersed =
        "[[body]]\nname = \"s\"\nshape = { sphere = { radius = 0.1 } }\nmass = 1\ninclusion = { inertia = false }\n";
    let ball = "[[joint]]\nname = \"j\"\nbetween = [§\"s\", \"space\"]\nkind = \"ball\"\n";
    assert_error(&format!("{TIME}{fluid}{immersed}{ball}"), "joint.j.between.0", "no inertia", "spring");
}

#[test]
fn a_start_within_digits_of_its_joints_is_put_on_them() {
    let near = BALL.replace("[0, 0, 0.1]", "[0, 1e-11, 0.10000000002]");
    let text = format!("{TIME}{BOXES}{near}");
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    assert_resolves_to_itself(&scene);
    let built = scene.built();
    let misfits = gyration::dynamics::Workspace::default().joint_misfits(&built.model, &built.state).unwrap();
    assert!(misfits[0].place < 1e-16, "{misfits:?}");
    assert_eq!((built.model.joints().len(), &*built.model.joints()[0].name), (1, "j"));
}
