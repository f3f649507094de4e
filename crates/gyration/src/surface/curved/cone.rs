//! Moments over the wall of a cone.
//!
//! On the ruling at the azimuth φ a point is Z = τ (R cos φ, R sin φ, −h) from the apex, 0 ≤ τ ≤ 1, the gap is affine in
//! τ and dA = R√(R²+h²) τ dτ dφ, so that K_k = ∫ κ τ^(k+1) dτ has a closed form. Around the axis, where the gap of the
//! base is a − b cos φ, the rule of `ring` is graded to its smallest value.

use std::f64::consts::PI;

use super::super::power::{GapSample, LineKernel};
use super::super::{GapField, MomentRequest, Moments};
use super::cylinder::circle_support;
use super::half_plane::{Chart, HalfPlane, TiltedGap, mirror};
use super::integrand::{GROUP, Integrand, Lines};
use super::ring::{Demand, Rings};
use crate::tensor::Vec3;

/// The wall of a cone about the z axis, base at z = −height/2, apex at +height/2, without its base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConeWall {
    /// R of the base [m].
    pub radius: f64,
    /// h [m].
    pub height: f64,
}

impl ConeWall {
    /// πR√(R² + h²) [m²].
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius.hypot(self.height)
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let apex = Vec3::new(0.0, 0.0, 0.5 * self.height);
        let rim = circle_support(self.radius, -0.5 * self.height, direction);
        if direction.dot(&apex) > direction.dot(&rim) { apex } else { rim }
    }

    /// Sums the moments about the apex in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Chart {
        let gap = TiltedGap::new(field);
        let (integrand, lines) = (Integrand::new(requests), Lines::new(requests, 1));
        let reach = self.radius * gap.across;
        let apex = gap.height + 0.5 * gap.along * self.height;
        let near = gap.height - 0.5 * gap.along * self.height - reach;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order };
        // Rulings contribute as the gap of their lower end: once that is the apex they are all alike.
        let cut = integrand.cut(near, 1.5);
        let cut = if cut < apex { cut } else { f64::INFINITY };
        let mut at_apex = [GapSample::UNIT; GROUP];
        for (sample, kernel) in at_apex.iter_mut().zip(lines.iter()) {
            *sample = kernel.sample(apex);
        }
        let slant = self.radius * self.radius.hypot(self.height);
        for node in Rings::new(&demand).nodes(near, near + 2.0 * reach) {
            let base = near + reach * node.versine;
            if base > cut {
                break;
            }
            for (((kernel, at_apex), request), moments) in lines.iter().zip(&at_apex).zip(requests).zip(out.iter_mut())
            {
                let line = from_apex(kernel, at_apex, &kernel.sample(base), request.order);
                let sums = HalfPlane::radial(&line, self.radius, -self.height);
                sums.turn(slant * node.weight, node.cos, node.sin_squared, request.order, moments);
            }
        }
        out.iter_mut().for_each(mirror);
        Chart { linear: gap.frame, offset: Vec3::new(0.0, 0.0, 0.5 * self.height) }
    }
}

/// K_k = ∫ κ τ^(k+1) dτ, k = 0 … order, τ from the apex; kernels integrate from the nearer end.
#[inline]
fn from_apex(kernel: &LineKernel, apex: &GapSample, base: &GapSample, order: usize) -> [f64; 4] {
    if apex.gap <= base.gap {
        let m = kernel.moments(apex, base, order + 1);
        return [m[1], m[2], m[3], m[4]];
    }
    // τ = 1 − x, x from the base.
    let m = kernel.moments(base, apex, order + 1);
    [
        m[0] - m[1],
        m[0] - 2.0 * m[1] + m[2],
        m[0] - 3.0 * m[1] + 3.0 * m[2] - m[3],
        m[0] - 4.0 * m[1] + 6.0 * m[2] - 4.0 * m[3] + m[4],
    ]
}
