//! Moments over the wall of a cylinder.
//!
//! Along a ruling the gap is affine in z, so that Z_j = ∫ κ z^j dz has a closed form; around the axis, where the gap of
//! each end is a − b cos φ, the rule of `ring` is graded to the smaller one: A_k ← ∫ R dφ Z_j(φ).

use std::f64::consts::TAU;

use super::half_plane::{AffineMap, TiltedGap};
use super::rules::integrand::Integrand;
use super::rules::ring::{Demand, Rings};
use super::rules::rulings::{OtherEnd, RulingSums, Rulings};
use super::sphere::shifted;
use crate::surface::line::LineKernel;
use crate::surface::{GapField, MomentRequest, Moments};
use crate::tensor::{Mat3, SymmetricThird, Vec3};

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
    pub(crate) fn moments(
        &self,
        field: &GapField,
        requests: &[MomentRequest],
        lines: &[LineKernel],
        out: &mut [Moments],
    ) -> AffineMap {
        let gap = TiltedGap::new(field);
        let integrand = Integrand::new(requests);
        // The end nearer to the plane, and the way to the other.
        let near_z = -0.5f64.copysign(gap.along) * self.height;
        let rise = gap.along.abs() * self.height;
        let reach = self.radius * gap.across;
        let near = gap.height + gap.along * near_z - reach;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order };
        let ring = Rings::new(&demand).chunks(near, near + 2.0 * reach);
        let cut = integrand.cut(near, 1.5);
        let rulings = Rulings { ring, near, reach, cut, other_end: OtherEnd::Above(rise) };
        for ((request, line), moments) in requests.iter().zip(lines).zip(out) {
            self.collect(&rulings.sums(request, line), near_z, moments);
        }
        AffineMap::frame(gap.frame)
    }

    /// Sets the moments odd in y, from sums weighted with sin φ.
    pub(super) fn collect_odd(&self, sums: &RulingSums, near_z: f64, out: &mut Moments) {
        let along = |line: &[f64; 4]| shifted(line, near_z, -2.0 * near_z).map(|z| self.radius * z);
        let (one, cos) = (along(&sums.one), along(&sums.cos));
        let (cos_squared, sin_squared) = (along(&sums.cos_squared), along(&sums.sin_squared));
        let (r, rr) = (self.radius, self.radius * self.radius);
        out.first.y = r * one[0];
        (out.second.m12, out.second.m23) = (rr * cos[0], r * one[1]);
        (out.second.m21, out.second.m32) = (out.second.m12, out.second.m23);
        let third = &mut out.third.0;
        (third[1], third[4], third[6], third[8]) =
            (r * rr * cos_squared[0], rr * cos[1], r * rr * sin_squared[0], r * one[2]);
    }

    /// The moments from the sums over the rulings, z = near_z (1 − 2t).
    pub(super) fn collect(&self, sums: &RulingSums, near_z: f64, out: &mut Moments) {
        let along = |line: &[f64; 4]| shifted(line, near_z, -2.0 * near_z).map(|z| self.radius * z);
        let (one, cos) = (along(&sums.one), along(&sums.cos));
        let (cos_squared, sin_squared) = (along(&sums.cos_squared), along(&sums.sin_squared));
        let (r, rr) = (self.radius, self.radius * self.radius);
        let cubic = rr * rr * self.height;
        out.zeroth = one[0];
        out.first = Vec3::new(r * cos[0], 0.0, one[1]);
        let (xx, yy, xz) = (rr * cos_squared[0], rr * sin_squared[0], r * cos[1]);
        out.second = Mat3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, one[2]);
        let (xxz, yyz) = (rr * cos_squared[1], rr * sin_squared[1]);
        let (xxx, xyy) = (cubic * sums.cos_cubed, cubic * sums.cos_sin_squared);
        out.third = SymmetricThird([xxx, 0.0, xxz, xyy, 0.0, r * cos[2], 0.0, yyz, 0.0, one[3]]);
    }
}

/// The point of a horizontal circle at height z that is farthest along `direction`.
pub(super) fn circle_support(radius: f64, z: f64, direction: &Vec3) -> Vec3 {
    let across = libm::hypot(direction.x, direction.y);
    if across > 0.0 {
        Vec3::new(radius * direction.x / across, radius * direction.y / across, z)
    } else {
        Vec3::new(radius, 0.0, z)
    }
}
