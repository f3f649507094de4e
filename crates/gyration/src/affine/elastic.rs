//! The elastic part of the derivative of the balance, −V δS_e J⁻¹, for an energy of the invariants.
//!
//! With G₁ = 2P, G₂ = 2(ι₁P − PC), G₃ = cof P = J P⁻ᵀ the derivatives of the invariants, and B = PPᵀ,
//!
//!   δS_e = δP (2(f₁ + ι₁f₂) I − 2f₂C) − 2f₂ (B δP + P δPᵀ P) + P (4(f₁₁ + f₂) P·δP)
//!          + Σ' f_kl G_k (G_l·δP) + f₃/J G₃ (G₃·δP) − f₃J P⁻ᵀ δPᵀ P⁻ᵀ
//!
//! where the sum is without k = l = 1. The last term is what a pressure −f₃J would do, and is left to `slopes`.

use super::mobility::Mobility;
use super::terms::Entry;
use crate::material::ByInvariants;
use crate::simd::{F64x4, SimdMat3, UNIT};

/// −V δS_e J⁻¹, but for what acts as a pressure.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Elastic {
    /// P.
    gradient: SimdMat3,
    /// 2f₂V P J⁻¹.
    crossed: SimdMat3,
    /// 2f₂V B and J⁻¹.
    left: SimdMat3,
    inverse: SimdMat3,
    /// −V (2(f₁ + ι₁f₂) I − 2f₂C) J⁻¹.
    own: SimdMat3,
    /// −4V (f₁₁ + f₂) P J⁻¹.
    along: SimdMat3,
    /// G_k J⁻¹ and −V Σ f_kl G_l, without f₁₁ and with f₃/J.
    other: Option<[(SimdMat3, SimdMat3); 3]>,
}

impl Elastic {
    #[inline(always)]
    pub fn fill<F: F64x4>(&mut self, volume: f64, (mobility, inverse): (&Mobility, &SimdMat3), at: &ByInvariants<F>) {
        let ByInvariants { derivatives, p, own, left, .. } = at;
        let ([_, f2, _], f11) = (derivatives.first, derivatives.second[0]);
        let along = mobility.of_moment(p);
        self.gradient = p.kept();
        self.crossed = (along * (2.0 * f2 * volume)).kept();
        self.along = (along * (-4.0 * volume * (f11 + f2))).kept();
        self.left = (*left * volume).kept();
        self.inverse = *inverse;
        self.own = (mobility.of_moment(own) * -volume).kept();
        if derivatives.first[2] != 0.0 || derivatives.second[1..] != [0.0; 5] {
            self.other = Some(other(volume, mobility, at));
        }
    }

    /// Of one entry of δP.
    #[inline(always)]
    pub fn image<F: F64x4>(&self, entry: Entry, registers: F) -> SimdMat3<F> {
        let Self { gradient, crossed, left, inverse, own, along, other } = self;
        let mut image = entry.crossed(gradient, crossed, registers) + entry.straight(left, inverse, registers);
        image += entry.straight(&SimdMat3(UNIT), own, registers);
        image += entry.whole(along, gradient, registers);
        if let Some(other) = other {
            for (way, weight) in other {
                image += entry.whole(way, weight, registers);
            }
        }
        image
    }
}

/// The terms of the second derivatives but f₁₁, and that of f₃/J.
#[inline(always)]
fn other<F: F64x4>(volume: f64, mobility: &Mobility, at: &ByInvariants<F>) -> [(SimdMat3, SimdMat3); 3] {
    let ByInvariants { derivatives, p, second, cofactor, .. } = at;
    let (f3, [_, f12, f13, f22, f23, f33]) = (derivatives.first[2], derivatives.second);
    let first = *p * 2.0;
    let spread = f3 / p.0[0].dot(&cofactor.0[0]);
    let sums = [
        *second * f12 + *cofactor * f13,
        first * f12 + *second * f22 + *cofactor * f23,
        first * f13 + *second * f23 + *cofactor * (f33 + spread),
    ];
    let way = |way: &SimdMat3<F>| mobility.of_moment(way).kept();
    let weight = |sum: SimdMat3<F>| (sum * -volume).kept();
    [(way(&first), weight(sums[0])), (way(second), weight(sums[1])), (way(cofactor), weight(sums[2]))]
}
