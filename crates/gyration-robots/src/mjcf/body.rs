//! Bodies within bodies: frames, and what each has.

use super::Reader;
use super::compiler::ORIENTATIONS;
use super::geom::{Geom, GeomKind};
use super::why::why;
use crate::pose::Pose;
use crate::report::{Read, elements, named};
use crate::robot::{Connection, ConnectionKind, FixedPlane, Fixture, Link, Part};
use crate::tag::Tag;
use crate::weight::{Inertia, weight};
use gyration::mass::MassProperties;
use gyration::tensor::{Mat3, Vec3};
use roxmltree::Node;

/// Bodies within bodies that are read: a chain of so many links is no robot.
const DEEPEST: usize = 500;
const IN_WORLD: [&str; 3] = ["body", "geom", "frame"];
const INSIDE: [&str; 6] = ["body", "geom", "joint", "freejoint", "inertial", "frame"];

/// What the contents of a body, or of the world, stand in.
#[derive(Debug, Clone, Copy)]
struct Around<'a> {
    /// The frame of the body in space.
    pose: Pose,
    /// The link that moves; none of what stands still.
    link: Option<usize>,
    name: &'a str,
    childclass: Option<&'a str>,
    depth: usize,
}

/// What stands in a body, its frames taken out.
#[derive(Debug, Default)]
struct Contents<'a, 'i> {
    bodies: Vec<(Node<'a, 'i>, Pose, Option<&'a str>)>,
    geoms: Vec<Geom>,
    joints: Vec<(Node<'a, 'i>, Pose, Option<&'a str>)>,
    inertial: Option<(Node<'a, 'i>, Pose)>,
}

impl<'a, 'i> Reader<'a, 'i, '_> {
    /// The world and all bodies.
    pub(super) fn world(&mut self, node: Node<'a, 'i>) {
        self.report.rest(node, Read { attributes: &[], elements: &IN_WORLD, why });
        let around = Around { pose: Pose::SAME, link: None, name: "world", childclass: None, depth: 0 };
        let contents = self.contents(node, &around);
        self.fix(contents.geoms, &around);
        for (body, frame, childclass) in contents.bodies {
            self.body(body, &frame, &Around { childclass, ..around });
        }
    }

    fn body(&mut self, node: Node<'a, 'i>, frame: &Pose, outer: &Around<'a>) {
        if outer.depth >= DEEPEST {
            self.report.fault(node, format!("more than {DEEPEST} bodies stand in one another"), "shorten the chain");
            return;
        }
        let attributes: Vec<&str> = ["name", "childclass", "pos"].into_iter().chain(ORIENTATIONS).collect();
        self.report.rest(node, Read { attributes: &attributes, elements: &INSIDE, why });
        self.report.again(node, &["inertial"]);
        let name = node.attribute("name").unwrap_or("body");
        if node.has_attribute("name") && !self.bodies.insert(name) {
            self.report.fault(node, format!("the body \"{name}\" occurs twice"), "give each a name of its own");
        }
        let own = self.compiler.pose(&Tag::alone(node), self.report);
        let pose = outer.pose.then(&frame.then(&own));
        let childclass = node.attribute("childclass").or(outer.childclass);
        let mut around = Around { pose, link: outer.link, name, childclass, depth: outer.depth + 1 };
        let contents = self.contents(node, &around);
        let mut joints = Vec::new();
        for (joint, frame, childclass) in &contents.joints {
            joints.push(self.joint(*joint, (&pose.then(frame), name), *childclass));
        }
        if outer.depth > 0
            && let Some(free) = joints.iter().find(|joint| joint.connection.kind == ConnectionKind::Free)
        {
            let message = format!("{}: a body within another cannot be free of it", named(node));
            self.report.fault(free.node, message, "put the body into the worldbody, or leave the joint out");
        }
        let stands_still = joints.is_empty() && outer.link.is_none();
        if stands_still {
            self.fix(contents.geoms, &around);
        } else {
            let index = self.robot.links.len();
            let connection = match joints[..] {
                [] => Connection { kind: ConnectionKind::Fixed, ..Connection::free(name, self.report.line(node)) },
                _ => self.together(&joints, name, outer.link.is_none()),
            };
            for joint in &joints {
                let Some(own) = joint.node.attribute("name") else { continue };
                if !self.joints.insert(own) {
                    self.report.fault(joint.node, format!("{} occurs twice", named(joint.node)), "rename one");
                }
                if joints.len() == 1 && connection.kind.coordinate().is_some() {
                    self.coordinates.insert(own, (index, joint.reference));
                }
            }
            let connection = Connection { parent: outer.link, ..connection };
            let mass = self.body_mass(contents.inertial, &contents.geoms);
            let parts = self.parts(contents.geoms, name);
            let line = self.report.line(node);
            self.robot.links.push(Link { name: name.to_owned(), line, pose, mass, parts, connection });
            around.link = Some(index);
        }
        for (body, frame, childclass) in contents.bodies {
            self.body(body, &frame, &Around { childclass, ..around });
        }
    }

    /// What stands in a body or in the world, through all frames within it.
    fn contents(&mut self, node: Node<'a, 'i>, around: &Around<'a>) -> Contents<'a, 'i> {
        let mut contents = Contents::default();
        let inside: &[&str] = if around.depth == 0 { &IN_WORLD } else { &INSIDE };
        let mut waiting = vec![(node, Pose::SAME, around.childclass)];
        while let Some((holder, frame, childclass)) = waiting.pop() {
            for child in elements(holder) {
                match child.tag_name().name() {
                    "body" => contents.bodies.push((child, frame, childclass)),
                    "geom" => contents.geoms.extend(self.geom(child, &frame, childclass)),
                    "joint" | "freejoint" => contents.joints.push((child, frame, childclass)),
                    "inertial" if contents.inertial.is_some() && holder != node => {
                        let what = format!("{}: a second <inertial>", named(node));
                        self.report.leave_out(child, what, "it has one, and the first is read");
                    }
                    "inertial" => contents.inertial = contents.inertial.or(Some((child, frame))),
                    "frame" => {
                        let attributes: Vec<&str> =
                            ["name", "childclass", "pos"].into_iter().chain(ORIENTATIONS).collect();
                        self.report.rest(child, Read { attributes: &attributes, elements: inside, why });
                        let own = self.compiler.pose(&Tag::alone(child), self.report);
                        waiting.push((child, frame.then(&own), child.attribute("childclass").or(childclass)));
                    }
                    // Listed as the rest of the body.
                    _ => {}
                }
            }
        }
        contents
    }

    /// Geometry that stands still.
    fn fix(&mut self, geoms: Vec<Geom>, around: &Around<'a>) {
        for Geom { name, line, kind, collides, .. } in geoms {
            let name = name.unwrap_or_else(|| around.name.to_owned());
            match kind {
                GeomKind::Plane(pose) => {
                    let pose = around.pose.then(&pose);
                    let normal = pose.direct(&Vec3::z());
                    self.robot.planes.push(FixedPlane { name, line, origin: pose.position, normal });
                }
                GeomKind::Solid(part) if collides => {
                    let part = Part { pose: around.pose.then(&part.pose), ..part };
                    self.robot.fixtures.push(Fixture { name, part });
                }
                GeomKind::Solid(part) => {
                    self.report.leave_out_at(
                        part.line,
                        format!("geom \"{name}\""),
                        "it meets nothing and stands still",
                    );
                }
            }
        }
    }

    /// The geometry of a body that moves: what collides, else all.
    fn parts(&mut self, geoms: Vec<Geom>, body: &str) -> Vec<Part> {
        let is_solid = |geom: &&Geom| matches!(geom.kind, GeomKind::Solid(_));
        let any_collides = geoms.iter().filter(is_solid).any(|geom| geom.collides);
        let mut parts = Vec::new();
        for Geom { kind, collides, line, .. } in geoms {
            match kind {
                GeomKind::Solid(part) if collides || !any_collides => parts.push(part),
                GeomKind::Solid(part) => {
                    let what = format!("body \"{body}\": the shape of a geom that meets nothing");
                    self.report.leave_out_at(part.line, what, "the shape is that of geoms that collide");
                }
                GeomKind::Plane(_) => {
                    let what = format!("body \"{body}\": a plane");
                    self.report.leave_out_at(line, what, "the planes of a scene do not move with a body");
                }
            }
        }
        parts
    }

    /// The mass of a body in its frame: as written, or that of its geometry.
    fn body_mass(&mut self, inertial: Option<(Node<'a, 'i>, Pose)>, geoms: &[Geom]) -> Option<MassProperties> {
        let written = inertial.and_then(|(node, frame)| self.inertial(node, &frame));
        let from_geometry = match self.compiler.from_geometry {
            Some(always) => always,
            None => inertial.is_none(),
        };
        if !from_geometry {
            return written;
        }
        let masses: Vec<MassProperties> = geoms.iter().filter_map(|geom| geom.mass).collect();
        (!masses.is_empty()).then(|| MassProperties::sum(masses))
    }

    fn inertial(&mut self, node: Node<'a, 'i>, outer: &Pose) -> Option<MassProperties> {
        let attributes: Vec<&str> =
            ["pos", "mass", "diaginertia", "fullinertia"].into_iter().chain(ORIENTATIONS).collect();
        self.report.rest(node, Read { attributes: &attributes, elements: &[], why });
        let tag = Tag::alone(node);
        let frame = outer.then(&self.compiler.pose(&tag, self.report));
        let mass = tag.required("mass", self.report)?;
        let diagonal = tag.vector("diaginertia", self.report);
        let full = tag.numbers::<6>("fullinertia", self.report);
        let tensor = match (full, diagonal) {
            (Some([xx, yy, zz, xy, xz, yz]), _) => Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
            (None, Some(diagonal)) => Mat3::from_diagonal(&diagonal),
            (None, None) => Mat3::zeros(),
        };
        weight(node, Inertia { mass, frame, tensor }, self.report)
    }
}
