//! Rotations as unit quaternions.

use crate::check::{Reporter, direction};
use crate::file::Orientation;
use crate::key::Key;
use gyration::kinematics::Quaternion;
use gyration::tensor::Vec3;

/// The quaternion of an orientation; notes an axis or quaternion that is zero.
pub(super) fn orientation(orientation: &Orientation, key: &Key, reporter: &mut Reporter<'_>) -> Option<Quaternion> {
    match orientation {
        Orientation::AxisAngle(turn) => {
            let Some(axis) = direction(&turn.axis) else {
                reporter.note(&key.key("axis_angle").key("axis"), "the axis is zero", "write a direction, [0, 0, 1]");
                return None;
            };
            Some(Quaternion::from_axis_angle(&axis, turn.angle.0))
        }
        Orientation::Quaternion(components) => {
            let along = Quaternion::along(*components);
            if along.is_none() {
                let help = "write [w, x, y, z], [1, 0, 0, 0] for no rotation";
                reporter.note(&key.key("quaternion"), "the quaternion is zero", help);
            }
            along
        }
        Orientation::EulerXyz(angles) => {
            let turn = |axis: Vec3, index: usize| Quaternion::from_axis_angle(&axis, angles[index].0);
            // About fixed axes the later turn stands to the left.
            Some(turn(Vec3::z(), 2).times(&turn(Vec3::y(), 1)).times(&turn(Vec3::x(), 0)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Diagnostics, Document};
    use crate::file::AxisAngle;
    use crate::quantity::Angle;
    use std::f64::consts::FRAC_PI_2;

    fn rotated(written: &Orientation, vector: Vec3) -> Vec3 {
        let document = Document::new("test", "");
        let mut found = Diagnostics::default();
        let mut reporter = Reporter::new(&document, &mut found);
        orientation(written, &Key::root(), &mut reporter).unwrap().rotation() * vector
    }

    #[test]
    fn euler_angles_turn_about_the_fixed_axes_x_then_y_then_z() {
        let quarter = Angle(FRAC_PI_2);
        let turned = rotated(&Orientation::EulerXyz([quarter, quarter, Angle(0.0)]), Vec3::y());
        // x: y → z; then y: z → x. A few roundings of numbers near one.
        assert!((turned - Vec3::x()).norm() < 1e-15, "{turned}");
    }

    #[test]
    fn axis_and_quaternion_need_not_be_of_unit_length() {
        let turn = AxisAngle { axis: [0.0, 0.0, 1e-200], angle: Angle(FRAC_PI_2) };
        assert!((rotated(&Orientation::AxisAngle(turn), Vec3::x()) - Vec3::y()).norm() < 1e-15);
        let quaternion = Orientation::Quaternion([1e200, 0.0, 0.0, 1e200]);
        assert!((rotated(&quaternion, Vec3::x()) - Vec3::y()).norm() < 1e-15);
    }
}
