//! A body that drives itself: P = F G, where F is elastic and G, the contraction, is what the body does by itself.
//!
//!   S = g (∂φ/∂F) G⁻ᵀ + τ P⁻ᵀ − π P⁻ᵀ,           g = det G,   τ = μ sym(Ḟ F⁻¹)
//!   μ_γ V_G = Fᵀ S Gᵀ − g φ I + Q,               V_G = Ġ G⁻¹,   Ḟ F⁻¹ = L − F V_G F⁻¹
//!   P̈ J = M − V S
//!
//! φ(F) is the energy per relaxed volume, Q the drive, μ_γ > 0. An incompressible material has det F = 1: its pressure π is
//! algebraic, since it acts on V_G. Internal friction after Sławianowski acts on L, as that of the medium in which the
//! body moves, and takes no part in the second line. Source: Tatone, *Soft and rigid impact*; `physics.md` §5 and §10.

mod feedback;

pub use feedback::{Feedback, Felt, Measure, Nearest};

use crate::signal::Signal;

/// How a body contracts, and what makes it do so.
#[derive(Debug, Clone, PartialEq)]
pub struct Contraction {
    /// μ_γ, > 0 unless G is prescribed \[Pa s\].
    pub viscosity: f64,
    /// det G, if it is kept as it is at the start: tr V_G = 0.
    pub kept_volume: Option<f64>,
    /// Which part of V_G there is.
    pub spin: Spin,
    /// What G follows.
    pub source: Source,
}

/// Which part of the contraction velocity there is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spin {
    /// All of it.
    #[default]
    Full,
    /// Its symmetric part alone.
    Symmetric,
}

/// What makes a body contract.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// Q is given, and G is part of the state.
    Driven {
        /// The part of Q that is given in time \[Pa\].
        drive: Signal,
        /// The parts that answer to the body.
        feedback: Vec<Feedback>,
    },
    /// G is given in time, and Q is what it takes.
    Prescribed(Signal),
}
