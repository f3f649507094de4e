//! What a controller applies to a body by hand: a force, an affine moment and a torque, held until they are changed.
//!
//!   f = F,   M = M_a + ½ [τ]× P⁻ᵀ,   power F·ṗ₀ + M·Ṗ
//!
//! F [N] and τ [N m] are constant in space and about the centre of mass, the entries of M_a [N m] are constant, the
//! first index spatial, the second material: a force F at a material point X is F with M_a = F ⊗ X. On a rigid body M
//! acts by its torque axial(RᵀM) in the body's axes, to which τ adds Rᵀτ. Nothing of this has a potential in the
//! ledger: its work is `work.load`.

use super::Loads;
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// Force, affine moment and torque that are held constant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Applied {
    /// F [N].
    pub force: Vec3,
    /// M_a [N m].
    pub moment: Mat3,
    /// τ [N m].
    pub torque: Vec3,
}

impl Applied {
    /// A force at a material point X (from the centre of mass).
    pub fn at_point(force: Vec3, point: &Vec3) -> Self {
        Self { force, moment: force * point.transpose(), torque: Vec3::zeros() }
    }

    /// Whether all its numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.force.iter().chain(&self.moment).chain(&self.torque).all(|number| number.is_finite())
    }

    /// What of M turns with the body, ½ [τ]× P⁻ᵀ; P⁻¹ is given.
    pub fn couple(&self, inverse: &Mat3) -> Mat3 {
        0.5 * cross_matrix(&self.torque) * inverse.transpose()
    }

    /// f and M; P⁻¹ is given.
    pub fn loads(&self, inverse: &Mat3) -> Loads {
        Loads { force: self.force, moment: self.moment + self.couple(inverse) }
    }
}
