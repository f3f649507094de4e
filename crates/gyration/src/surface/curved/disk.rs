//! Moments over a flat disk.
//!
//! On a chord across the fall of the gap the gap is constant. With the chord at x = R cos θ, half as long as R sin θ,
//!
//!   A₀ = ∫ κ(a − b cos θ) R² sin²θ dθ around the full circle,   ⟨y²⟩ = R² sin²θ/3 on the chord,
//!
//! so that one sum around the rim, graded by `ring`, gives all moments.

use std::f64::consts::PI;

use pulp::{Simd, WithSimd};

use super::cylinder::circle_support;
use super::half_plane::{AffineMap, TiltedGap};
use super::rules::integrand::{GROUP, Integrand, LANES, Lane};
use super::rules::ring::{Demand, RingChunk, Rings};
use super::rules::weight::{Deformed, Weighted};
use crate::simd::dispatch;
use crate::surface::{GapField, MomentRequest, Moments};
use crate::tensor::Vec3;

/// A disk about the z axis in the plane z = 0, one side of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk {
    /// R [m].
    pub radius: f64,
}

impl Disk {
    /// πR² [m²].
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// The point farthest along `direction`.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        circle_support(self.radius, 0.0, direction)
    }

    /// Sums the moments in the frame of [`TiltedGap`]; every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> AffineMap {
        let gap = TiltedGap::new(field);
        let integrand = Integrand::new(requests);
        let reach = self.radius * gap.across;
        let near = gap.height - reach;
        let demand = Demand { sharpest: integrand.sharpest, mildest: integrand.mildest, degree: integrand.order + 2 };
        let chords = Chords { ring: Rings::new(&demand).chunks(near, near + 2.0 * reach), near, reach, integrand };
        let sums = dispatch(chords);
        for ((sums, request), moments) in sums.iter().zip(requests).zip(out.iter_mut()) {
            self.collect(&sums.map(|lanes| lanes.iter().sum()), request.order, moments);
        }
        AffineMap::frame(gap.frame)
    }

    /// The same for a deformed disk, whose weight is the same everywhere.
    pub(crate) fn deformed_moments<const N: usize, const W: usize>(
        &self,
        deformed: &Deformed<N, W>,
        requests: &[MomentRequest],
        out: &mut Weighted<W>,
    ) -> AffineMap {
        let mut sums = [Moments::default(); GROUP];
        let map = self.moments(&deformed.field, requests, &mut sums);
        let weights = deformed.weights.of(&deformed.cofactor.column(2).into());
        for (out, weight) in out.iter_mut().zip(weights) {
            *out = sums;
            out.iter_mut().for_each(|moments| moments.scale(weight));
        }
        map
    }

    /// The moments from the sums of 1, x, x², y², x³, xy² in units of R.
    fn collect(&self, sums: &[f64; 6], order: usize, out: &mut Moments) {
        let (first, squared) = (self.radius, self.radius * self.radius);
        out.zeroth = squared * sums[0];
        if order >= 1 {
            out.first.x = squared * first * sums[1];
        }
        if order >= 2 {
            (out.second.m11, out.second.m22) = (squared * squared * sums[2], squared * squared * sums[3]);
        }
        if order >= 3 {
            (out.third.0[0], out.third.0[3]) =
                (squared * squared * first * sums[4], squared * squared * first * sums[5]);
        }
    }
}

/// The pass over the chords, the gap being near + reach · versine: compiled for each instruction set.
struct Chords {
    ring: &'static [RingChunk],
    near: f64,
    reach: f64,
    integrand: Integrand,
}

impl WithSimd for Chords {
    type Output = [[Lane; 6]; GROUP];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let cut = self.integrand.cut(self.near, 1.5);
        let mut sums = [[[0.0; LANES]; 6]; GROUP];
        for chunk in self.ring {
            let gaps = chunk.versine.map(|versine| self.near + self.reach * versine);
            if gaps[0] > cut {
                break;
            }
            let values = self.integrand.at_each(&gaps);
            for (value, sums) in values.iter().zip(&mut sums).take(self.integrand.count()) {
                add_chords(chunk, value, sums);
            }
        }
        sums
    }
}

/// Adds ∫ κ {1, x, x², y², x³, xy²} over the chords of a chunk, in units of R.
#[inline(always)]
fn add_chords(chunk: &RingChunk, value: &Lane, sums: &mut [Lane; 6]) {
    for lane in 0..LANES {
        let (x, squared) = (chunk.cos[lane], chunk.sin_squared[lane]);
        let w = chunk.weight[lane] * squared * value[lane];
        // ⟨y²⟩ of a chord of half length sin θ.
        let across = squared * (1.0 / 3.0);
        let (wx, wxx) = (w * x, w * x * x);
        sums[0][lane] += w;
        sums[1][lane] += wx;
        sums[2][lane] += wxx;
        sums[3][lane] += w * across;
        sums[4][lane] += wxx * x;
        sums[5][lane] += wx * across;
    }
}
