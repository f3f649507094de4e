//! Sums over points of a surface: for patches whose weight varies with both parameters.
//!
//! Points are gathered in groups of [`LANES`], kernels and products of components are computed together, and the sums
//! run lane by lane in a fixed order.

use super::integrand::{GROUP, Integrand, LANES, Lane};
use super::parallels::{TO_THIRD, collect};
use crate::surface::{MomentRequest, Moments};
use crate::tensor::Vec3;

/// Moments of all kernels over points that are added one by one, each with several weights.
pub(crate) struct PointSums<'a, const W: usize> {
    integrand: &'a Integrand,
    sums: [KernelSums; W],
    gaps: Lane,
    weights: [Lane; W],
    at: [Lane; 3],
    count: usize,
}

impl<'a, const W: usize> PointSums<'a, W> {
    pub(crate) fn new(integrand: &'a Integrand) -> Self {
        let unused = [0.0; LANES];
        let (gaps, weights, at) = ([1.0; LANES], [unused; W], [unused; 3]);
        Self { integrand, sums: [KernelSums::ZERO; W], gaps, weights, at, count: 0 }
    }

    /// Adds a point with its gap, its area and its weights per area.
    #[inline(always)]
    pub(crate) fn add(&mut self, (gap, area): (f64, f64), weights: &[f64; W], at: &Vec3) {
        let lane = self.count;
        self.gaps[lane] = gap;
        for (lanes, weight) in self.weights.iter_mut().zip(weights) {
            lanes[lane] = area * *weight;
        }
        for (lanes, x) in self.at.iter_mut().zip(at) {
            lanes[lane] = *x;
        }
        self.count += 1;
        if self.count == LANES {
            self.flush();
        }
    }

    /// Works on the points gathered.
    #[inline(always)]
    fn flush(&mut self) {
        let powers = powers(&self.at);
        let used = [1, 4, 10, 20][self.integrand.order.min(3)];
        let values = self.integrand.at_each(&self.gaps);
        for (weights, sums) in self.weights.iter_mut().zip(&mut self.sums) {
            for (value, sums) in values.iter().zip(&mut sums.lanes).take(self.integrand.count()) {
                let weighted = times(value, weights);
                accumulate(&weighted, &powers[..used], &mut sums[..used]);
            }
            *weights = [0.0; LANES];
        }
        self.count = 0;
    }

    /// The sums, once all points have been added.
    #[inline(always)]
    pub(crate) fn finish(mut self) -> [KernelSums; W] {
        if self.count > 0 {
            self.flush();
        }
        self.sums
    }
}

/// Adds value × component to the sums, lane by lane.
#[inline(always)]
fn accumulate(value: &Lane, components: &[Lane], sums: &mut [Lane]) {
    for (sum, component) in sums.iter_mut().zip(components) {
        for lane in 0..LANES {
            sum[lane] += value[lane] * component[lane];
        }
    }
}

#[inline(always)]
fn times(a: &Lane, b: &Lane) -> Lane {
    let mut product = *a;
    for (product, b) in product.iter_mut().zip(b) {
        *product *= b;
    }
    product
}

/// 1, x … z, xx … zz, xxx … zzz.
#[inline(always)]
fn powers([x, y, z]: &[Lane; 3]) -> [Lane; 20] {
    let (xx, xy, xz, yy, yz, zz) = (times(x, x), times(x, y), times(x, z), times(y, y), times(y, z), times(z, z));
    let (xxx, xxy, xxz, xyy) = (times(&xx, x), times(&xx, y), times(&xx, z), times(&yy, x));
    let (xyz, xzz, yyy, yyz) = (times(&xy, z), times(&zz, x), times(&yy, y), times(&yy, z));
    let (yzz, zzz) = (times(&zz, y), times(&zz, z));
    [[1.0; LANES], *x, *y, *z, xx, xy, xz, yy, yz, zz, xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz]
}

/// The components of 1, x … zzz for each kernel, lane by lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct KernelSums {
    lanes: [[Lane; TO_THIRD]; GROUP],
}

impl KernelSums {
    const ZERO: Self = Self { lanes: [[[0.0; LANES]; TO_THIRD]; GROUP] };

    /// Sets the moments of all kernels up to the orders asked for.
    pub(crate) fn collect_all(&self, requests: &[MomentRequest], out: &mut [Moments]) {
        let sums = self.lanes.map(|sums| sums.map(|lanes| lanes.iter().sum()));
        collect::<TO_THIRD>(&sums, requests, out);
    }
}
