//! Hencky: φ = μ |dev ln U|² + K/2 ln²J, ln U the logarithmic strain.
//!
//! With ε_i = ½ ln c_i and ℓ = ln J = Σ ε_i: s_i = (2μ(ε_i − ℓ/3) + Kℓ)/c_i.

use super::principal::{PAIRS, Principal, log_quotient};
use super::{MaterialError, require, require_modulus};

/// Quadratic in the logarithmic strain; shear modulus μ, bulk modulus K. Source: Hencky 1928.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hencky {
    /// μ \[Pa\].
    pub shear: f64,
    /// K \[Pa\].
    pub bulk: f64,
}

impl Hencky {
    pub(super) fn principal(&self, c: &[f64; 3]) -> Principal {
        let Self { shear, bulk } = *self;
        let logarithms = c.map(libm::log);
        let strain = logarithms.map(|log| 0.5 * log);
        let volume = strain.iter().sum::<f64>();
        let deviator = strain.map(|e| e - volume / 3.0);
        let mut sum = Principal {
            energy: shear * deviator.iter().map(|e| e * e).sum::<f64>() + 0.5 * bulk * volume * volume,
            ..Principal::default()
        };
        // The part of c_i s_i that is the same for all i.
        let common = bulk * volume - 2.0 / 3.0 * shear * volume;
        for i in 0..3 {
            sum.slopes[i] = (2.0 * shear * strain[i] + common) / c[i];
            for j in 0..3 {
                sum.curvature[i][j] = (0.5 * bulk - shear / 3.0) / (c[i] * c[j]);
            }
            sum.curvature[i][i] += shear / (c[i] * c[i]) - sum.slopes[i] / c[i];
        }
        for (quotient, (i, j)) in sum.quotients.iter_mut().zip(PAIRS) {
            // Of ln c / c by the product rule, and of 1/c.
            let quotient_of_logs = log_quotient([c[i], c[j]], [logarithms[i], logarithms[j]]);
            let logarithm = quotient_of_logs / c[i] - logarithms[j] / (c[i] * c[j]);
            *quotient = shear * logarithm - common / (c[i] * c[j]);
        }
        sum
    }

    /// s_i alone.
    pub(super) fn slopes(&self, c: &[f64; 3]) -> [f64; 3] {
        let Self { shear, bulk } = *self;
        let strain = c.map(|c| 0.5 * libm::log(c));
        let volume = (strain[0] + strain[1]) + strain[2];
        let common = (bulk - 2.0 / 3.0 * shear) * volume;
        [0, 1, 2].map(|i| (2.0 * shear * strain[i] + common) / c[i])
    }

    pub(super) fn validate(&self) -> Result<(), MaterialError> {
        require_modulus("shear", self.shear)?;
        require("bulk", self.bulk, self.bulk >= 0.0, "≥ 0")
    }
}
