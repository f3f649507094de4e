//! Limits of joints, and the stops that keep them.

use super::groups::{Host, Hosts};
use crate::report::Report;
use crate::robot::{Connection, ConnectionKind, Robot};
use gyration::tensor::Vec3;
use std::f64::consts::PI;

/// Exponent of a stop: in the middle of the range it pushes with a 6-millionth of what it does at the distance d₀.
pub(crate) const EXPONENT: u32 = 4;
/// Its distance d₀ as a part of the range.
const DISTANCE: f64 = 0.01;
/// Standard gravity of the Earth \[m/s²\].
const GRAVITY: f64 = 9.81;

/// The repulsion α (d/d₀)^−ν at the limits of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlannedStop {
    /// α \[N m\], \[N\].
    pub strength: f64,
    /// d₀ \[rad\], \[m\].
    pub distance: f64,
}

/// The limits that a scene can have; lists others.
pub(super) fn limits(connection: &Connection, report: &mut Report) -> Option<[f64; 2]> {
    let limits @ [low, high] = connection.limits?;
    let why = if low >= high {
        "there is nothing between them"
    } else if connection.kind == ConnectionKind::Hinge && (low < -PI || high > PI) {
        "the angle of a hinge is from −π to π in a scene"
    } else if low >= 0.0 || high <= 0.0 {
        "the joint starts at zero, and a stop pushes back before the limit: start elsewhere, or write limits around \
            zero"
    } else {
        return Some(limits);
    };
    let what = format!("joint \"{}\": limits {low:?}, {high:?}", connection.name);
    report.leave_out_at(connection.line, what, why);
    None
}

/// A stop as strong as the weight of what hangs on a joint.
pub(super) fn stop(robot: &Robot, hosts: &Hosts, index: usize, [low, high]: [f64; 2]) -> PlannedStop {
    let connection = hosts.connection(robot, index);
    let mut hangs = vec![false; robot.links.len()];
    let (mut mass, mut moment) = (0.0, 0.0);
    for other in hosts.bodies(robot) {
        let link = &robot.links[other];
        let Some(own) = link.mass else { continue };
        hangs[other] = other == index || matches!(hosts.parent(robot, other), Host::Link(parent) if hangs[parent]);
        if hangs[other] {
            let placed = own.transformed(&link.pose.rotation.rotation(), &link.pose.position);
            mass += placed.mass;
            moment += moment_about(&placed, &connection.point, &connection.axis);
        }
    }
    let lever = match connection.kind {
        ConnectionKind::Hinge => (moment / mass).sqrt(),
        _ => 1.0,
    };
    PlannedStop { strength: mass * GRAVITY * lever, distance: DISTANCE * (high - low) }
}

/// The moment of inertia about an axis of length one through a point \[kg m²\].
fn moment_about(mass: &gyration::mass::MassProperties, point: &Vec3, axis: &Vec3) -> f64 {
    let arm = (mass.center - point).cross(axis);
    axis.dot(&(mass.inertia() * axis)) + mass.mass * arm.norm_squared()
}
