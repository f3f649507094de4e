//! The fewest exponentials that keep a history to a stated error: build, measure, add a mode.
//!
//! Times are in units of τ here. What is measured, and must not exceed ε, is
//!
//!   max over t ≤ span of  ∫₀ᵗ|κ − κ̃| / ∫₀^max(t, θ) κ,     θ = min(1, span)
//!
//! from the built sum itself; nothing rests on an estimate of convergence.

use super::exponentials::Exponentials;
use super::interpolant::RationalInterpolant;
use super::kernel::HistoryKernel;
use super::points::{count, points};

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
pub struct UnresolvedHistory {
    /// τ = ρR²/η [s].
    pub tau: f64,
    /// The time over which the history is to be kept [s].
    pub span: f64,
    /// The error asked for.
    pub error: f64,
}

impl Exponentials {
    /// Basset's kernel √(τ/(πt)) of a sphere's translation, over (0, span] to `error`; τ = ρR²/η and span [s].
    ///
    ///   force = −6πηR [w + (τ/9 + rest) w′ + Σ c_k (w − y_k)]
    ///
    /// # Errors
    /// [`UnresolvedHistory`] if a time is not positive, if span/τ is outside 1e-12 … 1e12 or the error outside 1e-10 …
    /// 0.1.
    pub fn of_translation(tau: f64, span: f64, error: f64) -> Result<Self, UnresolvedHistory> {
        Self::of(HistoryKernel::Translation, tau, span, error)
    }

    /// The kernel ⅓(√(τ/(πt)) − e^(t/τ) erfc √(t/τ)) of a sphere's rotation, over (0, span] to `error`; τ = ρR²/η and
    /// span [s].
    ///
    ///   torque = −8πηR³ [Ω + rest Ω′ + Σ c_k (Ω − y_k)]
    ///
    /// # Errors
    /// As [`Self::of_translation`].
    pub fn of_rotation(tau: f64, span: f64, error: f64) -> Result<Self, UnresolvedHistory> {
        Self::of(HistoryKernel::Rotation, tau, span, error)
    }

    /// The kernel κ, over (0, span] to `error`.
    fn of(kernel: HistoryKernel, tau: f64, span: f64, error: f64) -> Result<Self, UnresolvedHistory> {
        let unresolved = UnresolvedHistory { tau, span, error };
        let admissible = tau > 0.0 && tau.is_finite() && SPANS.contains(&(span / tau)) && ERRORS.contains(&error);
        let sum = if admissible { fewest(kernel, span / tau, error) } else { None };
        sum.map(|sum| sum.in_seconds(tau)).ok_or(unresolved)
    }
}

/// No more modes than this: 1e-10 over 1e12 τ takes about 160.
const MOST_MODES: usize = 200;
/// Samples of ∫|κ − κ̃| in a range of e of lags, to choose a sum.
const COARSE: f64 = 16.0;
/// The same, to state its error.
const FINE: f64 = 100.0;
/// What the variation between the fine samples may miss, relatively; three times what a finer measurement finds.
const MISSED: f64 = 1e-3;
/// Where the lowest point of interpolation is tried, in units of 1/√span: a factor of e^¼ apart.
const LOWEST: [f64; 5] = [1.65, 2.12, 2.72, 3.49, 4.48];

/// The sum with the fewest modes that reaches the error over (0, span]; none if 200 do not.
fn fewest(kernel: HistoryKernel, span: f64, error: f64) -> Option<Exponentials> {
    // ε is about 20 e^−Λ when span ≤ τ, and down to 10 e^−Λ when span > τ: the count begins below what is needed.
    let least = (count(libm::log(9.0 / error), span, span.min(1.0)) / 2.0) as usize;
    (least.max(1)..=MOST_MODES).find_map(|modes| {
        let mut sum = best(kernel, span, modes).filter(|sum| sum.error <= error)?;
        sum.error = (1.0 + MISSED) * measured(kernel, span, &sum, FINE);
        (sum.error <= error).then_some(sum)
    })
}

/// The best sum of this many modes, by coarse measurements.
fn best(kernel: HistoryKernel, span: f64, modes: usize) -> Option<Exponentials> {
    let tried = LOWEST.map(|lowest| {
        let mut sum = built(kernel, &places(kernel, span, modes, lowest));
        sum.error = measured(kernel, span, &sum, COARSE);
        sum
    });
    tried.into_iter().min_by(|one, other| one.error.total_cmp(&other.error))
}

/// The points at which 1/√p is interpolated, 2n + 1 for n modes.
///
/// The kernel of rotation asks for p = 1 among them: see [`built`].
fn places(kernel: HistoryKernel, span: f64, modes: usize, lowest: f64) -> Vec<f64> {
    let reference = span.min(1.0);
    match kernel {
        HistoryKernel::Translation => points(2 * modes + 1, lowest, span, reference),
        HistoryKernel::Rotation => {
            let mut places = points(2 * modes, lowest, span, reference);
            places.insert(places.partition_point(|x| *x < 1.0), 1.0);
            places
        }
    }
}

/// The sum from the interpolant g(p) = rest + Σ c_k/(p + s_k) of 1/√p, its error not yet measured.
///
/// Translation has κ̂ = 1/√p. Rotation has κ̂ = ⅓/(1 + √p) = ⅓ (1 − p/√p)/(1 − p), and if g(1) = 1 then
///
///   ⅓ (1 − p g(p))/(1 − p) = ⅓ [rest + Σ c_k s_k/(1 + s_k) /(p + s_k)]
///
/// interpolates it at the same points, but p = 1, with the same rates and positive weights.
fn built(kernel: HistoryKernel, places: &[f64]) -> Exponentials {
    let RationalInterpolant { rates, mut weights, mut rest } = RationalInterpolant::new(places);
    if kernel == HistoryKernel::Rotation {
        weights.iter_mut().zip(&rates).for_each(|(weight, rate)| *weight *= rate / (3.0 * (1.0 + rate)));
        rest /= 3.0;
    }
    Exponentials { rates, weights, rest, error: f64::INFINITY }
}

/// max over t ≤ span of ∫₀ᵗ|κ − κ̃| / ∫₀^max(t, θ) κ, with this many samples in a range of e.
///
/// ∫|κ − κ̃| is the variation of ∫κ − ∫κ̃ between samples that are even in ln t. Before the first sample κ > Σ c_k ≥
/// κ̃: the sign does not change, and the variation is exact.
fn measured(kernel: HistoryKernel, span: f64, sum: &Exponentials, samples: f64) -> f64 {
    let reference = span.min(1.0);
    let fastest = sum.rates.iter().fold(1.0 / span, |a, b| a.max(*b));
    let first = 1e-4 / fastest;
    let count = (libm::log(span / first) * samples).ceil();
    let difference = |time: f64| kernel.integral(time) - sum.integral(time);
    let mut last = difference(first);
    let mut variation = sum.rest + (last + sum.rest).abs();
    let mut worst = variation / kernel.integral(reference);
    for index in 1..=count as usize {
        let time = first * libm::pow(span / first, index as f64 / count);
        let next = difference(time);
        variation += (next - last).abs();
        last = next;
        worst = worst.max(variation / kernel.integral(time.max(reference)));
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const KERNELS: [HistoryKernel; 2] = [HistoryKernel::Translation, HistoryKernel::Rotation];

    /// ∫ w′(s) κ(t − s) ds and the same with κ̃, for steps of w′ of equal lengths that end at t; τ = 1.
    fn loads(kernel: HistoryKernel, sum: &Exponentials, accelerations: &[f64], time: f64) -> (f64, f64) {
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
            (HistoryKernel::Translation, 1.0, [18, 33, 54]),
            (HistoryKernel::Translation, 100.0, [22, 40, 63]),
            (HistoryKernel::Translation, 1e4, [28, 49, 74]),
            (HistoryKernel::Rotation, 1.0, [20, 36, 58]),
            (HistoryKernel::Rotation, 100.0, [25, 44, 68]),
            (HistoryKernel::Rotation, 1e4, [31, 53, 80]),
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
                let finer = measured(kernel, span, &sum, 1000.0);
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
            let errors = lags.map(|lag| (sum.value(lag) / HistoryKernel::Translation.value(lag) - 1.0).abs());
            let worst = errors.fold(0.0, f64::max);
            println!("relative error of the kernel on [{shortest:e}, 1] of the span: {worst:.1e}");
            assert!(worst < most);
        }
    }

    #[test]
    fn history_scales_with_the_time_of_the_fluid() {
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
        fn history_under_bounded_accelerations_is_kept_to_the_stated_error(
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
