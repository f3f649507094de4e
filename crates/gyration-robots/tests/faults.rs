//! What is wrong with a file is told with its line; nothing panics on whatever stands in one.

use crate::{refused, tried};

const URDF: &str = include_str!("files/double-pendulum.urdf");
const MJCF: &str = include_str!("files/double-pendulum.xml");

/// The fault of a text in which a part is another.
fn of_change(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    refused(&text.replacen(from, to, 1)).join("\n")
}

#[test]
fn malformed_xml_is_told_with_its_line() {
    let told = of_change(URDF, "<parent link=\"world\"/>", "<parent link=\"world\">");
    assert!(told.starts_with("10: it is no XML"), "{told}");
    let told = refused("hello");
    assert!(told[0].starts_with("1: it is no XML"), "{told:?}");
    let told = refused("<sdf version=\"1.6\"/>");
    assert_eq!(told, ["1: the first element is <sdf>, of neither URDF (<robot>) nor MJCF (<mujoco>)"]);
}

#[test]
fn links_that_are_missing_or_double_are_told() {
    let told = of_change(URDF, "<parent link=\"thigh\"/>", "<parent link=\"thigj\"/>");
    assert_eq!(told, "22: the joint \"lower\" names the parent \"thigj\", which is no link");
    let told = of_change(URDF, "<child link=\"shin\"/>", "");
    assert_eq!(told, "22: the joint \"lower\" has no child");
    let told = of_change(URDF, "<link name=\"shin\">", "<link name=\"thigh\">");
    assert!(told.contains("28: the link \"thigh\" occurs twice, first in line 11"), "{told}");
    let told = of_change(URDF, "<link name=\"world\"/>", "<link name=\"world\"/><link name=\"moon\"/>");
    assert_eq!(told, "4: \"world\" and \"moon\" have no parents: a robot has one root");
}

#[test]
fn loops_are_told() {
    let again = "<joint name=\"again\" type=\"fixed\"><parent link=\"world\"/><child link=\"shin\"/></joint></robot>";
    let told = of_change(URDF, "</robot>", again);
    assert!(told.contains("the link \"shin\" is the child of two joints") && told.contains("a loop"), "{told}");
    let told = of_change(URDF, "<parent link=\"thigh\"/>", "<parent link=\"shin\"/>");
    assert!(told.starts_with("22: the joint \"lower\" joins the link \"shin\" to itself"), "{told}");
    let told = of_change(URDF, "<parent link=\"world\"/>", "<parent link=\"shin\"/>");
    assert!(told.starts_with("11: the joints go round in a circle: no root leads to thigh, shin"), "{told}");
}

#[test]
fn masses_that_no_body_has_are_told() {
    let told = of_change(URDF, "<mass value=\"1\"/>", "<mass value=\"-1\"/>");
    assert_eq!(told, "12: inertial of link \"thigh\": the mass is -1.0 kg");
    let told = of_change(URDF, "izz=\"0.002\"", "izz=\"0.2\"");
    assert!(told.contains("no body has these principal moments of inertia: 2.2e-2, 2.2e-2, 2e-1 kg m²"), "{told}");
    let told = of_change(
        URDF,
        "ixx=\"0.022\" ixy=\"0\" ixz=\"0\" iyy=\"0.022\" iyz=\"0\" izz=\"0.002\"",
        "ixx=\"0\" iyy=\"0\" izz=\"0\"",
    );
    assert_eq!(told, "11: \"thigh\" has a mass and no inertia: a joint turns it");
    let told = of_change(URDF, " iyy=\"0.022\"", "");
    assert_eq!(told, "15: inertia of link \"thigh\": the attribute \"iyy\" is missing");
    let without = URDF.replacen("<mass value=\"1\"/>", "<mass value=\"0\"/>", 1);
    assert_eq!(refused(&without), ["11: \"thigh\" moves, carries others, and has no mass"]);
    let told = of_change(MJCF, "mass=\"0.7\"", "mass=\"-0.7\"");
    assert!(told.contains("the mass is -0.7 kg"), "{told}");
}

#[test]
fn numbers_that_are_none_are_told() {
    let told = of_change(URDF, "xyz=\"0 0 -0.5\"", "xyz=\"0 0 ${-l}\"");
    assert!(told.contains("\"${-l}\" is no number"), "{told}");
    assert!(tried(&URDF.replacen("0 0 -0.5", "0 ${l} 0", 1)).unwrap_err().to_string().contains("xacro"));
    let told = of_change(URDF, "xyz=\"0 1 0\"", "xyz=\"0 0 0\"");
    assert!(told.contains("xyz is zero"), "{told}");
    let told = of_change(URDF, "rpy=\"0 -2 0\"", "rpy=\"0 -2\"");
    assert!(told.contains("has 2 numbers, not 3"), "{told}");
    let told = of_change(URDF, "radius=\"0.02\"", "radius=\"0\"");
    assert!(told.contains("a length is 0.0 m"), "{told}");
    let told = of_change(URDF, "type=\"continuous\"", "type=\"screw\"");
    assert!(told.contains("\"screw\", which is not known"), "{told}");
    let told = of_change(MJCF, "axisangle=\"0 1 0 -2\"", "axisangle=\"0 1 0 inf\"");
    assert!(told.contains("\"inf\" is no number"), "{told}");
    let told = of_change(MJCF, "eulerseq=\"XYZ\"", "eulerseq=\"XY\"");
    assert!(told.contains("eulerseq"), "{told}");
    let huge = URDF.replace("xyz=\"0 0 0\"", "xyz=\"0 1.7e308 0\"").replace("0 0 -0.5", "0 1.7e308 0");
    assert!(refused(&huge)[0].contains("leave their range"));
}

#[test]
fn a_body_within_another_is_not_free_of_it() {
    let model = |inside: &str| {
        format!(
            "<mujoco><worldbody><body name=\"a\"><freejoint/><geom size=\"1\"/>{inside}<geom size=\"1\"/></body></body>\
             </worldbody></mujoco>"
        )
    };
    for joint in ["<freejoint/>", "<joint type=\"free\"/>"] {
        let told = refused(&model(&format!("<body name=\"b\">{joint}")));
        assert_eq!(told, ["1: body \"b\": a body within another cannot be free of it"]);
    }
    assert!(tried(&model("<body name=\"b\"><joint/>")).is_ok());
}

#[test]
fn geometry_without_a_shape_or_a_size_is_told() {
    let cylinder = "<cylinder radius=\"0.02\" length=\"0.5\"/>";
    for (shape, expected) in [
        ("<box/>", "19: box of link \"thigh\": the attribute \"size\" is missing"),
        ("<mesh/>", "19: mesh of link \"thigh\": the attribute \"filename\" is missing"),
        ("", "19: geometry of link \"thigh\" has no shape"),
    ] {
        assert_eq!(of_change(URDF, cylinder, shape), expected);
    }
}

#[test]
fn words_that_are_no_keywords_are_told() {
    let compiler = "angle=\"radian\" eulerseq=\"XYZ\"";
    for (name, word) in [
        ("angle", "radians"),
        ("coordinate", "world"),
        ("autolimits", "no"),
        ("strippath", "1"),
        ("inertiafromgeom", "yes"),
    ] {
        let told = of_change(MJCF, compiler, &format!("{name}=\"{word}\""));
        assert_eq!(told, format!("3: compiler: {name} = \"{word}\" is no keyword"));
    }
    let told = of_change(MJCF, "<joint name=\"upper\"", "<joint name=\"upper\" limited=\"yes\" range=\"-1 1\"");
    assert_eq!(told, "14: joint \"upper\": limited = \"yes\" is no keyword");
    let motor = "<actuator><motor joint=\"upper\" forcelimited=\"on\"/></actuator></mujoco>";
    let told = of_change(MJCF, "</mujoco>", motor);
    assert!(told.contains("forcelimited = \"on\" is no keyword"), "{told}");
    let flag = "<option gravity=\"0 0 -9.81\"><flag gravity=\"off\"/></option>";
    let told = of_change(MJCF, "<option gravity=\"0 0 -9.81\"/>", flag);
    assert!(told.contains("gravity = \"off\" is no keyword"), "{told}");
}

#[test]
fn what_an_mjcf_names_must_be_there() {
    let told = of_change(MJCF, "childclass=\"shin\"", "childclass=\"chin\"");
    assert!(told.contains("there is no class \"chin\" of defaults"), "{told}");
    let told = of_change(MJCF, "</mujoco>", "<actuator><motor joint=\"knee\"/></actuator></mujoco>");
    assert!(told.contains("acts on the joint \"knee\", which is not there"), "{told}");
    let told = of_change(MJCF, "<worldbody>", "<include file=\"more.xml\"/><worldbody>");
    assert!(told.contains("files that are included are not read"), "{told}");
    let told = of_change(MJCF, "name=\"shin\"", "name=\"thigh\"");
    assert!(told.contains("the body \"thigh\" occurs twice"), "{told}");
    let told = of_change(MJCF, "angle=\"radian\"", "coordinate=\"global\"");
    assert!(told.contains("\"global\" is not read"), "{told}");
    assert_eq!(refused("<mujoco/>"), ["1: no body moves"]);
}

/// Every beginning of a file, and every file with a byte less, ends with a scene or with faults.
#[test]
fn files_that_are_cut_or_damaged_never_panic() {
    let others = [include_str!("files/nothing-maps.urdf"), include_str!("files/nothing-maps.xml")];
    let mut sound = 0;
    for text in [URDF, MJCF].into_iter().chain(others) {
        let places = text.char_indices().map(|(at, letter)| (at, at + letter.len_utf8()));
        for (start, end) in places {
            assert!(start >= text.trim_end().len() || tried(&text[..start]).is_err());
            sound += usize::from(tried(&format!("{}{}", &text[..start], &text[end..])).is_ok());
            let _ = tried(&format!("{}9{}", &text[..start], &text[end..]));
        }
    }
    // A blank less leaves a file as good as it was.
    assert!(sound > 100, "{sound}");
}

#[test]
fn a_file_that_nests_without_end_is_refused() {
    let bodies = 5000;
    let body = "<body><joint/><geom size=\"1\"/>";
    let text = format!("<mujoco><worldbody>{}{}</worldbody></mujoco>", body.repeat(bodies), "</body>".repeat(bodies));
    assert!(refused(&text)[0].contains("bodies stand in one another"));
    let text = format!("<mujoco>{}{}</mujoco>", "<default class=\"a\">".repeat(bodies), "</default>".repeat(bodies));
    assert_eq!(refused(&text), ["1: no body moves"]);
}
