//! St Venant–Kirchhoff: φ = λ/2 tr²E + μ E·E, E = (C − I)/2.
//!
//! With x = ι₁ − 3, y = ι₂ − 3: tr E = x/2 and |C − I|² = x² + 4x − 2y.

use super::invariants::{Derivatives, Invariants};
use super::{MaterialError, require, require_modulus};

/// Quadratic in Green's strain; soft, in the end unstable, under strong compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StVenantKirchhoff {
    /// λ \[Pa\].
    pub lambda: f64,
    /// μ \[Pa\].
    pub mu: f64,
}

impl StVenantKirchhoff {
    /// The orthogonality energy κ|PᵀP − I|² of affine body dynamics: λ = 0, μ = 4κ. Source: Lan et al. 2022.
    pub fn orthogonality(kappa: f64) -> Self {
        Self { lambda: 0.0, mu: 4.0 * kappa }
    }

    #[inline(always)]
    pub(super) fn derivatives(&self, invariants: &Invariants) -> Derivatives {
        let (lambda, mu, [x, y]) = (self.lambda, self.mu, invariants.excess);
        let second = 0.25 * lambda + 0.5 * mu;
        Derivatives {
            energy: 0.125 * lambda * x * x + 0.25 * mu * (x * x + 4.0 * x - 2.0 * y),
            first: [second * x + mu, -0.5 * mu, 0.0],
            second: [second, 0.0, 0.0, 0.0, 0.0, 0.0],
        }
    }

    pub(super) fn validate(&self) -> Result<(), MaterialError> {
        require_modulus("mu", self.mu)?;
        let bulk = self.lambda + 2.0 / 3.0 * self.mu;
        require("lambda", self.lambda, bulk >= 0.0, "≥ −2/3 mu, so that the bulk modulus is not negative")
    }
}
