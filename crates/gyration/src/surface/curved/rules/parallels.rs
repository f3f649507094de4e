//! Moments over parallels of an ellipsoid, [`LANES`] of them at a time.
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

use super::features::PolarNode;
use super::integrand::{GROUP, Integrand, LANES, Lane, accumulate};
use super::weight::{base, extra_digits};
use crate::surface::Moments;
use crate::tensor::{Mat3, Vec3};

/// The e-folds of e^(−Nη) asked for; the zeros of |B s|² are branch points, whose error is 1e-3 of that.
const AZIMUTH_DIGITS: f64 = 20.0;

/// Fewest and most points on a circle, in pairs.
const FEWEST_PAIRS: f64 = 2.0;
const MOST_PAIRS: f64 = 4096.0;

/// Numbers of components up to an order: of 1, x … z, xx … zz, xxx … zzz.
const COMPONENTS: [usize; 4] = [1, 4, 10, 20];

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

/// The element and its factors.
struct Weighted<'a, const N: usize> {
    element: &'a AreaElement,
    factors: &'a [Vec3; N],
}

/// A group of neighbouring parallels; those that fill the last group have no weight.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ParallelGroup {
    versine: Lane,
    cos: Lane,
    sin: Lane,
    weight: Lane,
    /// The e-folds by which the heaviest parallel weighs less than the lowest part of the surface.
    spared: f64,
}

impl ParallelGroup {
    /// Gathers at most [`LANES`] parallels; none if there are none.
    pub(crate) fn gather(nodes: &mut impl Iterator<Item = PolarNode>) -> Option<Self> {
        let first = nodes.next()?;
        let mut group = Self { spared: first.spared, ..Self::default() };
        group.set(0, &first, first.weight);
        let mut last = first;
        for lane in 1..LANES {
            let next = nodes.next();
            let weight = next.as_ref().map_or(0.0, |node| node.weight);
            last = next.unwrap_or(last);
            group.spared = group.spared.min(last.spared);
            group.set(lane, &last, weight);
        }
        Some(group)
    }

    fn set(&mut self, lane: usize, node: &PolarNode, weight: f64) {
        self.versine[lane] = node.versine;
        self.cos[lane] = 1.0 - node.versine;
        self.sin[lane] = (node.versine * (2.0 - node.versine)).max(0.0).sqrt();
        self.weight[lane] = weight;
    }

    /// Pairs of opposite points that resolve |B s| around these parallels.
    #[inline(always)]
    fn pairs<const N: usize>(&self, element: &AreaElement, order: usize) -> f64 {
        // Parallels that count less need fewer digits; the nearest zero is that of the largest circle.
        let z = self.cos.iter().fold(1.0, |least: f64, z| least.min(*z));
        let decay = element.decay(z * z, 1.0 - z * z).min(10.0);
        let digits = AZIMUTH_DIGITS + extra_digits::<N>() - self.spared;
        let points = digits.max(3.0) / decay + (order + N) as f64 + 1.0;
        (0.5 * points).ceil().clamp(FEWEST_PAIRS, MOST_PAIRS)
    }

    /// Adds κ times the moments of s over these parallels and over their images at π − θ, weighted with the element and
    /// its factors.
    ///
    /// The gap is near + reach · versine.
    #[inline(always)]
    fn add<const N: usize>(
        &self,
        of: &Weighted<N>,
        (near, reach): (f64, f64),
        integrand: &Integrand,
        sums: &mut ParallelSums,
    ) {
        let pairs = self.pairs::<N>(of.element, integrand.order);
        let third = integrand.order == 3;
        let circle = if third { self.around::<true, N>(of, pairs) } else { self.around::<false, N>(of, pairs) };
        let components = self.components(&circle, PI / pairs);
        let mut gaps = [0.0; 2 * LANES];
        for lane in 0..LANES {
            gaps[lane] = near + reach * self.versine[lane];
            gaps[LANES + lane] = near + reach * (1.0 + self.cos[lane]);
        }
        let values = integrand.at_each(&gaps);
        for (value, sums) in values.iter().zip(&mut sums.lanes).take(integrand.count()) {
            let (mut even, mut odd) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                even[lane] = value[lane] + value[LANES + lane];
                odd[lane] = value[lane] - value[LANES + lane];
            }
            accumulate(&even, &components[..1], &mut sums[..1]);
            accumulate(&odd, &components[1..4], &mut sums[1..4]);
            accumulate(&even, &components[4..10], &mut sums[4..10]);
            if third {
                accumulate(&odd, &components[10..], &mut sums[10..]);
            }
        }
    }

    /// The sums of the weight times 1, c, s, c², cs, and c³, c²s if `THIRD`, over pairs of opposite points.
    #[inline(always)]
    fn around<const THIRD: bool, const N: usize>(&self, of: &Weighted<N>, pairs: f64) -> [Lane; 7] {
        let q = &of.element.form;
        let [mut constant, mut square, mut mixed] = [[0.0; LANES]; 3];
        let [mut along_c, mut along_s] = [[0.0; LANES]; 2];
        for lane in 0..LANES {
            let (z, r) = (self.cos[lane], self.sin[lane]);
            constant[lane] = z * z * q.m33 + r * r * q.m22;
            square[lane] = r * r * (q.m11 - q.m22);
            mixed[lane] = 2.0 * r * r * q.m12;
            along_c[lane] = 2.0 * z * r * q.m13;
            along_s[lane] = 2.0 * z * r * q.m23;
        }
        let (step_s, step_c) = libm::sincos(PI / pairs);
        let (mut c, mut s) = (1.0, 0.0);
        let mut sums = [[0.0; LANES]; 7];
        for _ in 0..pairs as usize {
            let (cc, cs) = (c * c, c * s);
            for lane in 0..LANES {
                let even = constant[lane] + square[lane] * cc + mixed[lane] * cs;
                let odd = along_c[lane] * c + along_s[lane] * s;
                let (mut here, mut opposite) = (base::<N>(even + odd), base::<N>(even - odd));
                for factor in of.factors {
                    let (along, across) = (self.cos[lane] * factor.z, self.sin[lane] * (c * factor.x + s * factor.y));
                    (here, opposite) = (here * (along + across), opposite * (along - across));
                }
                let (w, v) = (here + opposite, here - opposite);
                sums[0][lane] += w;
                sums[1][lane] += v * c;
                sums[2][lane] += v * s;
                sums[3][lane] += w * cc;
                sums[4][lane] += w * cs;
                if THIRD {
                    sums[5][lane] += v * (c * cc);
                    sums[6][lane] += v * (s * cc);
                }
            }
            (c, s) = (c * step_c - s * step_s, s * step_c + c * step_s);
        }
        sums
    }

    /// The components of s, s⊗s, s⊗s⊗s from the sums of `around`, in the order of [`COMPONENTS`].
    #[inline(always)]
    fn components(&self, sums: &[Lane; 7], step: f64) -> [Lane; 20] {
        let mut out = [[0.0; LANES]; 20];
        for lane in 0..LANES {
            let (z, r) = (self.cos[lane], self.sin[lane]);
            let w = self.weight[lane] * step;
            let [w1, w2, w3] = [w * r, w * r * r, w * r * r * r];
            let [one, c, s, cc, cs, ccc, ccs] = sums.map(|lanes| lanes[lane]);
            let (zeroth, x, y) = (w * one, w1 * c, w1 * s);
            let (xx, xy, yy) = (w2 * cc, w2 * cs, w2 * (one - cc));
            let (xxx, xxy, xyy, yyy) = (w3 * ccc, w3 * ccs, w3 * (c - ccc), w3 * (s - ccs));
            let zz = z * z;
            let all = [
                [zeroth, x, y, z * zeroth, xx, xy, z * x, yy, z * y, zz * zeroth],
                [xxx, xxy, z * xx, xyy, z * xy, zz * x, yyy, z * yy, zz * y, z * zz * zeroth],
            ];
            for (out, value) in out.iter_mut().zip(all.as_flattened()) {
                out[lane] = *value;
            }
        }
        out
    }
}

/// All parallels that `nodes` tells of, the gap being gap.0 + gap.1 · versine: compiled for each instruction set.
pub(crate) struct ParallelSweep<'a, Nodes, const N: usize> {
    pub(crate) nodes: Nodes,
    pub(crate) element: &'a AreaElement,
    pub(crate) gap: (f64, f64),
    pub(crate) integrand: &'a Integrand,
    /// The linear forms in (e₁, e₂, f) with which the element is multiplied and, as often, divided by its length.
    pub(crate) factors: &'a [Vec3; N],
    pub(crate) sums: &'a mut ParallelSums,
}

impl<Nodes: Iterator<Item = PolarNode>, const N: usize> WithSimd for ParallelSweep<'_, Nodes, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        let of = Weighted { element: self.element, factors: self.factors };
        while let Some(parallels) = ParallelGroup::gather(&mut self.nodes) {
            parallels.add(&of, self.gap, self.integrand, self.sums);
        }
    }
}

/// The moments of each kernel, lane by lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ParallelSums {
    pub(crate) lanes: [[Lane; 20]; GROUP],
}

impl ParallelSums {
    pub(crate) const ZERO: Self = Self { lanes: [[[0.0; LANES]; 20]; GROUP] };

    /// The moments of the `place`-th kernel up to `order`.
    pub(crate) fn collect(&self, place: usize, order: usize, out: &mut Moments) {
        let mut sums = [0.0; 20];
        for (sum, lanes) in sums.iter_mut().zip(&self.lanes[place]).take(COMPONENTS[order.min(3)]) {
            *sum = lanes.iter().sum();
        }
        let [zeroth, x, y, z, xx, xy, xz, yy, yz, zz] = std::array::from_fn(|k| sums[k]);
        out.zeroth = zeroth;
        out.first = Vec3::new(x, y, z);
        out.second = Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        out.third.0.copy_from_slice(&sums[10..]);
    }
}
