//! The entries of the energy ledger: stores of energy, and works done on the bodies since t = 0.
//!
//! Their names are those of the columns `energy.…` and `work.…`; their values come from `balance` and, for the works,
//! from the powers that `rates` integrates with the state.

/// A store of energy [J].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Energy {
    /// ½ m|ṗ₀|² + ½ tr(Ṗ J Ṗᵀ).
    Kinetic,
    /// −m g·p₀.
    Gravity,
    /// ∫U(d) dA, where repulsion and adhesion have a potential.
    Contact,
    /// Springs.
    Load,
}

impl Energy {
    /// The word of the column `energy.…`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kinetic => "kinetic",
            Self::Gravity => "gravity",
            Self::Contact => "contact",
            Self::Load => "load",
        }
    }
}

/// A work done on the bodies since t = 0 [J].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// By damping, with the relative velocity; ≤ 0.
    Damping,
    /// By friction, with the relative velocity; ≤ 0.
    Friction,
    /// By dashpots; ≤ 0.
    Load,
    /// By the motion of the supports: ∫∫ q·(velocity of the support), all laws.
    Support,
}

impl Work {
    /// The word of the column `work.…`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Damping => "damping",
            Self::Friction => "friction",
            Self::Load => "load",
            Self::Support => "support",
        }
    }
}
