//! A link: its inertia and its geometry, each in a frame of its own.

use super::{origin, why::why};
use crate::mesh::NamedMesh;
use crate::report::{Read, Report, element, elements, named};
use crate::robot::{Part, PartShape};
use crate::tag::Tag;
use crate::weight::{Inertia, weight};
use gyration::mass::MassProperties;
use gyration::shape::{Capsule, Cuboid, Cylinder, Sphere};
use gyration::tensor::Mat3;
use roxmltree::Node;
use std::path::Path;

/// The mass of a link in its frame, and its geometry: what collides, else what is seen.
pub(super) fn read(node: Node<'_, '_>, folder: &Path, report: &mut Report) -> (Option<MassProperties>, Vec<Part>) {
    report.rest(node, Read { attributes: &["name"], elements: &["inertial", "collision", "visual"], why });
    let mass = element(node, "inertial").and_then(|inertial| mass(inertial, report));
    let all = |tag: &'static str| elements(node).filter(move |child| child.tag_name().name() == tag);
    if all("inertial").count() > 1 {
        report.fault(node, format!("{} has several <inertial>", named(node)), "write one");
    }
    let is_seen_only = all("collision").next().is_none();
    let tag = if is_seen_only { "visual" } else { "collision" };
    let parts = all(tag).filter_map(|child| part(child, folder, report)).collect();
    if let (false, Some(visual)) = (is_seen_only, all("visual").next()) {
        report.leave_out(visual, format!("{}: <visual>", named(node)), "the shape is that of <collision>");
    }
    (mass, parts)
}

fn mass(inertial: Node<'_, '_>, report: &mut Report) -> Option<MassProperties> {
    report.rest(inertial, Read { attributes: &[], elements: &["origin", "mass", "inertia"], why });
    report.again(inertial, &["mass", "inertia"]);
    let frame = origin(inertial, report);
    let inside = |tag: &str| element(inertial, tag);
    let Some(written) = inside("mass") else {
        let message = format!("{} has no <mass>", named(inertial));
        report.fault(inertial, message, "write <mass value=\"…\"/>");
        return None;
    };
    report.rest(written, Read { attributes: &["value"], elements: &[], why });
    let mass = Tag::alone(written).required("value", report)?;
    let tensor = match inside("inertia") {
        None => Mat3::zeros(),
        Some(inertia) => {
            let tag = Tag::alone(inertia);
            let (moments, products) = (["ixx", "iyy", "izz"], ["ixy", "ixz", "iyz"]);
            report.rest(inertia, Read { attributes: &[moments, products].concat(), elements: &[], why });
            let diagonal = moments.map(|name| tag.required(name, report));
            let unwritten: Vec<&str> = products.into_iter().filter(|name| !tag.has(name)).collect();
            if !unwritten.is_empty() {
                let what = format!("{}: {} = 0", named(inertia), unwritten.join(" = "));
                report.choose(Some(report.line(inertia)), what, "the file does not say it");
            }
            let [xy, xz, yz] = products.map(|name| tag.number(name, report).unwrap_or(0.0));
            let [xx, yy, zz] = [diagonal[0]?, diagonal[1]?, diagonal[2]?];
            Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
        }
    };
    weight(inertial, Inertia { mass, frame, tensor }, report)
}

fn part(node: Node<'_, '_>, folder: &Path, report: &mut Report) -> Option<Part> {
    report.rest(node, Read { attributes: &["name"], elements: &["origin", "geometry"], why });
    report.again(node, &["geometry"]);
    let pose = origin(node, report);
    let Some(geometry) = element(node, "geometry") else {
        report.fault(node, format!("{} has no <geometry>", named(node)), "write one, or leave the element out");
        return None;
    };
    let known = ["box", "sphere", "cylinder", "capsule", "mesh"];
    report.rest(geometry, Read { attributes: &[], elements: &known, why });
    let mut shapes = elements(geometry).filter(|child| known.contains(&child.tag_name().name()));
    let Some(shape) = shapes.next() else {
        // A shape that is not known is listed already.
        if elements(geometry).next().is_none() {
            report.fault(geometry, format!("{} has no shape", named(geometry)), "write <box size=\"…\"/>, or another");
        }
        return None;
    };
    for further in shapes {
        let what = format!("{}: a second shape, <{}>", named(geometry), further.tag_name().name());
        report.leave_out(further, what, "it has one, and the first is read");
    }
    let tag = Tag::alone(shape);
    let read = |attributes: &[&str], report: &mut Report| {
        report.rest(shape, Read { attributes, elements: &[], why });
    };
    let shape = match shape.tag_name().name() {
        "box" => {
            read(&["size"], report);
            let size = if tag.is_given("size", report) { tag.vector("size", report) } else { None }?;
            tag.are_positive(size.as_slice(), report).then_some(PartShape::Box(Cuboid { size }))?
        }
        "sphere" => {
            read(&["radius"], report);
            let radius = tag.required("radius", report)?;
            tag.are_positive(&[radius], report).then_some(PartShape::Sphere(Sphere { radius }))?
        }
        "mesh" => {
            read(&["filename", "scale"], report);
            let file = if tag.is_given("filename", report) { tag.text("filename") } else { None }?;
            let scale = tag.numbers::<3>("scale", report).unwrap_or([1.0; 3]);
            NamedMesh { file, folder, scale }.part(shape, report)?
        }
        round => {
            read(&["radius", "length"], report);
            let (radius, height) = (tag.required("radius", report), tag.required("length", report));
            let (radius, height) = (radius?, height?);
            let made = match round {
                "cylinder" => PartShape::Cylinder(Cylinder { radius, height }),
                _ => PartShape::Capsule(Capsule { radius, height }),
            };
            tag.are_positive(&[radius, height], report).then_some(made)?
        }
    };
    Some(Part { line: report.line(node), shape, pose })
}
