//! What makes tractions per deformed area derive from the potential of a pair.
//!
//! U_i = ∫U(d) k dA also changes with the area factor k, the plane kept; where U is least it is stationary in the
//! plane, so that this alone is added to what the gaps bring (`contact/tension`):
//!
//!   M_i ← M_i − λ_i T_i P⁻ᵀ,   T_i = ∫U(d) k (I − m⊗m) dA
//!   δ(T P⁻ᵀ) = (δT − T Hᵀ) P⁻ᵀ,   δT = −∫α(d/d₀)^−ν (X̃·δz) k (I − m⊗m) dA + ∂T/∂H·H
//!
//! T is symmetric, so that a tension turns nobody. Source: `docs/theory-meetings.md`.

use super::areas::{AreaMoments, AreaPotentials};
use super::laws::PairLaws;
use super::plane::Plane;
use super::side::{Half, columns};
use super::{Mat34, Vec4};
use crate::contact::{TensionSlopes, across, symmetric, tension};
use crate::surface::GapClosed;
use crate::tensor::{Mat3, Vec3};

/// The tension of both sides at a plane, as their moment before it is weighted: (0 | −T P⁻ᵀ); none of a side without.
pub(super) type Tensions = [Option<Mat34>; 2];

/// T of a side, and how it changes.
pub(super) struct TensionChange {
    own: TensionSlopes,
    /// ∫α(d/d₀)^−ν k m_a m_b X̃ dA.
    by_gap: [Vec4; 6],
}

/// What T of U(d) is of T of d^(1−ν).
fn factor(laws: &PairLaws) -> f64 {
    laws.coefficient / (laws.repulsion.exponent - 1.0)
}

/// (0 | M).
fn moment(moment: &Mat3) -> Mat34 {
    columns(&Vec3::zeros(), moment)
}

/// The tension of both sides.
///
/// # Errors
/// [`GapClosed`] if the plane does not separate the bodies.
pub(super) fn tensions(
    laws: &PairLaws,
    halves: [&Half; 2],
    plane: &Plane,
    room: &mut AreaMoments,
) -> Result<Tensions, GapClosed> {
    let Some(plan) = &laws.tightening else { return Ok([None, None]) };
    let found = room.find(halves, plane, plan)?;
    Ok([0, 1].map(|side| {
        let total = factor(laws) * tension(found.oriented(side, 0)?);
        Some(moment(&-(total * halves[side].side.inverse.transpose())))
    }))
}

impl TensionChange {
    /// Of both sides, from the moments of what places the plane and the potentials made of them.
    pub fn of_placing(laws: &PairLaws, found: &AreaMoments, placing: &AreaPotentials) -> [Option<Self>; 2] {
        [0, 1].map(|side| {
            laws.tightening.as_ref()?;
            let (oriented, potentials) = (found.oriented(side, 0)?, placing[side].as_ref()?);
            let mut own = TensionSlopes::default();
            own.add_scaled(factor(laws), oriented);
            Some(Self { own, by_gap: potentials.each_ref().map(|potential| potential.first) })
        })
    }

    /// The change of (0 | −T P⁻ᵀ) of a side.
    pub fn along(&self, half: &Half, place: &Mat34, heights: &Vec4) -> Mat34 {
        let h: Mat3 = place.fixed_columns::<3>(1) * half.side.inverse;
        let mut change = -across(&symmetric(&self.by_gap.each_ref().map(|first| first.dot(heights))));
        for (slope, (j, l)) in self.own.by_stretch.iter().zip((0..9).map(|place| (place / 3, place % 3))) {
            change += h[(j, l)] * slope;
        }
        moment(&((self.own.total * h.transpose() - change) * half.side.inverse.transpose()))
    }
}
