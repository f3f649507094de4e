//! Friction: resists the tangential part of the relative velocity; linear in it, unless it has a bound.

use super::{Action, LawKind, Term};

/// Frictional traction of a support on a surface point, per unit deformed area.
///
///   q = −β (d/d₀)^−ν (I − n⊗n) w
///
/// d gap [m], n unit normal (3), w relative velocity (3) [m/s]. Source: Tatone, *Soft and rigid impact*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// β [Pa s/m].
    pub beta: f64,
    /// ν > 0.
    pub exponent: f64,
    /// d₀ [m], the gap at which the power is one.
    pub reference_gap: f64,
    /// μ, Coulomb's bound on the friction of the contact (`bound`); without it friction is viscous.
    pub mu: Option<f64>,
}

impl Friction {
    /// The law as one power of the gap.
    pub fn term(&self) -> Term {
        Term {
            kind: LawKind::Friction,
            action: Action::Tangential,
            coefficient: self.beta * libm::pow(self.reference_gap, self.exponent),
            exponent: self.exponent,
            reference_gap: self.reference_gap,
        }
    }
}
