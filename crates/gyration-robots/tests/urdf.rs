//! Links without mass, links that stand still, limits, geometry.

use crate::{here, imported, opened};
use gyration::tensor::{Mat3, Vec3};
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

/// A pendulum whose limits are near the start: it hung at rest in its stop, with an energy of 310 J there.
#[test]
fn stops_hardly_push_where_a_joint_starts() {
    for [low, high] in [[-0.001, 2.0], [-2.0, 1e-9], [-1.0, 1.0]] {
        let limit = format!("<axis xyz=\"0 1 0\"/><limit lower=\"{low:?}\" upper=\"{high:?}\"/>");
        let links = format!("<link name=\"world\"/><link name=\"a\">{INERTIAL}</link>");
        let import = imported(&robot(&(links + &joint("j", "revolute", ["world", "a"], &limit))));
        opened(&import);
        let (_, behind) = import.scene.split_once("nu = 4, d0 = ").unwrap();
        let distance: f64 = behind.split(' ').next().unwrap().parse().unwrap();
        let push = |gap: f64| (gap / distance).powi(-4);
        // Of the weight at the radius of gyration.
        assert!((push(high) - push(-low)).abs() < 1e-6, "{low} {high}: {distance}");
    }
}

#[test]
fn limits_of_pi_with_some_digits_are_limits_of_pi() {
    let limits = |upper: &str| {
        let limit = format!("<limit lower=\"-{upper}\" upper=\"{upper}\"/>");
        let links = format!("<link name=\"world\"/><link name=\"a\">{INERTIAL}</link>");
        let import = imported(&robot(&(links + &joint("j", "revolute", ["world", "a"], &limit))));
        opened(&import).file().joint[0].limits.map(|limits| limits.map(|limit| limit.0))
    };
    let pi = std::f64::consts::PI;
    assert_eq!(limits("3.14159265359"), Some([-pi, pi]));
    let few: f64 = "3.14159".parse().unwrap();
    assert_eq!(limits("3.14159"), Some([-few, few]));
    assert_eq!(limits("3.15"), None);
}

#[test]
fn masses_without_inertia_are_part_of_what_they_are_fixed_to() {
    let point = "<link name=\"screw\"><inertial><origin xyz=\"0.5 0 0\"/><mass value=\"0.5\"/></inertial></link>";
    // A frame of no mass between them.
    let text = |screw: &str| {
        let links = format!("<link name=\"world\"/><link name=\"arm\">{INERTIAL}</link><link name=\"plate\"/>{screw}");
        let joints = joint("a", "continuous", ["world", "arm"], "<axis xyz=\"0 1 0\"/>")
            + &joint("b", "fixed", ["arm", "plate"], "")
            + &joint("c", "fixed", ["plate", "screw"], "");
        robot(&(links + &joints))
    };
    let import = imported(&text(point));
    assert!(says(&import, "\"screw\" has a mass and no inertia: it is part of \"arm\""), "{:?}", import.chosen);
    let scene = opened(&import);
    let (built, file) = (scene.built(), scene.file());
    assert_eq!((file.body.len(), file.joint.len()), (1, 1));
    let mass = built.model.bodies[0].solid.mass;
    assert_eq!(mass.mass, 2.5);
    // The point is at 0.5 0 2 from the centre of the arm, which is at 0 0 1; the reduced mass is 2 · 0.5 / 2.5.
    let center = built.state.motion(&built.model, 0).placement.position;
    assert!((center - Vec3::new(0.1, 0.0, 1.4)).norm() < 1e-15, "{center}");
    let arm = Vec3::new(0.5, 0.0, 2.0);
    let expected = Mat3::from_diagonal_element(0.1 + 0.4 * arm.norm_squared()) - 0.4 * arm * arm.transpose();
    assert!((mass.inertia() - expected).norm() < 1e-15, "{}", mass.inertia());
    // Where all are points, they are one body.
    let arm = "<link name=\"arm\"><inertial><mass value=\"1\"/></inertial></link>";
    let points = imported(&text(point).replace(&format!("<link name=\"arm\">{INERTIAL}</link>"), arm));
    assert!(points.scene.contains("mass = 1.5"), "{}", points.scene);
}

#[test]
fn many_things_of_one_name_are_numbered() {
    // What was asked of each name in turn took as many questions as there were names before it.
    let count = 20_000;
    let body = "<body name=\"a\"><geom name=\"g\" type=\"box\" size=\"1 1 1\"/></body>";
    let geoms = body.replace(" name=\"a\"", "").repeat(count);
    let link = "<body name=\"g\"><freejoint/><geom size=\"1\"/></body>";
    let import = imported(&format!("<mujoco><worldbody>{geoms}{link}</worldbody></mujoco>"));
    let last = format!("name = \"g-{}\"", count + 1);
    assert_eq!(import.scene.matches(&last).count(), 1);
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
