//! Repulsion: conservative, of potential α d₀ (d/d₀)^(1−ν)/(ν−1) per unit area (−α d₀ ln(d/d₀) at ν = 1).

use super::{Action, LawKind, Term};

/// Repulsive traction of a support on a surface point, per unit deformed area.
///
///   q = α (d/d₀)^−ν n
///
/// d gap [m], n unit normal (3). Source: Tatone, *Soft and rigid impact*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repulsion {
    /// α [Pa].
    pub alpha: f64,
    /// ν > 0.
    pub exponent: f64,
    /// d₀ [m], the gap at which the power is one.
    pub reference_gap: f64,
}

impl Repulsion {
    /// The law as one power of the gap.
    pub fn term(&self) -> Term {
        Term {
            kind: LawKind::Repulsion,
            action: Action::Central,
            coefficient: self.alpha * libm::pow(self.reference_gap, self.exponent),
            exponent: self.exponent,
            reference_gap: self.reference_gap,
        }
    }
}
