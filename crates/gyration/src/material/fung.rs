//! Fung: φ = μ/(2b) (e^{b(ι₁ − 3)} − 1), incompressible, or of ῑ₁ with K/2 (J − 1)².

use super::invariants::{Derivatives, Invariants};
use super::volume::{Distortion, isochoric_excess, with_volume};
use super::{MaterialError, require, require_bulk, require_modulus};

/// A material that stiffens exponentially; shear modulus μ at rest. Source: Fung, *Biomechanics*, isotropic form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fung {
    /// μ \[Pa\].
    pub shear: f64,
    /// b.
    pub exponent: f64,
    /// K \[Pa\]; none if incompressible.
    pub bulk: Option<f64>,
}

impl Fung {
    #[inline(always)]
    pub(super) fn derivatives(&self, invariants: &Invariants) -> Derivatives {
        let [x, _] = isochoric_excess(invariants, self.bulk);
        let (b, half) = (self.exponent, 0.5 * self.shear);
        let grown = libm::expm1(b * x);
        let w = Distortion {
            energy: half / b * grown,
            first: [half * (1.0 + grown), 0.0],
            second: [half * b * (1.0 + grown), 0.0, 0.0],
        };
        with_volume(&w, self.bulk, invariants)
    }

    pub(super) fn validate(&self) -> Result<(), MaterialError> {
        require_modulus("shear", self.shear)?;
        require("exponent", self.exponent, self.exponent > 0.0, "> 0")?;
        require_bulk(self.bulk)
    }
}
