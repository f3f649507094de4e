//! Moments over a deformed torus, point by point.
//!
//! The weight w(C N) depends on both angles and neither ±φ nor ±θ pair any longer (see `torus` for the angles and for
//! where the kernel is singular). A zero of v·v, v = C N, is at least as far from a real θ as for the whole form: with
//! the largest and the smallest singular value of C, tanh η = least/largest. What remains after the integration around
//! the tube is singular where two zeros meet, that is where C e_ρ × C e_z = cof(C) e_φ has no length: cof(C) has the
//! same ratio of extreme singular values, so that the same η holds for φ.

use pulp::{Simd, WithSimd};

use super::super::Torus;
use super::super::half_plane::{AffineMap, TiltedGap};
use super::super::rules::integrand::Integrand;
use super::super::rules::own_ring::{Dips, OwnRing, WEIGHT_DIGITS};
use super::super::rules::points::{KernelSums, PointSums};
use super::super::rules::ring::Demand;
use super::super::rules::weight::{Deformed, Weighted, Weights, extra_digits};
use super::ellipsoid::principal_axes;
use crate::simd::dispatch;
use crate::surface::MomentRequest;
use crate::tensor::{Mat3, Vec3};

impl Torus {
    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn deformed_moments<const N: usize, const W: usize>(
        &self,
        deformed: &Deformed<N, W>,
        requests: &[MomentRequest],
        out: &mut Weighted<W>,
    ) -> AffineMap {
        let gap = TiltedGap::new(&deformed.field);
        let integrand = Integrand::new(requests);
        let vectors = deformed.cofactor * gap.frame;
        let dips = dips(&vectors, &integrand, extra_digits::<N>());
        let sweep =
            TorusSweep { torus: self, gap: &gap, vectors, weights: &deformed.weights, integrand: &integrand, dips };
        for (sums, out) in dispatch(sweep).iter().zip(out) {
            sums.collect_all(requests, out);
        }
        AffineMap::frame(gap.frame)
    }
}

/// Where weights by the singular values of C are singular at worst.
pub(super) fn dips(vectors: &Mat3, integrand: &Integrand, extra: f64) -> Dips {
    let (squares, _) = principal_axes(&vectors.tr_mul(vectors));
    let share = (squares.min().max(0.0) / squares.max()).sqrt();
    let distance = libm::atanh(share.min(1.0 - 1e-9));
    Dips { distance, mildness: (integrand.mildest - 1.0).max(0.0), digits: WEIGHT_DIGITS + extra }
}

/// The pass over half-planes and around the tube in each.
struct TorusSweep<'a, const N: usize, const W: usize> {
    torus: &'a Torus,
    gap: &'a TiltedGap,
    vectors: Mat3,
    weights: &'a Weights<N, W>,
    integrand: &'a Integrand,
    dips: Dips,
}

impl<const N: usize, const W: usize> WithSimd for TorusSweep<'_, N, W> {
    type Output = [KernelSums; W];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [KernelSums; W] {
        let (torus, gap, integrand) = (self.torus, self.gap, self.integrand);
        let (sharpest, mildest) = (integrand.sharpest, integrand.mildest);
        let smallest =
            gap.height - torus.major_radius * gap.across - torus.minor_radius * libm::hypot(gap.along, gap.across);
        let cut = integrand.cut(smallest, 1.0);
        let outer = Demand { sharpest, mildest: mildest - 0.5, degree: integrand.order + 1 };
        let dips = Dips { mildness: (mildest - 1.5).max(0.0), ..self.dips };
        let outer = OwnRing::new(torus.outer_gaps(gap), &outer, &dips);
        let mut sums = PointSums::new(integrand);
        for node in outer.nodes() {
            let lateral = gap.across * node.cos;
            let (reach, middle) =
                (torus.minor_radius * libm::hypot(gap.along, lateral), gap.height - torus.major_radius * lateral);
            let near = middle - reach;
            if near > cut {
                break;
            }
            let sin = node.sin_squared.max(0.0).sqrt();
            self.around_tube((near, reach), (node.cos, sin), 0.5 * node.weight, &mut sums);
        }
        sums.finish()
    }
}

impl<const N: usize, const W: usize> TorusSweep<'_, N, W> {
    /// Adds the circles of the tube in the half-planes at ±φ, given (cos φ, sin φ).
    #[inline(always)]
    fn around_tube(&self, (near, reach): (f64, f64), (cos, sin): (f64, f64), weight: f64, sums: &mut PointSums<W>) {
        let (torus, gap, integrand) = (self.torus, self.gap, self.integrand);
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order + 2 };
        let ring = OwnRing::new((near, near + 2.0 * reach), &demand, &self.dips);
        let cut = near * integrand.cut_ratio(0.5);
        let (lateral, steepness) = (gap.across * cos, libm::hypot(gap.along, gap.across * cos));
        let (a, b) = if steepness > 0.0 { (lateral / steepness, -gap.along / steepness) } else { (1.0, 0.0) };
        for node in ring.nodes() {
            let distance = near + reach * node.versine;
            if distance > cut {
                break;
            }
            let across = node.sin_squared.max(0.0).sqrt();
            for side in [across, -across] {
                let (radial, axial) = (a * node.cos - b * side, b * node.cos + a * side);
                let rho = torus.major_radius + torus.minor_radius * radial;
                let area = 0.5 * weight * node.weight * torus.minor_radius * rho;
                for sin in [sin, -sin] {
                    let normal = Vec3::new(radial * cos, radial * sin, axial);
                    let at = Vec3::new(rho * cos, rho * sin, torus.minor_radius * axial);
                    let weights = self.weights.of(&(self.vectors * normal));
                    sums.add((distance, area), &weights, &at);
                }
            }
        }
    }
}
