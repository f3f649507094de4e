//! Whatever has no counterpart is listed with its line, and stands at the head of the scene.

use crate::{imported, opened};
use gyration_robots::Finding;

const URDF: &str = include_str!("files/nothing-maps.urdf");
const MJCF: &str = include_str!("files/nothing-maps.xml");

/// The line in which a text stands once.
fn line_of(text: &str, part: &str) -> usize {
    let lines: Vec<usize> =
        text.lines().enumerate().filter(|(_, line)| line.contains(part)).map(|(at, _)| at + 1).collect();
    assert_eq!(lines.len(), 1, "{part}: {lines:?}");
    lines[0]
}

fn lists(findings: &[Finding], line: usize, what: &str, why: &str) {
    let found =
        |finding: &&Finding| finding.line == Some(line) && finding.what.contains(what) && finding.why.contains(why);
    assert!(findings.iter().any(|finding| found(&finding)), "{line} {what} {why}: {findings:#?}");
}

#[test]
fn what_no_scene_has_of_a_urdf_is_listed_with_its_line() {
    let import = imported(URDF);
    let wanted = [
        ("<material name", "material", "looks"),
        ("arm.dae", "visual", "collision"),
        ("arm.stl", "arm.stl", "scale"),
        ("<verbose", "verbose", "[[contact]]"),
        ("lower=\"-6\"", "limits -6.0, 6.0", "from −π to π"),
        ("lower=\"-6\"", "effort = \"10\"", "drive"),
        ("lower=\"-6\"", "velocity = \"3\"", "controller"),
        ("friction=\"0.2\"", "friction = \"0.2\"", "dry friction"),
        ("<safety_controller", "safety_controller", "controller"),
        ("<calibration", "calibration", "sensors"),
        ("<mimic", "mimic", "moves freely"),
        ("type=\"planar\"", "glide", "moves freely"),
        ("damping=\"0.1\"", "damping = \"0.1\"", "no coordinate"),
        ("<link name=\"tip\"", "tip", "mass"),
        ("<transmission", "transmission", "drive"),
        ("<gazebo", "gazebo", "Gazebo"),
    ];
    for (place, what, why) in wanted {
        // Limits are told at their joint.
        let place = if what.starts_with("limits") { "type=\"revolute\"" } else { place };
        lists(&import.left_out, line_of(URDF, place), what, why);
    }
    lists(&import.left_out, line_of(URDF, "type=\"prismatic\""), "limits 0.0, 0.05", "starts at zero");
    // Products of inertia that are not written.
    lists(&import.chosen, 18, "ixy = ixz = iyz = 0", "does not say");
    for finding in import.left_out.iter().chain(&import.chosen) {
        assert!(import.scene.contains(&format!("# - {finding}\n")), "{finding}");
    }
    // Damping is what maps of all this.
    assert!(import.scene.contains("drive = { torque = \"-0.5*rate\" }"), "{}", import.scene);
    let scene = opened(&import);
    assert_eq!(scene.file().body.len(), 3);
    assert_eq!(scene.file().joint.len(), 2);
}

#[test]
fn what_no_scene_has_of_an_mjcf_is_listed_with_its_line() {
    let import = imported(MJCF);
    let wanted = [
        ("balanceinertia", "balanceinertia", "inertias"),
        ("timestep", "timestep", "tolerance"),
        ("timestep", "integrator", "tolerance"),
        ("timestep", "density", "fluid"),
        ("timestep", "contact = \"disable\"", "[[contact]]"),
        ("<size", "size", "MuJoCo"),
        ("<visual>", "quality", "looks"),
        ("armature=", "armature = \"0.1\"", "rotors"),
        ("friction=\"1", "friction", "[[contact]]"),
        ("<site size", "site", "point without mass"),
        ("<texture", "texture", "looks"),
        ("<light", "light", "looks"),
        ("\"hills\" type", "hfield", "height fields"),
        ("frictionloss", "frictionloss", "dry friction"),
        ("frictionloss", "solreflimit", "stop"),
        ("frictionloss", "limits 0.0, 1.0", "starts at zero"),
        ("rgba=", "rgba", "looks"),
        ("rgba=", "solref", "[[contact]]"),
        ("name=\"soft\"", "soft", "no file"),
        ("<site name", "tip", "point without mass"),
        ("<camera", "eye", "looks"),
        ("gravcomp", "gravcomp", "force"),
        ("name=\"bend\"", "bend", "moves freely"),
        ("name=\"turn\"", "turn", "moves freely"),
        ("name=\"socket\"", "range", "no limits"),
        ("name=\"socket\"", "stiffness", "no coordinate"),
        ("<exclude", "exclude", "[[contact]]"),
        ("<connect", "connect", "[[joint]]"),
        ("name=\"cord\"", "cord", "tendons"),
        ("<muscle", "muscle", "counterpart"),
        ("on-tendon", "on-tendon", "no joint"),
        ("on-two", "on-two", "no hinge or slide"),
        ("timeconst", "timeconst", "no state"),
        ("dyntype", "general", "without a state"),
        ("<gyro", "imu", "no sensors"),
        ("<key ", "home", "starts"),
    ];
    for (place, what, why) in wanted {
        lists(&import.left_out, line_of(MJCF, place), what, why);
    }
    for finding in import.left_out.iter().chain(&import.chosen) {
        assert!(import.scene.contains(&format!("# - {finding}\n")), "{finding}");
    }
    let scene = opened(&import);
    assert_eq!(scene.file().body.len(), 3);
    assert_eq!(scene.file().joint.len(), 2);
}

#[test]
fn defaults_and_ranges_that_a_joint_cannot_have_are_listed() {
    let text = "<mujoco><compiler autolimits=\"false\"/>\n\
                <default><joint stiffness=\"3\" damping=\"2\" range=\"0 1\"/></default>\n<worldbody>\n\
                <body name=\"a\"><joint name=\"f\" type=\"free\"/><geom size=\"1\"/>\n\
                <body name=\"b\"><joint name=\"s\" type=\"ball\" damping=\"1\"/><geom size=\"1\"/></body>\n\
                <body name=\"c\"><joint name=\"h\" range=\"-1 1\"/><geom size=\"1\"/></body></body>\n\
                </worldbody><actuator><motor name=\"m\" joint=\"h\" forcerange=\"-1 1\"/></actuator></mujoco>";
    let import = imported(text);
    for (line, what, why) in [
        (4, "\"f\": stiffness of its defaults", "no coordinate"),
        (4, "\"f\": damping of its defaults", "no coordinate"),
        (4, "\"f\": range of its defaults", "no limits"),
        (5, "\"s\": stiffness of its defaults", "no coordinate"),
        (5, "\"s\": damping = \"1\"", "no coordinate"),
        (5, "\"s\": range of its defaults", "no limits"),
        (6, "\"h\": range = \"-1.0 1.0\"", "limits nothing"),
        (7, "\"m\": forcerange = \"-1.0 1.0\"", "limits nothing"),
    ] {
        lists(&import.left_out, line, what, why);
    }
    assert_eq!(import.left_out.len(), 8, "{:#?}", import.left_out);
}

#[test]
fn an_attribute_that_nobody_knows_is_listed_wherever_it_stands() {
    for text in [include_str!("files/double-pendulum.urdf"), include_str!("files/double-pendulum.xml")] {
        let before = imported(text).left_out.len();
        let tags: Vec<usize> = text.match_indices(['>']).map(|(at, _)| at).collect();
        let mut tried = 0;
        for end in tags {
            let end = if text[..end].ends_with('/') { end - 1 } else { end };
            let start = text[..end].rfind('<').unwrap();
            if text[start..].starts_with("</") || text[start..].starts_with("<?") || text[start..].starts_with("<!") {
                continue;
            }
            let changed = format!("{} unheard-of=\"1\"{}", &text[..end], &text[end..]);
            let import = imported(&changed);
            let listed = import.left_out.iter().filter(|finding| finding.what.contains("unheard-of")).count();
            assert_eq!((listed, import.left_out.len()), (1, before + 1), "{changed}");
            let closed = format!("{}<unheard-of/>", &text[..start]) + &text[start..];
            // Before the first element, or behind its start, it is no element of the file.
            if text[..start].contains("<robot") || text[..start].contains("<mujoco") {
                let import = imported(&closed);
                let listed = import.left_out.iter().filter(|finding| finding.what.contains("unheard-of")).count();
                assert_eq!(listed, 1, "{closed}");
            }
            tried += 1;
        }
        assert!(tried > 10, "{tried}");
    }
}

#[test]
fn elements_that_are_written_again_are_listed() {
    for (text, part) in [
        (URDF, "<axis xyz=\"0 0 1\"/>"),
        (URDF, "<mass value=\"1\"/>"),
        (URDF, "<limit lower=\"-6\" upper=\"6\" effort=\"10\" velocity=\"3\"/>"),
        (include_str!("files/double-pendulum.urdf"), "<origin xyz=\"0 0 -0.5\" rpy=\"0 0.8 0\"/>"),
        (include_str!("files/double-pendulum.urdf"), "<geometry><cylinder radius=\"0.02\" length=\"0.5\"/></geometry>"),
        (include_str!("files/double-pendulum.urdf"), "<cylinder radius=\"0.02\" length=\"0.5\"/>"),
        (
            include_str!("files/double-pendulum.xml"),
            "<inertial pos=\"0 0 -0.25\" mass=\"1\" diaginertia=\"0.022 0.022 0.002\"/>",
        ),
    ] {
        let twice = imported(&text.replacen(part, &format!("{part}{part}"), 1));
        let listed = twice.left_out.iter().filter(|finding| finding.what.contains("a second ")).count();
        assert_eq!(listed, 1, "{part}: {:?}", twice.left_out);
    }
}
