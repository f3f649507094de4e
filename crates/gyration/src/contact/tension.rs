//! What makes tractions per deformed area derive from a potential.
//!
//! The potential ∫U(d) k dA, k = |cof(P) N|, changes with the gap, which gives the traction −U′k n, and with the area:
//!
//!   δk = k (I − m⊗m)·H,   H = δP P⁻¹,   M ← M − T P⁻ᵀ,   T = ∫U k (I − m⊗m) dA
//!
//! with the current unit normal m: a surface tension U(d). Since δm = −(I − m⊗m)Hᵀm, T itself changes by
//!
//!   ∫U k [tr H (I − m⊗m) − (m·Hm)(I + m⊗m) + Hᵀm⊗m + m⊗Hᵀm] dA
//!
//! Only central laws have a potential (`potential`). Source: `docs/theory-affine.md`.

use super::law_set::{ContactScratch, LawSet};
use super::meeting::{Deformation, Meeting};
use super::{AreaMeasure, LawKind};
use crate::surface::{GapClosed, OrientedMoments};
use crate::tensor::Mat3;

/// The potential of the central laws of a contact over the surface of a body [J], in the measure of the contact.
///
/// ∫U(d) dA, per deformed area ∫U(d) k dA; of the measure `deformed_area` this is a number, not a potential.
///
/// # Errors
/// [`GapClosed`] if a point of the surface lies on or behind the plane.
pub fn contact_potential(laws: &LawSet, meeting: &Meeting, scratch: &mut ContactScratch) -> Result<f64, GapClosed> {
    let plan = laws.potentials();
    let moments = scratch.take(plan.requests().len());
    meeting.moments(laws, plan, moments)?;
    Ok(laws.potential_terms().iter().map(|part| part.coefficient * moments[part.request].zeroth).sum())
}

/// T of each law.
pub(super) struct Tension<'a> {
    deformation: &'a Deformation,
    by_law: [Mat3; LawKind::COUNT],
}

/// T and its derivative by H.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TensionSlopes {
    pub total: Mat3,
    /// By H_jl, at 3j + l.
    pub by_stretch: [Mat3; 9],
}

/// The pairs of components in the order of [`OrientedMoments`]: 3j + l → place.
pub(super) const PAIR: [usize; 9] = [0, 1, 2, 1, 3, 4, 2, 4, 5];

impl<'a> Tension<'a> {
    /// T of a contact, if its measure has one.
    pub fn integrate(
        laws: &LawSet,
        meeting: &'a Meeting,
        scratch: &mut ContactScratch,
    ) -> Result<Option<Self>, GapClosed> {
        let Some((deformation, moments)) = oriented(laws, meeting, scratch)? else { return Ok(None) };
        let mut by_law = [Mat3::zeros(); LawKind::COUNT];
        for part in laws.potential_terms() {
            by_law[part.kind as usize] += part.coefficient * tension(&moments[part.request]);
        }
        Ok(Some(Self { deformation, by_law }))
    }

    /// −T P⁻ᵀ, what it adds to the moment of a law.
    pub fn moment(&self, kind: LawKind) -> Mat3 {
        -(self.by_law[kind as usize] * self.deformation.inverse.transpose())
    }
}

impl TensionSlopes {
    /// T of all laws and its derivative, if the measure of the contact has one.
    pub fn integrate(
        laws: &LawSet,
        meeting: &Meeting,
        scratch: &mut ContactScratch,
    ) -> Result<Option<Self>, GapClosed> {
        let Some((_, moments)) = oriented(laws, meeting, scratch)? else { return Ok(None) };
        let mut this = Self::default();
        for part in laws.potential_terms() {
            this.add_scaled(part.coefficient, &moments[part.request]);
        }
        Ok(Some(this))
    }

    /// Adds what a kernel with this coefficient brings, from its moments of order 0.
    pub fn add_scaled(&mut self, coefficient: f64, oriented: &OrientedMoments) {
        let n = normals(oriented);
        self.total += coefficient * across(&n);
        for (place, slope) in self.by_stretch.iter_mut().enumerate() {
            *slope += coefficient * slope_of(&n, oriented, place / 3, place % 3);
        }
    }
}

/// The moments of the potentials, weighted with normals; none in other measures than that of the potential.
fn oriented<'a, 'b>(
    laws: &LawSet,
    meeting: &'a Meeting,
    scratch: &'b mut ContactScratch,
) -> Result<Option<(&'a Deformation, &'b [OrientedMoments])>, GapClosed> {
    let Some(deformation) = &meeting.deformation else { return Ok(None) };
    if laws.measure != AreaMeasure::DeformedAreaPotential || laws.potential_terms().is_empty() {
        return Ok(None);
    }
    let plan = laws.potentials();
    let moments = scratch.take_oriented(plan.requests().len());
    meeting.surface.oriented_moments(&meeting.field, &deformation.cofactor, plan, moments)?;
    Ok(Some((deformation, moments)))
}

/// ∫κ k m⊗m dA.
fn normals(oriented: &OrientedMoments) -> Mat3 {
    symmetric(&oriented.pairs.each_ref().map(|moments| moments.zeroth))
}

/// ∫κ k (I − m⊗m) dA of a kernel.
pub(crate) fn tension(oriented: &OrientedMoments) -> Mat3 {
    across(&normals(oriented))
}

/// From the components xx, xy, xz, yy, yz, zz.
pub(crate) fn symmetric([xx, xy, xz, yy, yz, zz]: &[f64; 6]) -> Mat3 {
    Mat3::new(*xx, *xy, *xz, *xy, *yy, *yz, *xz, *yz, *zz)
}

/// ∫κ k (I − m⊗m) dA from ∫κ k m⊗m dA.
pub(crate) fn across(n: &Mat3) -> Mat3 {
    Mat3::from_diagonal_element(n.trace()) - n
}

/// The derivative of ∫κ k (I − m⊗m) dA by H_jl.
fn slope_of(n: &Mat3, oriented: &OrientedMoments, j: usize, l: usize) -> Mat3 {
    let mut slope = -fourth(oriented, j, l) - Mat3::from_diagonal_element(n[(j, l)]);
    if j == l {
        slope += across(n);
    }
    for a in 0..3 {
        slope[(l, a)] += n[(j, a)];
        slope[(a, l)] += n[(j, a)];
    }
    slope
}

/// ∫κ k m_j m_l m⊗m dA.
fn fourth(oriented: &OrientedMoments, j: usize, l: usize) -> Mat3 {
    Mat3::from_fn(|a, b| {
        let mut axes = [j, l, a, b];
        axes.sort_unstable();
        oriented.fourth[fourth_place(axes)]
    })
}

/// The place of m_a m_b m_c m_d, a ≤ b ≤ c ≤ d, among xxxx, xxxy, xxxz, xxyy, …, zzzz: by how many are not x, then z.
fn fourth_place(axes: [usize; 4]) -> usize {
    let beyond = axes.iter().filter(|axis| **axis > 0).count();
    let last = axes.iter().filter(|axis| **axis == 2).count();
    beyond * (beyond + 1) / 2 + last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fourth_products_stand_in_the_order_of_the_alphabet() {
        let mut places = Vec::new();
        for a in 0..3 {
            for b in a..3 {
                for c in b..3 {
                    places.extend((c..3).map(|d| fourth_place([a, b, c, d])));
                }
            }
        }
        assert_eq!(places, (0..15).collect::<Vec<_>>());
    }
}
