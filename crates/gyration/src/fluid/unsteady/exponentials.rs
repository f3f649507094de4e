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
    /// From units of τ to seconds.
    pub(super) fn in_seconds(mut self, tau: f64) -> Self {
        self.rates.iter_mut().for_each(|rate| *rate /= tau);
        self.rest *= tau;
        self
    }

    /// Σ c_k e^(−s_k t), for t > 0.
    pub fn value(&self, time: f64) -> f64 {
        self.pairs().map(|(rate, weight)| weight * libm::exp(-rate * time)).sum()
    }

    /// rest + Σ (c_k/s_k)(1 − e^(−s_k t)), for t > 0: ∫₀ᵗ κ̃ [s].
    pub fn integral(&self, time: f64) -> f64 {
        self.rest - self.pairs().map(|(rate, weight)| weight / rate * libm::expm1(-rate * time)).sum::<f64>()
    }

    /// Pairs (s_k, c_k).
    fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        self.rates.iter().copied().zip(self.weights.iter().copied())
    }
}
