//! A sphere that sinks from rest in a fluid at rest, with added mass and history: its speed in closed form.
//!
//!   A v′ + v + π^−½ ∫₀ᵗ v′(s)/√(t − s) ds = 1,   v(0) = 0,   A = (2ρ_p/ρ_f + 1)/9
//!
//! v in units of Stokes' speed 2(ρ_p − ρ_f)gR²/(9η), t in units of τ = ρ_f R²/η. The transform is v̂ = 1/(p (A p + √p +
//! 1)). With a, b the roots of A x² − x + 1 = 0,
//!
//!   v = 1 − (b erfcx(a√t) − a erfcx(b√t))/(b − a),     erfcx(z) = e^(z²) erfc z
//!
//! (Brush, Ho and Yen 1964; Clift, Grace and Weber, *Bubbles, Drops, and Particles*, ch. 11). a and b are complex for
//! A > ¼ and meet at A = ¼. The same number, without cases, is the integral over the cut of √p,
//!
//!   v = 1 − (2/π) ∫₀^∞ e^(−q²t)/((1 − A q²)² + q²) dq
//!
//! with poles at ±ia, ±ib. The approach to 1 is slow, 1 − v ≈ 1/√(πt).

use super::cut;
use std::f64::consts::PI;

/// v(t), relative to Stokes' speed, for A = `inertia` > 0 and t ≥ 0 in units of τ.
///
/// Absolute error below 1e-14 for A from 1/9 (a sphere without mass) to 1e4.
pub fn settling(inertia: f64, time: f64) -> f64 {
    let density = |q: f64| {
        let square = q * q;
        libm::exp(-square * time) / ((1.0 - inertia * square).powi(2) + square)
    };
    1.0 - 2.0 / PI * cut::integral(density)
}

#[cfg(test)]
mod tests {
    use super::super::talbot::inverse;
    use super::super::{Exponentials, kernel::HistoryKernel};
    use super::*;
    use nalgebra::Complex;

    #[test]
    fn speed_has_its_known_values() {
        for (time, known) in [(0.1, 0.1544895533), (1.0, 0.5163909604), (10.0, 0.8245501527)] {
            // Known to ten digits.
            assert!((settling(1.0 / 3.0, time) - known).abs() < 6e-11, "{time}: {}", settling(1.0 / 3.0, time));
        }
    }

    #[test]
    fn speed_is_that_of_the_error_functions() {
        let errors = CLOSED_FORM.map(|(inertia, time, known)| (settling(inertia, time) - known).abs());
        println!("settling: largest error {:.1e}", errors.iter().fold(0.0_f64, |a, b| a.max(*b)));
        // Rounding of some hundred terms, subtracted from 1.
        assert!(errors.iter().all(|error| *error < 1e-14), "{errors:?}");
    }

    #[test]
    fn speed_is_the_inverse_of_its_transform() {
        for inertia in [1.0 / 9.0, 0.25, 1.0 / 3.0, 2.0] {
            let transform = |p: Complex<f64>| (p * (p * inertia + p.sqrt() + 1.0)).inv();
            for time in [0.01, 0.3, 5.0, 1e3] {
                let error = (inverse(&transform, time) - settling(inertia, time)).abs();
                // The contour's own error.
                assert!(error < 1e-11, "A = {inertia}, t = {time}: {error:e}");
            }
        }
    }

    #[test]
    fn sphere_with_modes_in_place_of_its_history_settles_alike() {
        for (span, error) in [(10.0, 1e-4), (10.0, 1e-6), (1e4, 1e-6), (10.0, 1e-8)] {
            let history = Exponentials::of_translation(1.0, span, error).unwrap();
            for inertia in [1.0 / 9.0, 0.25, 1.0 / 3.0, 3.0] {
                // The linear system of v and the modes, solved by its transform: A p v + v + p v κ̃(p) = 1/p.
                let transform = |p: Complex<f64>| {
                    let pairs = history.rates.iter().zip(&history.weights);
                    let kernel =
                        pairs.map(|(rate, weight)| (p + rate).inv() * weight).sum::<Complex<f64>>() + history.rest;
                    (p * (p * inertia + 1.0 + p * kernel)).inv()
                };
                let times = [1e-4, 1e-2, 0.1, 1.0, 10.0, 1e3].into_iter().filter(|time| *time <= span);
                let worst = times
                    .map(|time| {
                        let exact = settling(inertia, time);
                        let load = HistoryKernel::Translation.integral(time.max(1.0)) / inertia;
                        ((inverse(&transform, time) - exact).abs(), load)
                    })
                    .fold((0.0_f64, 0.0_f64), |worst, (next, load)| (worst.0.max(next), worst.1.max(next / load)));
                println!("span {span:e}, ε = {error:e}, A = {inertia:.3}: |error of v| ≤ {:.1e}", worst.0);
                // The load is off by ε times that of the greatest acceleration, 1/A, and v by no more than that: the
                // history itself damps.
                assert!(worst.1 < error + 1e-11, "{worst:?}");
            }
        }
    }

    /// A, t, v by erfc in eighty digits.
    const CLOSED_FORM: [(f64, f64, f64); 28] = [
        (0.1111111111111111, 0.001, 0.007354508026112289),
        (0.1111111111111111, 0.1, 0.22403381029313413),
        (0.1111111111111111, 2.0, 0.6539850546378497),
        (0.1111111111111111, 300.0, 0.9674685642700155),
        (0.25, 0.001, 0.0036422202108225047),
        (0.25, 0.1, 0.17562910278191585),
        (0.25, 2.0, 0.6407809958476067),
        (0.25, 300.0, 0.9674535930352365),
        (0.250000001, 0.001, 0.00364222019757035),
        (0.250000001, 0.1, 0.17562910249750582),
        (0.250000001, 2.0, 0.6407809957489163),
        (0.250000001, 300.0, 0.9674535930351287),
        (0.3333333333333333, 0.001, 0.0027946526889567787),
        (0.3333333333333333, 0.1, 0.15448955331656733),
        (0.3333333333333333, 2.0, 0.6323876859516276),
        (0.3333333333333333, 300.0, 0.967444595512348),
        (1.0, 0.001, 0.0009762210271543119),
        (1.0, 0.1, 0.07700011677862495),
        (1.0, 2.0, 0.5581069419922264),
        (1.0, 300.0, 0.9673722123269146),
        (20.0, 0.001, 4.9939344033202206e-05),
        (20.0, 0.1, 0.004928903398614221),
        (20.0, 2.0, 0.09046825723503696),
        (20.0, 300.0, 0.9649150869215791),
        (1000.0, 0.001, 9.999757121976386e-07),
        (1000.0, 0.1, 9.997121874664674e-05),
        (1000.0, 2.0, 0.0019958790362030613),
        (1000.0, 300.0, 0.25613349756863624),
    ];
}
