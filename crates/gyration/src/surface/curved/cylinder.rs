//! Moments over the wall of a cylinder.
//!
//! Along a ruling the gap is affine in z, so that Z_j = ∫ κ z^j dz has a closed form; around the axis, where the gap of
//! each end is a − b cos φ, the rule of `ring` is graded to the smaller one:  A_k ← ∫ R dφ Z_j(φ).

use std::f64::consts::TAU;

use super::super::{GapField, MomentRequest, Moments};
use super::half_plane::{Chart, HalfPlane, TiltedGap, mirror};
use super::integrand::{Integrand, Lines};
use super::ring::{Demand, Rings};
use super::sphere::shifted;
use crate::tensor::Vec3;

/// The wall of a cylinder about the z axis, |z| ≤ height/2, without its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CylinderWall {
    /// R [m].
    pub radius: f64,
    /// h [m].
    pub height: f64,
}

impl CylinderWall {
    /// 2πRh [m²].
    pub fn area(&self) -> f64 {
        TAU * self.radius * self.height
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        circle_support(self.radius, 0.5f64.copysign(direction.z) * self.height, direction)
    }

    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Chart {
        let gap = TiltedGap::new(field);
        let (integrand, lines) = (Integrand::new(requests), Lines::new(requests, 0));
        // The end nearer to the plane, and the way to the other.
        let near_z = -0.5f64.copysign(gap.along) * self.height;
        let rise = gap.along.abs() * self.height;
        let reach = self.radius * gap.across;
        let near = gap.height + gap.along * near_z - reach;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order };
        let cut = integrand.cut(near, 1.5);
        for node in Rings::new(&demand).nodes(near, near + 2.0 * reach) {
            let d = near + reach * node.versine;
            if d > cut {
                break;
            }
            let weight = self.radius * node.weight;
            for ((kernel, request), moments) in lines.iter().zip(requests).zip(out.iter_mut()) {
                let line = kernel.moments(&kernel.sample(d), &kernel.sample(d + rise), request.order);
                let along = shifted(&line, near_z, -2.0 * near_z);
                let sums = HalfPlane::parallel(&along, self.radius);
                sums.turn(weight, node.cos, node.sin_squared, request.order, moments);
            }
        }
        out.iter_mut().for_each(mirror);
        Chart::frame(gap.frame)
    }
}

/// The point of a horizontal circle at height z that is farthest along `direction`.
pub(super) fn circle_support(radius: f64, z: f64, direction: &Vec3) -> Vec3 {
    let across = direction.x.hypot(direction.y);
    if across > 0.0 {
        Vec3::new(radius * direction.x / across, radius * direction.y / across, z)
    } else {
        Vec3::new(radius, 0.0, z)
    }
}
