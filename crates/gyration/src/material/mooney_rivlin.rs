//! Mooney–Rivlin: φ = c₁(ι₁ − 3) + c₂(ι₂ − 3), incompressible, or of ῑ₁, ῑ₂ with K/2 (J − 1)².

use super::invariants::{Derivatives, Invariants};
use super::volume::{Distortion, isochoric_excess, with_volume};
use super::{MaterialError, require_bulk, require_modulus};

/// Mooney–Rivlin; shear modulus 2(c₁ + c₂). Source: Tatone, *Soft and rigid impact*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MooneyRivlin {
    /// c₁ \[Pa\].
    pub c1: f64,
    /// c₂ \[Pa\].
    pub c2: f64,
    /// K \[Pa\]; none if incompressible.
    pub bulk: Option<f64>,
}

impl MooneyRivlin {
    /// Neo-Hookean: c₁ = μ/2, c₂ = 0.
    pub fn neo_hookean(shear: f64, bulk: Option<f64>) -> Self {
        Self { c1: 0.5 * shear, c2: 0.0, bulk }
    }

    #[inline(always)]
    pub(super) fn derivatives(&self, invariants: &Invariants) -> Derivatives {
        let [x, y] = isochoric_excess(invariants, self.bulk);
        let energy = self.c1 * x + self.c2 * y;
        let w = Distortion { energy, first: [self.c1, self.c2], second: [0.0; 3] };
        with_volume(&w, self.bulk, invariants)
    }

    pub(super) fn validate(&self) -> Result<(), MaterialError> {
        require_modulus("c1", self.c1)?;
        require_modulus("c2", self.c2)?;
        require_bulk(self.bulk)
    }
}
