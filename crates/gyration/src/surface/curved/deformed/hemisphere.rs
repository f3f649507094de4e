//! Moments over a deformed hemisphere, point by point.
//!
//! Parallels about c = m/|m| as in `hemisphere`, whole ones in θ from the pole, arcs in ψ, u = −cos θ = −σ cos ψ. On a
//! whole parallel the trapezoidal rule sums around, on an arc |φ| < α Gauss's. The weight w(C s) brings singularities
//! of its own: in θ where a parallel touches a dip of |C s| (`features`), which the substitution carries over to ψ, cos
//! θ = σ cos ψ, and in ψ where the end of an arc, which runs along the equator at the azimuth ψ, meets a zero of v·v.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use pulp::{Simd, WithSimd};

use super::super::Hemisphere;
use super::super::half_plane::{AffineMap, TiltedGap};
use super::super::rules::features::{Dip, dips};
use super::super::rules::graded::{GradedInterval, Singularity, gauss_legendre};
use super::super::rules::integrand::Integrand;
use super::super::rules::parallels::AreaElement;
use super::super::rules::points::{KernelSums, PointSums};
use super::super::rules::weight::{Deformed, Weighted, Weights, extra_digits};
use super::ellipsoid::principal_axes;
use crate::simd::dispatch;
use crate::surface::MomentRequest;
use crate::tensor::{Mat3, Vec3};

/// Digits of the weight, as a natural logarithm.
const DIGITS: f64 = 24.0;

impl Hemisphere {
    /// Sums the moments in the frame (e₁, e₂, c); every gap must be positive.
    pub(crate) fn deformed_moments<const N: usize, const W: usize>(
        &self,
        deformed: &Deformed<N, W>,
        requests: &[MomentRequest],
        out: &mut Weighted<W>,
    ) -> AffineMap {
        let gap = TiltedGap::new(&deformed.field);
        let slope = libm::hypot(gap.along, gap.across);
        let (cosine, sine) = if slope > 0.0 { (gap.along / slope, gap.across / slope) } else { (1.0, 0.0) };
        let frame = gap.frame * Mat3::new(cosine, 0.0, -sine, 0.0, 1.0, 0.0, sine, 0.0, cosine);
        let vectors = deformed.cofactor * frame;
        let (squares, axes) = principal_axes(&vectors.tr_mul(&vectors));
        let integrand = Integrand::new(requests);
        let sweep = HemisphereSweep {
            radius: self.radius,
            height: gap.height,
            reach: self.radius * slope,
            cosine,
            sine,
            vectors,
            element: AreaElement::deformed(&vectors, &squares),
            dips: dips(&squares.map(|x| x.max(0.0).sqrt()), &axes.row(2).transpose()),
            nearest: gap.height + self.radius * if cosine < 0.0 { -slope } else { -gap.across },
            mildness: (integrand.mildest - 1.0).max(0.0),
            weights: &deformed.weights,
            integrand: &integrand,
        };
        for (sums, out) in dispatch(sweep).iter().zip(out) {
            sums.collect_all(requests, out);
        }
        AffineMap::frame(frame)
    }
}

/// The pass over whole parallels and arcs.
struct HemisphereSweep<'a, const N: usize, const W: usize> {
    radius: f64,
    /// g₀ and R|m| [m].
    height: f64,
    reach: f64,
    /// c_z and σ.
    cosine: f64,
    sine: f64,
    /// C in the frame (e₁, e₂, c).
    vectors: Mat3,
    element: AreaElement,
    dips: [Dip; 2],
    /// The smallest gap on the patch; parallels count like gap^−mildness.
    nearest: f64,
    mildness: f64,
    weights: &'a Weights<N, W>,
    integrand: &'a Integrand,
}

impl<const N: usize, const W: usize> WithSimd for HemisphereSweep<'_, N, W> {
    type Output = [KernelSums; W];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [KernelSums; W] {
        let mut sums = PointSums::new(self.integrand);
        self.whole_parallels(&mut sums);
        self.arcs(&mut sums);
        sums.finish()
    }
}

impl<const N: usize, const W: usize> HemisphereSweep<'_, N, W> {
    const DIGITS: f64 = DIGITS + extra_digits::<N>();

    /// Adds the point of the unit sphere at the height u along c and the azimuth φ.
    #[inline(always)]
    fn add(&self, u: f64, gap: f64, (x, y): (f64, f64), weight: f64, sums: &mut PointSums<W>) {
        let s = Vec3::new(x, y, u);
        let area = weight * self.radius * self.radius;
        sums.add((gap, area), &self.weights.of(&(self.vectors * s)), &(self.radius * s));
    }

    /// The zone around the pole: θ from the lowest point, or from the highest one.
    #[inline(always)]
    fn whole_parallels(&self, sums: &mut PointSums<W>) {
        let last = FRAC_PI_2.min(libm::acos(self.sine.min(1.0)));
        let low = self.cosine < 0.0;
        // From the pole at hand the gap is nearest + rise (1 − cos θ); it vanishes at i·distance, or at π + i·distance.
        let (pole, rise) =
            if low { (self.height - self.reach, self.reach) } else { (self.height + self.reach, -self.reach) };
        let grazing = self.grazing(self.height / self.reach);
        let gap = Singularity { at: if low { 0.0 } else { PI }, distance: grazing, digits: self.gap_digits() };
        let width = if low { grazing.min(2.0) } else { 2.0 };
        let [a, b] = self.dips.map(|dip| dip.singularities(Self::DIGITS));
        let interval = GradedInterval { from: 0.0, to: last, width };
        if last <= 0.0 {
            return;
        }
        for node in interval.nodes(interval.points(&[gap, a[0], a[1], b[0], b[1]])) {
            let (sin, cos) = libm::sincos(node.at);
            let half = libm::sin(0.5 * node.at);
            let (distance, u) = (pole + rise * 2.0 * half * half, if low { -cos } else { cos });
            let decay = self.element.decay(cos * cos, sin * sin).min(10.0);
            let points =
                (self.digits(distance) / decay).ceil().clamp(1.0, 2048.0) + (self.integrand.order + N) as f64 + 1.0;
            let weight = node.weight * sin * TAU / points;
            let (step_y, step_x) = libm::sincos(TAU / points);
            let (mut x, mut y) = (sin, 0.0);
            for _ in 0..points as usize {
                self.add(u, distance, (x, y), weight, sums);
                (x, y) = (x * step_x - y * step_y, y * step_x + x * step_y);
            }
        }
    }

    /// The part where parallels cross the equator, −σ < u < σ.
    #[inline(always)]
    fn arcs(&self, sums: &mut PointSums<W>) {
        /// Arcs that grow over less than this angle ψ change no moment by more than its square.
        const FINEST: f64 = 1e-6;
        if self.sine <= 0.0 {
            return;
        }
        let reach = self.reach * self.sine;
        let near = self.height - reach;
        let grazing = self.grazing(self.height / reach);
        let opening = libm::atanh(self.cosine.abs().min(1.0 - 1e-9)).max(FINEST);
        let lowest = if self.cosine > 0.0 { near } else { self.height - self.reach };
        let drop = 0.5 * (self.integrand.cut(lowest, 1.5) - near) / reach;
        let last = if drop < 1.0 { 2.0 * libm::asin(drop.max(0.0).sqrt()) } else { PI };
        let singularities = self.arc_singularities(grazing, opening);
        let lower = GradedInterval { from: 0.0, to: last.min(FRAC_PI_2), width: grazing.min(opening) };
        let upper = GradedInterval { from: PI, to: FRAC_PI_2, width: opening };
        let upper = (last > FRAC_PI_2).then(|| upper.nodes(upper.points(&singularities)));
        for node in lower.nodes(lower.points(&singularities)).chain(upper.into_iter().flatten()) {
            let (half, cos_half) = libm::sincos(0.5 * node.at);
            let (sin, cos) = (2.0 * half * cos_half, 1.0 - 2.0 * half * half);
            self.arc((sin, cos), near + 2.0 * reach * half * half, node.weight, sums);
        }
    }

    /// One arc, at (sin ψ, cos ψ).
    #[inline(always)]
    fn arc(&self, (sin, cos): (f64, f64), gap: f64, weight: f64, sums: &mut PointSums<W>) {
        let u = -self.sine * cos;
        let (x, y) = (self.cosine * cos, sin);
        let (radius, half) = (libm::hypot(x, y), libm::atan2(y, x));
        let decay = self.element.decay(u * u, radius * radius).min(10.0);
        let points =
            0.5 * self.digits(gap) / libm::asinh(decay / half) + 4.0 + 1.5 * half * (self.integrand.order + N) as f64;
        let nodes = gauss_legendre(points.ceil() as usize);
        let weight = weight * self.sine * sin * half;
        // The rule is symmetric: one sine serves φ and −φ.
        for node in &nodes[..nodes.len() / 2] {
            let (y, x) = libm::sincos(half * node.at);
            self.add(u, gap, (radius * x, radius * y), weight * node.weight, sums);
            self.add(u, gap, (radius * x, -radius * y), weight * node.weight, sums);
        }
        if nodes.len() % 2 == 1 {
            self.add(u, gap, (radius, 0.0), weight * nodes[nodes.len() / 2].weight, sums);
        }
    }

    /// All that is singular in ψ.
    fn arc_singularities(&self, grazing: f64, opening: f64) -> [Singularity; 9] {
        let poles = |distance: f64, at: f64, digits: f64| Singularity { at, distance, digits };
        let gap = poles(grazing, 0.0, self.gap_digits());
        let [a, b] = self.dips.map(|dip| dip.singularities(Self::DIGITS).map(|s| crossing(&s, self.sine)));
        // The equator is (−cosine cos ψ … ) in the plane of (e₁, c) and e₂.
        let (ahead, aside) = (self.vectors * Vec3::new(self.cosine, 0.0, -self.sine), self.vectors.column(1));
        let (p, q, mixed) = (ahead.norm_squared(), aside.norm_squared(), ahead.dot(&aside));
        let (mean, swing) = (0.5 * (p + q), libm::hypot(mixed, 0.5 * (p - q)));
        let distance = if swing > 0.0 { 0.5 * libm::acosh((mean / swing).max(1.0)) } else { 10.0 };
        let least = (0.5 * libm::atan2(mixed, 0.5 * (p - q)) + FRAC_PI_2).abs();
        let least = if least > FRAC_PI_2 { PI - least } else { least };
        let ends = [least, PI - least].map(|at| poles(distance.max(1e-3), at, Self::DIGITS));
        let opens = [poles(opening, 0.0, DIGITS), poles(opening, PI, DIGITS)];
        [gap, opens[0], opens[1], a[0], a[1], b[0], b[1], ends[0], ends[1]]
    }

    /// The imaginary angle at which height − reach cos vanishes, given their ratio.
    fn grazing(&self, ratio: f64) -> f64 {
        let distance = libm::acosh(ratio.max(1.0));
        if distance.is_finite() { distance.clamp(1e-7, 20.0) } else { 20.0 }
    }

    /// Digits that a parallel at this gap needs: those above the lowest one count less.
    #[inline(always)]
    fn digits(&self, gap: f64) -> f64 {
        let spared = if self.mildness > 0.0 { self.mildness * libm::log((gap / self.nearest).max(1.0)) } else { 0.0 };
        (Self::DIGITS - spared).max(3.0)
    }

    fn gap_digits(&self) -> f64 {
        25.0 + 1.6 * self.integrand.sharpest.max(0.0)
    }
}

/// The place in ψ of a singularity in θ, cos θ = σ cos ψ.
fn crossing(s: &Singularity, sine: f64) -> Singularity {
    let (x, y) = (libm::cos(s.at) * libm::cosh(s.distance) / sine, libm::sin(s.at) * libm::sinh(s.distance) / sine);
    let sum = 0.5 * (libm::hypot(x + 1.0, y) + libm::hypot(x - 1.0, y)).max(2.0);
    Singularity { at: libm::acos((x / sum).clamp(-1.0, 1.0)), distance: libm::acosh(sum).max(1e-6), digits: s.digits }
}
