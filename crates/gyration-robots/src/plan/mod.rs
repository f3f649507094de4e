//! From the robot of a file to the sections of a scene.
//!
//! Links without mass are lumped into the one that they are fixed to, links that space holds are supports, and each
//! other link is a body: fixed ones are welds, so that each keeps its name, its motion and the force that holds it.
//! Points of joints are told from centres of mass.

mod axes;
mod groups;
mod names;
mod points;
mod stop;

use crate::pose::{Pose, turned};
use crate::report::Report;
use crate::robot::{Connection, ConnectionKind, Drive, Link, Part, PartShape, Robot};
use axes::body_axes;
use groups::{Host, Hosts, hosts};
use gyration::kinematics::Quaternion;
use gyration::mass::MassProperties;
use gyration::tensor::Vec3;
use names::Names;
pub(crate) use stop::{EXPONENT, PlannedStop};
use stop::{hanging, limits, stop};

/// A scene in numbers.
#[derive(Debug, Default)]
pub(crate) struct Plan {
    pub title: String,
    pub gravity: Option<Vec3>,
    pub planes: Vec<PlannedPlane>,
    pub supports: Vec<PlannedSupport>,
    pub bodies: Vec<PlannedBody>,
    pub joints: Vec<PlannedJoint>,
}

/// A plane in space.
#[derive(Debug)]
pub(crate) struct PlannedPlane {
    pub name: String,
    pub origin: Vec3,
    pub normal: Vec3,
}

/// A solid that stands still; the pose is that of its own frame.
#[derive(Debug)]
pub(crate) struct PlannedSupport {
    pub name: String,
    pub shape: PartShape,
    pub pose: Pose,
}

/// A body.
#[derive(Debug)]
pub(crate) struct PlannedBody {
    pub name: String,
    /// Where its centre of mass is, and how its axes are turned.
    pub pose: Pose,
    /// In its axes, from the origin of its shape.
    pub mass: MassProperties,
    /// In its axes, from the origin of its shape.
    pub parts: Vec<Part>,
    /// The normal of the plane in which it is kept.
    pub kept: Option<Vec3>,
}

/// A joint between two bodies, or between space and one.
#[derive(Debug)]
pub(crate) struct PlannedJoint {
    pub name: String,
    pub between: [String; 2],
    pub kind: JointKind,
    /// From the centre of mass of each, in its axes; of space a place.
    pub points: [Vec3; 2],
    /// In the axes of the first.
    pub axis: Vec3,
    pub limits: Option<([f64; 2], PlannedStop)>,
    pub drive: Drive,
}

/// What a scene calls a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum JointKind {
    Weld,
    Hinge,
    Slider,
    Ball,
}

/// The scene of a robot; `is_base_fixed`: its root stands still. Notes what no scene can have.
pub(crate) fn plan(mut robot: Robot, is_base_fixed: bool, report: &mut Report) -> Plan {
    let mut plan = Plan { title: robot.name.clone(), gravity: robot.gravity, ..Plan::default() };
    let points = points::take(&mut robot);
    let hosts = hosts(&robot, is_base_fixed, report);
    points::lump(&mut robot, &hosts, &points, report);
    let robot = &robot;
    let bodies = hosts.bodies(robot);
    let axes = body_axes(robot, &hosts, &bodies);
    let hangs = hanging(robot, &hosts, &bodies);
    let mut names = Names::default();
    let mut words: Vec<Option<String>> = Vec::new();
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); robot.links.len()];
    for (index, host) in hosts.of.iter().enumerate() {
        if let Host::Link(body) = host {
            members[*body].push(index);
        }
    }
    for (index, link) in robot.links.iter().enumerate() {
        let is_body = hosts.of[index] == Host::Link(index);
        words.push(is_body.then(|| names.take(&link.name, link.line, report)));
    }
    for plane in &robot.planes {
        let name = names.take(&plane.name, plane.line, report);
        plan.planes.push(PlannedPlane { name, origin: plane.origin, normal: plane.normal });
    }
    supports(robot, &hosts, &mut names, &mut plan, report);
    let mut joint_names = Names::default();
    for (index, link) in robot.links.iter().enumerate() {
        let (Some(name), Some(mass), Some(hangs)) = (&words[index], link.mass, hangs[index]) else { continue };
        let lumped = members[index].iter().map(|member| &robot.links[*member]);
        plan.bodies.push(body((name, link), &mass, &axes[index], lumped));
        let connection = hosts.connection(robot, index);
        let parent = hosts.parent(robot, index);
        let ends = match parent {
            Host::Link(parent) => [Some(parent), Some(index)],
            Host::Space | Host::Nothing => [None, Some(index)],
        };
        let kind = match connection.kind {
            ConnectionKind::Root | ConnectionKind::Free => continue,
            ConnectionKind::Planar => {
                keep(&mut plan, connection, parent, report);
                continue;
            }
            ConnectionKind::Fixed => JointKind::Weld,
            ConnectionKind::Hinge => JointKind::Hinge,
            ConnectionKind::Slider => JointKind::Slider,
            ConnectionKind::Ball => JointKind::Ball,
        };
        if mass.euler_tensor.trace() == 0.0 && kind != JointKind::Ball {
            let message = format!("\"{}\" has a mass and no inertia: a joint turns it", link.name);
            report.fault_at(link.line, message, "write its inertia, or that of a small ball, 2/5 m r²");
            continue;
        }
        let point = if kind == JointKind::Weld { link.pose.position } else { connection.point };
        let frame = |end: Option<usize>| end.map_or(Pose::SAME, |end| frame_of_body(robot, end, &axes));
        let points = ends.map(|end| Pose { position: point, ..Pose::SAME }.within(&frame(end)).position);
        let axis = crate::pose::inverse(&frame(ends[0]).rotation).rotation() * connection.axis;
        let word = |end: Option<usize>| end.and_then(|end| words[end].clone()).unwrap_or_else(|| "space".to_owned());
        let limits = limits(connection, report).map(|limits| (limits, stop(connection, &hangs, limits)));
        plan.joints.push(PlannedJoint {
            name: joint_names.take(&connection.name, connection.line, report),
            between: ends.map(word),
            kind,
            points,
            axis,
            limits,
            drive: connection.drive.clone(),
        });
    }
    if plan.joints.iter().any(|joint| joint.limits.is_some()) {
        let why = "a file has hard limits, a scene fields: a fiftieth of the way from the start to the nearer limit \
                   before each, it pushes as much as the weight of all that hangs on the joint, at its radius of gyration \
                   about the axis";
        report.choose(None, "stop", why);
    }
    if report.is_sound() && !plan.is_finite() {
        report.fault_at(1, "numbers of the file leave their range when they are put together", "look for huge ones");
    }
    plan
}

impl Plan {
    fn is_finite(&self) -> bool {
        let of_pose = |pose: &Pose| pose.position.iter().chain(&pose.rotation.0).all(|number| number.is_finite());
        let of_body = |body: &PlannedBody| {
            let mass = &body.mass;
            let parts = body.parts.iter().all(|part| of_pose(&part.pose));
            of_pose(&body.pose) && parts && mass.validate().is_ok()
        };
        let of_joint = |joint: &PlannedJoint| {
            let stop = joint.limits.iter().all(|(_, stop)| stop.strength.is_finite() && stop.distance > 0.0);
            stop && joint.points.iter().flatten().chain(&joint.axis).all(|number| number.is_finite())
        };
        let of_plane = |plane: &PlannedPlane| plane.origin.iter().chain(&plane.normal).all(|number| number.is_finite());
        self.bodies.iter().all(of_body)
            && self.joints.iter().all(of_joint)
            && self.planes.iter().all(of_plane)
            && self.supports.iter().all(|support| of_pose(&support.pose))
    }
}

/// The frame of a body in space: its centre of mass, its axes.
fn frame_of_body(robot: &Robot, index: usize, axes: &[Quaternion]) -> Pose {
    let link = &robot.links[index];
    let center = link.mass.map(|mass| mass.center).unwrap_or_default();
    Pose { position: link.pose.place(&center), rotation: axes[index] }
}

fn body<'r>(
    (name, link): (&str, &Link),
    mass: &MassProperties,
    axes: &Quaternion,
    lumped: impl Iterator<Item = &'r Link>,
) -> PlannedBody {
    // The origin of the shape is that of the link, its axes are those of the body.
    let frame = Pose { position: link.pose.position, rotation: *axes };
    let back = turned(&crate::pose::inverse(axes), &link.pose.rotation).rotation();
    let parts = lumped.flat_map(|link| {
        link.parts.iter().map(|part| Part { pose: link.pose.then(&part.pose).within(&frame), ..part.clone() })
    });
    PlannedBody {
        name: name.to_owned(),
        pose: Pose { position: link.pose.place(&mass.center), rotation: *axes },
        mass: mass.transformed(&back, &Vec3::zeros()),
        parts: parts.collect(),
        kept: None,
    }
}

/// Keeps the body planned last in a plane; lists it where another body carries the plane.
fn keep(plan: &mut Plan, connection: &Connection, parent: Host, report: &mut Report) {
    match (parent, plan.bodies.last_mut()) {
        (Host::Space, Some(body)) => body.kept = Some(connection.axis),
        _ => {
            let what = format!("joint \"{}\"", connection.name);
            let why = "a scene keeps a body in a plane of space only, not of another body: it moves freely";
            report.leave_out_at(connection.line, what, why);
        }
    }
}

/// Geometry that stands still; lists what no support can be.
fn supports(robot: &Robot, hosts: &Hosts, names: &mut Names, plan: &mut Plan, report: &mut Report) {
    let of_world = robot.fixtures.iter().map(|fixture| (fixture.name.as_str(), fixture.part.clone()));
    let held = robot.links.iter().zip(&hosts.of).filter(|(_, host)| **host == Host::Space);
    let of_links = held.flat_map(|(link, _)| {
        let placed = |part: &Part| Part { pose: link.pose.then(&part.pose), ..part.clone() };
        link.parts.iter().map(move |part| (link.name.as_str(), placed(part)))
    });
    for (name, part) in of_world.chain(of_links) {
        if let Err(why) = part.shape.solid().check_convex() {
            let why = format!("a support is convex: {why}");
            report.leave_out_at(part.line, format!("geometry of \"{name}\""), why);
            continue;
        }
        let name = names.take(name, part.line, report);
        plan.supports.push(PlannedSupport { name, shape: part.shape, pose: part.pose });
    }
}
