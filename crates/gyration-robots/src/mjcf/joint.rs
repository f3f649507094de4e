//! Joints of a body: points, axes and limits in its frame. Several of one body are one connection where there is one.

use super::Reader;
use super::why::why;
use crate::pose::Pose;
use crate::report::{Read, named};
use crate::robot::{Connection, ConnectionKind, Drive, shifted};
use gyration::tensor::{Mat3, Vec3};
use roxmltree::Node;

pub(super) const ATTRIBUTES: &[&str] =
    &["name", "class", "type", "pos", "axis", "range", "limited", "ref", "springref", "stiffness", "damping"];
const WITHOUT_COORDINATE: &[&str] = &["name", "class", "type", "pos", "limited"];
/// Volume of three directions of length one from which on they are independent.
const INDEPENDENT: f64 = 1e-6;

/// A joint as it is written.
#[derive(Debug)]
pub(super) struct WrittenJoint<'a, 'i> {
    pub node: Node<'a, 'i>,
    pub connection: Connection,
    /// The coordinate that MuJoCo gives it at the start \[rad\], \[m\].
    pub reference: f64,
}

impl<'a, 'i> Reader<'a, 'i, '_> {
    /// A joint of a body that stands in space at `pose`, which is that of the frame around the joint within it.
    pub(super) fn joint(
        &mut self,
        node: Node<'a, 'i>,
        (pose, body): (&Pose, &str),
        childclass: Option<&'a str>,
    ) -> WrittenJoint<'a, 'i> {
        let name = node.attribute("name").unwrap_or(body);
        let line = self.report.line(node);
        let mut connection = Connection::free(name, line);
        if node.tag_name().name() == "freejoint" {
            self.report.rest(node, Read { attributes: &["name"], elements: &[], why });
            return WrittenJoint { node, connection, reference: 0.0 };
        }
        let tag = self.defaults.tag(node, childclass, self.report);
        connection.kind = match tag.text("type").unwrap_or("hinge") {
            "hinge" => ConnectionKind::Hinge,
            "slide" => ConnectionKind::Slider,
            "ball" => ConnectionKind::Ball,
            "free" => ConnectionKind::Free,
            other => {
                let message = format!("{} has the type \"{other}\", which is not known", named(node));
                self.report.fault(node, message, "write hinge, slide, ball or free");
                ConnectionKind::Free
            }
        };
        let place = tag.vector("pos", self.report).unwrap_or_default();
        connection.point = pose.place(&place);
        let attributes = if connection.kind.coordinate().is_some() { ATTRIBUTES } else { WITHOUT_COORDINATE };
        self.report.rest(node, Read { attributes, elements: &[], why });
        let Some(coordinate) = connection.kind.coordinate() else {
            // Those of the element itself are listed with the rest of it.
            let unread = ATTRIBUTES.iter().filter(|name| !WITHOUT_COORDINATE.contains(name));
            for name in unread.filter(|name| tag.has(name) && !node.has_attribute(**name)) {
                let what = format!("{}: {name} of its defaults", named(node));
                self.report.leave_out(node, what, why(name));
            }
            return WrittenJoint { node, connection, reference: 0.0 };
        };
        connection.axis = pose.direct(&tag.direction("axis", self.report).unwrap_or_else(Vec3::z));
        let unit = if connection.kind == ConnectionKind::Hinge { self.compiler.unit } else { 1.0 };
        let number = |name: &str, reader: &mut Self| tag.number(name, reader.report).unwrap_or(0.0);
        let reference = unit * number("ref", self);
        let range = self.compiler.limits(&tag, ["range", "limited"], self.report);
        connection.limits = range.map(|range| range.map(|end| unit * end - reference));
        let relaxed = unit * number("springref", self) - reference;
        for (name, what) in [("stiffness", shifted(coordinate, relaxed)), ("damping", "rate".to_owned())] {
            let Some(numbers) = tag.list(name, self.report) else { continue };
            if numbers.len() > 1 {
                let what = format!("{}: {name} of more than one number", named(node));
                self.report.leave_out(node, what, "its powers beyond the first: write them into the `drive`");
            }
            connection.drive.resist(numbers.first().copied().unwrap_or(0.0), &what);
        }
        if reference != 0.0 {
            let what = format!("joint \"{name}\": {coordinate} + {reference:?} is its coordinate in MuJoCo");
            self.report.choose(Some(line), what, "coordinates of a scene are zero at the start");
        }
        WrittenJoint { node, connection, reference }
    }

    /// The one connection that several joints of a body are, beside the world or another body.
    pub(super) fn together(&mut self, joints: &[WrittenJoint<'a, 'i>], body: &str, is_in_world: bool) -> Connection {
        let first = &joints[0].connection;
        if let [only] = joints {
            return only.connection.clone();
        }
        let free = Connection::free(body, first.line);
        let found = one_of(joints, is_in_world);
        for joint in joints {
            let Connection { limits, drive, .. } = &joint.connection;
            let what = named(joint.node);
            if found.is_none() {
                let why = "several joints of one body that no joint of a scene is: the body moves freely";
                self.report.leave_out(joint.node, what, why);
            } else if limits.is_some() || *drive != Drive::default() {
                let why = "its limits, stiffness and damping: it is one of several joints that are one in the scene";
                self.report.leave_out(joint.node, what, why);
            }
        }
        let Some((kind, axis)) = found else { return free };
        let what = format!("body \"{body}\": {} joints are one", joints.len());
        let why = match kind {
            ConnectionKind::Ball => "three hinges through one point are a ball",
            ConnectionKind::Planar => "two slides and a hinge across them are `keep = { plane = … }`",
            _ => "three slides and a ball are no joint at all",
        };
        self.report.choose(Some(first.line), what, why);
        Connection { kind, axis, point: first.point, ..free }
    }
}

/// What several joints are together, with an axis.
fn one_of(joints: &[WrittenJoint<'_, '_>], is_in_world: bool) -> Option<(ConnectionKind, Vec3)> {
    let of_kind = |kind: ConnectionKind| -> Vec<&Connection> {
        joints.iter().map(|joint| &joint.connection).filter(|connection| connection.kind == kind).collect()
    };
    let (hinges, slides) = (of_kind(ConnectionKind::Hinge), of_kind(ConnectionKind::Slider));
    let balls = of_kind(ConnectionKind::Ball);
    let span = |three: &[&Connection]| match three {
        [a, b, c] => Mat3::from_columns(&[a.axis, b.axis, c.axis]).determinant().abs() > INDEPENDENT,
        _ => false,
    };
    let meet = |connections: &[&Connection]| connections.iter().all(|it| it.point == connections[0].point);
    let is_ball = span(&hinges) && meet(&hinges);
    match (slides.len(), hinges.len(), balls.len()) {
        _ if slides.len() + hinges.len() + balls.len() < joints.len() => None,
        (0, 3, 0) if is_ball => Some((ConnectionKind::Ball, Vec3::z())),
        (3, 3, 0) if is_in_world && span(&slides) && is_ball => Some((ConnectionKind::Free, Vec3::z())),
        (3, 0, 1) if is_in_world && span(&slides) => Some((ConnectionKind::Free, Vec3::z())),
        (2, 1, 0) if is_in_world => {
            let normal = hinges[0].axis;
            let across = slides.iter().all(|slide| slide.axis.dot(&normal).abs() < INDEPENDENT);
            let plane = slides[0].axis.cross(&slides[1].axis).norm() > INDEPENDENT;
            (across && plane).then_some((ConnectionKind::Planar, normal))
        }
        _ => None,
    }
}
