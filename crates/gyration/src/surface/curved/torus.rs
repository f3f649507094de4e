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

use pulp::{Simd, WithSimd};

use super::cylinder::circle_support;
use super::half_plane::{AffineMap, HalfPlane, TiltedGap, mirror};
use super::rules::integrand::{GROUP, Integrand, LANES};
use super::rules::ring::{Demand, RingNode, Rings};
use super::sphere::unit_or_z;
use crate::simd::dispatch;
use crate::surface::{GapField, MomentRequest, Moments};
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
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> AffineMap {
        let gap = TiltedGap::new(field);
        let integrand = Integrand::new(requests);
        let (sharpest, mildest) = (integrand.sharpest, integrand.mildest);
        let (near, far) = self.outer_gaps(&gap);
        let outer = Rings::new(&Demand { sharpest, mildest: mildest - 0.5, degree: integrand.order });
        let rings = Rings::new(&Demand { sharpest, mildest, degree: integrand.order + 1 });
        let around = Around { rings, cut_ratio: integrand.cut_ratio(0.5) };
        let smallest =
            gap.height - self.major_radius * gap.across - self.minor_radius * libm::hypot(gap.along, gap.across);
        let cut = integrand.cut(smallest, 1.0);
        let nodes = outer.nodes(near, far);
        dispatch(TubeSweep {
            torus: self,
            gap: &gap,
            nodes,
            cut,
            around: &around,
            integrand: &integrand,
            requests,
            out: &mut *out,
        });
        out.iter_mut().for_each(mirror);
        AffineMap::frame(gap.frame)
    }

    /// Gaps in the ratio (c − 1)/(c + 1), c the smaller root cos φ of a² = b².
    pub(super) fn outer_gaps(&self, gap: &TiltedGap) -> (f64, f64) {
        let (g, r, m) = (gap.height, self.minor_radius, gap.along);
        let surplus = self.major_radius * self.major_radius - r * r;
        let root = (g * g + surplus * m * m).max(0.0).sqrt();
        let c = (g * g - r * r * m * m) / (gap.across * (g * self.major_radius + r * root));
        // A horizontal torus has c = ∞: nothing varies around the axis.
        if c < 1e15 { ((c - 1.0).max(1e-14), c + 1.0) } else { (1.0, 1.0) }
    }

    /// ∫ κ ρ^i z^j dA/dφ around the tube in one half-plane.
    #[inline(always)]
    fn around_tube(&self, tube: &Tube, integrand: &Integrand, around: &Around) -> [HalfPlane; GROUP] {
        let mut cosines = [[[0.0; LANES]; 5]; GROUP];
        let cut = tube.near * around.cut_ratio;
        for chunk in around.rings.chunks(tube.near, tube.near + 2.0 * tube.reach) {
            let gaps = chunk.versine.map(|versine| tube.near + tube.reach * versine);
            if gaps[0] > cut {
                break;
            }
            for (value, sums) in integrand.at_each(&gaps).iter().zip(&mut cosines).take(integrand.count()) {
                for lane in 0..LANES {
                    let mut term = chunk.weight[lane] * value[lane];
                    for sum in sums.iter_mut() {
                        sum[lane] += term;
                        term *= chunk.cos[lane];
                    }
                }
            }
        }
        let mut planes = [HalfPlane::default(); GROUP];
        for (plane, sums) in planes.iter_mut().zip(&cosines).take(integrand.count()) {
            *plane = self.half_plane(&sums.map(|lanes| lanes.iter().sum()), tube.facing);
        }
        planes
    }

    /// The sums S_ij = ∫ κ ρ^i z^j r ρ dθ from ∫ κ cosᵏθ dθ, k = 0 … 4.
    ///
    /// With e = cos θ f + sin θ f⊥, f = (a, b), odd powers of sin θ cancel in E_pq = ∫ κ e_ρ^p e_z^q dθ.
    #[inline(always)]
    fn half_plane(&self, cosines: &[f64; 5], (a, b): (f64, f64)) -> HalfPlane {
        let [c0, c1, c2, c3, c4] = *cosines;
        // ∫ κ cosᵖ sin^q.
        let (t02, t12, t22, t04) = (c0 - c2, c1 - c3, c2 - c4, c0 - 2.0 * c2 + c4);
        let (aa, ab, bb) = (a * a, a * b, b * b);
        let (e10, e01) = (a * c1, b * c1);
        let (e20, e11, e02) = (aa * c2 + bb * t02, ab * (c2 - t02), bb * c2 + aa * t02);
        let e30 = a * (aa * c3 + 3.0 * bb * t12);
        let e21 = b * (aa * c3 + (bb - 2.0 * aa) * t12);
        let e12 = a * (bb * c3 + (aa - 2.0 * bb) * t12);
        let e03 = b * (bb * c3 + 3.0 * aa * t12);
        let e40 = aa * aa * c4 + 6.0 * aa * bb * t22 + bb * bb * t04;
        let e31 = ab * (aa * c4 + 3.0 * (bb - aa) * t22 - bb * t04);
        let e22 = aa * bb * (c4 + t04 - 4.0 * t22) + (aa * aa + bb * bb) * t22;
        let e13 = ab * (bb * c4 + 3.0 * (aa - bb) * t22 - aa * t04);
        let (big, r) = (self.major_radius, self.minor_radius);
        let (big2, rr) = (big * big, r * r);
        HalfPlane([
            r * (big * c0 + r * e10),
            r * (big2 * c0 + 2.0 * big * r * e10 + rr * e20),
            rr * (big * e01 + r * e11),
            r * (big2 * big * c0 + 3.0 * big2 * r * e10 + 3.0 * big * rr * e20 + rr * r * e30),
            rr * (big2 * e01 + 2.0 * big * r * e11 + rr * e21),
            rr * r * (big * e02 + r * e12),
            r * (big2 * big2 * c0 + 4.0 * big2 * big * r * e10 + 6.0 * big2 * rr * e20 + 4.0 * big * rr * r * e30)
                + r * rr * rr * e40,
            rr * (big2 * big * e01 + 3.0 * big2 * r * e11 + 3.0 * big * rr * e21 + rr * r * e31),
            rr * r * (big2 * e02 + 2.0 * big * r * e12 + rr * e22),
            rr * rr * (big * e03 + r * e13),
        ])
    }
}

/// The circles around the tube in all half-planes: compiled for each instruction set.
struct TubeSweep<'a, Nodes> {
    torus: &'a Torus,
    gap: &'a TiltedGap,
    nodes: Nodes,
    /// The gap beyond which half-planes are negligible.
    cut: f64,
    around: &'a Around,
    integrand: &'a Integrand,
    requests: &'a [MomentRequest],
    out: &'a mut [Moments],
}

impl<Nodes: Iterator<Item = RingNode>> WithSimd for TubeSweep<'_, Nodes> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { torus, gap, nodes, cut, around, integrand, requests, out } = self;
        for node in nodes {
            let lateral = gap.across * node.cos;
            let steepness = libm::hypot(gap.along, lateral);
            let middle = gap.height - torus.major_radius * lateral;
            let near = middle - torus.minor_radius * steepness;
            if near > cut {
                break;
            }
            // The side of the tube that faces the plane, in the half-plane (ρ, z).
            let facing = if steepness > 0.0 { (lateral / steepness, -gap.along / steepness) } else { (1.0, 0.0) };
            let tube = Tube { near, reach: torus.minor_radius * steepness, facing };
            let sums = torus.around_tube(&tube, integrand, around);
            for ((sum, request), moments) in sums.iter().zip(requests).zip(out.iter_mut()) {
                sum.turn(node.weight, node.cos, node.sin_squared, request.order, moments);
            }
        }
    }
}

/// What all circles around the tube have in common.
struct Around {
    rings: Rings,
    /// The gap beyond which a circle is negligible, by its smallest gap.
    cut_ratio: f64,
}

/// The gap around the tube: near + reach (1 − cos θ), θ from the direction `facing` in (ρ, z).
struct Tube {
    near: f64,
    reach: f64,
    facing: (f64, f64),
}
