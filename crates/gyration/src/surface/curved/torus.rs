//! Moments over a torus.
//!
//! Y = (ρ cos φ, ρ sin φ, r e_z), ρ = R + r e_ρ, e = (e_ρ, e_z) a unit vector around the tube, dA = r ρ dθ dφ. In the
//! half-plane at φ the gap is a(φ) − b(φ) cos θ, θ from the side of the tube that faces the plane:
//!
//!   a = g₀ − μ R cos φ,   b = r √(m_z² + μ² cos²φ).
//!
//! The integral around the tube is singular only where a² = b², a quadratic in cos φ whose two roots both exceed 1: the
//! outer rule is graded to the smaller one, the inner one to its own a and b. Requires r ≤ R.

use std::f64::consts::PI;

use super::super::{GapField, MomentRequest, Moments};
use super::cylinder::circle_support;
use super::half_plane::{Chart, HalfPlane, TiltedGap, mirror};
use super::integrand::{GROUP, Integrand};
use super::ring::{Demand, Ring};
use super::sphere::unit_or_z;
use crate::tensor::Vec3;

/// A torus about the z axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// R, from the axis to the middle of the tube [m].
    pub major_radius: f64,
    /// r ≤ R, of the tube [m].
    pub minor_radius: f64,
}

impl Torus {
    /// 4π²Rr [m²].
    pub fn area(&self) -> f64 {
        4.0 * PI * PI * self.major_radius * self.minor_radius
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        circle_support(self.major_radius, 0.0, direction) + self.minor_radius * unit_or_z(direction)
    }

    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Chart {
        let gap = TiltedGap::new(field);
        let integrand = Integrand::new(requests);
        let (sharpest, mildest) = (integrand.sharpest, integrand.mildest);
        let (near, far) = self.outer_gaps(&gap);
        let outer = Ring::new(near, far, &Demand { sharpest, mildest: mildest - 0.5, degree: integrand.order });
        let demand = Demand { sharpest, mildest, degree: integrand.order + 1 };
        let smallest = gap.height - self.major_radius * gap.across - self.minor_radius * gap.along.hypot(gap.across);
        let cut = integrand.cut(smallest, 1.0);
        for node in outer.nodes() {
            let lateral = gap.across * node.cos;
            let steepness = gap.along.hypot(lateral);
            let middle = gap.height - self.major_radius * lateral;
            let near = middle - self.minor_radius * steepness;
            if near > cut {
                break;
            }
            // The side of the tube that faces the plane, in the half-plane (ρ, z).
            let facing = if steepness > 0.0 { (lateral / steepness, -gap.along / steepness) } else { (1.0, 0.0) };
            let tube = Tube { near, reach: self.minor_radius * steepness, facing };
            let sums = self.around_tube(&tube, &integrand, &demand, requests);
            for ((sum, request), moments) in sums.iter().zip(requests).zip(out.iter_mut()) {
                sum.turn(node.weight, node.cos, node.sin_squared, request.order, moments);
            }
        }
        out.iter_mut().for_each(mirror);
        Chart::frame(gap.frame)
    }

    /// Gaps in the ratio (c − 1)/(c + 1), c the smaller root cos φ of a² = b².
    fn outer_gaps(&self, gap: &TiltedGap) -> (f64, f64) {
        let (g, r, m) = (gap.height, self.minor_radius, gap.along);
        let surplus = self.major_radius * self.major_radius - r * r;
        let root = (g * g + surplus * m * m).max(0.0).sqrt();
        let c = (g * g - r * r * m * m) / (gap.across * (g * self.major_radius + r * root));
        // A horizontal torus has c = ∞: nothing varies around the axis.
        if c < 1e15 { ((c - 1.0).max(1e-14), c + 1.0) } else { (1.0, 1.0) }
    }

    /// ∫ κ ρ^i z^j dA/dφ around the tube in one half-plane.
    fn around_tube(
        &self,
        tube: &Tube,
        integrand: &Integrand,
        demand: &Demand,
        requests: &[MomentRequest],
    ) -> [HalfPlane; GROUP] {
        let mut sums = [HalfPlane::default(); GROUP];
        let r = self.minor_radius;
        let (e_rho, e_z) = tube.facing;
        let cut = integrand.cut(tube.near, 0.5);
        for node in Ring::new(tube.near, tube.near + 2.0 * tube.reach, demand).nodes() {
            let d = tube.near + tube.reach * node.versine;
            if d > cut {
                break;
            }
            let values = integrand.at(d);
            let sin = node.sin_squared.sqrt();
            // Both sides of the tube have this gap; the weight counts them together.
            for sin in [sin, -sin] {
                let rho = self.major_radius + r * (node.cos * e_rho - sin * e_z);
                let z = r * (node.cos * e_z + sin * e_rho);
                let area = 0.5 * node.weight * r * rho;
                for ((value, request), sum) in values.iter().zip(requests).zip(&mut sums) {
                    sum.add_point(area * value, rho, z, request.order);
                }
            }
        }
        sums
    }
}

/// The gap around the tube: near + reach (1 − cos θ), θ from the direction `facing` in (ρ, z).
struct Tube {
    near: f64,
    reach: f64,
    facing: (f64, f64),
}
