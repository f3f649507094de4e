//! A sphere that is set spinning in a fluid at rest and let go: its spin in closed form.
//!
//!   B Ω′ + Ω + ∫₀ᵗ Ω′(s) κ(t − s) ds + Ω₀ κ(t) = 0,   Ω(0) = Ω₀,   B = ρ_p/(15ρ_f),   κ(t) = ⅓ (1/√(πt) − eᵗ erfc √t)
//!
//! t in units of τ = ρ_f R²/η; B is the moment of inertia (8/15)πρ_pR⁵ over 8πηR³τ. The transform is Ω̂ = BΩ₀/(1 + Bp +
//! ⅓ p/(1 + √p)), which has no pole off the cut; over the cut, p = −q²,
//!
//!   Ω/Ω₀ = (2B/π) ∫₀^∞ q b e^(−q²t)/(a² + b²) dq,    a = 1 − Bq² − q²/(3(1 + q²)),    b = q³/(3(1 + q²))
//!
//! In the end the spin is that of the vortex layer, Ω/Ω₀ ≈ (B/(4√π)) t^−5/2.

use super::cut;
use std::f64::consts::PI;

/// Ω(t)/Ω₀ for B = `inertia` > 0, of a homogeneous sphere ρ_p/(15ρ_f), and t ≥ 0 in units of τ.
///
/// Absolute error below 1e-13 for B up to 100.
pub fn spinning(inertia: f64, time: f64) -> f64 {
    let density = |q: f64| {
        let square = q * q;
        let layer = square / (3.0 * (1.0 + square));
        let (real, imaginary) = (1.0 - inertia * square - layer, q * layer);
        q * imaginary * libm::exp(-square * time) / (real * real + imaginary * imaginary)
    };
    2.0 * inertia / PI * cut::integral(density)
}

#[cfg(test)]
mod tests {
    use super::super::Exponentials;
    use super::super::talbot::inverse;
    use super::*;
    use nalgebra::Complex;

    const INERTIAS: [f64; 4] = [0.01, 1.0 / 15.0, 0.5, 5.0];

    #[test]
    fn spin_begins_at_one_and_ends_with_the_layer() {
        for inertia in INERTIAS {
            assert!((spinning(inertia, 0.0) - 1.0).abs() < 1e-13);
            let late = 1e8_f64;
            let layer = inertia / (4.0 * PI.sqrt()) * late.powf(-2.5);
            // The next term is of relative size t^−½.
            assert!((spinning(inertia, late) / layer - 1.0).abs() < 1e-3, "B = {inertia}");
        }
    }

    #[test]
    fn spin_is_the_inverse_of_its_transform() {
        for inertia in INERTIAS {
            let transform = |p: Complex<f64>| (p * inertia + p / (p.sqrt() + 1.0) / 3.0 + 1.0).inv() * inertia;
            for time in [0.01, 0.3, 5.0, 1e3] {
                let error = (inverse(&transform, time) - spinning(inertia, time)).abs();
                // The contour's own error.
                assert!(error < 1e-11, "B = {inertia}, t = {time}: {error:e}");
            }
        }
    }

    #[test]
    fn sphere_with_modes_in_place_of_its_history_spins_down_alike() {
        for (span, error) in [(10.0, 1e-4), (10.0, 1e-6), (1e4, 1e-6)] {
            let history = Exponentials::of_rotation(1.0, span, error).unwrap();
            for inertia in INERTIAS {
                let transform = |p: Complex<f64>| {
                    let pairs = history.rates.iter().zip(&history.weights);
                    let kernel =
                        pairs.map(|(rate, weight)| (p + rate).inv() * weight).sum::<Complex<f64>>() + history.rest;
                    (p * inertia + p * kernel + 1.0).inv() * inertia
                };
                let times = [1e-4, 1e-2, 0.1, 1.0, 10.0, 1e3].into_iter().filter(|time| *time <= span);
                let errors = times.map(|time| (inverse(&transform, time) - spinning(inertia, time)).abs());
                let worst = errors.fold(0.0, f64::max);
                println!("span {span:e}, ε = {error:e}, B = {inertia:.3}: |error of Ω/Ω₀| ≤ {worst:.1e}");
                // The impulse of the jump is off by ε ∫κ ≤ ⅓ ε, and so Ω by that over B, as long as it lasts.
                assert!(worst < error / (3.0 * inertia).min(1.0) + 1e-11);
            }
        }
    }
}
