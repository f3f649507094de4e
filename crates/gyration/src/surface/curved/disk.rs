//! Moments over a flat disk.
//!
//! On a chord across the fall of the gap the gap is constant. With the chord at x = R cos θ, half as long as R sin θ,
//!
//!   A₀ = ∫ κ(a − b cos θ) R² sin²θ dθ around the full circle,   ⟨y²⟩ = R² sin²θ/3 on the chord,
//!
//! so that one sum around the rim, graded by `ring`, gives all moments.

use std::f64::consts::PI;

use super::super::{GapField, MomentRequest, Moments};
use super::cylinder::circle_support;
use super::half_plane::{Chart, HalfPlane, TiltedGap, mirror};
use super::integrand::Integrand;
use super::ring::{Demand, Ring};
use crate::tensor::Vec3;

/// A disk about the z axis in the plane z = 0, one side of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk {
    /// R [m].
    pub radius: f64,
}

impl Disk {
    /// πR² [m²].
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        circle_support(self.radius, 0.0, direction)
    }

    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Chart {
        let gap = TiltedGap::new(field);
        let integrand = Integrand::new(requests);
        let reach = self.radius * gap.across;
        let near = gap.height - reach;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order + 2 };
        let cut = integrand.cut(near, 1.5);
        for node in Ring::new(near, near + 2.0 * reach, &demand).nodes() {
            let d = near + reach * node.versine;
            if d > cut {
                break;
            }
            let weight = self.radius * self.radius * node.sin_squared * node.weight;
            let sums = HalfPlane::parallel(&[1.0, 0.0, 0.0, 0.0], self.radius);
            for ((value, request), moments) in integrand.at(d).into_iter().zip(requests).zip(out.iter_mut()) {
                sums.turn(weight * value, node.cos, node.sin_squared / 3.0, request.order, moments);
            }
        }
        out.iter_mut().for_each(mirror);
        Chart::frame(gap.frame)
    }
}
