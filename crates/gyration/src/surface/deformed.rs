//! Moments per deformed area: the surface of a body whose gradient P is not a rotation.
//!
//! An element N dA of the reference surface becomes cof(P) N dA, cof(P) = det P P⁻ᵀ: the area factor is k = |cof(P) N|
//! and the current unit normal m = cof(P) N/k. Loads per deformed area need the first of these, their derivatives and
//! the stress of a potential per deformed area (δk = k (I − m⊗m)·δP P⁻¹) the others:
//!
//!   ∫ κ k X^⊗n dA,   ∫ κ k m_a m_b X^⊗n dA,   ∫ κ k m_a m_b m_c m_d dA,   κ = κ(g₀ + m_gap·X).
//!
//! The gap field is that of the deformed body, its direction Pᵀn; X stays the material point. Facets need no
//! quadrature: k and m are constant on each. Smooth patches are integrated once for each weight (`curved::weight`).

use super::curved::{AREA, GROUP, Weights};
use super::facets_plan::BATCH;
use super::{GapClosed, GapField, MomentPlan, MomentRequest, Moments, Surface};
use crate::tensor::Mat3;

/// The pairs of components in the order of [`OrientedMoments::pairs`]: xx, xy, xz, yy, yz, zz.
pub(super) const PAIRS: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];

/// The quadruples of components in the order of [`OrientedMoments::fourth`].
pub(super) const FOURTH: [[usize; 4]; 15] = [
    [0, 0, 0, 0],
    [0, 0, 0, 1],
    [0, 0, 0, 2],
    [0, 0, 1, 1],
    [0, 0, 1, 2],
    [0, 0, 2, 2],
    [0, 1, 1, 1],
    [0, 1, 1, 2],
    [0, 1, 2, 2],
    [0, 2, 2, 2],
    [1, 1, 1, 1],
    [1, 1, 1, 2],
    [1, 1, 2, 2],
    [1, 2, 2, 2],
    [2, 2, 2, 2],
];

/// Moments of a kernel over a deformed surface, weighted with products of the components of its current normal m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OrientedMoments {
    /// ∫ κ k m_a m_b X^⊗n dA for ab = xx, xy, xz, yy, yz, zz; the sum of xx, yy and zz is ∫ κ k X^⊗n dA.
    pub pairs: [Moments; 6],
    /// ∫ κ k m_a m_b m_c m_d dA for abcd = xxxx, xxxy, xxxz, xxyy, xxyz, xxzz, xyyy, xyyz, xyzz, xzzz, yyyy … zzzz, for
    /// requests of order 0; zero for others.
    pub fourth: [f64; 15],
}

impl Surface {
    /// The moments per deformed area, ∫ κ k X^⊗n dA, of planned requests, about the origin of X; set in the entries of
    /// `out`.
    ///
    /// `cofactor` is cof(P) = det P P⁻ᵀ (3×3), from which k = |cof(P) N|; `field` has the direction Pᵀn. Orders above a
    /// request's are zero. For a rotation these are [`Surface::planned_moments`].
    ///
    /// # Errors
    /// As there.
    pub fn deformed_moments(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        plan: &MomentPlan,
        out: &mut [Moments],
    ) -> Result<(), GapClosed> {
        assert_eq!(plan.requests.len(), out.len(), "one place for each request");
        out.fill(Moments::default());
        for (plan, out) in plan.facets.iter().zip(out.chunks_mut(BATCH)) {
            self.facets.add_deformed(field, cofactor, plan, out)?;
        }
        for patch in &self.patches {
            patch.check_gap(field)?;
            for (requests, out) in plan.requests.chunks(GROUP).zip(out.chunks_mut(GROUP)) {
                let [sums] = patch.weighted(field, cofactor, AREA, requests);
                for ((out, sum), request) in out.iter_mut().zip(&sums).zip(requests) {
                    out.add(sum, request.order);
                }
            }
        }
        Ok(())
    }

    /// The moments per deformed area weighted with m_a m_b and, for requests of order 0, with m_a m_b m_c m_d; m is the
    /// current unit normal.
    ///
    /// Orders up to 2 are meant; a request of order 0 costs its fifteen components of the fourth power. Arguments as
    /// for [`Surface::deformed_moments`].
    ///
    /// # Errors
    /// As there.
    pub fn oriented_moments(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        plan: &MomentPlan,
        out: &mut [OrientedMoments],
    ) -> Result<(), GapClosed> {
        assert_eq!(plan.requests.len(), out.len(), "one place for each request");
        out.fill(OrientedMoments::default());
        for (plan, out) in plan.facets.iter().zip(out.chunks_mut(BATCH)) {
            self.facets.add_oriented(field, cofactor, plan, out)?;
        }
        for patch in &self.patches {
            patch.check_gap(field)?;
            for (requests, out) in plan.requests.chunks(GROUP).zip(out.chunks_mut(GROUP)) {
                patch.add_oriented(field, cofactor, requests, out);
            }
        }
        Ok(())
    }
}

impl super::patch::Patch {
    /// Adds the oriented moments of at most [`GROUP`] requests.
    fn add_oriented(&self, field: &GapField, cofactor: &Mat3, requests: &[MomentRequest], out: &mut [OrientedMoments]) {
        for (pair, sums) in self.weighted(field, cofactor, Weights { factors: PAIRS }, requests).iter().enumerate() {
            for ((out, sum), request) in out.iter_mut().zip(sums).zip(requests) {
                out.pairs[pair].add(sum, request.order);
            }
        }
        // Only requests of order 0 have a fourth power.
        let mut scalars = [MomentRequest { kernel: super::Kernel::Log, order: 0 }; GROUP];
        let mut count = 0;
        for request in requests.iter().filter(|request| request.order == 0) {
            scalars[count] = *request;
            count += 1;
        }
        if count == 0 {
            return;
        }
        let weights = Weights { factors: FOURTH };
        for (place, sums) in self.weighted(field, cofactor, weights, &scalars[..count]).iter().enumerate() {
            let places = out.iter_mut().zip(requests).filter(|(_, request)| request.order == 0);
            for ((out, _), sum) in places.zip(sums) {
                out.fourth[place] += sum.zeroth;
            }
        }
    }
}
