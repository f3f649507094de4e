//! From an energy of the isochoric invariants ῑ₁ = J^−⅔ι₁, ῑ₂ = J^−4/3ι₂ and a bulk modulus to one of ι₁, ι₂, J.

use super::invariants::{Derivatives, Invariants};

/// ῑ₁ − 3 and ῑ₂ − 3; without a bulk modulus ι₁ − 3 and ι₂ − 3.
#[inline(always)]
pub(super) fn isochoric_excess(full: &Invariants, bulk: Option<f64>) -> [f64; 2] {
    if bulk.is_none() {
        return full.excess;
    }
    // J^p − 1 without loss near J = 1.
    let log = libm::log(full.volume);
    let grown = [libm::expm1(-2.0 / 3.0 * log), libm::expm1(-4.0 / 3.0 * log)];
    [full.excess[0] + grown[0] * full.first, full.excess[1] + grown[1] * full.second]
}

/// w, its first derivatives w₁, w₂ and its second w₁₁, w₁₂, w₂₂ with ῑ₁, ῑ₂.
pub(super) struct Distortion {
    pub energy: f64,
    pub first: [f64; 2],
    pub second: [f64; 3],
}

/// φ = w(ῑ₁, ῑ₂) + K/2 (J − 1)², by the chain rule; φ = w(ι₁, ι₂) without K.
#[inline(always)]
pub(super) fn with_volume(w: &Distortion, bulk: Option<f64>, full: &Invariants) -> Derivatives {
    let Distortion { energy, first: [w1, w2], second: [w11, w12, w22] } = *w;
    let Some(bulk) = bulk else {
        return Derivatives { energy, first: [w1, w2, 0.0], second: [w11, w12, 0.0, w22, 0.0, 0.0] };
    };
    let j = full.volume;
    let a = libm::pow(j, -2.0 / 3.0);
    let b = a * a;
    // ι₁a′, ι₁a″, ι₂b′, ι₂b″ with a = J^−⅔, b = J^−4/3.
    let (u, du) = (-2.0 / 3.0 * full.first * a / j, 10.0 / 9.0 * full.first * a / (j * j));
    let (v, dv) = (-4.0 / 3.0 * full.second * b / j, 28.0 / 9.0 * full.second * b / (j * j));
    let (da, db) = (-2.0 / 3.0 * a / j, -4.0 / 3.0 * b / j);
    Derivatives {
        energy: energy + 0.5 * bulk * (j - 1.0) * (j - 1.0),
        first: [w1 * a, w2 * b, w1 * u + w2 * v + bulk * (j - 1.0)],
        second: [
            w11 * a * a,
            w12 * a * b,
            w1 * da + a * (w11 * u + w12 * v),
            w22 * b * b,
            w2 * db + b * (w12 * u + w22 * v),
            w1 * du + w2 * dv + w11 * u * u + 2.0 * w12 * u * v + w22 * v * v + bulk,
        ],
    }
}
