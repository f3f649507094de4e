//! Where an integral over the parallels of an ellipsoid needs fine resolution, and the rule that gives it.
//!
//! As a function of x = 1 − cos θ, θ from the lowest point f, the integral of the area element |B s| around a parallel
//! is analytic, but singular close to real θ where the parallel touches the place where |B s| dips: the ends ±e_i of
//! the longest axis (B_i smallest), at cos θ = |f_i|, and the great circle normal to the shortest axis (B_j largest),
//! at sin θ = |f_j|. The distance of the singularity is about (|B s| in the dip)/(largest B). The gap is (near/δ)(δ +
//! x), for which `polar` keeps rules, of depths δ a little smaller. Only 0 ≤ x ≤ 1 is covered: the other half mirrors
//! it. Where dips are so narrow that one rule would need too many points, the range is cut at them and graded to each.

use std::f64::consts::{FRAC_PI_2, LN_2};

use super::graded::{GradedInterval, Singularity};
use super::integrand::Integrand;
use super::polar::{Depth, LARGEST_DEPTH, MOST_ROWS, ParallelRow, PolarNode};
use crate::simd::WIDTH;
use crate::tensor::Vec3;

/// A place θ where |B s| dips to `share` of its largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dip {
    cos: f64,
    sin: f64,
    share: f64,
}

/// The features of one call.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Features {
    dips: [Dip; MOST_DIPS],
    /// δ, at most the smallest gap by the rise of the gap from the lowest point to x = 1.
    depth: &'static Depth,
    sharpest: f64,
    mildest: f64,
    /// Parallels weigh as (1 + x/δ)^−mildness, at most e^excess times more where |B s| is larger than at the lowest
    /// point, and since δ is smaller than the gap's.
    mildness: f64,
    excess: f64,
    /// Further digits for weights that are harder to resolve than |B s|.
    extra: f64,
}

/// The end of the longest axis, the great circle normal to the shortest.
const MOST_DIPS: usize = 2;

/// Digits of the result as a natural logarithm, where it is the area element that dips.
const DIGITS: f64 = 20.0;

/// The same in rules that are graded to dips, and for the zero of the gap where it is seen as a singularity.
const GRADED_DIGITS: f64 = 28.0;
const GAP_DIGITS: f64 = 25.0;

/// Parallels that weigh less than e^−28 ≈ 1e-12 are left out.
const NEGLIGIBLE: f64 = 28.0;

/// Where one rule would need more points than this, the range is cut at the dips.
const MOST_POINTS: f64 = (MOST_ROWS * WIDTH) as f64;

/// Dips narrower than this get intervals of their own; wider ones only more points.
const NARROW: f64 = 0.25;

/// The dips for the cofactor B and the lowest direction f, both in the axes of B.
pub(crate) fn dips(cofactor: &Vec3, lowest: &Vec3) -> [Dip; MOST_DIPS] {
    let (i, j) = (cofactor.imin(), cofactor.imax());
    let mut touching = *lowest;
    touching[j] = 0.0;
    let length = touching.norm();
    let dip = if length > 1e-8 { cofactor.component_mul(&touching).norm() / length } else { cofactor[j] };
    let (pole, across) = (lowest[i].abs().min(1.0), lowest[j].abs().min(1.0));
    let other = |x: f64| (1.0 - x * x).max(0.0).sqrt();
    [
        Dip { cos: pole, sin: other(pole), share: cofactor[i] / cofactor[j] },
        Dip { cos: other(across), sin: across, share: dip / cofactor[j] },
    ]
}

impl Dip {
    /// Its singularities at θ and, since −X lies as X, at π − θ.
    pub(crate) fn singularities(&self, digits: f64) -> [Singularity; 2] {
        let distance = libm::atanh(self.share.min(1.0 - 1e-9));
        [self.cos, -self.cos].map(|cos| Singularity { at: libm::atan2(self.sin, cos), distance, digits })
    }
}

impl Features {
    /// The features for the smallest gap `near`, which rises by `reach` to x = 1, cofactor B and lowest direction f.
    pub(crate) fn new(near: f64, reach: f64, cofactor: &Vec3, lowest: &Vec3, integrand: &Integrand) -> Self {
        let largest = cofactor.max();
        let mildness = (integrand.mildest - 1.0).max(0.0);
        let dipped = largest * mildness.max(1.0) / cofactor.component_mul(lowest).norm();
        Self {
            dips: dips(cofactor, lowest),
            // A gap within rounding has no known size.
            depth: Depth::at_most((near / reach).clamp(1e-15, LARGEST_DEPTH)),
            sharpest: integrand.sharpest,
            mildest: integrand.mildest,
            mildness,
            excess: libm::log(dipped) + 0.5 * LN_2 * mildness,
            extra: 0.0,
        }
    }

    /// The features for a weight whose singularities need so many more digits.
    pub(crate) fn sharpened(self, extra: f64) -> Self {
        Self { extra, ..self }
    }

    /// The parallels from the lowest point to θ = ½π, as far as they count, and the e-folds by which the heaviest of a
    /// row weighs less than the lowest part of the surface.
    pub(crate) fn rows(&self) -> impl Iterator<Item = (ParallelRow, f64)> + '_ {
        let points = self.points();
        let kept = if points <= MOST_POINTS { self.depth.rule(points) } else { &[] };
        let graded = (points > MOST_POINTS).then(|| self.graded());
        let mut counting = graded.into_iter().flatten().filter(|node| self.spared(node.growth) < NEGLIGIBLE);
        let rows = kept.iter().copied().chain(std::iter::from_fn(move || ParallelRow::gather(&mut counting)));
        rows.map(|row| (row, self.spared(row.growth))).take_while(|(_, spared)| *spared < NEGLIGIBLE)
    }

    /// Points of a rule in y that resolves the exponentials and both dips.
    ///
    /// Gauss integrates e^(2ct) with 7 + 3√c points to 1e-12 (a fit on the safe side). For the dips it converges like
    /// r^−2n, r the sum of the semi-axes of the ellipse with foci ±1 through the singularity, t = 2 ln(1 + x/δ)/span
    /// − 1.
    fn points(&self) -> f64 {
        /// For the smooth factors beside the singularities.
        const SPARE: f64 = 3.0;
        let (depth, span) = (self.depth.depth, self.depth.span);
        let growth = (self.sharpest - 1.0).max(4.0 - self.mildest).max(3.0);
        let exponentials = 7.0 + 3.0 * (0.5 * growth * span).sqrt();
        // The far half sees the zero of the gap at x = 2 + δ, beyond the end.
        let beyond = 2.0 * libm::acosh(1.0 + 2.0 * LN_2 / span);
        let far = (DIGITS + self.sharpest - self.mildness * span).max(3.0) / beyond + SPARE;
        let mut points = exponentials.max(far);
        for dip in self.dips.iter().filter(|dip| dip.share < 1.0 - 1e-9) {
            let hyperbolic = 1.0 / (1.0 - dip.share * dip.share).sqrt();
            let imaginary = dip.sin * dip.share * hyperbolic / depth;
            for cos in [dip.cos, -dip.cos] {
                let real = 1.0 + (1.0 - cos * hyperbolic) / depth;
                let log = 0.5 * libm::log(real * real + imaginary * imaginary);
                let (t, height) = (2.0 * log / span - 1.0, 2.0 * libm::atan2(imaginary, real) / span);
                let s = 0.5 * (length(t - 1.0, height) + length(t + 1.0, height));
                let rate = 2.0 * libm::log(s + (s * s - 1.0).max(0.0).sqrt());
                let spared = (self.mildness * log - self.excess).max(0.0);
                points = points.max((DIGITS + self.extra - spared).max(3.0) / rate + SPARE);
            }
        }
        points.ceil()
    }

    /// Intervals in θ between the narrow dips, each graded to both of its ends.
    fn graded(&self) -> impl Iterator<Item = PolarNode> + '_ {
        let singularities = self.singularities();
        let mut breaks = [FRAC_PI_2; MOST_DIPS + 2];
        breaks[0] = 0.0;
        let mut count = 1;
        for singularity in singularities[1..].iter().filter(|s| s.distance < NARROW && s.at < FRAC_PI_2) {
            if count <= MOST_DIPS {
                breaks[count] = singularity.at;
                count += 1;
            }
        }
        breaks[..count].sort_by(f64::total_cmp);
        let halves = (0..count).flat_map(move |k| {
            let (left, right) = (breaks[k], breaks[k + 1]);
            let middle = 0.5 * (left + right);
            [(left, middle), (middle, right)].into_iter().zip([true, false]).filter(move |_| left < right)
        });
        halves.flat_map(move |((left, right), dense_left)| {
            let (from, to) = if dense_left { (left, right) } else { (right, left) };
            let interval = GradedInterval { from, to, width: clearance(&singularities, from) };
            let spared = self.spared(self.growth(left));
            let resolved = singularities.map(|s| Singularity { digits: (s.digits - spared).max(4.0), ..s });
            interval.nodes(interval.points(&resolved)).map(|node| self.polar(node.at, node.weight))
        })
    }

    /// The zero of the gap, then those of the dips.
    fn singularities(&self) -> [Singularity; 1 + 2 * MOST_DIPS] {
        let gap = Singularity {
            at: 0.0,
            distance: libm::acosh(1.0 + self.depth.depth),
            digits: GAP_DIGITS + 1.6 * self.sharpest.max(0.0),
        };
        let [a, b] = self.dips.map(|dip| dip.singularities(GRADED_DIGITS + self.extra));
        [gap, a[0], a[1], b[0], b[1]]
    }

    /// The e-folds by which a parallel weighs less than the lowest part of the surface.
    fn spared(&self, growth: f64) -> f64 {
        (self.mildness * growth - self.excess).max(0.0)
    }

    /// y = ln(1 + x/δ).
    fn growth(&self, theta: f64) -> f64 {
        let half = libm::sin(0.5 * theta);
        libm::log1p(2.0 * half * half / self.depth.depth)
    }

    fn polar(&self, theta: f64, weight: f64) -> PolarNode {
        let (sin, cos) = libm::sincos(0.5 * theta);
        PolarNode { versine: 2.0 * sin * sin, weight: weight * 2.0 * sin * cos, growth: self.growth(theta) }
    }
}

/// |(x, y)| of numbers whose squares are in range.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The distance of the nearest singularity from θ.
fn clearance(singularities: &[Singularity], theta: f64) -> f64 {
    let distance = |s: &Singularity| libm::hypot(s.distance, theta - s.at).min(libm::hypot(s.distance, theta + s.at));
    singularities.iter().map(distance).fold(2.0, f64::min)
}
