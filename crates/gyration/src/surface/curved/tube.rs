//! The tube of a torus, half-plane by half-plane.
//!
//! In the half-plane at the azimuth φ a point is (ρ, z) = (R + r e_ρ, r e_z), e = (e_ρ, e_z) a unit vector, and dA = r
//! ρ dθ dφ. In the frame of `TiltedGap` odd powers of sin φ cancel, so that the moments follow from S_ij = ∫ κ ρ^i z^j
//! r ρ dθ, i + j ≤ 3, of each half-plane, and these from C_k = ∫ κ cosᵏθ dθ, θ from the side f = (a, b) of the tube
//! that faces the plane: with e = cos θ f + sin θ f⊥ odd powers of sin θ cancel as well.
//!
//! Everything is written once for one half-plane and for as many as a register holds.

use std::ops::{Add, Mul, Sub};

use crate::surface::Moments;
use crate::tensor::{Mat3, SymmetricThird, Vec3};

/// One number, or a register of them.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Mul<f64, Output = Self>
{
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T> + Mul<f64, Output = T>> Number for T {}

/// What half-planes add up to: A₀, x, z, xx, yy, xz, zz, xxx, xyy, xxz, yyz, xzz, zzz.
pub(super) const COMPONENTS: usize = 13;

/// The number of components up to an order.
pub(super) const UP_TO: [usize; 4] = [1, 3, 7, COMPONENTS];

/// S₀₀, S₁₀, S₀₁, S₂₀, S₁₁, S₀₂, S₃₀, S₂₁, S₁₂, S₀₃ from R and r, C₀ … C₄ and f; those above the order have no meaning.
#[inline(always)]
pub(super) fn half_plane<T: Number>((big, r): (f64, f64), cosines: &[T; 5], (a, b): (T, T), order: usize) -> [T; 10] {
    let (big2, rr) = (big * big, r * r);
    let [c0, c1, c2, c3, c4] = *cosines;
    let mut sums = [c0; 10];
    let e10 = a * c1;
    sums[0] = (c0 * big + e10 * r) * r;
    if order == 0 {
        return sums;
    }
    // ∫ κ cosᵖ sin^q.
    let t02 = c0 - c2;
    let (aa, ab, bb) = (a * a, a * b, b * b);
    let (e01, e20, e11) = (b * c1, aa * c2 + bb * t02, ab * (c2 - t02));
    sums[1] = (c0 * big2 + e10 * (2.0 * big * r) + e20 * rr) * r;
    sums[2] = (e01 * big + e11 * r) * rr;
    if order == 1 {
        return sums;
    }
    let t12 = c1 - c3;
    let e02 = bb * c2 + aa * t02;
    let e30 = a * (aa * c3 + bb * t12 * 3.0);
    let e21 = b * (aa * c3 + (bb - aa * 2.0) * t12);
    let e12 = a * (bb * c3 + (aa - bb * 2.0) * t12);
    sums[3] = (c0 * (big2 * big) + e10 * (3.0 * big2 * r) + e20 * (3.0 * big * rr) + e30 * (rr * r)) * r;
    sums[4] = (e01 * big2 + e11 * (2.0 * big * r) + e21 * rr) * rr;
    sums[5] = (e02 * big + e12 * r) * (rr * r);
    if order == 2 {
        return sums;
    }
    let (t22, t04) = (c2 - c4, c0 - c2 * 2.0 + c4);
    let e03 = b * (bb * c3 + aa * t12 * 3.0);
    let e40 = aa * aa * c4 + aa * bb * t22 * 6.0 + bb * bb * t04;
    let e31 = ab * (aa * c4 + (bb - aa) * t22 * 3.0 - bb * t04);
    let e22 = aa * bb * (c4 + t04 - t22 * 4.0) + (aa * aa + bb * bb) * t22;
    let e13 = ab * (bb * c4 + (aa - bb) * t22 * 3.0 - aa * t04);
    sums[6] = (c0 * (big2 * big2)
        + e10 * (4.0 * big2 * big * r)
        + e20 * (6.0 * big2 * rr)
        + e30 * (4.0 * big * rr * r)
        + e40 * (rr * rr))
        * r;
    sums[7] = (e01 * (big2 * big) + e11 * (3.0 * big2 * r) + e21 * (3.0 * big * rr) + e31 * (rr * r)) * rr;
    sums[8] = (e02 * big2 + e12 * (2.0 * big * r) + e22 * rr) * (rr * r);
    sums[9] = (e03 * big + e13 * r) * (rr * rr);
    sums
}

/// The components of the pair of half-planes at ±φ, of total weight w; those above the order have no meaning.
#[inline(always)]
pub(super) fn turned<T: Number>(s: &[T; 10], w: T, cos: T, sin_squared: T, order: usize) -> [T; COMPONENTS] {
    let mut out = [w * s[0]; COMPONENTS];
    if order == 0 {
        return out;
    }
    let wc = w * cos;
    (out[1], out[2]) = (wc * s[1], w * s[2]);
    if order == 1 {
        return out;
    }
    let (wcc, wss) = (wc * cos, w * sin_squared);
    (out[3], out[4], out[5], out[6]) = (wcc * s[3], wss * s[3], wc * s[4], w * s[5]);
    if order == 2 {
        return out;
    }
    (out[7], out[8]) = (wcc * cos * s[6], wss * cos * s[6]);
    (out[9], out[10]) = (wcc * s[7], wss * s[7]);
    (out[11], out[12]) = (wc * s[8], w * s[9]);
    out
}

/// The moments that these components are.
pub(super) fn collect(sums: &[f64; COMPONENTS]) -> Moments {
    let [zeroth, x, z, xx, yy, xz, zz, xxx, xyy, xxz, yyz, xzz, zzz] = *sums;
    Moments {
        zeroth,
        first: Vec3::new(x, 0.0, z),
        second: Mat3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, zz),
        third: SymmetricThird([xxx, 0.0, xxz, xyy, 0.0, xzz, 0.0, yyz, 0.0, zzz]),
    }
}
