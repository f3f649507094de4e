//! Energies that are functions of ι₁, ι₂ and J.
//!
//!   ∂ι₁/∂P = 2P,   ∂ι₂/∂P = 2(ι₁P − PC),   ∂J/∂P = cof P
//!   S = 2(f₁ + ι₁f₂) P − 2f₂ PC + f₃ cof P
//!
//! f_k are the derivatives of the energy. cof P is quadratic in P: neither S nor its derivative needs an inverse.

use crate::tensor::{Mat3, cofactor, cofactor_change};

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

    /// dS, with df_k = f_kl dι_l.
    pub fn tangent(&self, dp: &Mat3) -> Mat3 {
        let Self { p, invariants, derivatives, pc, cofactor } = self;
        let [f1, f2, f3] = derivatives.first;
        let d1 = 2.0 * p.dot(dp);
        let d2 = 2.0 * (invariants.first * p.dot(dp) - pc.dot(dp));
        let d3 = cofactor.dot(dp);
        let [f11, f12, f13, f22, f23, f33] = derivatives.second;
        let changes = [f11 * d1 + f12 * d2 + f13 * d3, f12 * d1 + f22 * d2 + f23 * d3, f13 * d1 + f23 * d2 + f33 * d3];
        let half = p.tr_mul(dp);
        // d(PC) = dP C + P (dPᵀP + PᵀdP).
        let d_pc = dp * invariants.right + p * (half + half.transpose());
        let fixed = 2.0 * (f1 + invariants.first * f2) * dp + (2.0 * f2 * d1) * p - 2.0 * f2 * d_pc;
        fixed + f3 * cofactor_change(p, dp) + self.combination(&changes)
    }
}
