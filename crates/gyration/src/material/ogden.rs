//! Ogden: φ = Σ μ_p/α_p (Σ_i λ_i^α_p − 3), incompressible, or of J^−⅓λ_i with K/2 (J − 1)².
//!
//! With q_i = (J^−⅓λ_i)^α = J^−α/3 c_i^α/2 and T = Σ q_i each term gives s_i = μ (q_i − T/3)/c_i, without J and T if
//! incompressible; the volume gives K (J − 1) J/c_i.

use super::principal::{PAIRS, Principal, power_quotient};
use super::{MaterialError, require, require_bulk};

/// A sum of powers of the stretches; shear modulus ½ Σ μ_p α_p. Source: Ogden 1972.
#[derive(Debug, Clone, PartialEq)]
pub struct Ogden {
    /// The terms.
    pub terms: Vec<OgdenTerm>,
    /// K \[Pa\]; none if incompressible.
    pub bulk: Option<f64>,
}

/// One power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OgdenTerm {
    /// μ_p \[Pa\].
    pub mu: f64,
    /// α_p.
    pub alpha: f64,
}

impl Ogden {
    pub(super) fn principal(&self, c: &[f64; 3]) -> Principal {
        let mut sum = Principal::default();
        let log_volume = 0.5 * c.iter().map(|c| libm::log(*c)).sum::<f64>();
        for term in &self.terms {
            match self.bulk {
                None => term.add_plain(c, &mut sum),
                Some(_) => term.add_isochoric(c, log_volume, &mut sum),
            }
        }
        if let Some(bulk) = self.bulk {
            add_volume(bulk, c, log_volume, &mut sum);
        }
        sum
    }

    /// s_i alone.
    pub(super) fn slopes(&self, c: &[f64; 3]) -> [f64; 3] {
        let logarithms = c.map(libm::log);
        // J^α/3 is taken out of every power; 0 leaves it in.
        let log_volume = 0.5 * ((logarithms[0] + logarithms[1]) + logarithms[2]);
        let isochoric = if self.bulk.is_some() { log_volume / 3.0 } else { 0.0 };
        let mut carried = [0.0; 3];
        for OgdenTerm { mu, alpha } in &self.terms {
            let q = logarithms.map(|log| libm::exp(alpha * (0.5 * log - isochoric)));
            let third = if self.bulk.is_some() { (q[0] + q[1] + q[2]) / 3.0 } else { 0.0 };
            carried = [0, 1, 2].map(|i| carried[i] + mu * (q[i] - third));
        }
        let grown = libm::expm1(log_volume);
        let pressure = self.bulk.map_or(0.0, |bulk| bulk * grown * (1.0 + grown));
        [0, 1, 2].map(|i| (carried[i] + pressure) / c[i])
    }

    pub(super) fn validate(&self) -> Result<(), MaterialError> {
        for OgdenTerm { mu, alpha } in &self.terms {
            require("alpha", *alpha, *alpha != 0.0, "not 0")?;
            require("mu", *mu, mu * alpha >= 0.0, "of the sign of its `alpha`")?;
        }
        require_bulk(self.bulk)
    }
}

impl OgdenTerm {
    fn add_plain(&self, c: &[f64; 3], sum: &mut Principal) {
        let Self { mu, alpha } = *self;
        let n = 0.5 * alpha;
        let mut powers = [0.0; 3];
        for (i, c) in c.iter().enumerate() {
            let grown = libm::expm1(n * libm::log(*c));
            // c^(n−1).
            powers[i] = (1.0 + grown) / c;
            sum.energy += mu / alpha * grown;
            sum.slopes[i] += mu * powers[i];
            sum.curvature[i][i] += mu * (n - 1.0) * powers[i] / c;
        }
        for (quotient, (i, j)) in sum.quotients.iter_mut().zip(PAIRS) {
            *quotient += mu * power_quotient(n - 1.0, [c[i], c[j]], [powers[i], powers[j]]);
        }
    }

    fn add_isochoric(&self, c: &[f64; 3], log_volume: f64, sum: &mut Principal) {
        let Self { mu, alpha } = *self;
        let grown = c.map(|c| libm::expm1(alpha * (0.5 * libm::log(c) - log_volume / 3.0)));
        let q = grown.map(|g| 1.0 + g);
        let third = q.iter().sum::<f64>() / 3.0;
        sum.energy += mu / alpha * grown.iter().sum::<f64>();
        for i in 0..3 {
            let slope = mu * (q[i] - third) / c[i];
            sum.slopes[i] += slope;
            for j in 0..3 {
                sum.curvature[i][j] += mu * alpha / 6.0 * (third - q[i] - q[j]) / (c[i] * c[j]);
            }
            sum.curvature[i][i] += 0.5 * mu * alpha * q[i] / (c[i] * c[i]) - slope / c[i];
        }
        // J^−α/3 c^(α/2 − 1).
        let powers: [f64; 3] = std::array::from_fn(|i| q[i] / c[i]);
        for (quotient, (i, j)) in sum.quotients.iter_mut().zip(PAIRS) {
            let power = power_quotient(0.5 * alpha - 1.0, [c[i], c[j]], [powers[i], powers[j]]);
            *quotient += mu * (power + third / (c[i] * c[j]));
        }
    }
}

/// Adds K/2 (J − 1)².
fn add_volume(bulk: f64, c: &[f64; 3], log_volume: f64, sum: &mut Principal) {
    let grown = libm::expm1(log_volume);
    let j = 1.0 + grown;
    let pressure = bulk * grown * j;
    sum.energy += 0.5 * bulk * grown * grown;
    for i in 0..3 {
        sum.slopes[i] += pressure / c[i];
        for k in 0..3 {
            sum.curvature[i][k] += 0.5 * bulk * (j + grown) * j / (c[i] * c[k]);
        }
        sum.curvature[i][i] -= pressure / (c[i] * c[i]);
    }
    for (quotient, (i, k)) in sum.quotients.iter_mut().zip(PAIRS) {
        *quotient -= pressure / (c[i] * c[k]);
    }
}
