//! The inverse of the normal distribution.

use libm::erfc;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The number below which a normal random number lies with probability p, 0 < p < 1.
///
///   Φ(x) = ½ erfc(−x/√2) = p
///
/// By Halley's method from the rational approximation of Hastings (Abramowitz and Stegun 26.2.23, good to 4.5e-4):
/// cubic, so that two corrections reach rounding. Worked out in the lower tail, where p is known to all its digits.
pub fn inverse_normal(p: f64) -> f64 {
    if p > 0.5 {
        return -inverse_normal(1.0 - p);
    }
    let t = (-2.0 * libm::log(p)).sqrt();
    let fraction = (2.515517 + t * (0.802853 + t * 0.010328)) / (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    let mut x = fraction - t;
    for _ in 0..2 {
        let density = libm::exp(-0.5 * x * x) / (2.0 * PI).sqrt();
        let newton = (0.5 * erfc(-x * FRAC_1_SQRT_2) - p) / density;
        x -= newton / (1.0 + 0.5 * x * newton);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_of_the_distribution_is_good_to_rounding() {
        // Quantiles by the tables: 97.5 %, 99.9 %, one in a million.
        for (p, x) in [(0.975, 1.959963984540054), (0.999, 3.090232306167813), (1e-6, -4.753424308822899), (0.5, 0.0)] {
            assert!((inverse_normal(p) - x).abs() < 1e-14 * (1.0 + f64::abs(x)) / p.min(1.0 - p).sqrt(), "{p}");
        }
        let mut largest = 0.0_f64;
        for k in 0..400 {
            let p = libm::exp(-0.09 * f64::from(k)) * 0.5;
            let x = inverse_normal(p);
            // The relative error of p is |x| + 1/|x| times that of x, and that of erfc itself a few units of rounding.
            largest = largest.max((0.5 * erfc(-x * FRAC_1_SQRT_2) / p - 1.0).abs() / (1.0 + x * x));
        }
        println!("largest error of the distribution at its inverse: {largest:.2e} (1 + x²)");
        assert!(largest < 1e-15, "{largest:e}");
    }
}
