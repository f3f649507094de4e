//! Moments per deformed area: the surface of a body whose gradient P is not a rotation.
//!
//! An element N dA of the reference surface becomes cof(P) N dA, cof(P) = det P P⁻ᵀ: the area factor is k = |cof(P) N|
//! and the current unit normal m = cof(P) N/k. Loads per deformed area need the first of these, their derivatives and
//! the stress of a potential per deformed area (δk = k (I − m⊗m)·δP P⁻¹) the others:
//!
//!   ∫ κ k X^⊗n dA,   ∫ κ k m_a m_b X^⊗n dA,   ∫ κ k m_a m_b m_c m_d dA,   κ = κ(g₀ + m_gap·X).
//!
//! The gap field is that of the deformed body, its direction Pᵀn; X stays the material point. Facets need no
//! quadrature: k and m are constant on each. Smooth patches are integrated once for each weight
//! (`curved::rules::weight`).

use super::moments::Moments;

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
