//! Frames: where the origin of one stands in another, and how its axes are turned.

use gyration::kinematics::Quaternion;
use gyration::tensor::Vec3;

/// A frame within another: x = position + R(rotation) X.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pose {
    /// The origin \[m\].
    pub position: Vec3,
    /// From its own axes to those of the other.
    pub rotation: Quaternion,
}

impl Pose {
    /// The frame itself.
    pub const SAME: Self = Self { position: Vec3::new(0.0, 0.0, 0.0), rotation: Quaternion::IDENTITY };

    /// A frame that is given within this one, in the frame of this one.
    pub fn then(&self, inner: &Self) -> Self {
        Self { position: self.place(&inner.position), rotation: turned(&self.rotation, &inner.rotation) }
    }

    /// This frame, given in the same frame as `outer`, within `outer`.
    pub fn within(&self, outer: &Self) -> Self {
        let back = inverse(&outer.rotation);
        Self { position: back.rotation() * (self.position - outer.position), rotation: turned(&back, &self.rotation) }
    }

    /// A point of the frame in the frame around it \[m\].
    pub fn place(&self, point: &Vec3) -> Vec3 {
        self.position + self.direct(point)
    }

    /// A direction of the frame in the frame around it.
    pub fn direct(&self, direction: &Vec3) -> Vec3 {
        self.rotation.rotation() * direction
    }
}

/// First the inner, then the outer rotation, of length one.
pub(crate) fn turned(outer: &Quaternion, inner: &Quaternion) -> Quaternion {
    outer.times(inner).normalized()
}

/// The rotation back.
pub(crate) fn inverse(rotation: &Quaternion) -> Quaternion {
    let [w, x, y, z] = rotation.normalized().0;
    Quaternion([w, -x, -y, -z])
}

/// The direction of a vector of any length but zero.
pub(crate) fn unit(vector: &Vec3) -> Option<Vec3> {
    // The largest entry first: squares of very long or short ones leave the range of numbers.
    let largest = vector.amax();
    (largest > 0.0).then(|| (vector / largest).normalize())
}

/// Turns about the fixed axes x, then y, then z \[rad\]: R = Rz Ry Rx.
pub(crate) fn roll_pitch_yaw([roll, pitch, yaw]: [f64; 3]) -> Quaternion {
    let about = |axis: Vec3, angle: f64| Quaternion::from_axis_angle(&axis, angle);
    turned(&turned(&about(Vec3::z(), yaw), &about(Vec3::y(), pitch)), &about(Vec3::x(), roll))
}

/// The shortest turn of the z axis to a direction of length one; about x if it is −z.
pub(crate) fn z_axis_to(direction: &Vec3) -> Quaternion {
    let axis = Vec3::z().cross(direction);
    if axis.norm() == 0.0 {
        let about = if direction.z < 0.0 { std::f64::consts::PI } else { 0.0 };
        return Quaternion::from_axis_angle(&Vec3::x(), about);
    }
    Quaternion::from_axis_angle(&axis, libm::atan2(axis.norm(), direction.z))
}

/// The rotation with these columns, which are orthonormal and right-handed.
pub(crate) fn of_axes(x: &Vec3, y: &Vec3, z: &Vec3) -> Quaternion {
    // Four squares of components, of which the largest loses no digits (Shepperd).
    let squares = [1.0 + x.x + y.y + z.z, 1.0 + x.x - y.y - z.z, 1.0 - x.x + y.y - z.z, 1.0 - x.x - y.y + z.z];
    let (a, b, c) = (y.z - z.y, z.x - x.z, x.y - y.x);
    let (d, e, f) = (x.y + y.x, x.z + z.x, y.z + z.y);
    let largest = (1..4).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
    let rotation = match largest {
        0 => [squares[0], a, b, c],
        1 => [a, squares[1], d, e],
        2 => [b, d, squares[2], f],
        _ => [c, e, f, squares[3]],
    };
    Quaternion(rotation).normalized()
}
