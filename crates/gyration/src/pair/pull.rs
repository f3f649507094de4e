//! Adhesion between two bodies, which must not place their plane: the powers of the gap that pull beside what does.
//!
//!   W = Σ ± β d₀ Φ_m^(−(m−1)),   m = ν_a (−), ν_r (+; where it places the plane, that is U)
//!
//! Φ_m is what the plane's own Φ is, with the exponent m and each U_i per coefficient: of equal parallel faces W is the
//! potential of one of them at the whole gap.

use crate::contact::{Adhesion, LawKind};
use crate::surface::{MomentPlan, request};

/// What acts along the normal beside what places the plane.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pull {
    /// What pulls, and what pushes if it does not place the plane.
    pub terms: [Option<PullTerm>; 2],
    /// Of d^(1−m), d^−m and d^−(m+1) of each term.
    pub values: MomentPlan,
}

/// A power of the gap, as potential and as traction: ±β (d/d₀)^−m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PullTerm {
    /// −1 of what pulls, 1 of what pushes.
    pub sign: f64,
    /// β [Pa].
    pub strength: f64,
    /// d₀ [m].
    pub reference_gap: f64,
    /// m.
    pub exponent: f64,
    /// Where its moments stand in the plan `values`.
    pub places: [usize; 3],
}

impl Pull {
    /// Of an adhesion, beside what places the plane.
    pub fn new(law: &Adhesion, placed_by: LawKind) -> Self {
        let mut requests = Vec::new();
        let mut term = |sign: f64, exponent: f64| {
            let places = [0, 1, 2].map(|order| request(&mut requests, exponent - 1.0 + order as f64, order));
            PullTerm { sign, strength: law.beta, reference_gap: law.reference_gap, exponent, places }
        };
        let pulls = term(-1.0, law.attractive_exponent);
        let pushes = (placed_by != LawKind::Adhesion).then(|| term(1.0, law.repulsive_exponent));
        Self { terms: [Some(pulls), pushes], values: MomentPlan::new(requests) }
    }
}

impl PullTerm {
    /// β d₀^m.
    pub fn coefficient(&self) -> f64 {
        self.strength * libm::pow(self.reference_gap, self.exponent)
    }
}
