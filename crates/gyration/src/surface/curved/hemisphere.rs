//! Moments over a hemisphere: the ends of a capsule.
//!
//! On the parallels about c = m/|m|, s = u c + √(1−u²)(cos φ e₁ + sin φ e₂), the gap g₀ + R|m|u is constant. With the
//! hemisphere's axis z = c_z c + σ e₁, σ = √(1−c_z²), its rim lies at u = −σ cos ψ, and the arc |φ| < α of a parallel
//! ends there,
//!
//!   √(1−u²) (cos α, sin α) = (c_z cos ψ, sin ψ)
//!
//! so that moments odd in e₁ are integrals around the rim, B_i = ∮ κ sin²ψ cosⁱψ dψ. All others are W_k = ∫ κ xᵏ dA/R²,
//! x = 1 + u, and by Stokes' theorem integrals around the rim as well, of F_k dφ with F_k′ = κ xᵏ along the meridian
//! from the lowest point of the sphere, u = −1, through the rim to the highest, u = 1:
//!
//!   W_k = ½·2π F_k(1) − c_z ∮ [F_k(u) − ½ x F_k(1)]/(1−u²) dψ,       F_k = x^(k+1) ∫₀¹ κ t^k dt
//!
//! half of the sphere and what the tilt makes of it, smooth however near the rim runs to either point; where x > 1 the
//! bracket is ½ (1−u) F_k(1) − ∫_u^1 κ xᵏ du. A hemisphere that faces away from the support, and on whose sphere the
//! lowest point is much nearer than its own, takes F_k from the highest point:
//!
//!   W_k = c_z ∮ ∫_u^1 κ xᵏ du/(1−u²) dψ
//!
//! Integrals along meridians are moments along a segment, in closed form; around the rim the gap is a − b cos ψ, and
//! the rule of `ring` is graded to its smallest value.

use std::f64::consts::TAU;

use pulp::{Simd, WithSimd};

use super::cylinder::circle_support;
use super::half_plane::{AffineMap, TiltedGap};
use super::rules::integrand::{Integrand, LANES};
use super::rules::ring::{Demand, RingChunk, Rings};
use super::rules::rulings::rows_of;
use crate::simd::{F64s, Row, WIDTH, dispatch, fold};
use crate::surface::line::{End, EndKernel, LineKernel, line_moments};
use crate::surface::{GapField, MomentRequest, Moments};
use crate::tensor::{Mat3, Vec3};

/// The half z ≥ 0 of a sphere about the origin, without the disk that closes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hemisphere {
    /// R [m].
    pub radius: f64,
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
        requests: &[MomentRequest],
        lines: &[LineKernel],
        out: &mut [Moments],
    ) -> AffineMap {
        let gap = TiltedGap::new(field);
        let slope = libm::hypot(gap.along, gap.across);
        let (cosine, sine) = if slope > 0.0 { (gap.along / slope, gap.across / slope) } else { (1.0, 0.0) };
        let integrand = Integrand::new(requests);
        let rim = Rim::new((gap.height, self.radius * slope), (cosine, sine), &integrand);
        for ((request, line), moments) in requests.iter().zip(lines).zip(out) {
            rim.sums(request, line).collect(self.radius, (cosine, sine), request.order, moments);
        }
        AffineMap::frame(gap.frame * Mat3::new(cosine, 0.0, -sine, 0.0, 1.0, 0.0, sine, 0.0, cosine))
    }
}

/// Where on the sphere F_k is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
enum From {
    Lowest,
    Highest,
}

/// The rim, the gap on it being near + reach (1 − cos ψ).
#[derive(Debug, Clone, Copy)]
struct Rim {
    ring: &'static [RingChunk],
    near: f64,
    reach: f64,
    /// The gaps of the whole sphere at u = ∓1.
    ends: [f64; 2],
    cosine: f64,
    sine: f64,
    /// x at ψ = 0, 1 − σ to all its digits.
    least: f64,
    from: From,
}

/// W_k and B_i.
#[derive(Debug, Clone, Copy, Default)]
struct RimSums {
    whole: [f64; 4],
    rim: [f64; 3],
}

impl Rim {
    fn new((height, fall): (f64, f64), (cosine, sine): (f64, f64), integrand: &Integrand) -> Self {
        /// As much nearer than the rim the lowest point of the sphere may be to be of use where it is not in the
        /// hemisphere: its kernel is some 1.3^ν times that of the rim.
        const NEARER: f64 = 0.3;
        let (reach, least) = (fall * sine, cosine * cosine / (1.0 + sine));
        let (near, ends) = (height - reach, [height - fall, height + fall]);
        let from = if cosine <= 0.0 || fall * least <= NEARER * ends[0] { From::Lowest } else { From::Highest };
        let far = near + 2.0 * reach;
        // 1/x is singular as a gap is.
        let graded = match from {
            From::Lowest => near,
            From::Highest => near.min(far * least / (1.0 + sine)),
        };
        let degree = integrand.order.max(1) + 1;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree };
        Self { ring: Rings::new(&demand).chunks(graded, far), near, reach, ends, cosine, sine, least, from }
    }

    fn sums(&self, request: &MomentRequest, line: &LineKernel) -> RimSums {
        // Degree 1 is the least that a kernel is prepared for.
        let order = request.order.clamp(1, 3);
        let mut whole = [0.0; 4];
        if self.from == From::Lowest {
            let [low, high] = self.ends.map(|gap| line.sample(gap));
            let along = line.moments(&low, &high, order);
            for (k, (whole, moment)) in whole.iter_mut().zip(along).enumerate().take(order + 1) {
                *whole = f64::from(1 << k) * moment;
            }
        }
        let mut sums = dispatch(RimSweep { rim: self, kernel: EndKernel::new(line), whole, order });
        for (sum, whole) in sums.whole.iter_mut().zip(whole) {
            *sum = TAU * whole + self.cosine * *sum;
        }
        sums
    }
}

impl RimSums {
    /// The moments of a sphere of radius R.
    fn collect(&self, radius: f64, (cosine, sine): (f64, f64), order: usize, out: &mut Moments) {
        let ([w0, w1, w2, w3], [b0, b1, b2]) = (self.whole, self.rim);
        let squared = radius * radius;
        out.zeroth = squared * w0;
        if order >= 1 {
            out.first = squared * radius * Vec3::new(sine * b0, 0.0, w1 - w0);
        }
        if order >= 2 {
            // ½ ∫ κ (1 − u²) and what the ends of arcs make of it.
            let (mean, apart) = (w1 - 0.5 * w2, 0.5 * sine * cosine * b1);
            let xz = -sine * sine * b1;
            let second = Mat3::new(mean + apart, 0.0, xz, 0.0, mean - apart, 0.0, xz, 0.0, w2 - 2.0 * w1 + w0);
            out.second = squared * squared * second;
        }
        if order >= 3 {
            let (mean, apart) = (1.5 * w2 - 0.5 * w3 - w1, 0.5 * sine * sine * cosine * b2);
            let xyy = sine / 3.0 * (b0 - b2);
            let xxx = sine * (b0 - sine * sine * b2) - xyy;
            let zzz = w3 - 3.0 * (w2 - w1) - w0;
            let scale = squared * squared * radius;
            let entries =
                [(0, xxx), (3, xyy), (2, mean - apart), (7, mean + apart), (5, sine * sine * sine * b2), (9, zzz)];
            for (place, entry) in entries {
                out.third.0[place] = scale * entry;
            }
        }
    }
}

/// The pass over the rim for one kernel: compiled for each instruction set.
struct RimSweep<'a> {
    rim: &'a Rim,
    kernel: EndKernel<'a>,
    /// ½ F_k(1).
    whole: [f64; 4],
    order: usize,
}

impl WithSimd for RimSweep<'_> {
    type Output = RimSums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> RimSums {
        match self.order {
            1 => self.folded::<S, 1>(simd),
            2 => self.folded::<S, 2>(simd),
            _ => self.folded::<S, 3>(simd),
        }
    }
}

impl RimSweep<'_> {
    #[inline(always)]
    fn folded<S: Simd, const ORDER: usize>(&self, simd: S) -> RimSums {
        let Rim { ring, near, reach, sine, least, .. } = *self.rim;
        let (mut whole, mut rim) = ([[0.0; WIDTH]; 4], [[0.0; WIDTH]; 3]);
        let poles = self.rim.ends.map(|gap| self.kernel.at(F64s::splat(simd, gap)));
        for pair in ring.chunks(WIDTH / LANES) {
            let [weight, cos, versine, sin_squared] = rows_of(pair);
            for register in 0..WIDTH / S::F64_LANES {
                let load = |row: &Row| F64s::<S>::load(simd, row, register);
                let (weight, versine) = (load(&weight), load(&versine));
                let end = self.kernel.at(versine * reach + near);
                let turned = self.turned::<S, ORDER>(&end, &poles, versine * sine + least);
                for k in 0..=ORDER {
                    (weight * turned[k]).add_to(&mut whole[k], register);
                }
                let mut value = weight * load(&sin_squared) * self.kernel.value(&end);
                for row in rim.iter_mut().take(ORDER) {
                    value.add_to(row, register);
                    value = value * load(&cos);
                }
            }
        }
        RimSums { whole: whole.each_ref().map(fold), rim: rim.each_ref().map(fold) }
    }

    /// What stands by c_z around the rim, at x: of the two forms of it, equal where F_k is from the lowest point, that
    /// which divides by no small number.
    #[inline(always)]
    fn turned<S: Simd, const ORDER: usize>(&self, rim: &End<S>, poles: &[End<S>; 2], x: F64s<S>) -> [F64s<S>; 4] {
        let one = F64s::splat(x.simd, 1.0);
        if self.rim.from == From::Highest || x.smallest() >= 1.0 {
            return self.downward::<S, ORDER>(rim, &poles[1], x);
        }
        let low = self.upward::<S, ORDER>(rim, &poles[0], x);
        if x.largest() < 1.0 {
            return low;
        }
        let high = self.downward::<S, ORDER>(rim, &poles[1], x);
        let is_low = x.less_than(one);
        std::array::from_fn(|k| is_low.select(low[k], high[k]))
    }

    /// [½ F_k(1) − F_k/x]/(1 − u), up the meridian from the lowest point.
    #[inline(always)]
    fn upward<S: Simd, const ORDER: usize>(&self, rim: &End<S>, pole: &End<S>, x: F64s<S>) -> [F64s<S>; 4] {
        let along = line_moments(self.kernel.line, pole, rim, ORDER);
        let splat = |value: f64| F64s::splat(x.simd, value);
        let inverse = 1.0 / (splat(2.0) - x);
        let mut power = splat(1.0);
        std::array::from_fn(|k| {
            let turned = (splat(self.whole[k]) - power * along[k]) * inverse;
            power = power * x;
            turned
        })
    }

    /// [∫ κ xᵏ du/(1 − u) − ½ F_k(1)]/x, from u to 1, down the meridian from the highest point.
    #[inline(always)]
    fn downward<S: Simd, const ORDER: usize>(&self, rim: &End<S>, pole: &End<S>, x: F64s<S>) -> [F64s<S>; 4] {
        let m = line_moments(self.kernel.line, rim, pole, ORDER);
        let splat = |value: f64| F64s::splat(x.simd, value);
        let (above, inverse) = (splat(2.0) - x, 1.0 / x);
        let (xx, both, yy) = (x * x, x * above, above * above);
        let means = [
            m[0],
            x * m[0] + above * m[1],
            xx * m[0] + both * m[1] * 2.0 + yy * m[2],
            (xx * m[0] + both * m[1] * 3.0 + yy * m[2] * 3.0) * x + yy * above * m[3],
        ];
        std::array::from_fn(|k| (means[k] - splat(self.whole[k])) * inverse)
    }
}
