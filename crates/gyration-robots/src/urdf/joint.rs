//! A joint: the frame of the child within the parent, and what it lets the child do.

use super::{origin, why::why};
use crate::pose::Pose;
use crate::report::{Read, Report, element};
use crate::robot::{Connection, ConnectionKind, Drive};
use crate::tag::Tag;
use gyration::tensor::Vec3;

/// A joint between two links that are there.
#[derive(Debug, Clone)]
pub(super) struct WrittenJoint<'a, 'i> {
    pub tag: Tag<'a, 'i>,
    pub name: &'a str,
    /// The link before it.
    pub parent: &'a str,
}

impl WrittenJoint<'_, '_> {
    /// The frame of the child in space, and how it is joined to the parent.
    pub fn connection(&self, parent: &Pose, report: &mut Report) -> (Pose, Connection) {
        let node = self.tag.node();
        let read = ["parent", "child", "origin", "axis", "limit", "dynamics"];
        report.rest(node, Read { attributes: &["name", "type"], elements: &read, why });
        report.again(node, &["parent", "child", "axis", "limit", "dynamics"]);
        let pose = parent.then(&origin(node, report));
        let kind = self.kind(report);
        let axis = match element(node, "axis") {
            Some(axis) => {
                report.rest(axis, Read { attributes: &["xyz"], elements: &[], why });
                Tag::alone(axis).direction("xyz", report)
            }
            None => None,
        };
        let axis = pose.direct(&axis.unwrap_or_else(Vec3::x));
        let (limits, drive) = (self.limits(kind, report), self.drive(kind, report));
        let connection = Connection::free(self.name, report.line(node));
        (pose, Connection { kind, point: pose.position, axis, limits, drive, ..connection })
    }

    fn kind(&self, report: &mut Report) -> ConnectionKind {
        match self.tag.text("type") {
            Some("fixed") => ConnectionKind::Fixed,
            Some("revolute" | "continuous") => ConnectionKind::Hinge,
            Some("prismatic") => ConnectionKind::Slider,
            Some("spherical" | "ball") => ConnectionKind::Ball,
            Some("floating") => ConnectionKind::Free,
            Some("planar") => ConnectionKind::Planar,
            found => {
                let message = match found {
                    Some(word) => format!("the joint \"{}\" has the type \"{word}\", which is not known", self.name),
                    None => format!("the joint \"{}\" has no type", self.name),
                };
                let fix = "write revolute, continuous, prismatic, fixed, floating or planar";
                report.fault(self.tag.node(), message, fix);
                ConnectionKind::Fixed
            }
        }
    }

    fn limits(&self, kind: ConnectionKind, report: &mut Report) -> Option<[f64; 2]> {
        let node = element(self.tag.node(), "limit")?;
        let has_limits = kind.coordinate().is_some() && self.tag.text("type") != Some("continuous");
        let attributes: &[&str] = if has_limits { &["lower", "upper"] } else { &[] };
        report.rest(node, Read { attributes, elements: &[], why });
        if !has_limits {
            return None;
        }
        let tag = Tag::alone(node);
        let [lower, upper] = ["lower", "upper"].map(|name| tag.number(name, report).unwrap_or(0.0));
        Some([lower, upper])
    }

    fn drive(&self, kind: ConnectionKind, report: &mut Report) -> Drive {
        let mut drive = Drive::default();
        let Some(node) = element(self.tag.node(), "dynamics") else { return drive };
        let attributes: &[&str] = if kind.coordinate().is_some() { &["damping"] } else { &[] };
        report.rest(node, Read { attributes, elements: &[], why });
        if kind.coordinate().is_some() {
            drive.resist(Tag::alone(node).number("damping", report).unwrap_or(0.0), "rate");
        }
        drive
    }
}
