//! Sums over points of a surface: for patches whose weight varies with both parameters.
//!
//! Points are gathered in groups of [`LANES`], kernels and products of components are computed together, and the sums run
//! lane by lane in a fixed order.

use super::super::Moments;
use super::integrand::{GROUP, Integrand, LANES, Lane, accumulate};
use super::parallels::Sums;
use crate::tensor::Vec3;

/// Moments of all kernels over points that are added one by one.
pub(super) struct PointSums<'a> {
    integrand: &'a Integrand,
    sums: Sums,
    gaps: Lane,
    weights: Lane,
    at: [Lane; 3],
    count: usize,
}

impl<'a> PointSums<'a> {
    pub(super) fn new(integrand: &'a Integrand) -> Self {
        let unused = [0.0; LANES];
        Self { integrand, sums: Sums::ZERO, gaps: [1.0; LANES], weights: unused, at: [unused; 3], count: 0 }
    }

    /// Adds a point with its weight and gap.
    #[inline(always)]
    pub(super) fn add(&mut self, gap: f64, weight: f64, at: &Vec3) {
        let lane = self.count;
        (self.gaps[lane], self.weights[lane]) = (gap, weight);
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
        let mut components = [[0.0; LANES]; 20];
        for lane in 0..LANES {
            let (w, [x, y, z]) = (self.weights[lane], self.at.map(|lanes| lanes[lane]));
            let (wx, wy, wz) = (w * x, w * y, w * z);
            let second = [wx * x, wx * y, wx * z, wy * y, wy * z, wz * z];
            let [xx, xy, xz, yy, yz, zz] = second;
            let third = [xx * x, xx * y, xx * z, xy * y, xy * z, xz * z, yy * y, yy * z, yz * z, zz * z];
            let all = [w, wx, wy, wz].into_iter().chain(second).chain(third);
            for (component, value) in components.iter_mut().zip(all) {
                component[lane] = value;
            }
        }
        let used = [1, 4, 10, 20][self.integrand.order.min(3)];
        let values = self.integrand.at_each(&self.gaps);
        for (value, sums) in values.iter().zip(&mut self.sums.lanes).take(self.integrand.count().min(GROUP)) {
            accumulate(value, &components[..used], &mut sums[..used]);
        }
        (self.count, self.weights) = (0, [0.0; LANES]);
    }

    /// The sums, once all points have been added.
    #[inline(always)]
    pub(super) fn finish(mut self) -> Sums {
        if self.count > 0 {
            self.flush();
        }
        self.sums
    }
}

impl Sums {
    /// Sets the moments of all kernels up to the orders asked for.
    pub(super) fn collect_all(&self, requests: &[super::super::MomentRequest], out: &mut [Moments]) {
        for (place, (request, moments)) in requests.iter().zip(out).enumerate() {
            self.collect(place, request.order, moments);
        }
    }
}
