//! Quantities that are recorded on request.

use super::fields::{BodyField, EXTRA_FIELDS};
use gyration::tensor::Vec3;

/// A quantity recorded on request; the numbers are places in the list of fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extra {
    /// L = Ṗ P⁻¹.
    VelocityGradient,
    /// K about an origin.
    AffineMomentumTotal,
    /// N = P Mᵀ.
    AffineMoment,
    /// tr(N L).
    MomentPower,
    /// P⁻¹ K P⁻ᵀ.
    ComovingMomentum,
    /// What the balance of K leaves over.
    MomentumResidual,
    /// The principal stretches.
    PrincipalStretches,
    /// R of P = R U.
    Rotation,
    /// S Pᵀ/det P.
    CauchyStress,
    /// S.
    Stress,
}

/// A set of quantities recorded on request.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Extras {
    asked: [bool; EXTRA_FIELDS.len()],
    /// The point about which total affine momentum is taken [m].
    pub origin: Vec3,
}

impl Extras {
    /// The set of some quantities.
    pub fn new(quantities: impl IntoIterator<Item = Extra>, origin: Vec3) -> Self {
        let mut extras = Self { origin, ..Self::default() };
        for quantity in quantities {
            extras.asked[quantity as usize] = true;
        }
        extras
    }

    /// Whether nothing is asked for.
    pub fn is_empty(&self) -> bool {
        !self.asked.contains(&true)
    }

    pub(super) fn fields(&self) -> impl Iterator<Item = &'static BodyField> + use<> {
        EXTRA_FIELDS.iter().zip(self.asked).filter_map(|(field, asked)| asked.then_some(field))
    }
}
