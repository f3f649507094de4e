//! The axes of bodies: those of their links, so that a recording has the attitudes that other programs tell.
//!
//! A scene measures the angle of a hinge between the axes of its bodies. Where the frame of a link is turned about the
//! axis, or turned over, that angle is not the coordinate of the file: such a body has the axes of the one before it.

use super::groups::{Host, Hosts};
use crate::pose::{inverse, turned};
use crate::robot::{ConnectionKind, Robot};
use gyration::kinematics::Quaternion;

/// Angle \[rad\] that is rounding.
const ROUNDING: f64 = 1e-12;
/// Square of the cosine of half the angle between two axes from which on a turn about them is well defined.
const DEFINED: f64 = 1e-6;

/// The axes of the body of each link; bodies stand behind those to which they are joined.
pub(super) fn body_axes(robot: &Robot, hosts: &Hosts, bodies: &[usize]) -> Vec<Quaternion> {
    let mut axes: Vec<Quaternion> = robot.links.iter().map(|link| link.pose.rotation).collect();
    for &index in bodies {
        let connection = hosts.connection(robot, index);
        if connection.kind != ConnectionKind::Hinge {
            continue;
        }
        let before = match hosts.parent(robot, index) {
            Host::Link(parent) => axes[parent],
            Host::Space | Host::Nothing => Quaternion::IDENTITY,
        };
        let back = inverse(&before);
        let [w, x, y, z] = turned(&back, &axes[index]).0;
        let axis = back.rotation() * connection.axis;
        let along = x * axis.x + y * axis.y + z * axis.z;
        let angle = libm::atan2(2.0 * along * w, w * w - along * along);
        if w * w + along * along < DEFINED || angle.abs() > ROUNDING {
            axes[index] = before;
        }
    }
    axes
}
