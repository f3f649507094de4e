//! Moments over parallels of an ellipsoid, a row of them at a time.
//!
//! On the parallel s = z f + r (cos φ e₁ + sin φ e₂), z = cos θ, r = sin θ, the squared area element is a quadratic
//! form,
//!
//!   |B s|² = E(φ) + O(φ),   E = z²q₃₃ + r²(q₁₁c² + 2q₁₂cs + q₂₂s²),   O = 2zr(q₁₃c + q₂₃s),
//!
//! and φ + π changes the sign of O only: one pass over half a circle gives both halves. The parallel at π − θ is the
//! image of that at θ under s ↦ −s, which leaves |B s| alone, so that its moments are the same but for the sign of the
//! odd ones. The trapezoidal rule in φ converges like e^(−Nη), η the distance of the nearest zero of |B s|².

use std::f64::consts::PI;

use pulp::{Simd, WithSimd};

use super::features::Features;
use super::integrand::{GROUP, Integrand};
use super::polar::ParallelRow;
use super::weight::{bases, extra_digits};
use crate::simd::{F64s, Row, WIDTH, dispatch, fold};
use crate::surface::{MomentRequest, Moments};
use crate::tensor::{Mat3, Vec3};

/// The e-folds of e^(−Nη) asked for; the zeros of |B s|² are branch points, whose error is 1e-3 of that.
const AZIMUTH_DIGITS: f64 = 20.0;

/// Fewest and most points on a circle, in pairs.
const FEWEST_PAIRS: f64 = 2.0;
const MOST_PAIRS: f64 = 4096.0;

/// Components of 1, x … z, xx … zz, and of xxx … zzz beside them.
const TO_SECOND: usize = 10;
pub(crate) const TO_THIRD: usize = 20;

/// Kernels for which there is room without third moments.
const FEW: usize = 3;

/// |B s|² as a quadratic form in the frame (e₁, e₂, f).
#[derive(Debug, Clone, Copy)]
pub(crate) struct AreaElement {
    form: Mat3,
    /// The least |B s|, the least over f + (e₁, e₂), and the largest within (e₁, e₂), squared.
    least: f64,
    least_beyond: f64,
    most_across: f64,
}

impl AreaElement {
    pub(crate) fn new(cofactor: &Vec3, frame: &Mat3) -> Self {
        let squares = cofactor.component_mul(cofactor);
        let form = frame.transpose() * Mat3::from_diagonal(&squares) * frame;
        let f = frame.column(2);
        let (sum, difference) = (0.5 * (form.m11 + form.m22), 0.5 * (form.m11 - form.m22));
        Self {
            form,
            least: squares.min(),
            least_beyond: 1.0 / (f.x * f.x / squares.x + f.y * f.y / squares.y + f.z * f.z / squares.z),
            most_across: sum + libm::hypot(difference, form.m12),
        }
    }

    /// The element |B s| of a deformed surface, from B in the columns e₁, e₂, f and the eigenvalues of BᵀB.
    pub(crate) fn deformed(vectors: &Mat3, squares: &Vec3) -> Self {
        let form = vectors.tr_mul(vectors);
        let (sum, difference) = (0.5 * (form.m11 + form.m22), 0.5 * (form.m11 - form.m22));
        let across = form.m11 * form.m22 - form.m12 * form.m12;
        // 1/(f·(BᵀB)⁻¹ f); where rounding leaves nothing of the minor, least squares bound it.
        let least = squares.min().max(0.0);
        let beyond = if across > 0.0 { squares.product() / across } else { least };
        Self { form, least, least_beyond: beyond.max(least), most_across: sum + libm::hypot(difference, form.m12) }
    }

    /// A lower bound of η, the imaginary part of the azimuth at which |B s|² vanishes, on parallels (cos θ, sin θ)².
    ///
    /// There B(cos θ f + sin θ cosh η e) and sin θ sinh η B e' have equal lengths; the first is at least
    /// |cos θ| √least_beyond and √least · |s|, the second at most sin θ sinh η √most_across.
    #[inline(always)]
    pub(crate) fn decay(&self, cos_squared: f64, sin_squared: f64) -> f64 {
        let beyond = cos_squared * self.least_beyond / self.most_across;
        let excess = self.most_across - self.least;
        let least = if excess > 0.0 { self.least / excess } else { f64::INFINITY };
        libm::asinh((beyond.max(least) / sin_squared).sqrt())
    }
}

/// All parallels of a rule, the gap being gap.0 + gap.1 · versine.
#[derive(Clone, Copy)]
pub(crate) struct ParallelSweep<'a, const N: usize> {
    pub(crate) features: &'a Features,
    pub(crate) element: &'a AreaElement,
    pub(crate) gap: (f64, f64),
    pub(crate) integrand: &'a Integrand,
    /// The linear forms in (e₁, e₂, f) with which the element is multiplied and, as often, divided by its length.
    pub(crate) factors: &'a [Vec3; N],
}

impl<const N: usize> ParallelSweep<'_, N> {
    /// Sets the moments of s that are asked for.
    pub(crate) fn collect(&self, requests: &[MomentRequest], out: &mut [Moments]) {
        if self.integrand.order < 3 && requests.len() <= FEW {
            collect(&dispatch(Summed::<N, TO_SECOND, FEW>(*self)), requests, out);
        } else {
            collect(&dispatch(Summed::<N, TO_THIRD, GROUP>(*self)), requests, out);
        }
    }
}

/// Sums of C components for each of K kernels: compiled for each instruction set.
struct Summed<'a, const N: usize, const C: usize, const K: usize>(ParallelSweep<'a, N>);

impl<const N: usize, const C: usize, const K: usize> WithSimd for Summed<'_, N, C, K> {
    type Output = [[f64; C]; K];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self(sweep) = self;
        let mut sums = [[[0.0; WIDTH]; C]; K];
        for (row, spared) in sweep.features.rows() {
            sweep.add::<S, C>(simd, &row, spared, &mut sums);
        }
        let mut folded = [[0.0; C]; K];
        for (folded, sums) in folded.iter_mut().zip(&sums).take(sweep.integrand.count()) {
            for (folded, sum) in folded.iter_mut().zip(sums) {
                *folded = fold(sum);
            }
        }
        folded
    }
}

impl<const N: usize> ParallelSweep<'_, N> {
    /// Adds κ times the moments of s over these parallels and over their images at π − θ, weighted with the element and
    /// its factors.
    #[inline(always)]
    fn add<S: Simd, const C: usize>(&self, simd: S, row: &ParallelRow, spared: f64, sums: &mut [[Row; C]]) {
        let pairs = self.pairs(row, spared);
        let (step_sin, step_cos) = libm::sincos(PI / pairs);
        let (mut near, mut far) = ([0.0; WIDTH], [0.0; WIDTH]);
        for lane in 0..WIDTH {
            near[lane] = self.gap.0 + self.gap.1 * row.versine[lane];
            far[lane] = self.gap.0 + self.gap.1 * (1.0 + row.cos[lane]);
        }
        let (near, far) = (self.integrand.at_each(&near), self.integrand.at_each(&far));
        for register in 0..WIDTH / S::F64_LANES {
            let load = |row: &Row| F64s::<S>::load(simd, row, register);
            let (cos, sin) = (load(&row.cos), load(&row.sin));
            let circle = self.around::<S, C>(cos, sin, pairs as usize, (step_sin, step_cos));
            let components = components::<S, C>(&circle, (cos, sin), load(&row.weight) * (PI / pairs));
            for ((near, far), sums) in near.iter().zip(&far).zip(sums.iter_mut()).take(self.integrand.count()) {
                let (near, far) = (load(near), load(far));
                let (even, odd) = (near + far, near - far);
                (even * components[0]).add_to(&mut sums[0], register);
                for place in 1..4 {
                    (odd * components[place]).add_to(&mut sums[place], register);
                }
                for place in 4..TO_SECOND {
                    (even * components[place]).add_to(&mut sums[place], register);
                }
                for place in TO_SECOND..C {
                    (odd * components[place]).add_to(&mut sums[place], register);
                }
            }
        }
    }

    /// Pairs of opposite points that resolve |B s| around these parallels.
    #[inline(always)]
    fn pairs(&self, row: &ParallelRow, spared: f64) -> f64 {
        // Parallels that count less need fewer digits; the nearest zero is that of the largest circle.
        let z = row.least_cos;
        let decay = self.element.decay(z * z, 1.0 - z * z).min(10.0);
        let digits = AZIMUTH_DIGITS + extra_digits::<N>() - spared;
        let points = digits.max(3.0) / decay + (self.integrand.order + N) as f64 + 1.0;
        (0.5 * points).ceil().clamp(FEWEST_PAIRS, MOST_PAIRS)
    }

    /// The sums of the weight times 1, c, s, c², cs, and c³, c²s if third moments are wanted, over pairs of opposite
    /// points.
    #[inline(always)]
    fn around<S: Simd, const C: usize>(
        &self,
        z: F64s<S>,
        r: F64s<S>,
        pairs: usize,
        (step_sin, step_cos): (f64, f64),
    ) -> [F64s<S>; 7] {
        let q = &self.element.form;
        let zero = F64s::splat(z.simd, 0.0);
        let (rr, zr) = (r * r, z * r * 2.0);
        let constant = z * z * q.m33 + rr * q.m22;
        let (square, mixed) = (rr * (q.m11 - q.m22), rr * (2.0 * q.m12));
        let (along_cos, along_sin) = (zr * q.m13, zr * q.m23);
        let (mut c, mut s) = (1.0, 0.0);
        let mut sums = [zero; 7];
        for _ in 0..pairs {
            let (cc, cs) = (c * c, c * s);
            let even = constant + square * cc + mixed * cs;
            let odd = along_cos * c + along_sin * s;
            let (mut here, mut opposite) = (bases::<S, N>(even + odd), bases::<S, N>(even - odd));
            for factor in self.factors {
                let (along, across) = (z * factor.z, r * (c * factor.x + s * factor.y));
                (here, opposite) = (here * (along + across), opposite * (along - across));
            }
            let (w, v) = (here + opposite, here - opposite);
            sums[0] += w;
            sums[1] += v * c;
            sums[2] += v * s;
            sums[3] += w * cc;
            sums[4] += w * cs;
            if C == TO_THIRD {
                sums[5] += v * (c * cc);
                sums[6] += v * (s * cc);
            }
            (c, s) = (c * step_cos - s * step_sin, s * step_cos + c * step_sin);
        }
        sums
    }
}

/// The components of s, s⊗s, s⊗s⊗s from the sums of `around`.
#[inline(always)]
fn components<S: Simd, const C: usize>(
    [one, c, s, cc, cs, ccc, ccs]: &[F64s<S>; 7],
    (z, r): (F64s<S>, F64s<S>),
    w: F64s<S>,
) -> [F64s<S>; TO_THIRD] {
    let (w1, w2) = (w * r, w * r * r);
    let (zeroth, x, y) = (w * *one, w1 * *c, w1 * *s);
    let (xx, xy, yy) = (w2 * *cc, w2 * *cs, w2 * (*one - *cc));
    let zz = z * z;
    let mut out = [zeroth; TO_THIRD];
    (out[1], out[2], out[3]) = (x, y, z * zeroth);
    (out[4], out[5], out[6], out[7], out[8], out[9]) = (xx, xy, z * x, yy, z * y, zz * zeroth);
    if C == TO_THIRD {
        let w3 = w2 * r;
        (out[10], out[11], out[12]) = (w3 * *ccc, w3 * *ccs, z * xx);
        (out[13], out[14], out[15]) = (w3 * (*c - *ccc), z * xy, zz * x);
        (out[16], out[17], out[18], out[19]) = (w3 * (*s - *ccs), z * yy, zz * y, z * zz * zeroth);
    }
    out
}

/// The moments of the kernels up to the orders asked for.
pub(crate) fn collect<const C: usize>(sums: &[[f64; C]], requests: &[MomentRequest], out: &mut [Moments]) {
    for ((sums, request), out) in sums.iter().zip(requests).zip(out) {
        let mut wanted = [0.0; TO_THIRD];
        let count = [1, 4, TO_SECOND, TO_THIRD][request.order.min(3)];
        wanted[..count].copy_from_slice(&sums[..count]);
        let [zeroth, x, y, z, xx, xy, xz, yy, yz, zz, ..] = wanted;
        out.zeroth = zeroth;
        out.first = Vec3::new(x, y, z);
        out.second = Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        out.third.0.copy_from_slice(&wanted[TO_SECOND..]);
    }
}
