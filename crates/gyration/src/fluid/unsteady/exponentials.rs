//! A history as a sum of decaying exponentials, to a stated error.
//!
//!   κ(t) ≈ κ̃(t) = rest δ(t) + Σ_k c_k e^(−s_k t),     s_k > 0, c_k > 0, rest > 0
//!
//! The modes are state: with w the relative velocity, y_k(0) = 0 and
//!
//!   y_k′ = s_k (w − y_k),    z_k = w − y_k = ∫₀ᵗ e^(−s_k(t−s)) w′(s) ds,    ∫ w′ κ̃ = rest w′ + Σ c_k z_k
//!
//! where w(0) counts as a jump; no acceleration is needed but in `rest w′`, which is an added mass. *Dissipation*:
//! since w = y_k + z_k and z_k = y_k′/s_k,
//!
//!   w Σ c_k z_k = d/dt Σ c_k y_k²/(2s_k) + Σ c_k z_k²
//!
//! so that a mode gives back no more than it has stored, and always dissipates.
//!
//! *What the error ε means.* With θ = min(τ, span), for every relative velocity with |w′| ≤ a,
//!
//!   |∫ w′ (κ − κ̃)|(t) ≤ a ∫₀ᵗ |κ − κ̃| ≤ ε a ∫₀^max(t, θ) κ          at every t in (0, span]
//!
//! The right side is ε times the history's load under the constant acceleration a: the largest that such a motion can
//! have had by then (before θ: by θ, as long as the added mass outweighs it). The first inequality is sharp. `rest`
//! counts as part of ∫|κ − κ̃|; after a jump of w the same integral bounds the error of the impulse.
//!
//! The fastest mode lives for about ε² θ: the modes are stiff, and wait for an implicit stepper.

use super::fit;
use super::kernel::Kernel;

/// The errors that can be asked for: below, rounding is felt.
const ERRORS: std::ops::RangeInclusive<f64> = 1e-10..=0.1;
/// The spans that can be asked for, in units of τ.
const SPANS: std::ops::RangeInclusive<f64> = 1e-12..=1e12;

/// A sum of exponentials cannot be made for these numbers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a history of {tau:e} s cannot be kept over {span:e} s to {error:e}: both times must be > 0, \
     their ratio within 1e-12 and 1e12, the error within 1e-10 and 0.1"
)]
pub struct Unresolved {
    /// τ = ρR²/η [s].
    pub tau: f64,
    /// The time over which the history is to be kept [s].
    pub span: f64,
    /// The error asked for.
    pub error: f64,
}

/// κ̃(t) = rest δ(t) + Σ c_k e^(−s_k t), in place of the kernel of a sphere's translation or rotation.
#[derive(Debug, Clone, PartialEq)]
pub struct Exponentials {
    /// s_k > 0, rising [1/s].
    pub rates: Vec<f64>,
    /// c_k > 0, dimensionless as κ is.
    pub weights: Vec<f64>,
    /// ∫ of what is faster than the modes: a local term, rest w′ [s].
    pub rest: f64,
    /// ε as measured, at most the one asked for.
    pub error: f64,
}

impl Exponentials {
    /// Basset's kernel √(τ/(πt)) of a sphere's translation, over (0, span] to `error`; τ = ρR²/η and span [s].
    ///
    ///   force = −6πηR [w + (τ/9 + rest) w′ + Σ c_k (w − y_k)]
    ///
    /// # Errors
    /// [`Unresolved`] if a time is not positive, if span/τ is outside 1e-12 … 1e12 or the error outside 1e-10 … 0.1.
    pub fn of_translation(tau: f64, span: f64, error: f64) -> Result<Self, Unresolved> {
        Self::of(Kernel::Translation, tau, span, error)
    }

    /// The kernel ⅓(√(τ/(πt)) − e^(t/τ) erfc √(t/τ)) of a sphere's rotation, over (0, span] to `error`; τ = ρR²/η and
    /// span [s].
    ///
    ///   torque = −8πηR³ [Ω + rest Ω′ + Σ c_k (Ω − y_k)]
    ///
    /// # Errors
    /// As [`Self::of_translation`].
    pub fn of_rotation(tau: f64, span: f64, error: f64) -> Result<Self, Unresolved> {
        Self::of(Kernel::Rotation, tau, span, error)
    }

    /// The kernel κ, over (0, span] to `error`.
    fn of(kernel: Kernel, tau: f64, span: f64, error: f64) -> Result<Self, Unresolved> {
        let unresolved = Unresolved { tau, span, error };
        let admissible = tau > 0.0 && tau.is_finite() && SPANS.contains(&(span / tau)) && ERRORS.contains(&error);
        let sum = if admissible { fit::fewest(kernel, span / tau, error) } else { None };
        sum.map(|sum| sum.in_seconds(tau)).ok_or(unresolved)
    }

    /// From units of τ to seconds.
    fn in_seconds(mut self, tau: f64) -> Self {
        self.rates.iter_mut().for_each(|rate| *rate /= tau);
        self.rest *= tau;
        self
    }

    /// Σ c_k e^(−s_k t), for t > 0.
    pub fn value(&self, time: f64) -> f64 {
        self.pairs().map(|(rate, weight)| weight * (-rate * time).exp()).sum()
    }

    /// rest + Σ (c_k/s_k)(1 − e^(−s_k t)), for t > 0: ∫₀ᵗ κ̃ [s].
    pub fn integral(&self, time: f64) -> f64 {
        self.rest - self.pairs().map(|(rate, weight)| weight / rate * (-rate * time).exp_m1()).sum::<f64>()
    }

    /// Pairs (s_k, c_k).
    fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        self.rates.iter().copied().zip(self.weights.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const KERNELS: [Kernel; 2] = [Kernel::Translation, Kernel::Rotation];

    /// ∫ w′(s) κ(t − s) ds and the same with κ̃, for steps of w′ of equal lengths that end at t; τ = 1.
    fn loads(kernel: Kernel, sum: &Exponentials, accelerations: &[f64], time: f64) -> (f64, f64) {
        let length = time / accelerations.len() as f64;
        let mut loads = (0.0, 0.0);
        for (index, acceleration) in accelerations.iter().enumerate() {
            let (late, early) = (index as f64 * length, (index + 1) as f64 * length);
            loads.0 += acceleration * (kernel.integral(early) - kernel.integral(late));
            let recent = if index == 0 { 0.0 } else { sum.integral(late) };
            loads.1 += acceleration * (sum.integral(early) - recent);
        }
        loads
    }

    #[test]
    fn stated_errors_are_reached_with_few_modes() {
        let expected = [
            (Kernel::Translation, 1.0, [18, 33, 54]),
            (Kernel::Translation, 100.0, [22, 40, 63]),
            (Kernel::Translation, 1e4, [28, 49, 74]),
            (Kernel::Rotation, 1.0, [20, 36, 58]),
            (Kernel::Rotation, 100.0, [25, 44, 68]),
            (Kernel::Rotation, 1e4, [31, 53, 80]),
        ];
        for (kernel, span, most) in expected {
            for (error, most) in [1e-4, 1e-6, 1e-8].into_iter().zip(most) {
                let sum = Exponentials::of(kernel, 1.0, span, error).unwrap();
                let modes = sum.rates.len();
                let fastest = sum.rates[modes - 1];
                println!(
                    "{kernel:?}, span {span:e} τ: {modes} modes, error {:.2e}, fastest {fastest:.1e}/τ",
                    sum.error
                );
                assert!(sum.error <= error && modes <= most, "{kernel:?} {span:e} {error:e}: {modes}");
            }
        }
    }

    #[test]
    fn error_is_that_of_a_finer_measurement() {
        for kernel in KERNELS {
            for span in [1e-6, 1.0, 300.0, 1e6] {
                let sum = Exponentials::of(kernel, 1.0, span, 1e-6).unwrap();
                let finer = fit::measured(kernel, span, &sum, 1000.0);
                println!("{kernel:?}, span {span:e} τ: {:.5} of the stated error", finer / sum.error);
                assert!(finer <= sum.error && finer > 0.998 * sum.error, "{:e} {finer:e}", sum.error);
            }
        }
    }

    #[test]
    fn worst_acceleration_comes_near_the_stated_error() {
        for kernel in KERNELS {
            let sum = Exponentials::of(kernel, 1.0, 1.0, 1e-4).unwrap();
            // w′ = sign(κ − κ̃)(t − s), which is what makes the bound: even steps in time resolve all but the first
            // modes.
            let count = 20_000;
            let signs: Vec<f64> = (0..count)
                .map(|index| (f64::from(index) + 0.5) / f64::from(count))
                .map(|lag| (kernel.value(lag) - sum.value(lag)).signum())
                .collect();
            let (exact, kept) = loads(kernel, &sum, &signs, 1.0);
            let error = (exact - kept).abs() / kernel.integral(1.0);
            println!("{kernel:?}: worst {error:.2e} of {:.2e}", sum.error);
            assert!(error <= sum.error * (1.0 + 2e-3) && error > 0.3 * sum.error);
        }
    }

    #[test]
    fn kernel_itself_is_near_from_a_short_lag_on() {
        let sum = Exponentials::of_translation(1.0, 1.0, 1e-6).unwrap();
        for (shortest, most) in [(1e-8, 1e-2), (1e-4, 5e-5), (1e-2, 1e-5)] {
            let lags = (0..2000).map(|index| f64::powf(shortest, f64::from(index) / 1999.0));
            let errors = lags.map(|lag| (sum.value(lag) / Kernel::Translation.value(lag) - 1.0).abs());
            let worst = errors.fold(0.0, f64::max);
            println!("relative error of the kernel on [{shortest:e}, 1] of the span: {worst:.1e}");
            assert!(worst < most);
        }
    }

    #[test]
    fn memory_scales_with_the_time_of_the_fluid() {
        let (unit, slow) =
            (Exponentials::of_rotation(1.0, 50.0, 1e-5).unwrap(), Exponentials::of_rotation(8.0, 400.0, 1e-5).unwrap());
        assert_eq!(unit.weights, slow.weights);
        assert_eq!(unit.rest * 8.0, slow.rest);
        assert!(unit.rates.iter().zip(&slow.rates).all(|(unit, slow)| *unit == slow * 8.0));
    }

    #[test]
    fn numbers_that_mean_nothing_are_refused() {
        for (tau, span, error) in
            [(0.0, 1.0, 1e-6), (1.0, -1.0, 1e-6), (f64::NAN, 1.0, 1e-6), (1.0, f64::INFINITY, 1e-6), (1.0, 1.0, 1e-12)]
        {
            let refused = Exponentials::of_translation(tau, span, error).unwrap_err();
            assert!(refused.to_string().contains("must be > 0"));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]

        #[test]
        fn bounded_accelerations_are_remembered_to_the_stated_error(
            accelerations in prop::collection::vec(-1.0_f64..1.0, 1..60),
            (time, span) in (-5.0_f64..0.0, -2.0_f64..3.0),
            exponent in -7.0_f64..-3.0,
        ) {
            let (span, error) = (10_f64.powf(span), 10_f64.powf(exponent));
            let time = span * 10_f64.powf(time);
            for kernel in KERNELS {
                let sum = Exponentials::of(kernel, 1.0, span, error).unwrap();
                let (exact, kept) = loads(kernel, &sum, &accelerations, time);
                let load = kernel.integral(time.max(span.min(1.0)));
                prop_assert!((exact - kept).abs() <= error * load, "{kernel:?}: {:e}", (exact - kept) / load);
                prop_assert!(sum.weights.iter().chain(&sum.rates).all(|number| *number > 0.0) && sum.rest > 0.0);
            }
        }
    }
}
