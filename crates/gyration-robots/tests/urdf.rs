//! Links without mass, links that stand still, limits, geometry.

use crate::{here, imported, opened};
use gyration_robots::{Import, Options, import, import_text};
use std::fs;
use std::path::Path;

const INERTIAL: &str = "<inertial><mass value=\"2\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\"/></inertial>";
const BALL: &str = "<geometry><sphere radius=\"0.1\"/></geometry>";

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], inside: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin xyz=\"0 0 1\"/>{inside}</joint>"
    )
}

fn robot(content: &str) -> String {
    format!("<robot name=\"r\">{content}</robot>")
}

fn says(import: &Import, what: &str) -> bool {
    import.chosen.iter().any(|finding| format!("{}: {}", finding.what, finding.why).contains(what))
}

#[test]
fn links_without_mass_are_part_of_what_they_are_fixed_to() {
    // The first of the group has no mass, and what moves hangs on a link without mass, too.
    let text = robot(
        &(format!(
            "<link name=\"foot\"/><link name=\"base\">{INERTIAL}</link><link name=\"mount\"/>\
                   <link name=\"arm\">{INERTIAL}</link>\
                   <link name=\"tool\"><collision>{BALL}</collision></link>"
        ) + &joint("a", "fixed", ["foot", "mount"], "")
            + &joint("b", "revolute", ["mount", "arm"], "<axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\"/>")
            + &joint("c", "fixed", ["arm", "tool"], "")
            + &joint("d", "fixed", ["foot", "base"], "")),
    );
    let import = imported(&text);
    assert!(says(&import, "moves freely; --fixed-base"), "{:?}", import.chosen);
    let scene = opened(&import);
    let file = scene.file();
    let names: Vec<&str> = file.body.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["base", "arm"]);
    assert_eq!(file.joint.len(), 1);
    assert_eq!(file.joint[0].between, ["base".to_owned(), "arm".to_owned()]);
    // The mount is 1 m above the foot, the arm 1 m above that; the base is where the mount is.
    assert_eq!(file.joint[0].points.map(|point| point.map(|entry| entry.0)), [[0.0, 0.0, 1.0], [0.0; 3]]);
    // The tool is a ball 1 m above the arm; its body has the centre of mass of the arm.
    assert!(import.scene.contains("shape = { sphere = { radius = 0.1 } }"), "{}", import.scene);
    assert!(import.scene.contains("center = [0.0, 0.0, -1.0]"), "{}", import.scene);
}

#[test]
fn a_base_stands_still_where_it_is_asked_to() {
    let text = robot(
        &(format!(
            "<link name=\"base\">{INERTIAL}<collision>{BALL}</collision></link><link name=\"arm\">{INERTIAL}</link>"
        ) + &joint("j", "prismatic", ["base", "arm"], "<axis xyz=\"1 0 0\"/><limit lower=\"-0.5\" upper=\"0.5\"/>")),
    );
    assert_eq!(opened(&imported(&text)).file().body.len(), 2);
    let fixed = Options { is_base_fixed: true, ..here() };
    let import = import_text("robot.urdf", &text, Path::new(""), fixed).unwrap();
    let scene = opened(&import);
    let file = scene.file();
    assert_eq!((file.body.len(), file.support.len()), (1, 1));
    assert_eq!(file.joint[0].between, ["space".to_owned(), "arm".to_owned()]);
    assert!(says(&import, "--fixed-base"), "{:?}", import.chosen);
    // The stop of a slider pushes with the weight, 2 kg · 9.81 m/s², at a hundredth of a metre.
    assert!(import.scene.contains("alpha = 19.62, nu = 4, d0 = 0.01"), "{}", import.scene);
}

#[test]
fn a_link_that_floats_is_joined_to_nothing_and_one_in_a_plane_is_kept_there() {
    let text = |kind: &str| {
        robot(
            &(format!("<link name=\"world\"/><link name=\"a\">{INERTIAL}</link>")
                + &joint("j", kind, ["world", "a"], "<axis xyz=\"0 0 2\"/>")),
        )
    };
    let floats = imported(&text("floating"));
    assert!(opened(&floats).file().joint.is_empty());
    let kept = imported(&text("planar"));
    assert!(kept.scene.contains("keep = { plane = [0.0, 0.0, 1.0] }"), "{}", kept.scene);
    opened(&kept);
    assert!(kept.left_out.is_empty(), "{:?}", kept.left_out);
}

#[test]
fn names_are_those_of_a_scene() {
    let text = robot(
        &(format!(
            "<link name=\"world\"/><link name=\"space\">{INERTIAL}</link><link name=\"a b\">{INERTIAL}</link>\
                   <link name=\"a_b\">{INERTIAL}</link>"
        ) + &joint("j/1", "ball", ["world", "space"], "")
            + &joint("k", "ball", ["space", "a b"], "")
            + &joint("l", "ball", ["space", "a_b"], "")),
    );
    let import = imported(&text);
    let scene = opened(&import);
    let names: Vec<&str> = scene.file().body.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["space-2", "a_b", "a_b-2"]);
    assert_eq!(scene.file().joint[0].name, "j_1");
    assert!(says(&import, "\"a b\" is called \"a_b\""), "{:?}", import.chosen);
}

/// A tetrahedron of edge 1 along the axes, in centimetres.
const TETRAHEDRON: &str = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn meshes_are_found_in_packages_and_told_from_the_folder_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("arm_description");
    fs::create_dir_all(package.join("urdf")).unwrap();
    fs::create_dir_all(package.join("meshes")).unwrap();
    fs::write(package.join("meshes/a.obj"), TETRAHEDRON).unwrap();
    fs::write(package.join("meshes/open.obj"), TETRAHEDRON.replace("f 2 3 4\n", "")).unwrap();
    let mesh = |file: &str| {
        format!("<collision><geometry><mesh filename=\"{file}\" scale=\"0.01 0.01 0.01\"/></geometry></collision>")
    };
    let link = |name: &str, file: &str| format!("<link name=\"{name}\">{INERTIAL}{}</link>", mesh(file));
    let content = "<link name=\"world\"/>".to_owned()
        + &link("a", "package://arm_description/meshes/a.obj")
        + &link("b", "../meshes/a.obj")
        + &link("c", "../meshes/open.obj")
        + &link("d", "package://elsewhere/a.obj")
        + &["a", "b", "c", "d"].map(|name| joint(&format!("to-{name}"), "floating", ["world", name], "")).concat();
    let path = package.join("urdf/arm.urdf");
    fs::write(&path, robot(&content)).unwrap();
    let made = import(&path, Options { folder: &package, is_base_fixed: false }).unwrap();
    assert!(made.scene.contains("mesh = { file = \"meshes/a.obj\", scale = 0.01 }"), "{}", made.scene);
    let told: Vec<String> = made.left_out.iter().map(|finding| finding.what.clone() + ": " + &finding.why).collect();
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told[0].contains("open.obj") && told[0].contains("triangles"), "{told:?}");
    assert!(told[1].contains("no such file in the package"), "{told:?}");
    let scene = gyration_scene::Scene::parse("scene.toml", &made.scene, &package, &[]);
    let scene = scene.unwrap_or_else(|errors| panic!("{errors}\n{}", made.scene));
    let volume = scene.built().model.bodies[0].solid.mass.volume;
    assert!((volume - 1.0 / 6.0).abs() < 1e-15, "{volume}");
}
