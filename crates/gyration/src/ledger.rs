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
    /// V φ, of the materials.
    Elastic,
    /// ∫U(d) dA, where repulsion and adhesion have a potential.
    Contact,
    /// Springs.
    Load,
}

impl Energy {
    /// All of them, in the order of the ledger.
    pub const ALL: [Self; 5] = [Self::Kinetic, Self::Gravity, Self::Elastic, Self::Contact, Self::Load];

    /// The word of the column `energy.…`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kinetic => "kinetic",
            Self::Gravity => "gravity",
            Self::Elastic => "elastic",
            Self::Contact => "contact",
            Self::Load => "load",
        }
    }
}

/// A work done on the bodies since t = 0 [J].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// By repulsion, with the relative velocity, where it has no potential.
    Repulsion,
    /// By damping, with the relative velocity; ≤ 0.
    Damping,
    /// By friction, with the relative velocity; ≤ 0.
    Friction,
    /// By adhesion, with the relative velocity, where it has no potential.
    Adhesion,
    /// By internal friction, and friction that is linear in the velocity; ≤ 0.
    Viscosity,
    /// By the drag μ_γ of contraction; ≤ 0.
    Contraction,
    /// By the drive: ∫V Q·V_G.
    Drive,
    /// By dashpots and couples, and by what a controller applies.
    Load,
    /// By the motion of the supports: ∫∫ q·(velocity of the support), all laws.
    Support,
    /// By the fluid: drag, and the weight of what is displaced.
    Fluid,
    /// By the pressure of incompressible bodies, and by putting them back to det P = 1: what the error of a step
    /// leaves.
    Constraint,
}

impl Work {
    /// How many there are.
    pub const COUNT: usize = 11;
    /// All of them, in the order of the ledger.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Repulsion,
        Self::Damping,
        Self::Friction,
        Self::Adhesion,
        Self::Viscosity,
        Self::Contraction,
        Self::Drive,
        Self::Load,
        Self::Support,
        Self::Fluid,
        Self::Constraint,
    ];

    /// The word of the column `work.…`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Repulsion => "repulsion",
            Self::Damping => "damping",
            Self::Friction => "friction",
            Self::Adhesion => "adhesion",
            Self::Viscosity => "viscosity",
            Self::Contraction => "contraction",
            Self::Drive => "drive",
            Self::Load => "load",
            Self::Support => "support",
            Self::Fluid => "fluid",
            Self::Constraint => "constraint",
        }
    }
}
