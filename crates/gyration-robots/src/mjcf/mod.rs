//! MJCF: bodies within bodies, each with a frame in that around it, its joints, its geometry, its inertia.
//!
//! A body without joints is fixed to the one around it; in the world it stands still. What an element does not say, its
//! class of defaults does. Source: the XML reference of MuJoCo.

mod actuator;
mod body;
mod compiler;
mod defaults;
mod geom;
mod joint;
mod law;
mod why;

use crate::report::{Read, Report, elements};
use crate::robot::Robot;
use crate::tag::Tag;
use compiler::Compiler;
use defaults::Defaults;
use gyration::tensor::Vec3;
use roxmltree::Node;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use why::{why, why_of_equality, why_of_flag, why_of_sensor};

/// A file that is being read.
pub(crate) struct Reader<'a, 'i, 'r> {
    defaults: Defaults<'a, 'i>,
    compiler: Compiler,
    meshes: BTreeMap<String, Tag<'a, 'i>>,
    report: &'r mut Report,
    robot: Robot,
    /// Link and reference of each joint with a coordinate, by name.
    coordinates: BTreeMap<&'a str, (usize, f64)>,
    /// The names of all joints.
    joints: BTreeSet<&'a str>,
    /// The names of all bodies.
    bodies: BTreeSet<&'a str>,
}

/// Reads a robot; notes what is wrong, and lists what has no place in a scene.
pub(crate) fn read(root: Node<'_, '_>, folder: &Path, report: &mut Report) -> Robot {
    let compiler = Compiler::read(root, folder, report);
    let defaults = Defaults::read(root, report);
    let name = root.attribute("model").unwrap_or("robot").to_owned();
    let mut reader = Reader {
        defaults,
        compiler,
        meshes: BTreeMap::new(),
        report,
        robot: Robot { name, ..Robot::default() },
        coordinates: BTreeMap::new(),
        joints: BTreeSet::new(),
        bodies: BTreeSet::new(),
    };
    reader.sections(root);
    if reader.robot.links.is_empty() && reader.report.is_sound() {
        reader.report.fault(root, "no body moves", "write a <body> with a joint into <worldbody>");
    }
    reader.robot
}

impl<'a, 'i> Reader<'a, 'i, '_> {
    fn sections(&mut self, root: Node<'a, 'i>) {
        for include in root.descendants().filter(|node| node.has_tag_name("include")) {
            let fix = "save the whole model in one file, by `mj_saveLastXML` of MuJoCo, and import that";
            self.report.fault(include, "files that are included are not read", fix);
        }
        let known = ["compiler", "default", "option", "asset", "worldbody", "actuator"];
        let sections =
            ["contact", "equality", "sensor", "tendon", "keyframe", "custom", "visual", "include", "extension"];
        let read: Vec<&str> = known.iter().chain(&sections).copied().collect();
        self.report.rest(root, Read { attributes: &["model"], elements: &read, why });
        let all = |name: &'static str| elements(root).filter(move |node| node.tag_name().name() == name);
        for section in elements(root).filter(|node| sections.contains(&node.tag_name().name())) {
            let why = match section.tag_name().name() {
                "sensor" => why_of_sensor,
                "equality" => why_of_equality,
                _ => why,
            };
            self.report.rest(section, Read { attributes: &[], elements: &[], why });
        }
        let mut weighs = None;
        for option in all("option") {
            self.report.rest(option, Read { attributes: &["gravity"], elements: &["flag"], why });
            let gravity = Tag::alone(option).vector("gravity", self.report);
            self.robot.gravity = gravity.or(self.robot.gravity);
        }
        for flag in all("option").flat_map(elements).filter(|node| node.tag_name().name() == "flag") {
            self.report.rest(flag, Read { attributes: &["gravity"], elements: &[], why: why_of_flag });
            weighs = Tag::alone(flag).keyword("gravity", &["disable", "enable"], self.report).or(weighs);
        }
        if weighs == Some("disable") {
            self.robot.gravity = Some(Vec3::zeros());
        }
        for asset in all("asset") {
            self.report.rest(asset, Read { attributes: &[], elements: &["mesh"], why });
            for mesh in elements(asset).filter(|node| node.tag_name().name() == "mesh") {
                self.mesh_asset(mesh);
            }
        }
        for world in all("worldbody") {
            self.world(world);
        }
        for section in all("actuator") {
            self.actuators(section);
        }
    }

    fn mesh_asset(&mut self, node: Node<'a, 'i>) {
        self.report.rest(node, Read { attributes: &["name", "class", "file", "scale"], elements: &[], why });
        let tag = self.defaults.tag(node, None, self.report);
        // Without a name it has that of its file.
        let stem = |file: &str| Path::new(file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let name = node.attribute("name").map(str::to_owned).or_else(|| stem(tag.text("file")?));
        match name {
            Some(name) => {
                self.meshes.insert(name, tag);
            }
            None => self.report.fault(node, "a mesh has neither name nor file", "write name=\"…\" file=\"…\""),
        }
    }
}
