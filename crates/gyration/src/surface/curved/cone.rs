//! Moments over the wall of a cone.
//!
//! On the ruling at the azimuth φ a point is Z = τ (R cos φ, R sin φ, −h) from the apex, 0 ≤ τ ≤ 1, the gap is affine
//! in τ and dA = R√(R²+h²) τ dτ dφ, so that K_k = ∫ κ τ^(k+1) dτ has a closed form. Around the axis, where the gap of
//! the base is a − b cos φ, the rule of `ring` is graded to its smallest value.

use std::f64::consts::PI;

use super::cylinder::circle_support;
use super::half_plane::{AffineMap, TiltedGap};
use super::rules::integrand::Integrand;
use super::rules::ring::{Demand, Rings};
use super::rules::rulings::{OtherEnd, RulingSums, Rulings};
use crate::surface::line::LineKernel;
use crate::surface::{GapField, MomentRequest, Moments};
use crate::tensor::{Mat3, SymmetricThird, Vec3};

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
        PI * self.radius * libm::hypot(self.radius, self.height)
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let apex = Vec3::new(0.0, 0.0, 0.5 * self.height);
        let rim = circle_support(self.radius, -0.5 * self.height, direction);
        if direction.dot(&apex) > direction.dot(&rim) { apex } else { rim }
    }

    /// Sums the moments about the apex in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn moments(
        &self,
        field: &GapField,
        requests: &[MomentRequest],
        lines: &[LineKernel],
        out: &mut [Moments],
    ) -> AffineMap {
        let gap = TiltedGap::new(field);
        let integrand = Integrand::new(requests);
        let reach = self.radius * gap.across;
        let apex = gap.height + 0.5 * gap.along * self.height;
        let near = gap.height - 0.5 * gap.along * self.height - reach;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order };
        // Rulings contribute as the gap of their lower end: once that is the apex they are all alike.
        let cut = integrand.cut(near, 1.5);
        let cut = if cut < apex { cut } else { f64::INFINITY };
        let ring = Rings::new(&demand).chunks(near, near + 2.0 * reach);
        let rulings = Rulings { ring, near, reach, cut, other_end: OtherEnd::Common(apex) };
        for ((request, line), moments) in requests.iter().zip(lines).zip(out) {
            self.collect(&rulings.sums(request, line), moments);
        }
        AffineMap { linear: gap.frame, offset: Vec3::new(0.0, 0.0, 0.5 * self.height) }
    }

    /// Sets the moments odd in y, from sums weighted with sin φ; one more t stands with every y.
    pub(super) fn collect_odd(&self, sums: &RulingSums, out: &mut Moments) {
        let area = self.radius * libm::hypot(self.radius, self.height);
        let (r, z) = (self.radius, -self.height);
        let (one, cos) = (sums.one.map(|sum| area * r * sum), sums.cos.map(|sum| area * r * r * sum));
        let cubic = area * r * r * r;
        out.first.y = one[1];
        (out.second.m12, out.second.m23) = (cos[1], z * one[2]);
        (out.second.m21, out.second.m32) = (out.second.m12, out.second.m23);
        let third = &mut out.third.0;
        (third[1], third[4], third[6], third[8]) =
            (cubic * sums.cos_squared[1], z * cos[2], cubic * sums.sin_squared[1], z * z * one[3]);
    }

    /// The moments from the sums over the rulings, (ρ, z) = t (R, −h).
    pub(super) fn collect(&self, sums: &RulingSums, out: &mut Moments) {
        let area = self.radius * libm::hypot(self.radius, self.height);
        let (r, z) = (self.radius, -self.height);
        let (one, cos) = (sums.one.map(|sum| area * sum), sums.cos.map(|sum| area * r * sum));
        let across = area * r * r;
        let [xx, xxz, ..] = sums.cos_squared.map(|sum| across * sum);
        let [yy, yyz, ..] = sums.sin_squared.map(|sum| across * sum);
        let [xxx, xyy] = [sums.cos_cubed, sums.cos_sin_squared].map(|sum| across * r * sum);
        let (xz, xzz) = (z * cos[1], z * z * cos[2]);
        out.zeroth = one[0];
        out.first = Vec3::new(cos[0], 0.0, z * one[1]);
        out.second = Mat3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, z * z * one[2]);
        out.third = SymmetricThird([xxx, 0.0, z * xxz, xyy, 0.0, xzz, 0.0, z * yyz, 0.0, z * z * z * one[3]]);
    }
}
