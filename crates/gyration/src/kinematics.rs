//! Placements and velocities of a homogeneously moving body, and the unit quaternion of a rigid one.
//!
//!   p(X, t) = p₀ + P (X − X₀),   ṗ(X, t) = ṗ₀ + Ṗ (X − X₀),   X − X₀ measured from the centre of mass.
//!
//! A rigid body carries its rotation as a quaternion q = (w, x, y, z), P = R(q/|q|). The length of q is a gauge:
//! nothing depends on it, the stepper puts it back to one after each step, and P is a rotation to rounding at every
//! instant, so that there is no drift off SO(3). Its angular velocity Ω is kept in the body's own axes: q̇ = ½ q ∘ (0,
//! Ω), Ṗ = P [Ω]×.

use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{Matrix3x4, Matrix4, Matrix4x3};

/// Where a body is: p₀ [m] and the placement gradient P (3×3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// p₀, the position of the centre of mass [m].
    pub position: Vec3,
    /// P, the placement gradient.
    pub gradient: Mat3,
}

/// Where a body is and how it moves, whatever its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// p₀ and P.
    pub placement: Placement,
    /// ṗ₀ and Ṗ.
    pub velocity: Velocity,
}

/// How a body moves: ṗ₀ [m/s] and Ṗ [1/s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Velocity {
    /// ṗ₀, the velocity of the centre of mass [m/s].
    pub velocity: Vec3,
    /// Ṗ, the rate of the placement gradient [1/s].
    pub gradient_rate: Mat3,
}

impl Placement {
    /// A bound on |P X|/|X|: √‖PᵀP‖_∞.
    pub fn stretch_bound(&self) -> f64 {
        let square = self.gradient.tr_mul(&self.gradient);
        let sums = square.row_iter().map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>());
        sums.fold(0.0, f64::max).sqrt()
    }

    /// The place p₀ + P X [m] of the material point X (from the centre of mass).
    pub fn place(&self, point: &Vec3) -> Vec3 {
        self.position + self.gradient * point
    }
}

impl Velocity {
    /// At rest.
    pub const ZERO: Self = Self {
        velocity: Vec3::new(0.0, 0.0, 0.0),
        gradient_rate: Mat3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    };

    /// The velocity ṗ₀ + Ṗ X [m/s] of the material point X (from the centre of mass).
    pub fn at(&self, point: &Vec3) -> Vec3 {
        self.velocity + self.gradient_rate * point
    }
}

/// A quaternion (w, x, y, z) whose direction is a rotation; its length is a gauge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quaternion(pub [f64; 4]);

impl Quaternion {
    /// No rotation.
    pub const IDENTITY: Self = Self([1.0, 0.0, 0.0, 0.0]);

    /// Of four numbers (w, x, y, z).
    pub fn read(numbers: &[f64]) -> Self {
        Self([numbers[0], numbers[1], numbers[2], numbers[3]])
    }

    /// The unit quaternion along four numbers (w, x, y, z) of any size; none of zeros.
    pub fn along(numbers: [f64; 4]) -> Option<Self> {
        // The largest first: squares of very long or short ones leave the range of numbers.
        let largest = numbers.iter().fold(0.0_f64, |largest, number| largest.max(number.abs()));
        (largest > 0.0).then(|| Self(numbers.map(|number| number / largest)).normalized())
    }

    /// The unit quaternion of a rotation matrix; of another matrix some rotation near it.
    ///
    ///   4 q qᵀ of R has the diagonal 1 ± R₁₁ ± R₂₂ ± R₃₃: its row with the largest entry, to length one.
    pub fn of_rotation(r: &Mat3) -> Self {
        let (x, y, z) = (r[(0, 0)], r[(1, 1)], r[(2, 2)]);
        let (a, b, c) = (r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
        let (d, e, f) = (r[(1, 0)] + r[(0, 1)], r[(0, 2)] + r[(2, 0)], r[(2, 1)] + r[(1, 2)]);
        let rows = [
            [1.0 + x + y + z, a, b, c],
            [a, 1.0 + x - y - z, d, e],
            [b, d, 1.0 - x + y - z, f],
            [c, e, f, 1.0 - x - y + z],
        ];
        let diagonal = |row: usize| rows[row][row];
        let largest = (1..4).fold(0, |best, row| if diagonal(row) > diagonal(best) { row } else { best });
        Self::along(rows[largest]).unwrap_or(Self::IDENTITY)
    }

    /// The rotation by `angle` [rad] about `axis` (any length but zero).
    pub fn from_axis_angle(axis: &Vec3, angle: f64) -> Self {
        let (sin, cos) = libm::sincos(0.5 * angle);
        let v = axis * (sin / axis.norm());
        Self([cos, v.x, v.y, v.z])
    }

    /// The product a ∘ b: first the rotation b, then a.
    pub fn times(&self, other: &Self) -> Self {
        let [aw, ax, ay, az] = self.0;
        let [bw, bx, by, bz] = other.0;
        Self([
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ])
    }

    /// |q|.
    pub fn norm(&self) -> f64 {
        self.0.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    /// q/|q|.
    pub fn normalized(&self) -> Self {
        let norm = self.norm();
        Self(self.0.map(|c| c / norm))
    }

    /// The rotation matrix R(q/|q|).
    pub fn rotation(&self) -> Mat3 {
        let [w, x, y, z] = self.0;
        let s = 2.0 / (w * w + x * x + y * y + z * z);
        Mat3::new(
            1.0 - s * (y * y + z * z),
            s * (x * y - w * z),
            s * (x * z + w * y),
            s * (x * y + w * z),
            1.0 - s * (x * x + z * z),
            s * (y * z - w * x),
            s * (x * z - w * y),
            s * (y * z + w * x),
            1.0 - s * (x * x + y * y),
        )
    }

    /// q̇ = ½ q ∘ (0, Ω) for the angular velocity Ω in body axes [rad/s].
    pub fn rate(&self, spin: &Vec3) -> [f64; 4] {
        self.times(&Self([0.0, 0.5 * spin.x, 0.5 * spin.y, 0.5 * spin.z])).0
    }

    /// The rotation vector δθ (body axes) of increments of the components: δR = R [δθ]×, δθ = 2 vec(q⁻¹ ∘ δq).
    pub fn turn_by_component(&self) -> Matrix3x4<f64> {
        let [w, x, y, z] = self.0;
        let turns = Matrix3x4::new(-x, w, z, -y, -y, -z, w, x, -z, y, -x, w);
        turns * (2.0 / (w * w + x * x + y * y + z * z))
    }

    /// ∂q̇/∂q, q̇ = ½ q ∘ (0, Ω).
    pub fn rate_by_component(&self, spin: &Vec3) -> Matrix4<f64> {
        let (x, y, z) = (0.5 * spin.x, 0.5 * spin.y, 0.5 * spin.z);
        Matrix4::new(0.0, -x, -y, -z, x, 0.0, z, -y, y, -z, 0.0, x, z, y, -x, 0.0)
    }

    /// ∂q̇/∂Ω.
    pub fn rate_by_spin(&self) -> Matrix4x3<f64> {
        let [w, x, y, z] = self.0.map(|component| 0.5 * component);
        Matrix4x3::new(-x, -y, -z, w, -z, y, z, w, -x, -y, x, w)
    }
}

/// Ṗ = P [Ω]× of a rigid body with angular velocity Ω in body axes.
pub fn rigid_gradient_rate(rotation: &Mat3, spin: &Vec3) -> Mat3 {
    rotation * cross_matrix(spin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_has_its_quaternion_wherever_it_turns() {
        for axis in [Vec3::x(), Vec3::y(), Vec3::z(), Vec3::new(1.0, -2.0, 0.5)] {
            for angle in [0.0, 1e-9, 1.0, 3.0, std::f64::consts::PI, 5.0] {
                let rotation = Quaternion::from_axis_angle(&axis, angle).rotation();
                let found = Quaternion::of_rotation(&rotation);
                assert!(
                    (found.rotation() - rotation).norm() < 1e-15 && (found.norm() - 1.0).abs() < 1e-15,
                    "{axis} {angle}"
                );
            }
        }
    }

    #[test]
    fn rotation_follows_the_axis_and_the_product() {
        let a = Quaternion::from_axis_angle(&Vec3::z(), 0.5 * std::f64::consts::PI);
        assert!((a.rotation() * Vec3::x() - Vec3::y()).norm() < 1e-15);
        let b = Quaternion::from_axis_angle(&Vec3::new(1.0, 2.0, -0.5), 1.1);
        let product = a.times(&b).rotation();
        assert!((product - a.rotation() * b.rotation()).norm() < 1e-15);
        assert!((product * product.transpose() - Mat3::identity()).norm() < 1e-15);
    }

    #[test]
    fn length_is_a_gauge() {
        let q = Quaternion([0.3, -0.2, 0.7, 0.1]);
        let longer = Quaternion(q.0.map(|c| 3.0 * c));
        assert!((q.rotation() - longer.rotation()).norm() < 1e-15);
    }

    #[test]
    fn turn_of_a_component_is_the_derivative_of_the_rotation() {
        let q = Quaternion([0.8, -0.3, 0.4, 0.6]);
        for component in 0..4 {
            let step = 1e-6;
            let (mut ahead, mut behind) = (q, q);
            ahead.0[component] += step;
            behind.0[component] -= step;
            let difference = (ahead.rotation() - behind.rotation()) / (2.0 * step);
            let exact = q.rotation() * cross_matrix(&q.turn_by_component().column(component).into());
            // Central differences: step² of truncation, eps/step of rounding, both below 1e-9.
            assert!((difference - exact).norm() < 1e-9);
        }
    }

    #[test]
    fn rate_of_a_quaternion_is_the_sum_of_its_derivatives() {
        let (q, spin) = (Quaternion([0.8, -0.3, 0.4, 0.6]), Vec3::new(0.7, -1.1, 0.4));
        // Bilinear in q and Ω: each derivative times its argument is the whole.
        let rate = nalgebra::Vector4::from(q.rate(&spin));
        assert!((q.rate_by_component(&spin) * nalgebra::Vector4::from(q.0) - rate).norm() < 1e-15);
        assert!((q.rate_by_spin() * spin - rate).norm() < 1e-15);
    }
}
