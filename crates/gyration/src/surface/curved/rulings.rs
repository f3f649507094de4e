//! Walls made of straight lines: one ruling for each node of a ring, several of them at once in lanes.
//!
//! Along a ruling the gap is affine, so that L_j = ∫ κ t^j dt, t from 0 to 1, has a closed form (`power_lanes`). What the moments
//! of a wall need of the whole ring is
//!
//!   Σ w T L_j,   T = 1, c, c², s², c³, c s²,   c = cos φ, s = sin φ,
//!
//! with t from the end at which the gap varies (a cylinder, whose rulings all rise alike), or with t^(j + 1 + deg T) and t
//! from the common end (a cone, whose rulings widen from the apex). Sums run over logical lanes and are folded in a fixed
//! order, so that every width of registers gives the same bytes.

use pulp::{Simd, WithSimd};

use super::super::lanes::{Lanes, Row, WIDTH, dispatch, fold};
use super::super::lanes_power::{Log2, SplitExponent, whole_power};
use super::super::power::LineKernel;
use super::super::power_lanes::{End, line_moments};
use super::super::{Kernel, MomentRequest};
use super::integrand::LANES;
use super::ring::RingChunk;
use super::weight::Weights;
use crate::tensor::Vec3;

/// The rulings of one wall: gaps base = near + reach · versine at one end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rulings<'a> {
    pub(super) ring: &'a [RingChunk],
    pub(super) near: f64,
    pub(super) reach: f64,
    /// The gap of the base from which on rulings are negligible.
    pub(super) cut: f64,
    pub(super) other_end: OtherEnd,
}

/// The gap at the other end of a ruling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum OtherEnd {
    /// That of the base and this rise ≥ 0: a cylinder.
    Above(f64),
    /// The same for all: the apex of a cone.
    Common(f64),
}

/// Sums over a ring; places that an order does not ask for are 0.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RulingSums {
    /// L₀ … L₃, or those of a cone.
    pub(super) one: [f64; 4],
    /// c L₀ … c L₂; of a cone from c L₁ on, and so on.
    pub(super) cos: [f64; 4],
    pub(super) cos_squared: [f64; 4],
    pub(super) sin_squared: [f64; 4],
    pub(super) cos_cubed: f64,
    pub(super) cos_sin_squared: f64,
}

impl Rulings<'_> {
    /// The sums for one kernel.
    pub(super) fn sums(&self, request: &MomentRequest) -> RulingSums {
        let line = self.line(request);
        dispatch(Sweep::new(self, &line, request))
    }

    /// For each weight w the sums with w₊ and those with w₋ sin φ, w± = ½ (w(φ) ± w(−φ)).
    pub(super) fn weighted_sums<const N: usize, const W: usize>(
        &self,
        request: &MomentRequest,
        weights: &WallWeights<N, W>,
    ) -> [[RulingSums; 2]; W] {
        let line = self.line(request);
        dispatch(WeightedSweep { sweep: Sweep::new(self, &line, request), weights })
    }

    /// The kernel along a ruling.
    fn line(&self, request: &MomentRequest) -> LineKernel {
        let beyond = usize::from(matches!(self.other_end, OtherEnd::Common(_)));
        LineKernel::up_to(request.kernel, request.order.clamp(1, 3) + beyond)
    }
}

/// Weights that depend on the azimuth only.
pub(super) struct WallWeights<'a, const N: usize, const W: usize> {
    /// x, y, z of the current area vector v = z + cos φ x + sin φ y.
    pub(super) vectors: [Vec3; 3],
    pub(super) weights: &'a Weights<N, W>,
}

/// The pass over the rulings for one kernel: compiled for each instruction set.
struct Sweep<'a> {
    rulings: &'a Rulings<'a>,
    line: &'a LineKernel,
    exponent: SplitExponent,
    needs_log: bool,
    order: usize,
}

impl<'a> Sweep<'a> {
    fn new(rulings: &'a Rulings<'a>, line: &'a LineKernel, request: &MomentRequest) -> Self {
        let exponent = match request.kernel {
            Kernel::Power(exponent) => exponent,
            Kernel::Log => 1.0,
        };
        let needs_log = line.needs_log() || line.integer.is_none();
        // Degree 1 is the least that a kernel is prepared for.
        Self { rulings, line, exponent: SplitExponent::new(exponent), needs_log, order: request.order.clamp(1, 3) }
    }
}

impl WithSimd for Sweep<'_> {
    type Output = RulingSums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> RulingSums {
        let rows = match self.order {
            1 => self.rows::<S, 1>(simd),
            2 => self.rows::<S, 2>(simd),
            _ => self.rows::<S, 3>(simd),
        };
        RulingSums::folded(&rows)
    }
}

impl RulingSums {
    #[inline(always)]
    fn folded(rows: &[Row; 13]) -> Self {
        let s = rows.map(|row| fold(&row));
        Self {
            one: [s[0], s[1], s[2], s[3]],
            cos: [s[4], s[5], s[6], 0.0],
            cos_squared: [s[7], s[8], 0.0, 0.0],
            sin_squared: [s[9], s[10], 0.0, 0.0],
            cos_cubed: s[11],
            cos_sin_squared: s[12],
        }
    }
}

/// The pass with several weights.
struct WeightedSweep<'a, const N: usize, const W: usize> {
    sweep: Sweep<'a>,
    weights: &'a WallWeights<'a, N, W>,
}

impl<const N: usize, const W: usize> WithSimd for WeightedSweep<'_, N, W> {
    type Output = [[RulingSums; 2]; W];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        match self.sweep.order {
            1 => self.sums::<S, 1>(simd),
            2 => self.sums::<S, 2>(simd),
            _ => self.sums::<S, 3>(simd),
        }
    }
}

impl<const N: usize, const W: usize> WeightedSweep<'_, N, W> {
    #[inline(always)]
    fn sums<S: Simd, const ORDER: usize>(&self, simd: S) -> [[RulingSums; 2]; W] {
        let Rulings { ring, near, reach, cut, .. } = *self.sweep.rulings;
        let mut sums = [[[[0.0; WIDTH]; 13]; 2]; W];
        for pair in ring.chunks(WIDTH / LANES) {
            if near + reach * pair[0].versine[0] > cut {
                break;
            }
            let [weight, cos, versine, sin_squared] = rows_of(pair);
            for register in 0..WIDTH / S::F64_LANES {
                let load = |row: &Row| Lanes::<S>::load(simd, row, register);
                let line = self.sweep.line::<S, ORDER>(load(&versine) * reach + near);
                let (weight, cos, sin_squared) = (load(&weight), load(&cos), load(&sin_squared));
                let sin = sin_squared.sqrt();
                let [plus, minus] = self.weights.at(cos, sin);
                for (place, [even, odd]) in sums.iter_mut().enumerate() {
                    let half = weight * 0.5;
                    let (w, v) = (half * (plus[place] + minus[place]), half * (plus[place] - minus[place]) * sin);
                    self.sweep.add::<S, ORDER>(&line, (w, cos, sin_squared), register, even);
                    self.sweep.add::<S, ORDER>(&line, (v, cos, sin_squared), register, odd);
                }
            }
        }
        sums.map(|parities| parities.map(|rows| RulingSums::folded(&rows)))
    }
}

impl<const N: usize, const W: usize> WallWeights<'_, N, W> {
    /// The weights at φ and at −φ.
    #[inline(always)]
    fn at<S: Simd>(&self, cos: Lanes<S>, sin: Lanes<S>) -> [[Lanes<S>; W]; 2] {
        let [x, y, z] = &self.vectors;
        let even = [0, 1, 2].map(|k| cos * x[k] + z[k]);
        let odd = [0, 1, 2].map(|k| sin * y[k]);
        let vectors = [[0, 1, 2].map(|k| even[k] + odd[k]), [0, 1, 2].map(|k| even[k] - odd[k])];
        vectors.map(|v| {
            let zero = Lanes::splat(cos.simd, 0.0);
            let squared = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
            let base = match N {
                0 => squared.sqrt(),
                2 => 1.0 / squared.sqrt(),
                _ => 1.0 / (squared * squared.sqrt()),
            };
            // What is not a number stays so.
            let base = squared.less_than(Lanes::splat(cos.simd, f64::MIN_POSITIVE)).select(zero, base);
            self.weights.factors.map(|factors| factors.iter().fold(base, |product, &factor| product * v[factor]))
        })
    }
}

/// Weights, cosines, versines and squared sines of up to two chunks; those of a missing one are zero.
#[inline(always)]
fn rows_of(pair: &[RingChunk]) -> [Row; 4] {
    let mut rows = [[0.0; WIDTH]; 4];
    let [weight, cos, versine, sin_squared] = &mut rows;
    for (k, chunk) in pair.iter().enumerate() {
        weight[k * LANES..][..LANES].copy_from_slice(&chunk.weight);
        cos[k * LANES..][..LANES].copy_from_slice(&chunk.cos);
        versine[k * LANES..][..LANES].copy_from_slice(&chunk.versine);
        sin_squared[k * LANES..][..LANES].copy_from_slice(&chunk.sin_squared);
    }
    rows
}

impl Sweep<'_> {
    #[inline(always)]
    fn rows<S: Simd, const ORDER: usize>(&self, simd: S) -> [Row; 13] {
        let mut sums = [[0.0; WIDTH]; 13];
        for pair in self.rulings.ring.chunks(WIDTH / LANES) {
            if self.rulings.near + self.rulings.reach * pair[0].versine[0] > self.rulings.cut {
                break;
            }
            let [weight, cos, versine, sin_squared] = rows_of(pair);
            for register in 0..WIDTH / S::F64_LANES {
                let load = |row: &Row| Lanes::<S>::load(simd, row, register);
                let base = load(&versine) * self.rulings.reach + self.rulings.near;
                let line = self.line::<S, ORDER>(base);
                let trigonometry = (load(&weight), load(&cos), load(&sin_squared));
                self.add::<S, ORDER>(&line, trigonometry, register, &mut sums);
            }
        }
        sums
    }

    /// L_j of a cylinder, or ∫ κ t^(j+1) dt of a cone.
    #[inline(always)]
    fn line<S: Simd, const ORDER: usize>(&self, base: Lanes<S>) -> [Lanes<S>; 4] {
        match self.rulings.other_end {
            OtherEnd::Above(rise) => {
                let m = line_moments(self.line, &self.end(base), &self.end(base + rise), ORDER);
                [m[0], m[1], m[2], m[3]]
            }
            OtherEnd::Common(apex) => {
                let apex = Lanes::splat(base.simd, apex);
                let apex_nearer = apex.less_than(base);
                let (near, far) = (apex_nearer.select(apex, base), apex_nearer.select(base, apex));
                let m = line_moments(self.line, &self.end(near), &self.end(far), ORDER + 1);
                // Else t = 1 − x, x from the base.
                let reversed = [
                    m[0] - m[1],
                    m[0] - m[1] * 2.0 + m[2],
                    m[0] - m[1] * 3.0 + m[2] * 3.0 - m[3],
                    m[0] - m[1] * 4.0 + m[2] * 6.0 - m[3] * 4.0 + m[4],
                ];
                std::array::from_fn(|k| apex_nearer.select(m[k + 1], reversed[k]))
            }
        }
    }

    #[inline(always)]
    fn end<S: Simd>(&self, gap: Lanes<S>) -> End<S> {
        let inverse = 1.0 / gap;
        let log = Log2::new(if self.needs_log { gap } else { Lanes::splat(gap.simd, 1.0) });
        let power = match self.line.integer {
            Some(exponent) => whole_power(gap, inverse, exponent),
            None => log.negative_power(&self.exponent),
        };
        End { gap, inverse, power, log }
    }

    /// Adds w T L_j of one register.
    #[inline(always)]
    fn add<S: Simd, const ORDER: usize>(
        &self,
        line: &[Lanes<S>; 4],
        (weight, cos, sin_squared): (Lanes<S>, Lanes<S>, Lanes<S>),
        register: usize,
        sums: &mut [Row; 13],
    ) {
        let cone = matches!(self.rulings.other_end, OtherEnd::Common(_));
        // Orders are of T and t together.
        let mut add = |first: usize, degree: usize, factor: Lanes<S>| {
            for j in 0..=ORDER - degree {
                let moment = if cone { line[j + degree] } else { line[j] };
                (factor * moment).add_to(&mut sums[first + j], register);
            }
        };
        let along = weight * cos;
        add(0, 0, weight);
        add(4, 1, along);
        if ORDER >= 2 {
            add(7, 2, along * cos);
            add(9, 2, weight * sin_squared);
        }
        if ORDER >= 3 {
            add(11, 3, along * cos * cos);
            add(12, 3, along * sin_squared);
        }
    }
}
