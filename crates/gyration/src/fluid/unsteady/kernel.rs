//! The kernels of the history force and torque on a sphere, exactly.
//!
//!   translation   κ = √(τ/(πt))                               κ̂(p) = τ/√(pτ)
//!   rotation      κ = ⅓ (√(τ/(πt)) − e^(t/τ) erfc √(t/τ))     κ̂(p) = τ/(3(1 + √(pτ)))
//!
//! The second is the inverse of the torque −(8πηR³/3) (3 + 3ℓ + ℓ²)/(1 + ℓ) Ω = −8πηR³ (1 + pκ̂(p)) Ω with ℓ = √(pτ):
//! Landau and Lifshitz, *Fluid Mechanics*, §24 (problems). The affine moment of a strain has 5/3 of it (`vibration`).
//! Both are transforms ∫ density(s) e^(−st) ds of positive densities, found from the jump of κ̂ over the cut p = −s,
//!
//!   1/(π√(sτ)),     √(sτ)/(3π(1 + sτ))          per d(sτ)
//!
//! and therefore completely monotone: sums of positive exponentials are their nature.

use super::erfc;
use std::f64::consts::PI;

/// What the sphere does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HistoryKernel {
    /// It translates: Basset's history force.
    Translation,
    /// It turns.
    Rotation,
}

impl HistoryKernel {
    /// κ(t), with t in units of τ, t > 0; dimensionless.
    pub fn value(self, time: f64) -> f64 {
        match self {
            Self::Translation => 1.0 / (PI * time).sqrt(),
            Self::Rotation => erfc::excess(time.sqrt()) / 3.0,
        }
    }

    /// ∫₀ᵗ κ, with t in units of τ, t ≥ 0: 2√(t/π), and ⅓(1 − eᵗ erfc √t).
    ///
    /// The history's part in the load, under an acceleration that has been constant for this time.
    pub fn integral(self, time: f64) -> f64 {
        match self {
            Self::Translation => 2.0 * (time / PI).sqrt(),
            Self::Rotation => erfc::fall(time.sqrt()) / 3.0,
        }
    }

    /// The density of κ(t) = ∫₀^∞ density(s) e^(−st) ds, with s in units of 1/τ, s > 0.
    pub fn density(self, rate: f64) -> f64 {
        match self {
            Self::Translation => 1.0 / (PI * rate.sqrt()),
            Self::Rotation => rate.sqrt() / (3.0 * PI * (1.0 + rate)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KERNELS: [HistoryKernel; 2] = [HistoryKernel::Translation, HistoryKernel::Rotation];

    #[test]
    fn kernel_is_the_transform_of_its_density() {
        for kernel in KERNELS {
            for time in [1e-3, 0.1, 1.0, 30.0, 1e4] {
                // Trapezoid in ln s: exponentially accurate, since the integrand decays on both sides; poles at Im = π.
                let terms = (-1600..900).map(|index| (f64::from(index) * 0.05).exp());
                let sum: f64 = terms.map(|rate| kernel.density(rate) * (-rate * time).exp() * rate).sum();
                let error = 0.05 * sum / kernel.value(time) - 1.0;
                assert!(error.abs() < 1e-13, "{kernel:?} at {time}: {error:e}");
            }
        }
    }

    #[test]
    fn kernel_is_the_slope_of_its_integral() {
        for kernel in KERNELS {
            for time in [1e-6_f64, 0.003, 0.2, 4.0, 500.0] {
                let step = 1e-3 * time;
                let at = |factor: f64| kernel.integral(time + factor * step);
                let slope = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
                // Differences of fourth order with a step of 1e-3: 1e-12, and rounding over 1e-3 of a small slope.
                assert!((slope / kernel.value(time) - 1.0).abs() < 2e-9, "{kernel:?} at {time}");
            }
        }
    }

    #[test]
    fn rotation_forgets_by_the_three_halves_power_and_in_all_a_third() {
        let late = 1e8_f64;
        assert!((HistoryKernel::Rotation.value(late) * 6.0 * PI.sqrt() * late.powf(1.5) - 1.0).abs() < 1e-7);
        assert!((HistoryKernel::Rotation.integral(1e30) - 1.0 / 3.0).abs() < 1e-14);
    }
}
