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
        ("drive = { torque = §\"2 N\" }".to_owned(), "drive.torque", "this is a torque", "0.1 N m"),
        (
            "drive = { torque = { sum = [{ sine = { amplitude = §\"2 N\", frequency = 5 } }] } }".to_owned(),
            "drive.torque.sum.0.sine.amplitude",
            "is a torque",
            "\"0.1 N m\"",
        ),
        (
            "drive = { torque = { ramp = { to = 3, duration = 1 } }, constants = §{ k = 1 } }".to_owned(),
            "drive.constants",
            "a signal has no constants",
            "leave them out",
        ),
        ("drive = { torque = { §sinus = 1 } }".to_owned(), "drive.torque.sinus", "unknown", "sine"),
        (
            "drive = { torque = { square = §{ amplitude = 3 } } }".to_owned(),
            "drive.torque.square.frequency",
            "missing",
            "Hz",
        ),
        (
            "drive = { torque = { table = { file = §\"q.csv\" } } }".to_owned(),
            "drive.torque.table.file",
            "cannot read the table",
            "relative to the folder of the scene",
        ),
        ("drive = { torque = §[1, 0, 0] }".to_owned(), "drive.torque", "found an array", "an expression"),
        (
            "drive = { torque = §{ sine = { amplitude = 1e200, frequency = 1 } } }".to_owned(),
            "drive.torque",
            "leaves the range",
            "smaller",
        ),
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

/// What is wrong with a scene, in words; nothing if it is right.
fn told(text: &str) -> String {
    Scene::parse("scene.toml", text, Path::new(""), &[]).map_or_else(|errors| errors.to_string(), |_| String::new())
}

/// The points of a ball joint are apart by digits, which are no length of a mass point.
#[test]
fn a_mass_point_on_a_ball_joint_starts_as_its_body_moves() {
    for angle in [0.0, 0.3, 0.31, 0.7, 1.0, -0.4] {
        let [x, z] = [0.1 * f64::cos(angle), -0.1 * f64::sin(angle)];
        let bodies = |velocity: &str| {
            format!(
                "{TIME}[[body]]\nname = \"rod\"\nshape = {{ box = {{ size = [0.2, 0.02, 0.02] }} }}\nmass = 1\n\
                 orientation = {{ axis_angle = {{ axis = [0, 1, 0], angle = {angle:?} }} }}\n[[body]]\n\
                 name = \"tip\"\nshape = {{ points = [{{ mass = 0.1, at = [0, 0, 0] }}] }}\n\
                 position = [{x:?}, 0, {z:?}]\nvelocity = {velocity}\n[[joint]]\nname = \"j\"\n\
                 between = [\"rod\", \"tip\"]\nkind = \"ball\"\npoints = [[0.1, 0, 0], [0, 0, 0]]\n"
            )
        };
        let found = told(&bodies("[0, 0, 3]"));
        assert!(found.contains("would part at 3e0 m/s"), "{angle}: {found}");
        assert_eq!(told(&bodies("[0, 0, 0]")), "", "{angle}");
    }
}

#[test]
fn velocities_and_places_of_the_smallest_bodies_are_held_to_the_same_digits() {
    for radius in [1e-2, 5e-6, 4e-10] {
        let ball = |velocity: &str| {
            let length = 10.0 * radius;
            format!(
                "{TIME}[[body]]\nname = \"a\"\nshape = {{ sphere = {{ radius = {radius:?} }} }}\ndensity = 1000\n\
                 velocity = {velocity}\n[[joint]]\nname = \"j\"\nbetween = [\"space\", \"a\"]\n\
                 kind = \"distance\"\npoints = [[0, 0, {length:?}], [0, 0, 0]]\n"
            )
        };
        assert!(told(&ball("[1, 0, 1e-6]")).contains("would part at"), "{radius}");
        assert_eq!(told(&ball("[1, 0, 0]")), "", "{radius}");
    }
    // A box of a tenth of a micrometre, turned about a line that is oblique to its axes.
    for angle in [0.3, 1.1, 2.0] {
        let text = format!(
            "{TIME}[[body]]\nname = \"a\"\nshape = {{ box = {{ size = [1e-8, 2e-8, 3e-8] }} }}\ndensity = 1000\n\
             orientation = {{ axis_angle = {{ axis = [1, 2, 3], angle = {angle:?} }} }}\n[[joint]]\n\
             name = \"j\"\nbetween = [\"space\", \"a\"]\nkind = \"weld\"\n"
        );
        assert_eq!(told(&text), "", "{angle}");
    }
}

#[test]
fn the_nearest_velocities_are_those_of_all_bodies_without_rounding() {
    let spinning = BOXES.replacen("mass = 1\n", "mass = 1\nangular_velocity = [1, 2, 3]\n", 1);
    let weld = "[[joint]]\nname = \"j\"\nbetween = [\"space\", \"a\"]\nkind = \"weld\"\n";
    let found = told(&format!("{TIME}{spinning}{weld}"));
    let still = "velocity = [0.0, 0.0, 0.0], angular_velocity = [0.0, 0.0, 0.0] of \"a\"";
    assert!(found.contains(still), "{found}");
    // Of three in a row the first moves: so does the last.
    let moving = BOXES.replacen("mass = 1\n", "mass = 1\nvelocity = [1, 0, 0]\n", 1);
    let third =
        "[[body]]\nname = \"c\"\nshape = { box = { size = [0.1, 0.1, 0.2] } }\nmass = 1\nposition = [0, 0, -0.4]\n";
    let second = BALL.replace("\"j\"", "\"k\"").replace("\"b\"", "\"c\"").replace("\"a\"", "\"b\"");
    let found = told(&format!("{TIME}{moving}{third}{BALL}{second}"));
    assert!(["\"a\"", "\"b\"", "\"c\""].iter().all(|name| found.contains(&format!("] of {name}"))), "{found}");
    // A straight row between two points that stand: no velocities are near.
    let [top, bottom] = [("top", "a", 0.1), ("bottom", "b", -0.3)].map(|(name, body, z)| {
        format!(
            "[[joint]]\nname = \"{name}\"\nbetween = [\"space\", \"{body}\"]\nkind = \"ball\"\n\
             points = [[0, 0, {z:?}], [0, 0, {:?}]]\n",
            if body == "a" { 0.1 } else { -0.1 }
        )
    });
    let found = told(&format!("{TIME}{moving}{BALL}{top}{bottom}"));
    assert!(found.contains("over-determined") && !found.contains("the nearest that do"), "{found}");
}

#[test]
fn a_support_that_turns_round_moves_by_rounding_only() {
    let text = format!(
        "{TIME}[[support]]\nname = \"hand\"\nplane = {{}}\nmotion = {{ oscillate = {{ direction = [1, 0, 0], amplitude \
         = 0.03, frequency = 2, phase = \"90 deg\" }} }}\n[[body]]\nname = \"bob\"\nshape = {{ sphere = {{ radius = \
         0.02 }} }}\ndensity = 1000\nposition = [0.03, 0, -0.2]\n[[joint]]\nname = \"j\"\nbetween = [\"hand\", \
         \"bob\"]\nkind = \"ball\"\npoints = [[0, 0, 0], [0, 0, 0.2]]\n"
    );
    Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
}

/// A parallelogram of two cranks and a coupler in the plane of x and z, whose last joint is written out.
fn parallelogram(last: &str) -> String {
    let link = |name: &str, [x, z]: [f64; 2], size: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nposition = [{x:?}, 0, {z:?}]\nshape = {{ box = {{ size = {size} }} }}\nmass \
                = 1\n"
        )
    };
    let hinge = |name: &str, between: [&str; 2], points: [[f64; 3]; 2]| {
        format!(
            "[[joint]]\nname = \"{name}\"\nbetween = {between:?}\nkind = \"hinge\"\naxis = [0, 1, 0]\npoints = \
                {points:?}\n"
        )
    };
    [
        TIME,
        &link("l", [0.0, -0.5], "[0.1, 0.1, 1]"),
        &link("c", [0.4, -1.0], "[0.8, 0.1, 0.1]"),
        &link("r", [0.8, -0.5], "[0.1, 0.1, 1]"),
        &hinge("A", ["space", "l"], [[0.0; 3], [0.0, 0.0, 0.5]]),
        &hinge("B", ["l", "c"], [[0.0, 0.0, -0.5], [-0.4, 0.0, 0.0]]),
        &hinge("C", ["c", "r"], [[0.4, 0.0, 0.0], [0.0, 0.0, -0.5]]),
        last,
    ]
    .concat()
}

#[test]
fn fourth_hinge_of_a_loop_in_a_plane_is_told_and_moves_as_the_fix_says() {
    let hinge = "§[[joint]]\nname = \"D\"\nbetween = [\"r\", \"space\"]\nkind = \"hinge\"\naxis = [0, 1, 0]\n\
                 points = [[0, 0, 0.5], [0.8, 0, 0]]\n";
    assert_error(&parallelogram(hinge), "joint.D", "3 of its 5 equations follow", "two distances");
    let distance = |name: &str, anchor: &str| {
        format!(
            "[[joint]]\nname = \"{name}\"\nbetween = [\"r\", \"space\"]\nkind = \"distance\"\n\
             points = [[0, 0, 0.5], {anchor}]\n"
        )
    };
    let loads = |text: &str| Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap();
    let fixed = loads(&parallelogram(&[distance("D", "[1.8, 0, 0]"), distance("E", "[0.8, 0, 1]")].concat()));
    let equations: usize = fixed.built().model.joints().iter().map(|joint| joint.rows().len()).sum();
    // 18 coordinates, of which one is free.
    assert_eq!(equations, 17);
    let ball = hinge.replacen("§", "", 1).replace("\"hinge\"\naxis = [0, 1, 0]", "\"ball\"");
    let text = parallelogram(&ball);
    let joint = text.find("name = \"C\"").unwrap();
    let (before, after) = text.split_at(joint);
    loads(&[before, &after.replacen("\"hinge\"\naxis = [0, 1, 0]", "\"ball\"", 1)].concat());
}

#[test]
fn joint_at_a_pin_is_told_to_take_its_place() {
    let pinned = BOXES.replacen("mass = 1\n", "mass = 1\npin = [0, 0, 0.1]\n", 1);
    let ball = "§[[joint]]\nname = \"j\"\nbetween = [\"a\", \"space\"]\nkind = \"ball\"\npoints = [[0, 0, 0.1], [0, \
        0, 0.1]]\n";
    assert_error(&format!("{TIME}{pinned}{ball}"), "joint.j", "3 of its 3 equations", "a pin holds a point already");
}

#[test]
fn signals_of_a_drive_are_those_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("u.csv"), "t, u\n0, 1\n2, 5\n").unwrap();
    let signal = |written: &str| {
        let hinge = "between = [\"a\", \"space\"]\nkind = \"hinge\"\naxis = [0, 1, 0]";
        let text = joint(&format!("{hinge}\ndrive = {{ torque = {written} }}"));
        let scene = Scene::parse("scene.toml", &text, folder.path(), &[]).unwrap();
        if !written.contains("table") {
            assert_resolves_to_itself(&scene);
        }
        scene.built().model.joints()[0].motor.signal().unwrap().clone()
    };
    let at = |written: &str, time: f64| signal(written).at(time)[(0, 0)];
    assert_eq!(at("{ constant = { value = \"30 N mm\" } }", 0.7), 0.03);
    assert_eq!(at("{ sine = { amplitude = 2, frequency = 5, phase = \"90 deg\" } }", 0.0), 2.0);
    assert_eq!(at("{ square = { amplitude = 2, frequency = 5 } }", 0.15), -2.0);
    assert_eq!(at("{ ramp = { to = 3, duration = \"2 s\" } }", 0.5), 0.75);
    assert_eq!(at("{ table = { file = \"u.csv\" } }", 0.5), 2.0);
    assert_eq!(at("{ sum = [{ constant = { value = 1 } }, { ramp = { from = 2, to = 3, duration = 1 } }] }", 0.5), 3.5);
}

#[test]
fn a_torque_may_have_a_unit() {
    let motor = |written: &str| {
        let hinge = "between = [\"a\", \"space\"]\nkind = \"hinge\"\naxis = [0, 1, 0]";
        let text = joint(&format!("{hinge}\ndrive = {{ torque = {written} }}"));
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
        assert_resolves_to_itself(&scene);
        scene.built().model.joints()[0].motor.clone()
    };
    assert_eq!(motor("\"-30 N cm\""), motor("-0.3"));
}

#[test]
fn reference_distance_of_a_stop_is_one_if_left_out() {
    let hinge = |d0: &str| {
        let text = format!(
            "{TIME}{BOXES}[[joint]]\nname = \"j\"\nbetween = [\"a\", \"space\"]\nkind = \"hinge\"\naxis = [0, 1, 0]\n\
             limits = [-1, 1]\nstop = {{ repulsion = {{ alpha = 1, nu = 2{d0} }}, damping = {{ beta = 1, nu = 2{d0} }} }}\n"
        );
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
        assert_resolves_to_itself(&scene);
        scene.built().model.joints()[0].motor.clone()
    };
    assert_eq!(hinge(""), hinge(", d0 = 1"));
    assert_ne!(hinge(""), hinge(", d0 = 0.1"));
}
