//! The potential of two sides from those of each: a mean of their soft gaps.
//!
//!   s_i = √w_i U_i^−q/Σ,   U = Σ^(−1/q),   q = 1/(2(ν−1)),   ∂U/∂U_i = λ_i = s_i U/U_i

use super::laws::raised;

/// U of two sides, and how much each has to do with it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mean {
    /// U [J].
    pub energy: f64,
    /// s.
    pub parts: [f64; 2],
    /// q.
    pub power: f64,
}

impl Mean {
    /// Of U_i [J] and √w_i, for a power d^−ν.
    pub fn of(values: [f64; 2], root_shares: [f64; 2], exponent: f64) -> Self {
        let power = 0.5 / (exponent - 1.0);
        // The lower one has the larger s; their ratio may be too small for a number, not too large.
        let [low, high] = if values[0] <= values[1] { [0, 1] } else { [1, 0] };
        let mut parts = root_shares;
        parts[high] *= libm::exp(power * libm::log(values[low] / values[high]));
        let parts = parts.map(|part| part / (parts[0] + parts[1]));
        // U = U_i (s_i²/w_i)^(ν−1), of the side whose part is the larger.
        let larger = usize::from(parts[1] > parts[0]);
        let squeezed = (parts[larger] / root_shares[larger]).powi(2);
        let energy = values[larger] * raised(squeezed, exponent - 1.0);
        Self { energy, parts, power }
    }

    /// δ log λ of both, given δ log U_i.
    pub fn weights_along(&self, growth: [f64; 2]) -> [f64; 2] {
        let mean = self.along(growth);
        growth.map(|own| (1.0 + self.power) * (mean - own))
    }

    /// δ log U, given δ log U_i.
    pub fn along(&self, growth: [f64; 2]) -> f64 {
        self.parts[0] * growth[0] + self.parts[1] * growth[1]
    }
}
