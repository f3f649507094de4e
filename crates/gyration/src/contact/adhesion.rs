//! Adhesion: attraction beyond d₀, repulsion below; conservative.

use super::{Action, LawKind, Term};

/// Adhesive traction of a support on a surface point, per unit deformed area.
///
///   q = −β ((d/d₀)^−ν_a − (d/d₀)^−ν_r) n,   ν_r > ν_a;   zero at d = d₀
///
/// Potential −β d₀ [(d/d₀)^(1−ν_a)/(ν_a−1) − (d/d₀)^(1−ν_r)/(ν_r−1)]. Source: Tatone, *Soft and rigid impact*.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adhesion {
    /// β [Pa].
    pub beta: f64,
    /// ν_a > 0.
    pub attractive_exponent: f64,
    /// ν_r > ν_a.
    pub repulsive_exponent: f64,
    /// d₀ [m].
    pub reference_gap: f64,
}

impl Adhesion {
    /// The attractive and the repulsive power.
    pub fn terms(&self) -> [Term; 2] {
        let term = |sign: f64, exponent: f64| Term {
            kind: LawKind::Adhesion,
            action: Action::Central,
            coefficient: sign * self.beta * libm::pow(self.reference_gap, exponent),
            exponent,
            reference_gap: self.reference_gap,
        };
        [term(-1.0, self.attractive_exponent), term(1.0, self.repulsive_exponent)]
    }
}
