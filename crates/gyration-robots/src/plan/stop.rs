//! Limits of joints, and the stops that keep them.

use super::groups::{Host, Hosts};
use crate::report::Report;
use crate::robot::{Connection, ConnectionKind, Link, Robot};
use gyration::mass::MassProperties;
use gyration::tensor::Vec3;
use std::f64::consts::PI;

/// Exponent of a stop: where the joint starts it pushes with a 6-millionth, 50⁻⁴, of what it does at the distance d₀.
pub(crate) const EXPONENT: u32 = 4;
/// Its distance d₀ as a part of the way from the start to the nearer limit.
const DISTANCE: f64 = 0.02;
/// The default of `world.gravity` \[m/s²\].
const GRAVITY: f64 = 9.81;
/// Angle \[rad\] by which a limit may be beyond ±π: files write π with seven digits and more.
const ROUNDING: f64 = 1e-6;

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
    let [low, high] = connection.limits?;
    let why = if low >= high {
        "there is nothing between them"
    } else if connection.kind == ConnectionKind::Hinge && low.abs().max(high.abs()) > PI + ROUNDING {
        "the angle of a hinge is from −π to π in a scene"
    } else if low >= 0.0 || high <= 0.0 {
        "the joint starts at zero, and a stop pushes back before the limit: start elsewhere, or write limits around \
            zero"
    } else {
        let most = if connection.kind == ConnectionKind::Hinge { PI } else { f64::INFINITY };
        return Some([low.max(-most), high.min(most)]);
    };
    let what = format!("joint \"{}\": limits {low:?}, {high:?}", connection.name);
    report.leave_out_at(connection.line, what, why);
    None
}

/// What hangs on the joint of each body, the body with it, in space; none of links without a body.
pub(super) fn hanging(robot: &Robot, hosts: &Hosts, bodies: &[usize]) -> Vec<Option<MassProperties>> {
    let placed = |link: &Link| Some(link.mass?.transformed(&link.pose.rotation.rotation(), &link.pose.position));
    let mut sums: Vec<Option<MassProperties>> = robot.links.iter().map(placed).collect();
    // From the leaves: each body stands behind the one to which it is joined.
    for index in bodies.iter().rev() {
        if let Host::Link(parent) = hosts.parent(robot, *index) {
            sums[parent] = sums[parent].into_iter().chain(sums[*index]).reduce(|sum, own| sum.combined(&own));
        }
    }
    sums
}

/// A stop as strong as the weight of what hangs on a joint.
pub(super) fn stop(connection: &Connection, hangs: &MassProperties, [low, high]: [f64; 2]) -> PlannedStop {
    let lever = match connection.kind {
        ConnectionKind::Hinge => (moment_about(hangs, &connection.point, &connection.axis) / hangs.mass).sqrt(),
        _ => 1.0,
    };
    PlannedStop { strength: hangs.mass * GRAVITY * lever, distance: DISTANCE * high.min(-low) }
}

/// The moment of inertia about an axis of length one through a point \[kg m²\].
fn moment_about(mass: &MassProperties, point: &Vec3, axis: &Vec3) -> f64 {
    let arm = (mass.center - point).cross(axis);
    axis.dot(&(mass.inertia() * axis)) + mass.mass * arm.norm_squared()
}
