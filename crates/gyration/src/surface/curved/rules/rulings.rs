//! Walls made of straight lines: one ruling for each node of a ring, several of them at once in lanes.
//!
//! Along a ruling the gap is affine, so that L_j = ∫ κ t^j dt, t from 0 to 1, has a closed form (`line`). What the
//! moments of a wall need of the whole ring is
//!
//!   Σ w T L_j,   T = 1, c, c², s², c³, c s²,   c = cos φ, s = sin φ,
//!
//! with t from the end at which the gap varies (a cylinder, whose rulings all rise alike), or with t^(j + 1 + deg T)
//! and t from the common end (a cone, whose rulings widen from the apex). Sums run over logical lanes and are folded in
//! a fixed order, so that every width of registers gives the same bytes.

use pulp::{Simd, WithSimd};

use super::integrand::LANES;
use super::ring::RingChunk;
use crate::simd::{F64s, Row, WIDTH, dispatch, fold};
use crate::surface::MomentRequest;
use crate::surface::line::{EndKernel, LineKernel, line_moments};

/// The rulings of one wall: gaps base = near + reach · versine at one end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rulings<'a> {
    pub(crate) ring: &'a [RingChunk],
    pub(crate) near: f64,
    pub(crate) reach: f64,
    /// The gap of the base from which on rulings are negligible.
    pub(crate) cut: f64,
    pub(crate) other_end: OtherEnd,
}

/// The gap at the other end of a ruling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum OtherEnd {
    /// That of the base and this rise ≥ 0: a cylinder.
    Above(f64),
    /// The same for all: the apex of a cone.
    Common(f64),
}

/// Sums over a ring; places that an order does not ask for are 0.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RulingSums {
    /// L₀ … L₃, or those of a cone.
    pub(crate) one: [f64; 4],
    /// c L₀ … c L₂; of a cone from c L₁ on, and so on.
    pub(crate) cos: [f64; 4],
    pub(crate) cos_squared: [f64; 4],
    pub(crate) sin_squared: [f64; 4],
    pub(crate) cos_cubed: f64,
    pub(crate) cos_sin_squared: f64,
}

impl Rulings<'_> {
    /// The sums for one kernel, prepared up to the degree that `line` gives it.
    pub(crate) fn sums(&self, request: &MomentRequest, line: &LineKernel) -> RulingSums {
        dispatch(RulingSweep::new(self, line, request))
    }

    /// The kernel along a ruling.
    pub(crate) fn line(&self, request: &MomentRequest) -> LineKernel {
        let beyond = usize::from(matches!(self.other_end, OtherEnd::Common(_)));
        LineKernel::up_to(request.kernel, request.order.clamp(1, 3) + beyond)
    }
}

/// The pass over the rulings for one kernel: compiled for each instruction set.
pub(crate) struct RulingSweep<'a> {
    pub(crate) rulings: &'a Rulings<'a>,
    kernel: EndKernel<'a>,
    pub(crate) order: usize,
}

impl<'a> RulingSweep<'a> {
    pub(crate) fn new(rulings: &'a Rulings<'a>, line: &'a LineKernel, request: &MomentRequest) -> Self {
        // Degree 1 is the least that a kernel is prepared for.
        Self { rulings, kernel: EndKernel::new(line), order: request.order.clamp(1, 3) }
    }
}

impl WithSimd for RulingSweep<'_> {
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
    pub(crate) fn folded(rows: &[Row; 13]) -> Self {
        let sum = |place: usize| fold(&rows[place]);
        Self {
            one: [sum(0), sum(1), sum(2), sum(3)],
            cos: [sum(4), sum(5), sum(6), 0.0],
            cos_squared: [sum(7), sum(8), 0.0, 0.0],
            sin_squared: [sum(9), sum(10), 0.0, 0.0],
            cos_cubed: sum(11),
            cos_sin_squared: sum(12),
        }
    }
}

/// Weights, cosines, versines and squared sines of up to two chunks; those of a missing one are zero.
#[inline(always)]
pub(crate) fn rows_of(pair: &[RingChunk]) -> [Row; 4] {
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

impl RulingSweep<'_> {
    #[inline(always)]
    fn rows<S: Simd, const ORDER: usize>(&self, simd: S) -> [Row; 13] {
        let mut sums = [[0.0; WIDTH]; 13];
        for pair in self.rulings.ring.chunks(WIDTH / LANES) {
            if self.rulings.near + self.rulings.reach * pair[0].versine[0] > self.rulings.cut {
                break;
            }
            let [weight, cos, versine, sin_squared] = rows_of(pair);
            for register in 0..WIDTH / S::F64_LANES {
                let load = |row: &Row| F64s::<S>::load(simd, row, register);
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
    pub(crate) fn line<S: Simd, const ORDER: usize>(&self, base: F64s<S>) -> [F64s<S>; 4] {
        let kernel = &self.kernel;
        match self.rulings.other_end {
            OtherEnd::Above(rise) => {
                let m = line_moments(kernel.line, &kernel.at(base), &kernel.at(base + rise), ORDER);
                [m[0], m[1], m[2], m[3]]
            }
            OtherEnd::Common(apex) => {
                let apex = F64s::splat(base.simd, apex);
                let apex_nearer = apex.less_than(base);
                let (near, far) = (apex_nearer.select(apex, base), apex_nearer.select(base, apex));
                let m = line_moments(kernel.line, &kernel.at(near), &kernel.at(far), ORDER + 1);
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

    /// Adds w T L_j of one register.
    #[inline(always)]
    pub(crate) fn add<S: Simd, const ORDER: usize>(
        &self,
        line: &[F64s<S>; 4],
        (weight, cos, sin_squared): (F64s<S>, F64s<S>, F64s<S>),
        register: usize,
        sums: &mut [Row; 13],
    ) {
        let cone = matches!(self.rulings.other_end, OtherEnd::Common(_));
        // Orders are of T and t together.
        let mut add = |first: usize, degree: usize, factor: F64s<S>| {
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
