//! A body that drives itself: P = F G, where F is elastic and G, the contraction, is what the body does by itself.
//!
//!   S = g (∂φ/∂F) G⁻ᵀ + τ P⁻ᵀ − π P⁻ᵀ,           g = det G,   τ = μ sym(Ḟ F⁻¹)
//!   μ_γ V_G = Fᵀ S Gᵀ − g φ I + Q,               V_G = Ġ G⁻¹,   Ḟ F⁻¹ = L − F V_G F⁻¹
//!   P̈ J = M − V S
//!
//! φ(F) is the energy per relaxed volume, Q the drive, μ_γ > 0. An incompressible material has det F = 1: its pressure
//! π is algebraic, since it acts on V_G. Internal friction after Sławianowski acts on L, as that of the medium in which
//! the body moves, and takes no part in the second line. Source: Tatone, *Soft and rigid impact*;
//! `docs/theory-contractile.md`.

mod batch;
mod decomposition;
mod feedback;
mod mobility;
mod restore;
mod slopes;
mod solution;
mod turned;
mod vectors;

pub use decomposition::Decomposition;
pub use feedback::{Feedback, FeedbackMeasure, Felt, Nearest};
pub use restore::Restored;
pub(crate) use slopes::ContractileSlopes;

use crate::affine::{AffineBody, Gyration};
use crate::signal::{Jet, Signal};
use crate::simd::{F64x4, SimdMat3, WithF64x4, dispatch_f64x4};
use crate::tensor::Mat3;
use solution::ContractionSolution;

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
    pub source: ContractionSource,
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
pub enum ContractionSource {
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

/// A contractile body at P, Ṗ and G.
#[derive(Debug, Clone, Copy)]
pub struct Pull<'a> {
    /// Inertia, material (of F), internal friction.
    pub body: &'a AffineBody,
    /// How it contracts.
    pub contraction: &'a Contraction,
    /// P, Ṗ.
    pub at: &'a Gyration,
    /// P = F G.
    pub decomposition: &'a Decomposition,
}

impl Contraction {
    /// Whether G is part of the state.
    pub fn is_driven(&self) -> bool {
        matches!(self.source, ContractionSource::Driven { .. })
    }

    /// The parts of the drive that answer to the body.
    pub fn feedback(&self) -> &[Feedback] {
        match &self.source {
            ContractionSource::Driven { feedback, .. } => feedback,
            ContractionSource::Prescribed(_) => &[],
        }
    }

    /// The signal of the drive, or of G.
    pub fn signal(&self) -> &Signal {
        match &self.source {
            ContractionSource::Driven { drive, .. } => drive,
            ContractionSource::Prescribed(signal) => signal,
        }
    }
}

/// What drives or prescribes the contraction at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContractionCommand {
    /// Q \[Pa\].
    Drive(Mat3),
    /// V_G \[1/s\] and d(tr V_G)/dt \[1/s²\].
    Velocity(Mat3, f64),
}

/// The balance of a contractile body and its law of contraction, solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContractileBalance {
    /// P̈ [1/s²].
    pub acceleration: Mat3,
    /// V_G = Ġ G⁻¹ [1/s].
    pub contraction_velocity: Mat3,
    /// Ġ [1/s].
    pub contraction_rate: Mat3,
    /// Q, given or taken \[Pa\].
    pub drive: Mat3,
    /// S, internal friction that acts on L included [Pa].
    pub stress: Mat3,
    /// π [Pa]; none of a compressible material.
    pub pressure: Option<f64>,
    /// V (μ |sym Ḟ F⁻¹|² + τ_L·L) ≥ 0 [W], τ_L being internal friction that acts on L.
    pub friction: f64,
    /// V μ_γ |V_G|² ≥ 0 [W].
    pub drag: f64,
    /// V Q·V_G [W].
    pub drive_power: f64,
}

/// V_G and d(tr V_G)/dt where G is prescribed: V_G = Ġ G⁻¹, d(tr V_G)/dt = tr(G̈ G⁻¹) − tr V_G².
pub fn velocity_of(jet: &Jet, decomposition: &Decomposition) -> ContractionCommand {
    let velocity = jet.rate * decomposition.inverse;
    let growing = (jet.acceleration * decomposition.inverse).trace() - (velocity * velocity).trace();
    ContractionCommand::Velocity(velocity, growing)
}

/// A balance to be solved.
struct Balance<'a, 'b> {
    pull: &'b Pull<'a>,
    command: &'b ContractionCommand,
    moment: &'b Mat3,
}

impl WithF64x4 for Balance<'_, '_> {
    type Output = ContractileBalance;

    #[inline(always)]
    fn run<F: F64x4>(self, zeros: F) -> ContractileBalance {
        let Self { pull, command, moment } = self;
        ContractionSolution::new(pull, command, &SimdMat3::of(moment).with(zeros)).balance(pull, command)
    }
}

impl Pull<'_> {
    /// Solves the balance and the law of contraction; `moment` is M [N m].
    pub fn balance(&self, command: &ContractionCommand, moment: &Mat3) -> ContractileBalance {
        dispatch_f64x4(Balance { pull: self, command, moment })
    }
}

/// V g φ(F) \[J\].
pub fn energy(body: &AffineBody, at: &Decomposition) -> f64 {
    let density = body.material.as_ref().map_or(0.0, |material| material.response(&at.elastic).energy);
    body.volume * at.volume_ratio * density
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::affine::Viscosity;
    use crate::material::{Material, MooneyRivlin};
    use crate::shape::{Cuboid, Shape};
    use crate::simd::in_memory;
    use crate::tensor::Vec3;

    /// All columns of the derivative, in memory.
    struct Derivative<'a, 'b>(&'b Pull<'a>, &'b ContractionCommand);

    impl WithF64x4 for Derivative<'_, '_> {
        type Output = Vec<[f64; 54]>;

        // Loops: what iterators call is not compiled for the instruction set.
        #[inline(always)]
        fn run<F: F64x4>(self, zeros: F) -> Self::Output {
            let slopes = self.0.slopes_in(zeros, self.1, &Mat3::identity());
            let (mut numbers, mut written) = ([0.0; 54], Vec::new());
            for b in 0..3 {
                for along in [slopes.along_gradient(b), slopes.along_rate(b), slopes.along_contraction(b)] {
                    along.write(&mut numbers, 18, true);
                    written.push(numbers);
                }
            }
            written
        }
    }

    #[test]
    fn registers_of_every_width_give_the_same_bytes() {
        let entries = |seed: f64| Mat3::from_fn(|i, j| (seed + 2.1 * i as f64 + 0.8 * (j * j) as f64).sin());
        let mass = Shape::Box(Cuboid { size: Vec3::new(0.8, 1.0, 0.6) }).mass_properties(0.8);
        for (bulk, viscosity) in
            [None, Some(7.0)].into_iter().flat_map(|bulk| [0.0, 0.6].map(|viscosity| (bulk, viscosity)))
        {
            let material = Material::MooneyRivlin(MooneyRivlin { c1: 2.0, c2: 1.0, bulk });
            let viscosity = Viscosity { kirchhoff: viscosity, shear: 0.1, bulk: 0.2 };
            let body = AffineBody::new(&mass, None, Some(material), viscosity).unwrap();
            let source = ContractionSource::Driven { drive: Signal::Constant(entries(0.3)), feedback: Vec::new() };
            let contraction = Contraction { viscosity: 0.8, kept_volume: None, spin: Spin::Full, source };
            let at = Gyration::of(&(Mat3::identity() + 0.2 * entries(0.1)), &entries(1.3)).unwrap();
            let decomposition = Decomposition::of(&at.gradient, &(Mat3::identity() + 0.1 * entries(2.2))).unwrap();
            let pull = Pull { body: &body, contraction: &contraction, at: &at, decomposition: &decomposition };
            let command = ContractionCommand::Drive(entries(0.3));
            let moment = entries(0.9);
            let balance = || Balance { pull: &pull, command: &command, moment: &moment };
            assert_eq!(dispatch_f64x4(balance()), in_memory(balance()));
            let wide = dispatch_f64x4(Derivative(&pull, &command));
            assert_eq!(wide, in_memory(Derivative(&pull, &command)));
            assert_eq!(wide.len(), 9);
        }
    }
}
