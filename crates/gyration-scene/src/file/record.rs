//! `[record]`: further quantities that a recording shall hold.

use crate::quantity::Length;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a recording shall hold besides: further quantities of each body, what acts between two.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Record {
    /// Which quantities.
    pub quantities: Vec<Recorded>,
    /// The point about which total affine momentum and moment are taken (m).
    pub origin: [Length; 3],
    /// Whether to record, for each sample, what acts between two: contacts, springs, bonds.
    #[serde(skip_serializing_if = "is_left_out")]
    pub pairs: bool,
}

/// A resolved scene that does not ask for pairs is what it was without the key.
fn is_left_out(asked: &bool) -> bool {
    !asked
}

/// A quantity that is recorded on request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Recorded {
    /// L = Ṗ P⁻¹ (1/s).
    VelocityGradient,
    /// Affine momentum about the origin, P J Ṗᵀ + (p₀ − o) ⊗ m ṗ₀ (kg m²/s).
    AffineMomentumTotal,
    /// N = P Mᵀ, the affine moment of the loads (N m).
    AffineMoment,
    /// tr(N L), the power of the affine moment (W).
    MomentPower,
    /// Co-moving affine momentum P⁻¹ K P⁻ᵀ, K = P J Ṗᵀ (kg m²/s).
    ComovingMomentum,
    /// What dK/dt = Ṗ J Ṗᵀ + N − V (S Pᵀ)ᵀ leaves over (N m).
    MomentumResidual,
    /// The principal stretches, singular values of P.
    PrincipalStretches,
    /// The rotation R of P = R U.
    Rotation,
    /// Angular velocity of L of P = L D Rᵀ, the frame of the principal axes in space (rad/s).
    Spin,
    /// Angular velocity of R of P = L D Rᵀ, the frame of the principal axes in the reference placement (rad/s).
    Vorticity,
    /// The Cauchy stress S Pᵀ/det P (Pa).
    CauchyStress,
    /// The first Piola stress S (Pa).
    Stress,
    /// Σ f·n over the contacts, n the normal of each (N).
    NormalForce,
    /// Σ |f − (f·n) n| over the contacts (N).
    TangentialForce,
    /// The force of all other bodies that it meets (N).
    PairForce,
    /// p₀ less that of the scene at rest (m).
    Displacement,
    /// The force of `keep` on the centre of mass (N).
    ConstraintForce,
    /// N = P Mᵀ, the affine moment of `keep` (N m).
    ConstraintMoment,
    /// f, the force of all loads but the weight and the reaction of a pin (N).
    ForceTotal,
    /// M, the affine moment of the same loads about the centre of mass or the pin (N m).
    MomentTotal,
    /// f of supports, other bodies, springs, fluid, friction and what else is loaded on the body, each apart (N).
    ForceByKind,
    /// M of the same kinds, each apart (N m).
    MomentByKind,
    /// Affine moment about the origin, N + (p₀ − o) ⊗ f (N m).
    AffineMomentTotal,
    /// D, the affine moment of internal and of linear friction (N m).
    FrictionMoment,
    /// Ṗ J Ṗᵀ, twice the derivative of the kinetic energy by the metric (J).
    KineticTensor,
    /// Ṗ J, the momentum conjugate to P (kg m²/s).
    CanonicalMomentum,
    /// ½ m|ṗ₀|² of the centre of mass and ½ tr(Ṗ J Ṗᵀ) about it, each apart (J).
    KineticEnergy,
    /// F = P G⁻¹.
    ElasticGradient,
    /// The elastic part S_e of the first Piola stress, without pressure and friction (Pa).
    ElasticStress,
    /// Eshelby's stress A = Fᵀ S Gᵀ − det G φ I, which drives the contraction (Pa).
    Eshelby,
    /// ∫ f dt of the contacts of the body over the interval that ends with the sample (N s).
    Impulse,
    /// The largest |f| of the contacts of the body within that interval (N).
    PeakForce,
}
