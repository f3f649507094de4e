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

use super::super::rule::{GradedInterval, Singularity};
use super::super::{GapField, MomentRequest, Moments};
use super::cylinder::circle_support;
use super::half_plane::{Chart, TiltedGap, mirror};
use super::integrand::{Integrand, Lines};
use super::sphere::{add_zone, height_moments};
use crate::tensor::{Mat3, Vec3};

/// The half z ≥ 0 of a sphere about the origin, without the disk that closes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hemisphere {
    /// R [m].
    pub radius: f64,
}

/// How the parallels lie to the hemisphere.
struct Parallels {
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
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Chart {
        let gap = TiltedGap::new(field);
        let slope = gap.along.hypot(gap.across);
        let (cosine, sine) = if slope > 0.0 { (gap.along / slope, gap.across / slope) } else { (1.0, 0.0) };
        let parallels = Parallels { height: gap.height, reach: self.radius * slope, cosine, sine };
        self.whole_parallels(&parallels, requests, out);
        self.arcs(&parallels, requests, out);
        out.iter_mut().for_each(mirror);
        Chart::frame(gap.frame * Mat3::new(cosine, 0.0, -sine, 0.0, 1.0, 0.0, sine, 0.0, cosine))
    }

    /// The zone around the pole, between u = ±σ and ±1.
    fn whole_parallels(&self, p: &Parallels, requests: &[MomentRequest], out: &mut [Moments]) {
        let (from, to) = if p.cosine > 0.0 { (p.sine, 1.0) } else { (-1.0, -p.sine) };
        if from < to {
            for ((kernel, request), moments) in Lines::new(requests, 0).iter().zip(requests).zip(out) {
                let u = height_moments(kernel, p.height, p.reach, from, to, request.order);
                add_zone(self.radius, request.order, &u, moments);
            }
        }
    }

    /// The part where parallels cross the equator, −σ < u < σ.
    fn arcs(&self, p: &Parallels, requests: &[MomentRequest], out: &mut [Moments]) {
        /// Arcs that grow over less than this angle ψ change no moment by more than its square.
        const FINEST: f64 = 1e-6;
        if p.sine <= 0.0 {
            return;
        }
        let integrand = Integrand::new(requests);
        let reach = p.reach * p.sine;
        let (near, far) = (p.height - reach, p.height + reach);
        // ψ = iη where the gap vanishes, cosh η = g₀/(R|m|σ); the arcs are singular at tan ψ = ±i c_z.
        let grazing = 2.0 * (near / far).sqrt().min(1.0 - 1e-9).atanh();
        let opening = p.cosine.abs().min(1.0 - 1e-9).atanh().max(FINEST);
        let lowest = if p.cosine > 0.0 { near } else { p.height - p.reach };
        let drop = 0.5 * (integrand.cut(lowest, 1.5) - near) / reach;
        let last = if drop < 1.0 { 2.0 * drop.max(0.0).sqrt().asin() } else { PI };
        let poles =
            |distance: f64, at: f64, sharpness: f64| Singularity { at, distance, digits: 24.0 + 1.2 * sharpness };
        let below =
            [poles(grazing, 0.0, integrand.sharpest.max(0.0)), poles(opening, 0.0, 0.0), poles(opening, PI, 0.0)];
        let lower = GradedInterval { from: 0.0, to: last.min(FRAC_PI_2), width: grazing.min(opening) };
        let upper = GradedInterval { from: PI, to: FRAC_PI_2, width: opening };
        let upper = (last > FRAC_PI_2).then(|| upper.nodes(upper.points(&below)));
        for node in lower.nodes(lower.points(&below)).chain(upper.into_iter().flatten()) {
            let half = (0.5 * node.at).sin();
            let values = integrand.at(near + 2.0 * reach * half * half);
            let arc = Arc::new(p, node.at, node.weight * self.radius * self.radius);
            for ((value, request), moments) in values.iter().zip(requests).zip(out.iter_mut()) {
                arc.add(*value, self.radius, request.order, moments);
            }
        }
    }
}

/// Moments of one arc, weight included, in the order of Z = u c + √(1−u²)(cos φ e₁ + sin φ e₂).
struct Arc {
    zeroth: f64,
    first: (f64, f64),
    /// xx, yy, xz, zz.
    second: [f64; 4],
    /// xxx, xyy, xxz, yyz, xzz, zzz.
    third: [f64; 6],
}

impl Arc {
    fn new(p: &Parallels, psi: f64, weight: f64) -> Self {
        let (sin, cos) = psi.sin_cos();
        let u = -p.sine * cos;
        // √(1−u²) times the cosine and the sine of α.
        let (x, y) = (p.cosine * cos, sin);
        let squared = x * x + y * y;
        let w = weight * p.sine * sin;
        let angle = y.atan2(x);
        let (zeroth, first) = (2.0 * w * angle, 2.0 * w * y);
        let (xx, yy) = (w * (angle * squared + x * y), w * (angle * squared - x * y));
        let cubic = 2.0 / 3.0 * w * y * y * y;
        let xxx = 2.0 * w * y * squared - cubic;
        Self {
            zeroth,
            first: (first, u * zeroth),
            second: [xx, yy, u * first, u * u * zeroth],
            third: [xxx, cubic, u * xx, u * yy, u * u * first, u * u * u * zeroth],
        }
    }

    #[inline]
    fn add(&self, value: f64, radius: f64, order: usize, out: &mut Moments) {
        out.zeroth += value * self.zeroth;
        if order == 0 {
            return;
        }
        let w = value * radius;
        out.first.x += w * self.first.0;
        out.first.z += w * self.first.1;
        if order == 1 {
            return;
        }
        let w = w * radius;
        out.second.m11 += w * self.second[0];
        out.second.m22 += w * self.second[1];
        out.second.m13 += w * self.second[2];
        out.second.m33 += w * self.second[3];
        if order == 2 {
            return;
        }
        let w = w * radius;
        for (place, entry) in [0, 3, 2, 7, 5, 9].into_iter().zip(self.third) {
            out.third.0[place] += w * entry;
        }
    }
}
