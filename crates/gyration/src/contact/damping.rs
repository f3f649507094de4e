//! Damping: resists the normal part of the relative velocity; dissipates β (d/d₀)^−ν (n·w)² per unit area, unless it is
//! one-sided.

use super::{Action, LawKind, Term};

/// Damping traction of a support on a surface point, per unit deformed area.
///
///   q = −β (d/d₀)^−ν (n⊗n) w
///
/// d gap [m], n unit normal (3), w relative velocity (3) [m/s]. Source: Tatone, *Soft and rigid impact*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damping {
    /// β [Pa s/m].
    pub beta: f64,
    /// ν > 0.
    pub exponent: f64,
    /// d₀ [m], the gap at which the power is one.
    pub reference_gap: f64,
    /// w₀ [m/s] of damping that hardly pulls on what recedes (`one_sided`); without it damping is viscous.
    pub release: Option<f64>,
}

impl Damping {
    /// The law as one power of the gap.
    pub fn term(&self) -> Term {
        Term {
            kind: LawKind::Damping,
            action: Action::Normal,
            coefficient: self.beta * libm::pow(self.reference_gap, self.exponent),
            exponent: self.exponent,
            reference_gap: self.reference_gap,
        }
    }
}
