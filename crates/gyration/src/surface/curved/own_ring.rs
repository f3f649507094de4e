//! A rule around a circle that is made for one call: as in `ring`, with a weight that has singularities of its own.
//!
//! The weight |v| of a deformed surface is analytic in θ up to zeros of v·v no nearer to the real axis than iη, at places
//! that need not be known. Under the substitution of `ring`, whose slope is
//!
//!   dw/dθ = 1/(2√v),   v = ½ [(1 + p²) − (1 − p²) cos θ],
//!
//! a zero at θ + iη is at the height h(θ) = ∫₀^η Re dw/dθ(θ + iy) dy, and the trapezoidal rule errs by e^(−2πh/step) there,
//! weighted with what the kernel has fallen to at θ. The frequency 2π/step is the largest that any θ asks for. Such
//! rules depend on the deformation, so that they are made on the spot, in place, and not kept.

use std::f64::consts::{FRAC_PI_2, PI};

use super::super::rule::gauss_legendre;
use super::integrand::LANES;
use super::ring::{Demand, RingChunk, RingNode, SlitMap, frequency};

/// Room for a rule, in chunks; a finer one than this is not made.
const MOST_CHUNKS: usize = 96;

/// Zeros farther away than this need no more points than the powers of cos θ.
const FARTHEST: f64 = 2.0;

/// The singularities of a weight around a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dips {
    /// A lower bound of η.
    pub(super) distance: f64,
    /// The kernel falls like gap^−mildness.
    pub(super) mildness: f64,
    /// Digits wanted at the near end, as a natural logarithm.
    pub(super) digits: f64,
}

/// Digits of the weight |v| itself; its zeros are branch points, whose error is 1e-2 of e^(−2πh/step).
pub(super) const WEIGHT_DIGITS: f64 = 22.0;

/// The rule, for θ from 0 to π.
#[derive(Debug, Clone, Copy)]
pub(super) struct OwnRing {
    chunks: [RingChunk; MOST_CHUNKS],
    count: usize,
}

impl OwnRing {
    /// The rule for gaps between `near` and `far` ≥ `near` > 0.
    pub(super) fn new((near, far): (f64, f64), demand: &Demand, dips: &Dips) -> Self {
        let squared = (near / far).clamp(1e-15, 0.9);
        let map = SlitMap::new(squared);
        let kernel = frequency(demand) * FRAC_PI_2 / map.height;
        let wanted = kernel.max(dips.frequency(&map, far / near)) + 2.0 * demand.degree as f64 * map.p;
        let intervals = map.intervals(wanted).min(MOST_CHUNKS * LANES - 1);
        let count = (intervals + 1).div_ceil(LANES);
        let mut chunks = [RingChunk::default(); MOST_CHUNKS];
        map.fill(intervals, &mut chunks[..count]);
        Self { chunks, count }
    }

    pub(super) fn chunks(&self) -> &[RingChunk] {
        &self.chunks[..self.count]
    }

    /// The same rule, node by node.
    pub(super) fn nodes(&self) -> impl Iterator<Item = RingNode> + '_ {
        self.chunks().iter().flat_map(|chunk| {
            let node = |lane: usize| RingNode {
                weight: chunk.weight[lane],
                cos: chunk.cos[lane],
                versine: chunk.versine[lane],
                sin_squared: chunk.sin_squared[lane],
            };
            (0..LANES).map(node).filter(|node| node.weight != 0.0)
        })
    }

    /// The rule with other weights, which `share` gives as a multiple of the old ones at (cos θ, sin θ).
    pub(super) fn weighted(&self, share: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = *self;
        for chunk in &mut out.chunks[..self.count] {
            for lane in 0..LANES {
                chunk.weight[lane] *= share(chunk.cos[lane], chunk.sin_squared[lane].max(0.0).sqrt());
            }
        }
        out
    }
}

impl Dips {
    /// The frequency that the worst place asks for.
    fn frequency(&self, map: &SlitMap, ratio: f64) -> f64 {
        /// Places at which a zero is imagined.
        const PLACES: u32 = 8;
        let distance = self.distance.min(FARTHEST);
        let places = (0..=PLACES).map(|place| {
            let cos = (PI * f64::from(place) / f64::from(PLACES)).cos();
            let gap = 1.0 + 0.5 * (ratio - 1.0) * (1.0 - cos);
            (self.digits - self.mildness * gap.ln()).max(0.0) / height(map, cos, distance)
        });
        places.fold(0.0, f64::max)
    }
}

/// h(θ), at most K'.
fn height(map: &SlitMap, cos: f64, distance: f64) -> f64 {
    let (squared, sin) = (map.squared, (1.0 - cos * cos).max(0.0).sqrt());
    let mut sum = 0.0;
    for node in gauss_legendre(4) {
        let y = 0.5 * distance * (1.0 + node.at);
        let (real, imaginary) =
            (0.5 * (1.0 + squared - (1.0 - squared) * cos * y.cosh()), 0.5 * (1.0 - squared) * sin * y.sinh());
        let modulus = real.hypot(imaginary);
        if modulus > 0.0 {
            // Re 1/(2√v).
            sum += 0.25 * distance * node.weight * (0.5 * (modulus + real)).max(0.0).sqrt() / modulus;
        }
    }
    sum.clamp(1e-6, map.height)
}
