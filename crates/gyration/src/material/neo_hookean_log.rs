//! Neo-Hookean with logarithm: φ = μ/2 (ι₁ − 3) − μ ln J + λ/2 ln²J.

use super::invariants::{Derivatives, Invariants};
use super::{MaterialError, require, require_modulus};

/// Compressible neo-Hookean; Lamé's constants at rest are λ and μ. Source: Bonet and Wood, *Nonlinear continuum
/// mechanics for finite element analysis*, §6.4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookeanLog {
    /// μ \[Pa\].
    pub mu: f64,
    /// λ \[Pa\].
    pub lambda: f64,
}

impl NeoHookeanLog {
    #[inline(always)]
    pub(super) fn derivatives(&self, invariants: &Invariants) -> Derivatives {
        let (mu, lambda, j) = (self.mu, self.lambda, invariants.volume);
        let log = libm::log(j);
        let slope = lambda * log - mu;
        Derivatives {
            energy: 0.5 * mu * invariants.excess[0] - mu * log + 0.5 * lambda * log * log,
            first: [0.5 * mu, 0.0, slope / j],
            second: [0.0, 0.0, 0.0, 0.0, 0.0, (lambda - slope) / (j * j)],
        }
    }

    pub(super) fn validate(&self) -> Result<(), MaterialError> {
        require_modulus("mu", self.mu)?;
        let bulk = self.lambda + 2.0 / 3.0 * self.mu;
        require("lambda", self.lambda, self.lambda >= 0.0 && bulk >= 0.0, "≥ 0")
    }
}
