//! Energies that are functions of ι₁, ι₂ and J.
//!
//!   ∂ι₁/∂P = 2P,   ∂ι₂/∂P = 2(ι₁P − PC),   ∂J/∂P = cof P
//!   S = 2(f₁ + ι₁f₂) P − 2f₂ PC + f₃ cof P
//!
//! f_k are the derivatives of the energy. cof P is quadratic in P: neither S nor its derivative needs an inverse.

use super::Material;
use crate::simd::{F64x4, SimdMat3, UNIT};

/// ι₁, ι₂ and J of a gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Invariants {
    /// ι₁ = tr C.
    pub first: f64,
    /// ι₂ = ½(tr²C − tr C²).
    pub second: f64,
    /// J = det P.
    pub volume: f64,
    /// ι₁ − 3 and ι₂ − 3, from C − I: near rest they are small, and nothing of them is lost.
    pub excess: [f64; 2],
}

impl Invariants {
    /// Those of C, or of B = PPᵀ, which has the same, and of det P.
    #[inline(always)]
    pub fn of<F: F64x4>(squares: &SimdMat3<F>, volume: f64) -> Self {
        let (x, y, z) = (squares.at(0, 0) - 1.0, squares.at(1, 1) - 1.0, squares.at(2, 2) - 1.0);
        let (xy, yz, zx) = (squares.at(0, 1), squares.at(1, 2), squares.at(2, 0));
        let minors = x * y - xy * xy + y * z - yz * yz + z * x - zx * zx;
        let trace = (x + y) + z;
        let excess = [trace, 2.0 * trace + minors];
        Self { first: 3.0 + excess[0], second: 3.0 + excess[1], volume, excess }
    }
}

/// φ and its derivatives with ι₁, ι₂, J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Derivatives {
    /// φ [J/m³].
    pub energy: f64,
    /// f₁, f₂, f₃.
    pub first: [f64; 3],
    /// f₁₁, f₁₂, f₁₃, f₂₂, f₂₃, f₃₃.
    pub second: [f64; 6],
}

/// An energy at a gradient, with all that stress and tangent need.
///
/// With G₁ = 2P, G₂ = 2(ι₁P − PC), G₃ = cof P, the derivatives of ι₁, ι₂, J, and the derivatives of these,
///
///   ∂S_iA/∂P_jB = δ_ij (2(f₁ + ι₁f₂) δ_AB − 2f₂ C_AB) − 2f₂ (P_iB P_jA + (PPᵀ)_ij δ_AB) + f₂ (G₁ ⊗ G₁)_iAjB
///                 + f₃ ε_ijk ε_ABC P_kC + Σ f_kl (G_k ⊗ G_l)_iAjB
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ByInvariants<F = [f64; 4]> {
    pub derivatives: Derivatives,
    pub p: SimdMat3<F>,
    /// G₂.
    pub second: SimdMat3<F>,
    /// cof P.
    pub cofactor: SimdMat3<F>,
    /// 2(f₁ + ι₁f₂) I − 2f₂ C.
    pub own: SimdMat3<F>,
    /// 2f₂ PPᵀ.
    pub left: SimdMat3<F>,
}

impl<F: F64x4> ByInvariants<F> {
    #[inline(always)]
    pub fn new(p: &SimdMat3<F>, material: &Material) -> Self {
        let (right, cofactor) = (p.transpose().times(p), p.cofactor());
        let invariants = Invariants::of(&right, p.0[0].dot(&cofactor.0[0]));
        let derivatives = material.derivatives(&invariants);
        let [f1, f2, _] = derivatives.first;
        let own = (right * (-2.0 * f2)).plus_unit(2.0 * (f1 + invariants.first * f2));
        let second = (*p * invariants.first - p.times(&right)) * 2.0;
        let left = p.times_transposed(p) * (2.0 * f2);
        Self { derivatives, p: *p, second, cofactor, own, left }
    }

    #[inline(always)]
    pub fn energy(&self) -> f64 {
        self.derivatives.energy
    }

    /// S.
    #[inline(always)]
    pub fn stress(&self) -> SimdMat3<F> {
        let [f1, f2, f3] = self.derivatives.first;
        (self.p * (2.0 * f1) + self.second * f2) + self.cofactor * f3
    }
}

impl ByInvariants {
    /// ∂S/∂P_jB.
    #[inline(always)]
    pub fn slope(&self, j: usize, b: usize) -> SimdMat3 {
        let Self { derivatives, p, second, cofactor, own, left } = self;
        let [_, f2, f3] = derivatives.first;
        let [f11, f12, f13, f22, f23, f33] = derivatives.second;
        let (x, y, z) = (2.0 * p.at(j, b), second.at(j, b), cofactor.at(j, b));
        // Of G₁, G₂, G₃; that of G₁ = 2P stands before P.
        let by_first = 2.0 * ((f11 + f2) * x + f12 * y + f13 * z);
        let by_second = f12 * x + f22 * y + f23 * z;
        let by_volume = f13 * x + f23 * y + f33 * z;
        let mut slope = (*p * by_first + *second * by_second) + *cofactor * by_volume;
        for a in 0..3 {
            slope.0[a] += UNIT[j] * own.at(a, b) - p.0[b] * (2.0 * f2 * p.at(j, a));
        }
        slope.0[b] = slope.0[b] - left.0[j];
        if f3 != 0.0 {
            // ε_ijk P_kC = (e_j × P_C)_i.
            let (next, last) = ((b + 1) % 3, (b + 2) % 3);
            slope.0[next] += UNIT[j].cross(&p.0[last]) * -f3;
            slope.0[last] += UNIT[j].cross(&p.0[next]) * f3;
        }
        slope
    }
}

/// φ and S Pᵀ = 2(f₁ + ι₁f₂) B − 2f₂ B² + J f₃ I, B = PPᵀ: symmetric to the last bit, since all of it is.
#[inline(always)]
pub(super) fn energy_and_kirchhoff_stress<F: F64x4>(
    p: &SimdMat3<F>,
    volume: f64,
    material: &Material,
) -> (f64, SimdMat3<F>) {
    let left = p.times_transposed(p);
    let invariants = Invariants::of(&left, volume);
    let Derivatives { energy, first: [f1, f2, f3], .. } = material.derivatives(&invariants);
    let mut stress = (left * (2.0 * (f1 + invariants.first * f2))).plus_unit(volume * f3);
    if f2 != 0.0 {
        stress = stress - left.times(&left) * (2.0 * f2);
    }
    (energy, stress)
}
