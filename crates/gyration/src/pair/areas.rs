//! How what the surface of a side brings changes with its area factor, per deformed area.
//!
//!   δk = k (tr H − m·H m) = k Σ (δ_jl − m_j m_l) H_jl,   H = δP P⁻¹
//!
//! m is the current normal. So a moment changes by six others, weighted with the products of the components of m, which
//! `stretch` combines for a δP. Source: `docs/theory-affine.md`, contact per deformed area.

use super::Mat34;
use super::laws::PairLaws;
use super::plane::Plane;
use super::pull::Pull;
use super::side::{Half, Potential};
use super::{Mat4, side::joined};
use crate::surface::{GapClosed, MomentPlan, Moments, OrientedMoments};
use crate::tensor::Mat3;

/// The weights of the moments with xx, xy, xz, yy, yz, zz in the change of those of a side.
pub(super) type Stretch = [f64; 6];

/// The potentials of both sides, with each product of the components of m; none of a side whose areas do not change.
pub(super) type AreaPotentials = [Option<[Potential; 6]>; 2];

/// Moments of both sides, with each product of the components of m; empty of a side whose areas do not change.
#[derive(Debug, Clone, Default)]
pub(super) struct AreaMoments {
    sides: [Vec<OrientedMoments>; 2],
}

/// The weights of a side for a change of (p₀ | P); none if its areas do not change.
pub(super) fn stretch(half: &Half, place: &Mat34) -> Option<Stretch> {
    half.cofactor?;
    let h: Mat3 = place.fixed_columns::<3>(1) * half.side.inverse;
    let trace = h.trace();
    Some([trace - h.m11, -(h.m12 + h.m21), -(h.m13 + h.m31), trace - h.m22, -(h.m23 + h.m32), trace - h.m33])
}

/// The change of potentials.
pub(super) fn potentials_along(of: &AreaPotentials, stretch: &[Option<Stretch>; 2]) -> Option<[Potential; 2]> {
    let along = |side: usize| {
        let (own, weights) = (of[side].as_ref()?, stretch[side].as_ref()?);
        let mut sum = Potential::ZERO;
        own.iter().zip(weights).for_each(|(potential, weight)| sum.add_scaled(*weight, potential));
        Some(sum)
    };
    match [along(0), along(1)] {
        [None, None] => None,
        found => Some(found.map(|potential| potential.unwrap_or(Potential::ZERO))),
    }
}

impl AreaMoments {
    /// Integrates the moments of a plan where areas change.
    ///
    /// # Errors
    /// [`GapClosed`] if the plane does not separate the bodies.
    pub fn find(&mut self, halves: [&Half; 2], plane: &Plane, plan: &MomentPlan) -> Result<&Self, GapClosed> {
        for (room, half) in self.sides.iter_mut().zip(halves) {
            let count = if half.cofactor.is_some() { plan.requests().len() } else { 0 };
            room.resize(count, OrientedMoments::default());
            half.oriented_moments(plane, plan, room)?;
        }
        Ok(self)
    }

    /// Those of one request of a side.
    fn of(&self, side: usize, place: usize) -> Option<&[Moments; 6]> {
        self.sides[side].get(place).map(|moments| &moments.pairs)
    }

    /// All of one request of a side; none of a side whose areas do not change.
    pub fn oriented(&self, side: usize, place: usize) -> Option<&OrientedMoments> {
        self.sides[side].get(place)
    }

    /// ∫κ X̃⊗X̃ dA of a request of a side, κ with this coefficient.
    pub fn joined(&self, side: usize, place: usize, coefficient: f64) -> Option<[Mat4; 6]> {
        let of = |moments: &Moments| coefficient * joined(moments.zeroth, &moments.first, &moments.second);
        self.of(side, place).map(|pairs| pairs.each_ref().map(of))
    }

    /// The potentials of c d^−ν, whose three powers stand at these places.
    fn potentials(&self, coefficient: f64, exponent: f64, places: [usize; 3]) -> AreaPotentials {
        [0, 1].map(|side| {
            let [energy, force, stiffness] = places.map(|place| self.of(side, place));
            let (energy, force, stiffness) = (energy?, force?, stiffness?);
            let of = |k: usize| Potential::new(coefficient, exponent, [&energy[k], &force[k], &stiffness[k]]);
            Some(std::array::from_fn(of))
        })
    }

    /// Those of what places the plane.
    ///
    /// # Errors
    /// [`GapClosed`] if the plane does not separate the bodies.
    pub fn placing(&mut self, laws: &PairLaws, halves: [&Half; 2], plane: &Plane) -> Result<AreaPotentials, GapClosed> {
        self.find(halves, plane, &laws.placing)?;
        Ok(self.potentials(laws.coefficient, laws.repulsion.exponent, [0, 1, 2]))
    }

    /// Those of the powers of an adhesion.
    ///
    /// # Errors
    /// [`GapClosed`] if the plane does not separate the bodies.
    pub fn pulling(
        &mut self,
        pull: &Pull,
        halves: [&Half; 2],
        plane: &Plane,
    ) -> Result<[AreaPotentials; 2], GapClosed> {
        self.find(halves, plane, &pull.values)?;
        Ok(pull.terms.map(|term| match term {
            Some(term) => self.potentials(term.coefficient(), term.exponent, term.places),
            None => [None, None],
        }))
    }
}
