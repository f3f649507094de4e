//! `[record]`: further quantities that a recording shall hold.

use crate::quantity::Length;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Further quantities that a recording shall hold, of each body.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Record {
    /// Which quantities.
    pub quantities: Vec<Recorded>,
    /// The point about which total affine momentum is taken (m).
    pub origin: [Length; 3],
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
}
