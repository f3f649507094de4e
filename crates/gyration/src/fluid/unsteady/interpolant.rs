//! Rational interpolants of 1/√p with positive weights, in closed form.
//!
//! Let x = √p and let x₁ … x_m be positive points, m odd. The product of Blaschke factors
//!
//!   B(x) = ∏ⱼ (xⱼ − x)/(xⱼ + x)      has B(−x) = 1/B(x), so that      g(p) = (1/x)(1 − B)/(1 + B)
//!
//! is even in x: a rational function of p, which equals 1/√p where B = 0, at p = xⱼ²; its relative error is −2B/(1 +
//! B). On x = iy each factor has modulus 1 and phase −2 arctan(y/xⱼ). Hence all poles are real, p = −s_k with s_k =
//! y_k², and
//!
//!   Σⱼ arctan(y_k/xⱼ) = (k − ½)π,   k = 1 … n = (m − 1)/2          one root each: the left side grows from 0 to mπ/2
//!   g(p) = rest + Σ_k c_k/(p + s_k),   c_k = 2/Σⱼ xⱼ/(xⱼ² + y_k²) > 0,   rest = 1/Σⱼ xⱼ > 0
//!
//! This is the multipoint Padé approximant (rational Gauss rule) of the Stieltjes function 1/√p; no linear system is
//! solved. Where to interpolate is not decided here.

use std::f64::consts::PI;

/// A sum of simple fractions, rest + Σ c_k/(p + s_k), which is near 1/√p.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RationalInterpolant {
    /// s_k > 0, rising; unit of p.
    pub rates: Vec<f64>,
    /// c_k > 0; unit of √p.
    pub weights: Vec<f64>,
    /// What is left as p → ∞; unit of 1/√p.
    pub rest: f64,
}

impl RationalInterpolant {
    /// The interpolant of 1/√p at p = xⱼ², for an odd number of positive points in rising order.
    pub fn new(points: &[f64]) -> Self {
        debug_assert!(points.len() % 2 == 1 && points.is_sorted() && points[0] > 0.0);
        let zeros: Vec<f64> = (1..=points.len() / 2).map(|index| zero(points, (index as f64 - 0.5) * PI)).collect();
        Self {
            rates: zeros.iter().map(|y| y * y).collect(),
            weights: zeros.iter().map(|y| 2.0 / points.iter().map(|x| x / (x * x + y * y)).sum::<f64>()).collect(),
            rest: 1.0 / points.iter().sum::<f64>(),
        }
    }
}

/// The y > 0 at which Σⱼ arctan(y/xⱼ) is `phase`: Newton's method in ln y, kept within a bracket that shrinks.
///
/// With m points, at y = x₁/(e m) the sum is below 1/e and at y = e m x_m above mπ/2 − 1/e: π/2 … (m/2 − 1)π lies
/// between.
fn zero(points: &[f64], phase: f64) -> f64 {
    let reach = 1.0 + libm::log(points.len() as f64);
    let mut low = libm::log(points[0]) - reach;
    let mut high = libm::log(points[points.len() - 1]) + reach;
    let mut logarithm = 0.5 * (low + high);
    // Halving alone would take 60 steps to the last digit.
    for _ in 0..100 {
        let y = libm::exp(logarithm);
        let excess = points.iter().map(|x| libm::atan(y / x)).sum::<f64>() - phase;
        let slope: f64 = points.iter().map(|x| x * y / (x * x + y * y)).sum();
        if excess > 0.0 {
            high = logarithm;
        } else {
            low = logarithm;
        }
        let newton = logarithm - excess / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let change = (next - logarithm).abs();
        logarithm = next;
        if change < 4.0 * f64::EPSILON * (1.0 + logarithm.abs()) {
            break;
        }
    }
    libm::exp(logarithm)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(interpolant: &RationalInterpolant, p: f64) -> f64 {
        let fractions = interpolant.rates.iter().zip(&interpolant.weights).map(|(rate, weight)| weight / (p + rate));
        interpolant.rest + fractions.sum::<f64>()
    }

    fn points() -> Vec<f64> {
        vec![0.02, 0.3, 0.31, 1.0, 2.5, 40.0, 41.0, 900.0, 1e5]
    }

    #[test]
    fn interpolant_takes_the_values_at_the_points() {
        let interpolant = RationalInterpolant::new(&points());
        for x in points() {
            // A sum of positive terms: rounding only.
            assert!((value(&interpolant, x * x) * x - 1.0).abs() < 1e-14, "at {x}");
        }
    }

    #[test]
    fn error_of_the_interpolant_is_the_product_of_blaschke() {
        let interpolant = RationalInterpolant::new(&points());
        for x in [1e-3, 0.1, 0.7, 7.0, 300.0, 1e7] {
            let product: f64 = points().iter().map(|point| (point - x) / (point + x)).product();
            let error = value(&interpolant, x * x) * x - 1.0;
            // The relative error is −2B/(1 + B).
            assert!((error + 2.0 * product / (1.0 + product)).abs() < 1e-12 * (1.0 + error.abs()), "at {x}: {error:e}");
        }
    }

    #[test]
    fn rates_and_weights_are_positive_and_rates_rise() {
        let interpolant = RationalInterpolant::new(&points());
        assert_eq!(interpolant.rates.len(), 4);
        assert!(interpolant.rates[0] > 0.0 && interpolant.rates.is_sorted());
        assert!(interpolant.weights.iter().all(|weight| *weight > 0.0) && interpolant.rest > 0.0);
    }
}
