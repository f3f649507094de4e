//! Moments over a hemisphere: the ends of a capsule.
//!
//! On the parallels about c = m/|m|, s = u c + √(1−u²)(cos φ e₁ + sin φ e₂), the gap g₀ + R|m|u is constant. With the
//! hemisphere's axis z = c_z c + σ e₁, σ = √(1−c_z²), a parallel is whole or absent where |u| > σ, which is a zone of a
//! sphere in closed form; elsewhere, u = −σ cos ψ, it is the arc |φ| < α with
//!
//!   √(1−u²) (cos α, sin α) = (c_z cos ψ, sin ψ),
//!
//! whose moments are elementary: one integral over ψ is left, graded to both ends.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use pulp::{Simd, WithSimd};

use super::cylinder::circle_support;
use super::half_plane::{AffineMap, TiltedGap};
use super::rules::graded::{GradedInterval, QuadratureNode, Singularity};
use super::rules::integrand::{GROUP, Integrand, LANES, Lane, accumulate};
use super::sphere::{add_zone, height_moments};
use crate::simd::dispatch;
use crate::surface::line::LineKernel;
use crate::surface::{GapField, MomentRequest, Moments};
use crate::tensor::{Mat3, Vec3};

/// The half z ≥ 0 of a sphere about the origin, without the disk that closes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hemisphere {
    /// R [m].
    pub radius: f64,
}

/// How the parallels lie to the hemisphere.
struct TiltedParallels {
    /// g₀ and R|m| [m].
    height: f64,
    reach: f64,
    /// c_z and σ.
    cosine: f64,
    sine: f64,
}

impl Hemisphere {
    /// 2πR² [m²].
    pub fn area(&self) -> f64 {
        TAU * self.radius * self.radius
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        if direction.z > 0.0 {
            self.radius * direction.normalize()
        } else {
            circle_support(self.radius, 0.0, direction)
        }
    }

    /// Sums the moments in the frame (e₁, e₂, c); every gap must be positive.
    pub(crate) fn moments(
        &self,
        field: &GapField,
        (requests, lines): (&[MomentRequest], &[LineKernel]),
        out: &mut [Moments],
    ) -> AffineMap {
        let gap = TiltedGap::new(field);
        let slope = libm::hypot(gap.along, gap.across);
        let (cosine, sine) = if slope > 0.0 { (gap.along / slope, gap.across / slope) } else { (1.0, 0.0) };
        let parallels = TiltedParallels { height: gap.height, reach: self.radius * slope, cosine, sine };
        self.whole_parallels(&parallels, requests.iter().zip(lines), out);
        self.arcs(&parallels, requests, out);
        AffineMap::frame(gap.frame * Mat3::new(cosine, 0.0, -sine, 0.0, 1.0, 0.0, sine, 0.0, cosine))
    }

    /// The zone around the pole, between u = ±σ and ±1.
    fn whole_parallels<'a>(
        &self,
        p: &TiltedParallels,
        requests: impl Iterator<Item = (&'a MomentRequest, &'a LineKernel)>,
        out: &mut [Moments],
    ) {
        let (from, to) = if p.cosine > 0.0 { (p.sine, 1.0) } else { (-1.0, -p.sine) };
        if from < to {
            for ((request, kernel), moments) in requests.zip(out) {
                let u = height_moments(kernel, p.height, p.reach, from, to, request.order);
                add_zone(self.radius, request.order, &u, moments);
            }
        }
    }

    /// The part where parallels cross the equator, −σ < u < σ.
    fn arcs(&self, p: &TiltedParallels, requests: &[MomentRequest], out: &mut [Moments]) {
        /// Arcs that grow over less than this angle ψ change no moment by more than its square.
        const FINEST: f64 = 1e-6;
        if p.sine <= 0.0 {
            return;
        }
        let integrand = Integrand::new(requests);
        let reach = p.reach * p.sine;
        let (near, far) = (p.height - reach, p.height + reach);
        // ψ = iη where the gap vanishes, cosh η = g₀/(R|m|σ); the arcs are singular at tan ψ = ±i c_z.
        let grazing = 2.0 * libm::atanh((near / far).sqrt().min(1.0 - 1e-9));
        let opening = libm::atanh(p.cosine.abs().min(1.0 - 1e-9)).max(FINEST);
        let lowest = if p.cosine > 0.0 { near } else { p.height - p.reach };
        let drop = 0.5 * (integrand.cut(lowest, 1.5) - near) / reach;
        let last = if drop < 1.0 { 2.0 * libm::asin(drop.max(0.0).sqrt()) } else { PI };
        let poles =
            |distance: f64, at: f64, sharpness: f64| Singularity { at, distance, digits: 24.0 + 1.2 * sharpness };
        let below =
            [poles(grazing, 0.0, integrand.sharpest.max(0.0)), poles(opening, 0.0, 0.0), poles(opening, PI, 0.0)];
        let lower = GradedInterval { from: 0.0, to: last.min(FRAC_PI_2), width: grazing.min(opening) };
        let upper = GradedInterval { from: PI, to: FRAC_PI_2, width: opening };
        let upper = (last > FRAC_PI_2).then(|| upper.nodes(upper.points(&below)));
        let nodes = lower.nodes(lower.points(&below)).chain(upper.into_iter().flatten());
        let sums = dispatch(ArcSweep { parallels: p, nodes, gap: (near, reach), integrand: &integrand });
        for ((sums, request), moments) in sums.iter().zip(requests).zip(out) {
            self.collect(&sums.map(|lanes| lanes.iter().sum()), request.order, moments);
        }
    }

    /// Adds the moments from the sums of those of the arcs of the unit sphere.
    fn collect(&self, sums: &[f64; 13], order: usize, out: &mut Moments) {
        let squared = self.radius * self.radius;
        let [zeroth, x, z, xx, yy, xz, zz, xxx, xyy, xxz, yyz, xzz, zzz] = *sums;
        out.zeroth += squared * zeroth;
        if order >= 1 {
            let scale = squared * self.radius;
            out.first += scale * Vec3::new(x, 0.0, z);
        }
        if order >= 2 {
            let scale = squared * squared;
            out.second += scale * Mat3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, zz);
        }
        if order >= 3 {
            let scale = squared * squared * self.radius;
            for (place, entry) in [(0, xxx), (3, xyy), (2, xxz), (7, yyz), (5, xzz), (9, zzz)] {
                out.third.0[place] += scale * entry;
            }
        }
    }
}

/// The pass over the arcs, the gap being gap.0 + gap.1 (1 − cos ψ): compiled for each instruction set.
struct ArcSweep<'a, Nodes> {
    parallels: &'a TiltedParallels,
    nodes: Nodes,
    gap: (f64, f64),
    integrand: &'a Integrand,
}

impl<Nodes: Iterator<Item = QuadratureNode>> WithSimd for ArcSweep<'_, Nodes> {
    type Output = [[Lane; 13]; GROUP];

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) -> Self::Output {
        let mut sums = [[[0.0; LANES]; 13]; GROUP];
        loop {
            // Lanes without a node have no weight.
            let (mut gaps, mut arcs, mut count) = ([self.gap.0; LANES], [[0.0; LANES]; 13], 0);
            for (lane, node) in self.nodes.by_ref().take(LANES).enumerate() {
                let (sin, cos) = libm::sincos(0.5 * node.at);
                gaps[lane] = self.gap.0 + 2.0 * self.gap.1 * sin * sin;
                let arc = arc(self.parallels, 2.0 * sin * cos, 1.0 - 2.0 * sin * sin, node.weight);
                for (arcs, value) in arcs.iter_mut().zip(arc) {
                    arcs[lane] = value;
                }
                count += 1;
            }
            if count == 0 {
                return sums;
            }
            let values = self.integrand.at_each(&gaps);
            for (value, sums) in values.iter().zip(&mut sums).take(self.integrand.count()) {
                accumulate(value, &arcs, sums);
            }
        }
    }
}

/// Moments of the arc at ψ of the unit sphere, weight included, of Z = u c + √(1−u²)(cos φ e₁ + sin φ e₂): 1; x, z; xx,
/// yy, xz, zz; xxx, xyy, xxz, yyz, xzz, zzz.
#[inline(always)]
fn arc(p: &TiltedParallels, sin: f64, cos: f64, weight: f64) -> [f64; 13] {
    let u = -p.sine * cos;
    // √(1−u²) times the cosine and the sine of α.
    let (x, y) = (p.cosine * cos, sin);
    let squared = x * x + y * y;
    let w = weight * p.sine * sin;
    let angle = libm::atan2(y, x);
    let (zeroth, first) = (2.0 * w * angle, 2.0 * w * y);
    let (xx, yy) = (w * (angle * squared + x * y), w * (angle * squared - x * y));
    let cubic = 2.0 / 3.0 * w * y * y * y;
    let xxx = 2.0 * w * y * squared - cubic;
    let uu = u * u;
    [zeroth, first, u * zeroth, xx, yy, u * first, uu * zeroth, xxx, cubic, u * xx, u * yy, uu * first, u * uu * zeroth]
}
