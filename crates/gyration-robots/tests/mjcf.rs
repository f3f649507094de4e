//! Orientations, inertias of geometry, defaults, several joints of a body, drives.

use crate::{imported, opened};
use gyration::tensor::{Mat3, Vec3};
use std::f64::consts::PI;

const BODY: &str = "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 2 2.5\"/>";

fn mujoco(head: &str, world: &str) -> String {
    format!("<mujoco>{head}<worldbody>{world}</worldbody></mujoco>")
}

/// P of a body that is turned so.
fn turned(head: &str, orientation: &str) -> Mat3 {
    let text = mujoco(head, &format!("<body name=\"a\" {orientation}><freejoint/>{BODY}</body>"));
    let scene = opened(&imported(&text));
    scene.built().state.motion(&scene.built().model, 0).placement.gradient
}

fn about(axis: usize, degrees: f64) -> Mat3 {
    let (s, c) = (degrees * PI / 180.0).sin_cos();
    match axis {
        0 => Mat3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
        1 => Mat3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
        _ => Mat3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
    }
}

#[test]
fn frames_are_turned_by_each_of_five_attributes() {
    let half = |degrees: f64| (degrees * PI / 360.0).sin_cos();
    let (s, c) = half(40.0);
    let radians = "<compiler angle=\"radian\"/>";
    let cases = [
        ("", format!("quat=\"{c} 0 {s} 0\""), about(1, 40.0)),
        ("", "axisangle=\"0 2 0 40\"".to_owned(), about(1, 40.0)),
        (radians, format!("axisangle=\"0 2 0 {}\"", 40.0 * PI / 180.0), about(1, 40.0)),
        // In turning axes: x, then y', then z''.
        ("", "euler=\"10 20 30\"".to_owned(), about(0, 10.0) * about(1, 20.0) * about(2, 30.0)),
        (
            "<compiler eulerseq=\"zyx\"/>",
            "euler=\"10 20 30\"".to_owned(),
            about(2, 10.0) * about(1, 20.0) * about(0, 30.0),
        ),
        (
            "<compiler eulerseq=\"XYZ\"/>",
            "euler=\"10 20 30\"".to_owned(),
            about(2, 30.0) * about(1, 20.0) * about(0, 10.0),
        ),
        ("", "xyaxes=\"0 3 0 -1 1 0\"".to_owned(), about(2, 90.0)),
        ("", "xyaxes=\"-1 0 0 0 1 0\"".to_owned(), about(1, 180.0)),
        ("", "zaxis=\"2 0 0\"".to_owned(), about(1, 90.0)),
        ("", "zaxis=\"0 0 -1\"".to_owned(), about(0, 180.0)),
    ];
    for (head, orientation, expected) in cases {
        let found = turned(head, &orientation);
        assert!((found - expected).norm() < 4e-15, "{orientation}: {found} {expected}");
    }
}

#[test]
fn frames_within_frames_add_up() {
    let text = mujoco(
        "",
        &format!(
            "<frame pos=\"1 0 0\" euler=\"0 0 90\"><frame pos=\"1 0 0\"><body name=\"a\" pos=\"0 1 0\"><freejoint/>{BODY}\
             <frame pos=\"0 0 1\"><geom size=\"0.1\"/></frame></body></frame></frame>"
        ),
    );
    let scene = opened(&imported(&text));
    let (model, placement) = (&scene.built().model, scene.built().state.motion(&scene.built().model, 0).placement);
    assert!((placement.position - Vec3::new(0.0, 1.0, 0.0)).norm() < 1e-15, "{}", placement.position);
    assert!((placement.gradient - about(2, 90.0)).norm() < 1e-15);
    // The ball is the shape, whose origin is its centre.
    assert_eq!(model.bodies[0].solid.mass.center, Vec3::new(0.0, 0.0, -1.0));
}

#[test]
fn inertias_come_of_geometry_where_none_is_written() {
    // Two balls on a capsule along x, by density and by mass, and a box that weighs nothing.
    let (density, radius, half) = (500.0, 0.1, 0.3);
    let text = mujoco(
        "",
        &format!(
            "<body name=\"a\"><freejoint/>\
             <geom type=\"capsule\" fromto=\"-{half} 0 0 {half} 0 0\" size=\"{radius}\" density=\"{density}\"/>\
             <geom pos=\"1 0 0\" size=\"0.2\" mass=\"3\"/><geom type=\"box\" size=\"1 1 1\" mass=\"0\"/></body>"
        ),
    );
    let scene = opened(&imported(&text));
    let mass = scene.built().model.bodies[0].solid.mass;
    // A cylinder and two half balls, whose centres of mass are 3/8 r beyond its ends.
    let (rod, ends) = (density * PI * radius * radius * 2.0 * half, density * 4.0 / 3.0 * PI * radius.powi(3));
    let capsule = rod + ends;
    assert!((mass.mass - capsule - 3.0).abs() < 1e-13, "{}", mass.mass);
    let center = 3.0 / (capsule + 3.0);
    assert!((mass.center.x - center).abs() < 1e-15 && mass.center.y.abs() < 1e-15, "{}", mass.center);
    let along = 0.5 * rod * radius * radius + 0.4 * ends * radius * radius;
    let across = rod * (radius * radius / 4.0 + half * half / 3.0)
        + ends * (0.4 * radius * radius + half * half + 0.75 * half * radius);
    let ball = 0.4 * 3.0 * 0.04;
    let expected = [along + ball, across + capsule * center * center + ball + 3.0 * (1.0 - center).powi(2)];
    let inertia = mass.inertia();
    assert!((inertia[(0, 0)] - expected[0]).abs() < 1e-14, "{inertia}");
    assert!((inertia[(1, 1)] - expected[1]).abs() < 1e-13, "{inertia} {expected:?}");
}

#[test]
fn defaults_hold_by_class_and_the_nearest_first() {
    let head = "<default><geom type=\"box\" size=\"0.1 0.1 0.1\" mass=\"1\"/>\
                <default class=\"big\"><geom size=\"0.2 0.2 0.2\"/><default class=\"heavy\"><geom mass=\"5\"/></default>\
                </default></default>";
    let text = mujoco(
        head,
        "<body name=\"a\"><freejoint/><geom/></body>\
         <body name=\"b\" childclass=\"big\"><freejoint/><geom/></body>\
         <body name=\"c\" childclass=\"big\"><freejoint/><geom class=\"heavy\"/></body>\
         <body name=\"d\" childclass=\"heavy\"><freejoint/><geom mass=\"7\"/></body>",
    );
    let scene = opened(&imported(&text));
    let solids = scene.built().model.bodies.iter().map(|body| (body.solid.mass.mass, body.solid.mass.volume));
    let found: Vec<_> = solids.map(|(mass, volume)| (mass, (volume * 1e3).round())).collect();
    assert_eq!(found, [(1.0, 8.0), (1.0, 64.0), (5.0, 64.0), (7.0, 64.0)]);
}

#[test]
fn several_joints_of_a_body_are_one_where_there_is_one() {
    let hinges =
        "<joint name=\"x\" axis=\"1 0 0\"/><joint name=\"y\" axis=\"0 1 0\"/><joint name=\"z\" axis=\"0 0 1\"/>";
    let ball = imported(&mujoco("", &format!("<body name=\"a\">{hinges}{BODY}</body>")));
    assert!(ball.scene.contains("kind = \"ball\"") && ball.left_out.is_empty(), "{}", ball.scene);
    opened(&ball);
    let planar = "<joint type=\"slide\" axis=\"1 0 0\"/><joint type=\"slide\" axis=\"0 0 1\"/><joint axis=\"0 1 0\"/>";
    let leg = "<body name=\"leg\"><joint name=\"hip\" axis=\"0 1 0\"/>".to_owned() + BODY + "</body>";
    let kept = imported(&mujoco("", &format!("<body name=\"a\">{planar}{BODY}{leg}</body>")));
    assert!(kept.scene.contains("keep = { plane = [0.0, 1.0, 0.0] }"), "{}", kept.scene);
    assert_eq!(opened(&kept).file().joint.len(), 1);
    let apart = hinges.replace("name=\"x\"", "name=\"x\" pos=\"0 0 1\"");
    let free = imported(&mujoco("", &format!("<body name=\"a\">{apart}{BODY}</body>")));
    assert_eq!(free.left_out.len(), 3);
    assert!(opened(&free).file().joint.is_empty());
}

#[test]
fn what_stands_in_the_world_is_a_support() {
    let text = mujoco(
        "<option gravity=\"0 0 -1.62\"/>",
        &format!(
            "<geom name=\"floor\" type=\"plane\" size=\"5 5 0.1\" pos=\"0 0 -1\" euler=\"0 90 0\"/>\
             <body name=\"post\" pos=\"1 0 0\"><geom type=\"cylinder\" size=\"0.1 0.5\"/>\
             <body name=\"arm\" pos=\"0 0 1\"><joint name=\"j\"/>{BODY}</body></body>"
        ),
    );
    let scene = opened(&imported(&text));
    let file = scene.file();
    assert_eq!(file.world.gravity.map(|entry| entry.0), [0.0, 0.0, -1.62]);
    let plane = file.support[0].plane.as_ref().unwrap();
    assert!((Vec3::from(plane.normal) - Vec3::x()).norm() < 1e-15, "{plane:?}");
    assert_eq!(file.support[1].position.map(|place| place.map(|entry| entry.0)), Some([1.0, 0.0, 0.0]));
    assert_eq!(file.joint[0].between, ["space".to_owned(), "arm".to_owned()]);
    assert_eq!(file.joint[0].points[0].map(|entry| entry.0), [1.0, 0.0, 1.0]);
}

/// A body on a joint that is driven.
fn driven(head: &str, joint: &str, actuators: &str) -> String {
    let world = format!("<body name=\"a\"><joint name=\"j\" {joint}/>{BODY}</body>");
    format!("<mujoco>{head}<worldbody>{world}</worldbody><actuator>{actuators}</actuator></mujoco>")
}

/// The torque of the drive of a scene, as it is written.
fn drive(joint: &str, actuators: &str) -> String {
    drive_of(&driven("", joint, actuators))
}

fn drive_of(text: &str) -> String {
    let import = imported(text);
    opened(&import);
    let line = import.scene.lines().find(|line| line.starts_with("drive")).unwrap();
    line.to_owned()
}

#[test]
fn springs_dashpots_and_actuators_are_drives() {
    let radians = PI / 180.0;
    let spring = drive("stiffness=\"3\" springref=\"30\" damping=\"0.5\"", "");
    let from = 30.0 * radians;
    assert_eq!(spring, format!("drive = {{ torque = \"-3.0*(angle - {from:?}) + -0.5*rate\" }}"));
    let motor = drive("type=\"slide\"", "<motor joint=\"j\" gear=\"20\"/>");
    assert_eq!(motor, "drive = { force = \"20.0*1.0*u\", constants = { u = 0 } }");
    let servo = drive("", "<position joint=\"j\" kp=\"4\" kv=\"0.1\" gear=\"2\" forcerange=\"-5 5\"/>");
    let law = "2.0*(max(-5.0, min(5.0, 4.0*u + -8.0*angle + -0.2*rate)))";
    assert_eq!(servo, format!("drive = {{ torque = \"{law}\", constants = {{ u = 0 }} }}"));
    let two = drive(
        "ref=\"90\"",
        "<velocity joint=\"j\" kv=\"2\"/><general joint=\"j\" biastype=\"affine\" biasprm=\"1 -2 0\"/>",
    );
    let reference = 90.0 * radians;
    let law = format!("2.0*u + -2.0*rate + 1.0*u_2 + 1.0*1 + -2.0*(angle + {reference:?})");
    assert_eq!(two, format!("drive = {{ torque = \"{law}\", constants = {{ u = 0, u_2 = 0 }} }}"));
}

/// What MuJoCo 3.17 and 4.0 compile of each: gain, and b₁ and b₂ of the bias.
#[test]
fn actuators_of_a_class_share_their_defaults() {
    let (servo, damper) = ("<position kp=\"4\" kv=\"2\"/>", "<velocity kv=\"3\"/>");
    let cases = [
        (servo, "", "general", [4.0, -4.0, -2.0]),
        (servo, "", "velocity", [1.0, 0.0, -1.0]),
        (servo, "", "motor", [1.0, 0.0, 0.0]),
        (servo, "<general gainprm=\"7\"/>", "position", [7.0, -7.0, -2.0]),
        (servo, "<general gainprm=\"7\"/>", "general", [7.0, -4.0, -2.0]),
        (servo, "<motor/>", "position", [4.0, -4.0, -2.0]),
        (servo, "<motor/>", "general", [1.0, 0.0, 0.0]),
        (servo, damper, "position", [4.0, -4.0, -2.0]),
        (servo, damper, "general", [3.0, 0.0, -3.0]),
        (damper, "<general/>", "position", [3.0, -3.0, -3.0]),
        ("<general gainprm=\"5\"/>", "", "velocity", [5.0, 0.0, -5.0]),
        ("<general biasprm=\"1 2 -3\"/>", "", "position", [1.0, -1.0, -3.0]),
        ("<general biasprm=\"1 2 -3\"/>", "", "general", [1.0, 0.0, 0.0]),
        ("<general dyntype=\"filter\"/>", "", "velocity", [1.0, 0.0, -1.0]),
    ];
    for (outer, inner, kind, [gain, by_length, by_rate]) in cases {
        let head = format!("<default>{outer}<default class=\"c\">{inner}</default></default>");
        let found = drive_of(&driven(&head, "", &format!("<{kind} joint=\"j\" class=\"c\"/>")));
        let terms = [(gain, "u"), (by_length, "angle"), (by_rate, "rate")];
        let terms: Vec<String> =
            terms.iter().filter(|(factor, _)| *factor != 0.0).map(|(factor, it)| format!("{factor:?}*{it}")).collect();
        let expected = format!("drive = {{ torque = \"{}\", constants = {{ u = 0 }} }}", terms.join(" + "));
        assert_eq!(found, expected, "{outer} {inner} {kind}");
    }
    // Those common to all actuators, of whatever element.
    let head = "<default><motor gear=\"5\" forcerange=\"-2 2\"/></default>";
    let found = drive_of(&driven(head, "", "<general joint=\"j\"/>"));
    assert_eq!(found, "drive = { torque = \"5.0*max(-2.0, min(2.0, 1.0*u))\", constants = { u = 0 } }");
    let muscle = imported(&driven("<default><muscle/></default>", "", "<general name=\"g\" joint=\"j\"/>"));
    assert!(muscle.left_out.iter().any(|finding| finding.what == "general \"g\""), "{:?}", muscle.left_out);
}

#[test]
fn a_range_of_force_without_width_limits_nothing() {
    let none = driven("", "", "<motor joint=\"j\" forcerange=\"0 0\"/>");
    assert_eq!(drive_of(&none), "drive = { torque = \"1.0*u\", constants = { u = 0 } }");
}

#[test]
fn each_actuator_of_a_joint_is_told_with_its_own_input() {
    let import = imported(&driven("", "", "<motor name=\"m\" joint=\"j\"/><motor name=\"n\" joint=\"j\"/>"));
    let told: Vec<&str> = import.chosen.iter().map(|finding| finding.what.as_str()).collect();
    for (actuator, input) in [("m", "u"), ("n", "u_2")] {
        let expected = format!("motor \"{actuator}\": its input is the constant `{input}` of the drive, zero");
        assert!(told.contains(&expected.as_str()), "{told:?}");
    }
}

#[test]
fn joints_and_inertials_stand_in_the_frames_around_them() {
    let joint = "<joint name=\"j\" axis=\"1 0 0\" pos=\"0 0 1\"/>";
    let inertial = "<inertial pos=\"1 0 0\" mass=\"1\" diaginertia=\"1 2 2.5\"/>";
    let frame = format!("<frame pos=\"1 2 3\" euler=\"0 0 90\">{joint}{inertial}</frame>");
    let import = imported(&mujoco("", &format!("<body name=\"a\">{frame}</body>")));
    assert!(import.left_out.is_empty(), "{:?}", import.left_out);
    let scene = opened(&import);
    let (built, joint) = (scene.built(), &scene.file().joint[0]);
    // As MuJoCo compiles it: joint at 1 2 4 along y, centre of mass at 1 3 3, moments 2, 1, 2.5.
    let axis = Vec3::from(joint.axis.unwrap());
    assert!((axis - Vec3::y()).norm() < 1e-15, "{axis}");
    assert_eq!(joint.points[0].map(|entry| entry.0), [1.0, 2.0, 4.0]);
    let placement = built.state.motion(&built.model, 0).placement;
    // Entries of a rotation by a quarter turn round to 2⁻⁵².
    assert!((placement.position - Vec3::new(1.0, 3.0, 3.0)).norm() < 1e-15, "{}", placement.position);
    let inertia = placement.gradient * built.model.bodies[0].solid.mass.inertia() * placement.gradient.transpose();
    assert!((inertia - Mat3::from_diagonal(&Vec3::new(2.0, 1.0, 2.5))).norm() < 1e-14, "{inertia}");
}

#[test]
fn directions_of_any_length_are_read() {
    for (orientation, expected) in [
        ("quat=\"1e-200 0 1e-200 0\"", about(1, 90.0)),
        ("axisangle=\"0 1e-200 0 40\"", about(1, 40.0)),
        ("zaxis=\"1e-200 0 0\"", about(1, 90.0)),
        ("xyaxes=\"0 3e-200 0 -1e200 1e200 0\"", about(2, 90.0)),
    ] {
        // A few roundings of numbers near one.
        assert!((turned("", orientation) - expected).norm() < 4e-15, "{orientation}");
    }
}

#[test]
fn gravity_that_is_switched_off_is_zero() {
    let body = format!("<body name=\"a\"><freejoint/>{BODY}</body>");
    let text = mujoco("<option gravity=\"0 0 -5\"><flag gravity=\"disable\"/></option>", &body);
    assert_eq!(opened(&imported(&text)).file().world.gravity.map(|entry| entry.0), [0.0; 3]);
}

#[test]
fn limits_are_told_from_the_reference() {
    let text = mujoco("", &format!("<body name=\"a\"><joint name=\"j\" range=\"-30 90\" ref=\"45\"/>{BODY}</body>"));
    let import = imported(&text);
    let limits = opened(&import).file().joint[0].limits.unwrap().map(|limit| limit.0);
    let expected = [-75.0, 45.0].map(|degrees: f64| degrees * PI / 180.0);
    assert!((0..2).all(|k| (limits[k] - expected[k]).abs() < 1e-15), "{limits:?}");
    assert!(
        import.chosen.iter().any(|finding| finding.what.contains("its coordinate in MuJoCo")),
        "{:?}",
        import.chosen
    );
    let loose = imported(&text.replace("range", "limited=\"false\" range"));
    assert!(opened(&loose).file().joint[0].limits.is_none());
}
