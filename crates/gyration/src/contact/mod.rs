//! Contact laws: tractions of a support that are powers of the gap d, per unit deformed area.
//!
//! | law       | traction                              | parameters         |
//! |-----------|---------------------------------------|--------------------|
//! | repulsion | α (d/d₀)^−ν n                         | α [Pa]             |
//! | damping   | −β (d/d₀)^−ν (n⊗n) w                  | β [Pa s/m]         |
//! | friction  | −β (d/d₀)^−ν (I − n⊗n) w              | β [Pa s/m]         |
//! | adhesion  | −β ((d/d₀)^−ν_a − (d/d₀)^−ν_r) n      | β [Pa], ν_r > ν_a  |
//!
//! The friction of a contact may have a bound, that of Coulomb (`bound`), and its damping may hardly pull on what
//! recedes (`one_sided`): both depend on all of the contact.
//!
//! n is the support's unit normal, w the velocity relative to the support. A law sees a gap and a velocity, never a
//! mesh, a body or a time. Each is a sum of [`Term`]s, one power of the gap each, which is all that `resultant` needs
//! to integrate it over a surface. Source: Tatone, *Soft and rigid impact*.

mod adhesion;
mod ball;
mod bound;
mod damping;
mod foot;
mod friction;
mod law_set;
mod meeting;
mod negligible;
mod one_sided;
mod potential;
mod repulsion;
mod resultant;
mod rigid;
mod slopes;
mod sums;
mod support_contact;
mod tension;
mod wrench;

pub use adhesion::Adhesion;
pub(crate) use bound::{Bound, Sliding};
pub use damping::Damping;
pub(crate) use foot::repulsion_center;
pub use friction::Friction;
pub use law_set::{ContactScratch, LawSet};
pub use meeting::{Deformation, Meeting, RelativeMotion};
pub use negligible::Negligible;
pub(crate) use one_sided::{OneSided, Shift};
pub use repulsion::Repulsion;
pub use resultant::{ContactLoads, Overall};
pub use slopes::ContactSlopes;
pub use support_contact::Contact;
pub use tension::contact_potential;
pub(crate) use tension::{TensionSlopes, across, symmetric, tension};
pub use wrench::{ContactWrench, RigidLoads, RigidMotion};

/// In which measure of area the tractions are given; on a rigid body all three are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AreaMeasure {
    /// Force per deformed area, as in the slides.
    #[default]
    DeformedArea,
    /// Force per reference area.
    ReferenceArea,
    /// Derived from the potential ∫U(d) k dA.
    DeformedAreaPotential,
}

/// One of the four laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactLaw {
    /// Pushes away from the support.
    Repulsion(Repulsion),
    /// Resists approach and departure.
    Damping(Damping),
    /// Resists sliding.
    Friction(Friction),
    /// Attracts beyond d₀, repels below.
    Adhesion(Adhesion),
}

/// The column of the ledger, and the resultant, to which a term belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawKind {
    /// Repulsion.
    Repulsion,
    /// Damping.
    Damping,
    /// Friction.
    Friction,
    /// Adhesion.
    Adhesion,
}

impl LawKind {
    /// How many kinds there are.
    pub const COUNT: usize = 4;
    /// All kinds, in the order of the ledger.
    pub const ALL: [Self; Self::COUNT] = [Self::Repulsion, Self::Damping, Self::Friction, Self::Adhesion];

    /// The word used in scenes, columns and messages.
    pub fn name(self) -> &'static str {
        ["repulsion", "damping", "friction", "adhesion"][self as usize]
    }
}

/// What a term's power of the gap multiplies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// n.
    Central,
    /// −(n·w) n.
    Normal,
    /// −(w − (n·w) n).
    Tangential,
}

impl Action {
    /// How many actions there are.
    pub const COUNT: usize = 3;
    /// All of them.
    pub const ALL: [Self; Self::COUNT] = [Self::Central, Self::Normal, Self::Tangential];
}

/// One power of the gap: traction = c d^−ν × (what the action says), c = coefficient × d₀^ν.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// The law it belongs to.
    pub kind: LawKind,
    /// What the power multiplies.
    pub action: Action,
    /// c [Pa m^ν] for a central term, [Pa s m^(ν−1)] for a viscous one.
    pub coefficient: f64,
    /// ν.
    pub exponent: f64,
    /// d₀ [m], needed by the potential at ν = 1 only.
    pub reference_gap: f64,
}

impl Term {
    /// A bound on its traction over d^−ν at a speed [m/s], and ν − 1, by which its work to infinity falls; none where
    /// that has no bound. One-sided damping shifts an approach by as much as it resists once more.
    pub(crate) fn falling_work(&self, speed: f64) -> Option<(f64, f64)> {
        let factor = if self.action == Action::Central { 1.0 } else { 2.0 * speed };
        let falls = self.exponent - 1.0;
        (falls > 0.0).then_some((self.coefficient.abs() * factor, falls))
    }
}

impl ContactLaw {
    /// The law as a sum of powers of the gap.
    pub fn terms(&self) -> [Option<Term>; 2] {
        match self {
            Self::Repulsion(law) => [Some(law.term()), None],
            Self::Damping(law) => [Some(law.term()), None],
            Self::Friction(law) => [Some(law.term()), None],
            Self::Adhesion(law) => law.terms().map(Some),
        }
    }

    /// Its kind.
    pub fn kind(&self) -> LawKind {
        match self {
            Self::Repulsion(_) => LawKind::Repulsion,
            Self::Damping(_) => LawKind::Damping,
            Self::Friction(_) => LawKind::Friction,
            Self::Adhesion(_) => LawKind::Adhesion,
        }
    }

    /// The exponent that decides whether the law forbids touching: ν, or ν_r for adhesion.
    pub fn leading_exponent(&self) -> f64 {
        match self {
            Self::Repulsion(law) => law.exponent,
            Self::Damping(law) => law.exponent,
            Self::Friction(law) => law.exponent,
            Self::Adhesion(law) => law.repulsive_exponent,
        }
    }

    /// μ of a friction that has a bound.
    pub fn mu(&self) -> Option<f64> {
        match self {
            Self::Friction(law) => law.mu,
            Self::Repulsion(_) | Self::Damping(_) | Self::Adhesion(_) => None,
        }
    }

    /// w₀ [m/s] of a damping that is one-sided.
    pub fn release(&self) -> Option<f64> {
        match self {
            Self::Damping(law) => law.release,
            Self::Repulsion(_) | Self::Friction(_) | Self::Adhesion(_) => None,
        }
    }

    /// The factor of the law at a gap d > 0: its traction along n for a central law [Pa], the resistance per speed for
    /// a viscous one [Pa s/m].
    pub fn factor(&self, gap: f64) -> f64 {
        self.terms().iter().flatten().map(|term| term.coefficient * libm::pow(gap, -term.exponent)).sum()
    }
}
