//! The weight with which granules are seen from a point, and its means along the line between two of them.
//!
//!   w(r) = (2π b²)^(−3/2) e^(−r²/2b²),   (W, I₁, I₀) = ∫₀¹ (1, 1 − s, s) w(r − s l) ds
//!   l·∇ of each: −b⁻² ∫₀¹ (1, 1 − s, s) l·(r − s l) w ds
//!
//! r leads from the first to the point, l to the second. Gauss' rule of 16 points over parts of two widths leaves
//! rounding: the derivatives are integrals of their own, so that w_i − w_j = l·∇W and its like are no identities here.

use gyration::surface::gauss_legendre;
use gyration::tensor::Vec3;
use std::f64::consts::TAU;

/// Beyond so many widths a weight is below rounding of the largest.
const REACH: f64 = 9.0;
/// Points of a part.
const POINTS: usize = 16;
/// The length of a part, in widths.
const PART: f64 = 2.0;

/// A Gaussian weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Weight {
    /// b, the standard deviation \[m\].
    width: f64,
    peak: f64,
}

/// Means along a line \[1/m³\], and their derivatives along l.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct LineWeights {
    /// W.
    pub whole: f64,
    /// I₁, heavier towards the first.
    pub first: f64,
    /// I₀, heavier towards the second.
    pub second: f64,
    /// l·∇W.
    pub whole_along: f64,
    /// l·∇I₁.
    pub first_along: f64,
    /// l·∇I₀.
    pub second_along: f64,
}

impl Weight {
    /// Of a width above zero.
    pub fn new(width: f64) -> Self {
        Self { width, peak: 1.0 / (TAU.sqrt() * width).powi(3) }
    }

    /// How far it reaches \[m\].
    pub fn reach(&self) -> f64 {
        REACH * self.width
    }

    /// w \[1/m³\].
    pub fn at(&self, r: &Vec3) -> f64 {
        self.peak * libm::exp(-0.5 * r.norm_squared() / (self.width * self.width))
    }

    /// v·∇w \[1/(m³ s)\].
    pub fn along(&self, r: &Vec3, v: &Vec3) -> f64 {
        -v.dot(r) / (self.width * self.width) * self.at(r)
    }

    /// The means along the line from a granule, where there is the point r from it, to another; none out of reach.
    pub fn line(&self, r: &Vec3, l: &Vec3) -> Option<LineWeights> {
        let length = l.norm();
        let nearest = if length > 0.0 { r.dot(l) / (length * length) } else { 0.5 };
        if (r - nearest.clamp(0.0, 1.0) * l).norm() > self.reach() {
            return None;
        }
        let within = if length > 0.0 { self.reach() / length } else { 1.0 };
        let (from, to) = ((nearest - within).max(0.0), (nearest + within).min(1.0));
        let parts = ((to - from) * length / (PART * self.width)).ceil().max(1.0);
        let half = 0.5 * (to - from) / parts;
        let mut sums = LineWeights::default();
        for part in 0..parts as usize {
            let middle = from + (2 * part + 1) as f64 * half;
            for node in gauss_legendre(POINTS) {
                let s = middle + half * node.at;
                let away = r - s * l;
                let weight = half * node.weight * self.at(&away);
                let along = -l.dot(&away) / (self.width * self.width) * weight;
                sums.whole += weight;
                sums.first += (1.0 - s) * weight;
                sums.second += s * weight;
                sums.whole_along += along;
                sums.first_along += (1.0 - s) * along;
                sums.second_along += s * along;
            }
        }
        Some(sums)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, wanted: f64, scale: f64) {
        assert!((found - wanted).abs() <= 1e-13 * scale, "{found:e} is not {wanted:e}");
    }

    #[test]
    fn derivatives_along_the_line_are_differences_of_weights() {
        // w_i − w_j = l·∇W, w_i − W = l·∇I₁, w_j − W = −l·∇I₀.
        for (width, length) in [(0.3, 0.01), (0.3, 1.0), (0.02, 1.0), (0.001, 1.0), (5.0, 0.2)] {
            let weight = Weight::new(width);
            let l = length * Vec3::new(0.6, -0.64, 0.48);
            for s in [-0.4, 0.0, 0.3, 0.5, 1.0, 1.2] {
                let r = s * l + width * Vec3::new(0.4, 0.3, -0.7);
                let Some(line) = weight.line(&r, &l) else {
                    assert!(s * (1.0 - s) < 0.0 && width < 0.1 * length);
                    continue;
                };
                let (first, second, scale) = (weight.at(&r), weight.at(&(r - l)), weight.at(&Vec3::zeros()));
                close(line.whole_along, first - second, scale);
                close(line.first_along, first - line.whole, scale);
                close(line.second_along, line.whole - second, scale);
                close(line.first + line.second, line.whole, scale);
            }
        }
    }

    #[test]
    fn granules_in_one_place_have_the_weight_of_that_place() {
        let (weight, r) = (Weight::new(0.2), Vec3::new(0.1, 0.0, 0.05));
        let line = weight.line(&r, &Vec3::zeros()).unwrap();
        close(line.whole, weight.at(&r), weight.at(&r));
        assert_eq!((line.whole_along, line.first_along), (0.0, 0.0));
    }

    #[test]
    fn a_weight_is_one_over_all_space() {
        // Σ over a lattice of spacing b/2: the error of the sum is e^(−8π²).
        let (b, h) = (0.7, 0.35);
        let weight = Weight::new(b);
        let places = || (-25..=25).map(|n| f64::from(n) * h);
        let sum: f64 = places()
            .flat_map(|x| places().flat_map(move |y| places().map(move |z| Vec3::new(x, y, z))))
            .map(|r| weight.at(&r))
            .sum();
        close(sum * h * h * h, 1.0, 100.0);
    }
}
