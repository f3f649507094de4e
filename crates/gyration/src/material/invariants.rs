//! Energies that are functions of ι₁, ι₂ and J.
//!
//!   ∂ι₁/∂P = 2P,   ∂ι₂/∂P = 2(ι₁P − PC),   ∂J/∂P = cof P
//!   S = 2(f₁ + ι₁f₂) P − 2f₂ PC + f₃ cof P
//!
//! f_k are the derivatives of the energy. cof P is quadratic in P: neither S nor its derivative needs an inverse.

use super::Tangent;
use crate::tensor::{Mat3, cofactor};

/// ι₁, ι₂ and J of a gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Invariants {
    /// ι₁ = tr C.
    pub first: f64,
    /// ι₂ = ½(tr²C − tr C²).
    pub second: f64,
    /// J = det P.
    pub volume: f64,
    /// ι₁ − 3 and ι₂ − 3, from C − I: near rest they are small, and nothing of them is lost.
    pub excess: [f64; 2],
    /// C = PᵀP.
    right: Mat3,
}

impl Invariants {
    #[inline(always)]
    pub fn of(p: &Mat3) -> Self {
        let right = p.tr_mul(p);
        let e = right - Mat3::identity();
        let minors = e[(0, 0)] * e[(1, 1)] - e[(0, 1)] * e[(0, 1)] + e[(1, 1)] * e[(2, 2)] - e[(1, 2)] * e[(1, 2)]
            + e[(2, 2)] * e[(0, 0)]
            - e[(2, 0)] * e[(2, 0)];
        let trace = e.trace();
        let excess = [trace, 2.0 * trace + minors];
        Self { first: 3.0 + excess[0], second: 3.0 + excess[1], volume: p.determinant(), excess, right }
    }
}

/// φ and its derivatives with ι₁, ι₂, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Derivatives {
    /// φ [J/m³].
    pub energy: f64,
    /// f₁, f₂, f₃.
    pub first: [f64; 3],
    /// f₁₁, f₁₂, f₁₃, f₂₂, f₂₃, f₃₃.
    pub second: [f64; 6],
}

/// An energy at a gradient, with all that stress and tangent need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ByInvariants {
    p: Mat3,
    invariants: Invariants,
    derivatives: Derivatives,
    /// PC.
    pc: Mat3,
    /// cof P.
    cofactor: Mat3,
}

impl ByInvariants {
    pub fn new(p: &Mat3, invariants: Invariants, derivatives: Derivatives) -> Self {
        Self { p: *p, invariants, derivatives, pc: p * invariants.right, cofactor: cofactor(p) }
    }

    pub fn energy(&self) -> f64 {
        self.derivatives.energy
    }

    /// S.
    pub fn stress(&self) -> Mat3 {
        self.combination(&self.derivatives.first)
    }

    /// g₁ ∂ι₁/∂P + g₂ ∂ι₂/∂P + g₃ ∂J/∂P.
    fn combination(&self, g: &[f64; 3]) -> Mat3 {
        2.0 * (g[0] + self.invariants.first * g[1]) * self.p - 2.0 * g[1] * self.pc + g[2] * self.cofactor
    }

    /// ∂S/∂P. With G₁ = 2P, G₂ = 2(ι₁P − PC), G₃ = cof P, the derivatives of ι₁, ι₂, J, and the derivatives of these,
    ///
    ///   ∂S_iA/∂P_jB = 2(f₁ + ι₁f₂) δ_ij δ_AB − 2f₂ (δ_ij C_AB + P_iB P_jA + (PPᵀ)_ij δ_AB) + f₂ (G₁ ⊗ G₁)_iAjB
    ///                 + f₃ ε_ijk ε_ABC P_kC + Σ f_kl (G_k ⊗ G_l)_iAjB
    pub fn tangent(&self) -> Tangent {
        let Self { p, invariants, derivatives, pc, cofactor } = self;
        let [f1, f2, f3] = derivatives.first;
        let [f11, f12, f13, f22, f23, f33] = derivatives.second;
        let own = 2.0 * (f1 + invariants.first * f2);
        let (left, right) = (2.0 * f2 * p * p.transpose(), 2.0 * f2 * invariants.right);
        let (g1, g2, twice) = (2.0 * p, 2.0 * (invariants.first * p - pc), 2.0 * f2 * p);
        let mut tangent = Tangent::zeros();
        for (place, column) in tangent.as_mut_slice().chunks_exact_mut(9).enumerate() {
            let (j, b) = (place % 3, place / 3);
            let (x, y, z) = (g1[(j, b)], g2[(j, b)], cofactor[(j, b)]);
            let by = [(f11 + f2) * x + f12 * y + f13 * z, f12 * x + f22 * y + f23 * z, f13 * x + f23 * y + f33 * z];
            for row in 0..9 {
                let (i, a) = (row % 3, row / 3);
                column[row] = (by[0] * g1[row] + by[1] * g2[row] + by[2] * cofactor[row]) - twice[(i, b)] * p[(j, a)];
            }
            for k in 0..3 {
                column[3 * k + j] -= right[(k, b)];
                column[3 * b + k] -= left[(k, j)];
            }
            column[place] += own;
            // ε_ijk ε_ABC P_kC has four terms for each (j, B): those of the other indices.
            for (s, t) in [(1, 2), (2, 1)] {
                let (i, k) = ((j + s) % 3, (j + t) % 3);
                let (a, c) = ((b + s) % 3, (b + t) % 3);
                column[3 * a + i] += f3 * p[(k, c)];
                column[3 * c + i] -= f3 * p[(k, a)];
            }
        }
        tangent
    }
}

/// S for the derivatives of an energy: what [`ByInvariants::stress`] gives, without what only the tangent needs.
#[inline(always)]
pub(super) fn stress(p: &Mat3, derivatives: impl Fn(&Invariants) -> Derivatives) -> Mat3 {
    let invariants = Invariants::of(p);
    let [f1, f2, f3] = derivatives(&invariants).first;
    let mut stress = 2.0 * (f1 + invariants.first * f2) * p;
    if f2 != 0.0 {
        stress -= 2.0 * f2 * (p * invariants.right);
    }
    if f3 != 0.0 {
        stress += f3 * cofactor(p);
    }
    stress
}
