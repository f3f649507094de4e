//! A rule around a circle that is made for one call: as in `ring`, with a weight that has singularities of its own.
//!
//! The weight |v| of a deformed surface is analytic in θ up to zeros of v·v no nearer to the real axis than iη, at
//! places that need not be known. The substitution tan(θ/2) = p sc(w) of `ring` carries a zero at θ + iη to the height
//! h(θ) = Im w, and the trapezoidal rule errs by e^(−2πh/step) there, weighted with what the kernel has fallen to at θ.
//! The frequency 2π/step is the largest that any θ asks for. Near the low end and far from it
//!
//!   sc(w) ≈ sinh w:         h ≈ cos(θ/2) Im asinh(tan(ζ/2)/p),   ζ = θ + iη,
//!   p sc(w) ≈ csch(K − w):  h ≈ sin(θ/2)/√(p² cos²(θ/2) + sin²(θ/2)) |Im asinh(cot(ζ/2))|.
//!
//! Such rules depend on the deformation, so that they are made on the spot, in place, and not kept.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use pulp::{Simd, WithSimd};

use super::integrand::{LANES, Lane};
use super::ring::{Demand, RingChunk, RingNode, frequency, mean, nodes, sine_and_cosine};
use crate::simd::dispatch;

/// Room for a rule, in chunks; a finer one than this is not made.
const MOST_CHUNKS: usize = 96;

/// Zeros farther away than this need no more points than the powers of cos θ.
const FARTHEST: f64 = 2.0;

/// The singularities of a weight around a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dips {
    /// A lower bound of η.
    pub(crate) distance: f64,
    /// The kernel falls like gap^−mildness.
    pub(crate) mildness: f64,
    /// Digits wanted at the near end, as a natural logarithm.
    pub(crate) digits: f64,
}

/// Digits of the weight |v| itself; its zeros are branch points, whose error is 1e-2 of e^(−2πh/step).
pub(crate) const WEIGHT_DIGITS: f64 = 22.0;

/// The rule, for θ from 0 to π.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OwnRing {
    chunks: [RingChunk; MOST_CHUNKS],
    count: usize,
}

impl OwnRing {
    /// The rule for gaps between `near` and `far` ≥ `near` > 0.
    ///
    /// The weight grows like cos θ towards ±i∞ and counts as one degree of the demand.
    #[inline(always)]
    pub(crate) fn new((near, far): (f64, f64), demand: &Demand, dips: &Dips) -> Self {
        let squared = (near / far).clamp(1e-15, 0.9);
        let p = squared.sqrt();
        let (quarter, height) = (FRAC_PI_2 / mean(p), FRAC_PI_2 / mean((1.0 - squared).sqrt()));
        let kernel = frequency(demand) * FRAC_PI_2 / height;
        let wanted = kernel.max(dips.frequency(p, far / near)) + 2.0 * demand.degree as f64 * p;
        let intervals = ((quarter * wanted / TAU).ceil().max(1.0) as usize + 1).min(MOST_CHUNKS * LANES - 1);
        let count = (intervals + 1).div_ceil(LANES);
        let mut chunks = [RingChunk::default(); MOST_CHUNKS];
        dispatch(Fill { squared, step: quarter / intervals as f64, intervals, chunks: &mut chunks[..count] });
        Self { chunks, count }
    }

    pub(crate) fn chunks(&self) -> &[RingChunk] {
        &self.chunks[..self.count]
    }

    /// The same rule, node by node.
    #[inline(always)]
    pub(crate) fn nodes(&self) -> impl Iterator<Item = RingNode> + '_ {
        nodes(self.chunks())
    }
}

/// The points of a rule, from both ends to the middle: compiled for each instruction set.
///
/// At u from the end, sn(K − u) = cn/dn, cn(K − u) = p sn/dn and dn(K − u) = p/dn, so that cot(θ/2) = sn/cn: both
/// halves follow from the functions on 0 ≤ u ≤ K/2, over which they keep their digits.
struct Fill<'a> {
    squared: f64,
    step: f64,
    intervals: usize,
    chunks: &'a mut [RingChunk],
}

impl WithSimd for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { squared, step, intervals, chunks } = self;
        let (p, modulus) = (squared.sqrt(), 1.0 - squared);
        let one = Elliptic::new(sine_and_cosine(step, p), squared);
        let two = one.after(&one, modulus);
        let (three, four) = (two.after(&one, modulus), two.after(&two, modulus));
        // Lane j runs through j, j + 4, j + 8 …
        let starts = [Elliptic { sn: 0.0, cn: 1.0, dn: 1.0 }, one, two, three];
        let (mut sn, mut cn): (Lane, Lane) = (starts.map(|start| start.sn), starts.map(|start| start.cn));
        for first in (0..=intervals / 2).step_by(LANES) {
            let (mut near, mut far) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3]);
            for lane in 0..LANES {
                let (ss, cc) = (sn[lane] * sn[lane], cn[lane] * cn[lane]);
                let dn_squared = cc + squared * ss;
                let (dn, inverse) = (dn_squared.sqrt(), 1.0 / dn_squared);
                let halves = [(&mut near, squared * ss * inverse, cc * inverse), (&mut far, cc, ss)];
                for (point, half_sine, half_cosine) in halves {
                    (point[1][lane], point[2][lane]) = (half_sine, half_cosine);
                }
                (near[0][lane], far[0][lane]) = (4.0 * step * p * dn * inverse, 4.0 * step * dn);
                let next = Elliptic { sn: sn[lane], cn: cn[lane], dn }.after(&four, modulus);
                (sn[lane], cn[lane]) = (next.sn, next.cn);
            }
            for lane in 0..LANES {
                let place = first + lane;
                if 2 * place <= intervals {
                    // The ends stand for one point each, others for θ and −θ.
                    let share = if place == 0 { 0.5 } else { 1.0 };
                    set(chunks, intervals - place, share, far.map(|lanes| lanes[lane]));
                    set(chunks, place, share, near.map(|lanes| lanes[lane]));
                }
            }
        }
    }
}

/// Sets a point from its weight and the squares of the sine and the cosine of θ/2.
#[inline(always)]
fn set(chunks: &mut [RingChunk], place: usize, share: f64, [weight, half_sine, half_cosine]: [f64; 3]) {
    let (chunk, lane) = (&mut chunks[place / LANES], place % LANES);
    chunk.weight[lane] = share * weight;
    chunk.cos[lane] = half_cosine - half_sine;
    chunk.versine[lane] = 2.0 * half_sine;
    chunk.sin_squared[lane] = 4.0 * half_sine * half_cosine;
}

/// sn, cn, dn of one argument.
#[derive(Clone, Copy)]
struct Elliptic {
    sn: f64,
    cn: f64,
    dn: f64,
}

impl Elliptic {
    #[inline(always)]
    fn new((sn, cn): (f64, f64), squared: f64) -> Self {
        Self { sn, cn, dn: (cn * cn + squared * sn * sn).sqrt() }
    }

    /// The functions of the sum of two arguments.
    #[inline(always)]
    fn after(&self, by: &Self, modulus: f64) -> Self {
        let inverse = 1.0 / (1.0 - modulus * self.sn * self.sn * by.sn * by.sn);
        let sn = (self.sn * by.cn * by.dn + by.sn * self.cn * self.dn) * inverse;
        let cn = (self.cn * by.cn - self.sn * self.dn * by.sn * by.dn) * inverse;
        Self::new((sn, cn), 1.0 - modulus)
    }
}

impl Dips {
    /// The frequency that the worst place asks for, for gaps in this ratio.
    #[inline(always)]
    fn frequency(&self, p: f64, ratio: f64) -> f64 {
        /// Places at which a zero is imagined, beside θ = 0.
        const PLACES: usize = 6;
        let distance = self.distance.min(FARTHEST);
        let (sinh, cosh) = (libm::sinh(distance), libm::cosh(distance));
        (0..=PLACES).fold(0.0, |worst: f64, place| {
            let (sin, cos) = libm::sincos(PI * place as f64 / PLACES as f64);
            let gap = 1.0 + 0.5 * (ratio - 1.0) * (1.0 - cos);
            let digits = self.digits - if self.mildness > 0.0 { self.mildness * libm::log(gap) } else { 0.0 };
            if digits <= 0.0 { worst } else { worst.max(digits / height(p, (sin, cos), (sinh, cosh))) }
        })
    }
}

/// h(θ) from p, (sin, cos) θ and (sinh, cosh) η.
#[inline(always)]
fn height(p: f64, (sin, cos): (f64, f64), (sinh, cosh): (f64, f64)) -> f64 {
    // Squares of the sine and the cosine of θ/2.
    let (low, high) = (0.5 * (1.0 - cos), 0.5 * (1.0 + cos));
    let height = if low < p * high {
        let scale = 1.0 / (p * (cos + cosh));
        high.sqrt() * asinh_imaginary(sin * scale, sinh * scale)
    } else {
        let scale = 1.0 / (cosh - cos);
        (low / (p * p * high + low)).sqrt() * asinh_imaginary(sin * scale, sinh * scale)
    };
    height.max(1e-6)
}

/// Im asinh(x + iy) for y ≥ 0.
#[inline(always)]
fn asinh_imaginary(x: f64, y: f64) -> f64 {
    let sum = 0.5 * ((x * x + (y + 1.0) * (y + 1.0)).sqrt() + (x * x + (y - 1.0) * (y - 1.0)).sqrt());
    libm::asin((y / sum).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∮ √(1 + e² − 2e cos(θ − θ₀)) (near + … versine)^−ν dθ, which has branch points at θ₀ ± i ln(1/e).
    fn integral(ring: &OwnRing, near: f64, nu: f64, distance: f64, at: f64) -> f64 {
        let weight = |sin: f64, cos: f64| {
            let e = (-distance).exp();
            (1.0 + e * e - 2.0 * e * (cos * at.cos() + sin * at.sin())).sqrt()
        };
        let term = |n: RingNode| {
            let sin = n.sin_squared.sqrt();
            let kernel = (near + 0.5 * (1.0 - near) * n.versine).powf(-nu);
            0.5 * n.weight * kernel * (weight(sin, n.cos) + weight(-sin, n.cos))
        };
        ring.nodes().map(term).sum()
    }

    #[test]
    fn weights_with_branch_points_are_resolved_wherever_they_are() {
        let mut worst: f64 = 0.0;
        for near in [1e-6, 1e-3, 0.1, 0.9] {
            for nu in [0.0, 1.0, 4.0, 9.0] {
                for distance in [0.2, 0.5, 3.0] {
                    let demand = Demand { sharpest: nu, mildest: nu, degree: 1 };
                    let dips = Dips { distance, mildness: (nu - 0.5_f64).max(0.0), digits: WEIGHT_DIGITS };
                    let ring = OwnRing::new((near, 1.0), &demand, &dips);
                    let fine = OwnRing::new((near, 1.0), &demand, &Dips { digits: 3.0 * WEIGHT_DIGITS, ..dips });
                    for at in [0.0, 0.3, 1.0, 2.0, 3.0] {
                        let (found, exact) =
                            (integral(&ring, near, nu, distance, at), integral(&fine, near, nu, distance, at));
                        let error = (found / exact - 1.0).abs();
                        worst = worst.max(error);
                        assert!(error < 1e-10, "near {near}, ν {nu}, distance {distance}, at {at}: {error:e}");
                    }
                }
            }
        }
        println!("ring with a weight: worst relative error {worst:.1e}");
    }
}
