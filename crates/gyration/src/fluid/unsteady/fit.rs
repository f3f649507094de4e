//! The fewest exponentials that keep a history to a stated error: build, measure, add a mode.
//!
//! Times are in units of τ here. What is measured, and must not exceed ε, is
//!
//!   max over t ≤ span of  ∫₀ᵗ|κ − κ̃| / ∫₀^max(t, θ) κ,     θ = min(1, span)
//!
//! from the built sum itself; nothing rests on an estimate of convergence.

use super::exponentials::Exponentials;
use super::interpolant::Interpolant;
use super::kernel::Kernel;
use super::points::{count, points};

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
pub(super) fn fewest(kernel: Kernel, span: f64, error: f64) -> Option<Exponentials> {
    // ε is about 20 e^−Λ when span ≤ τ, and down to 10 e^−Λ when span > τ: the count begins below what is needed.
    let least = (count((9.0 / error).ln(), span, span.min(1.0)) / 2.0) as usize;
    (least.max(1)..=MOST_MODES).find_map(|modes| {
        let mut sum = best(kernel, span, modes).filter(|sum| sum.error <= error)?;
        sum.error = (1.0 + MISSED) * measured(kernel, span, &sum, FINE);
        (sum.error <= error).then_some(sum)
    })
}

/// The best sum of this many modes, by coarse measurements.
fn best(kernel: Kernel, span: f64, modes: usize) -> Option<Exponentials> {
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
fn places(kernel: Kernel, span: f64, modes: usize, lowest: f64) -> Vec<f64> {
    let reference = span.min(1.0);
    match kernel {
        Kernel::Translation => points(2 * modes + 1, lowest, span, reference),
        Kernel::Rotation => {
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
fn built(kernel: Kernel, places: &[f64]) -> Exponentials {
    let Interpolant { rates, mut weights, mut rest } = Interpolant::new(places);
    if kernel == Kernel::Rotation {
        weights.iter_mut().zip(&rates).for_each(|(weight, rate)| *weight *= rate / (3.0 * (1.0 + rate)));
        rest /= 3.0;
    }
    Exponentials { rates, weights, rest, error: f64::INFINITY }
}

/// max over t ≤ span of ∫₀ᵗ|κ − κ̃| / ∫₀^max(t, θ) κ, with this many samples in a range of e.
///
/// ∫|κ − κ̃| is the variation of ∫κ − ∫κ̃ between samples that are even in ln t. Before the first sample κ > Σ c_k ≥
/// κ̃: the sign does not change, and the variation is exact.
pub(super) fn measured(kernel: Kernel, span: f64, sum: &Exponentials, samples: f64) -> f64 {
    let reference = span.min(1.0);
    let fastest = sum.rates.iter().fold(1.0 / span, |a, b| a.max(*b));
    let first = 1e-4 / fastest;
    let count = ((span / first).ln() * samples).ceil();
    let difference = |time: f64| kernel.integral(time) - sum.integral(time);
    let mut last = difference(first);
    let mut variation = sum.rest + (last + sum.rest).abs();
    let mut worst = variation / kernel.integral(reference);
    for index in 1..=count as usize {
        let time = first * (span / first).powf(index as f64 / count);
        let next = difference(time);
        variation += (next - last).abs();
        last = next;
        worst = worst.max(variation / kernel.integral(time.max(reference)));
    }
    worst
}
