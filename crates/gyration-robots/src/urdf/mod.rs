//! URDF: links in a tree of joints, each with a frame in that of the link before it.
//!
//! The frame of a link is that of its joint; its inertia has a frame within it, its geometry another. The axis of a
//! joint stands in the frame of the joint. Source: the pages `urdf/XML` of ROS.

mod joint;
mod link;
mod why;

use crate::pose::Pose;
use crate::report::{Read, Report, element, elements};
use crate::robot::{Connection, ConnectionKind, Link, Robot};
use crate::tag::Tag;
use joint::WrittenJoint;
use roxmltree::Node;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Reads a robot; notes what is wrong, and lists what has no place in a scene.
pub(crate) fn read(root: Node<'_, '_>, folder: &Path, report: &mut Report) -> Robot {
    report.rest(root, Read { attributes: &["name", "version"], elements: &["link", "joint"], why: why::why });
    let links = named_elements(root, "link", report);
    let joints = joints(root, &links, report);
    let name = root.attribute("name").unwrap_or("robot").to_owned();
    let mut robot = Robot { name, ..Robot::default() };
    let Some(order) = tree(root, &links, &joints, report) else { return robot };
    let mut indices: BTreeMap<&str, usize> = BTreeMap::new();
    for name in order {
        let node = links[name];
        let above = joints.get(name).and_then(|joint| Some((joint, *indices.get(joint.parent)?)));
        let (pose, connection) = match above {
            Some((joint, parent)) => {
                let (pose, connection) = joint.connection(&robot.links[parent].pose, report);
                (pose, Connection { parent: Some(parent), ..connection })
            }
            None => {
                let free = Connection::free(name, report.line(node));
                (Pose::SAME, Connection { kind: ConnectionKind::Root, ..free })
            }
        };
        indices.insert(name, robot.links.len());
        let (mass, parts) = link::read(node, folder, report);
        robot.links.push(Link { name: name.to_owned(), line: report.line(node), pose, mass, parts, connection });
    }
    robot
}

/// The elements of a tag by their names; notes those without one and those that have that of another.
fn named_elements<'a, 'i>(root: Node<'a, 'i>, tag: &str, report: &mut Report) -> BTreeMap<&'a str, Node<'a, 'i>> {
    let mut found = BTreeMap::new();
    for node in elements(root).filter(|node| node.tag_name().name() == tag) {
        match node.attribute("name").map(str::trim).filter(|name| !name.is_empty()) {
            None => report.fault(node, format!("a {tag} has no name"), "write name=\"…\""),
            Some(name) => {
                if let Some(first) = found.insert(name, node) {
                    let message = format!("the {tag} \"{name}\" occurs twice, first in line {}", report.line(first));
                    report.fault(node, message, "give each a name of its own");
                }
            }
        }
    }
    found
}

/// The joints by the names of their children; notes those that name no link, and links with several.
fn joints<'a, 'i>(
    root: Node<'a, 'i>,
    links: &BTreeMap<&'a str, Node<'a, 'i>>,
    report: &mut Report,
) -> BTreeMap<&'a str, WrittenJoint<'a, 'i>> {
    let mut found: BTreeMap<&str, WrittenJoint<'_, '_>> = BTreeMap::new();
    for (name, node) in named_elements(root, "joint", report) {
        let end = |tag: &str, report: &mut Report| {
            let found = element(node, tag);
            if let Some(found) = found {
                report.rest(found, Read { attributes: &["link"], elements: &[], why: why::why });
            }
            let written = found.and_then(|end| end.attribute("link")).map(str::trim);
            let Some(link) = written else {
                let message = format!("the joint \"{name}\" has no {tag}");
                report.fault(node, message, format!("write <{tag} link=\"…\"/>"));
                return None;
            };
            if !links.contains_key(link) {
                let message = format!("the joint \"{name}\" names the {tag} \"{link}\", which is no link");
                report.fault(node, message, "write the name of a link, or add the link");
                return None;
            }
            Some(link)
        };
        let (parent, child) = (end("parent", report), end("child", report));
        let (Some(parent), Some(child)) = (parent, child) else { continue };
        if parent == child {
            let message = format!("the joint \"{name}\" joins the link \"{child}\" to itself");
            report.fault(node, message, "write another link as its parent");
            continue;
        }
        if let Some(first) = found.get(child) {
            let message = format!(
                "the link \"{child}\" is the child of two joints, \"{}\" and \"{name}\": a loop, and URDF has trees \
                    only",
                first.name
            );
            report.fault(node, message, "leave one out, and close the loop in the scene by a [[joint]]");
            continue;
        }
        found.insert(child, WrittenJoint { tag: Tag::alone(node), name, parent });
    }
    found
}

/// The names of the links, each behind its parent; none, with a note, where they are no tree.
fn tree<'a>(
    root: Node<'_, '_>,
    links: &BTreeMap<&'a str, Node<'a, '_>>,
    joints: &BTreeMap<&'a str, WrittenJoint<'a, '_>>,
    report: &mut Report,
) -> Option<Vec<&'a str>> {
    // In the order of the file.
    let mut names: Vec<&str> = links.keys().copied().collect();
    names.sort_by_key(|name| links[name].range().start);
    let mut children: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for name in &names {
        if let Some(joint) = joints.get(name) {
            children.entry(joint.parent).or_default().push(name);
        }
    }
    let roots: Vec<&str> = names.iter().filter(|name| !joints.contains_key(*name)).copied().collect();
    let mut order = Vec::new();
    let mut waiting: Vec<&str> = roots.iter().rev().copied().collect();
    while let Some(name) = waiting.pop() {
        order.push(name);
        waiting.extend(children.get(name).into_iter().flatten().rev());
    }
    // Faults of joints leave links without a parent: those are told already.
    if !report.is_sound() {
        return None;
    }
    if names.is_empty() {
        report.fault(root, "the robot has no links", "write <link name=\"…\"> elements");
        return None;
    }
    if let [first, second, ..] = roots[..] {
        let message = format!("\"{first}\" and \"{second}\" have no parents: a robot has one root");
        report.fault(links[second], message, "join the one to the other by a joint");
        return None;
    }
    let reached: BTreeSet<&str> = order.iter().copied().collect();
    let lost: Vec<&str> = names.into_iter().filter(|name| !reached.contains(name)).collect();
    if let [first, ..] = lost[..] {
        let message = format!("the joints go round in a circle: no root leads to {}", lost.join(", "));
        report.fault(links[first], message, "leave out the joint that closes the circle");
        return None;
    }
    Some(order)
}

/// The frame of an `origin`, where there is one.
fn origin(node: Node<'_, '_>, report: &mut Report) -> Pose {
    report.again(node, &["origin"]);
    let Some(written) = element(node, "origin") else { return Pose::SAME };
    report.rest(written, Read { attributes: &["xyz", "rpy"], elements: &[], why: why::why });
    let tag = Tag::alone(written);
    let position = tag.vector("xyz", report).unwrap_or_default();
    let angles = tag.numbers::<3>("rpy", report).unwrap_or_default();
    Pose { position, rotation: crate::pose::roll_pitch_yaw(angles) }
}
