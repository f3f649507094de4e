//! Where an integral over the parallels of an ellipsoid needs fine resolution.
//!
//! As a function of the polar angle θ from the lowest point f, the integral of the area element |B s| around a parallel
//! is analytic, but singular close to real θ where the parallel touches the place where |B s| dips: the ends ±e_i of the
//! longest axis (B_i smallest), at cos θ = |f_i|, and the great circle normal to the shortest axis (B_j largest), at
//! sin θ = |f_j|. The distance of the singularity is about (|B s| in the dip)/(largest B). The gap vanishes at θ = iη.

use std::f64::consts::PI;

use super::super::rule::{GradedInterval, Singularity};
use super::integrand::Integrand;
use crate::tensor::Vec3;

/// The features of one call.
#[derive(Debug, Clone, Copy)]
pub(super) struct Features {
    singularities: [Singularity; MOST],
    count: usize,
    /// Half of this is how much the gap rises from θ = 0 to ½π, as a share of the smallest.
    rise: f64,
    /// Parallels weigh as (d/near)^−mildness, at most e^excess times more where |B s| is larger than at the lowest point.
    mildness: f64,
    excess: f64,
}

/// The gap, the two ends of the longest axis, two tangents of the great circle.
const MOST: usize = 5;

/// Digits of the result, as a natural logarithm.
const DIGITS: f64 = 25.0;

/// The same where the area element dips: a few more, since κ is not smallest there.
const AREA_DIGITS: f64 = 28.0;

/// Dips narrower than this get intervals of their own; wider ones only more points.
const NARROW: f64 = 0.25;

impl Features {
    /// The features for gaps from `near` to `far`, cofactor B and lowest direction f.
    pub(super) fn new(near: f64, far: f64, cofactor: &Vec3, lowest: &Vec3, integrand: &Integrand) -> Self {
        let grazing = 2.0 * (near / far).sqrt().min(1.0 - 1e-9).atanh();
        let pole = Singularity { at: 0.0, distance: grazing, digits: DIGITS + 1.6 * integrand.sharpest.max(0.0) };
        let mildness = (integrand.mildest - 1.0).max(0.0);
        let (i, j) = (cofactor.imin(), cofactor.imax());
        let excess = (cofactor[j] * mildness.max(1.0) / cofactor.component_mul(lowest).norm()).ln();
        let mut features = Self { singularities: [pole; MOST], count: 1, rise: far / near - 1.0, mildness, excess };
        features.push_pair(lowest[i].abs().min(1.0).acos(), cofactor[i] / cofactor[j]);
        let mut touching = *lowest;
        touching[j] = 0.0;
        let length = touching.norm();
        if length > 1e-8 {
            let dip = cofactor.component_mul(&touching).norm() / length;
            features.push_pair(lowest[j].abs().min(1.0).asin(), dip / cofactor[j]);
        }
        features
    }

    /// A dip at θ and, since −X lies as X, at π − θ. Of a sphere nothing dips.
    fn push_pair(&mut self, at: f64, share: f64) {
        if share < 1.0 - 1e-9 {
            let distance = share.atanh();
            for at in [at, PI - at] {
                self.singularities[self.count] = Singularity { at, distance, digits: AREA_DIGITS };
                self.count += 1;
            }
        }
    }

    /// The distance of the nearest singularity from θ.
    fn clearance(&self, theta: f64) -> f64 {
        let distance = |s: &Singularity| s.distance.hypot(theta - s.at).min(s.distance.hypot(theta + s.at));
        self.singularities[..self.count].iter().map(distance).fold(2.0, f64::min)
    }

    /// The e-folds by which the parallel at θ weighs less than the lowest part of the surface.
    pub(super) fn spared(&self, theta: f64) -> f64 {
        let half = (0.5 * theta).sin();
        (self.mildness * (self.rise * half * half).ln_1p() - self.excess).max(0.0)
    }

    /// The angle beyond which parallels are negligible, or π.
    fn last(&self) -> f64 {
        /// e^−28 ≈ 1e-12.
        const NEGLIGIBLE: f64 = 28.0;
        let drop = ((NEGLIGIBLE + self.excess) / self.mildness).exp_m1() / self.rise;
        if drop < 1.0 { 2.0 * drop.sqrt().asin() } else { PI }
    }

    /// The intervals that cover 0 ≤ θ ≤ π as far as it counts, each with its number of points.
    pub(super) fn intervals(&self) -> impl Iterator<Item = (GradedInterval, usize)> + '_ {
        let last = self.last();
        let mut breaks = [last; MOST + 2];
        breaks[0] = 0.0;
        let mut count = 1;
        for singularity in &self.singularities[1..self.count] {
            if singularity.distance < NARROW && singularity.at < last {
                breaks[count] = singularity.at;
                count += 1;
            }
        }
        breaks[..count].sort_by(f64::total_cmp);
        (0..count).flat_map(move |k| {
            let (left, right) = (breaks[k], breaks[k + 1]);
            let middle = 0.5 * (left + right);
            [(left, middle), (right, middle)].into_iter().filter(move |_| left < right).map(|(from, to)| {
                let interval = GradedInterval { from, to, width: self.clearance(from) };
                (interval, interval.points(&self.resolved(from.min(to))[..self.count]))
            })
        })
    }

    /// The singularities with the digits that matter where κ has fallen to its value at θ.
    fn resolved(&self, theta: f64) -> [Singularity; MOST] {
        let spared = self.spared(theta);
        self.singularities.map(|s| Singularity { digits: (s.digits - spared).max(4.0), ..s })
    }
}
