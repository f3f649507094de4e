//! Rules over the parallels of half a sphere, kept for the life of the program.
//!
//! In y = ln(1 + x/δ), x = 1 − cos θ, powers of the gap (near/δ)(δ + x) are exponentials, which Gauss's rule integrates
//! over 0 ≤ x ≤ 1 without a singularity. With a smaller δ' ≤ δ their singularity lies at y = ln(δ/δ' − 1) ± iπ, which
//! for δ < √2 δ' is farther to the left than −0.88 and no nearer than π: the rule for δ' serves as well, to 1e-13 for δ
//! ≥ 1e-6 and to 3e-10 at δ = 1e-8 and ν = 4 … 5, where rounding leaves a gap known to 1e-8. So rules are kept for
//! depths √2 apart and for numbers of points that fill rows.

use std::sync::OnceLock;

use super::graded::gauss_legendre;
use crate::simd::{Row, WIDTH};

/// A parallel of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PolarNode {
    /// 1 − cos θ.
    pub(crate) versine: f64,
    /// Weight in x, area 2π on the half sphere.
    pub(crate) weight: f64,
    /// y = ln(1 + x/δ).
    pub(crate) growth: f64,
}

/// [`WIDTH`] parallels; those that fill the last row have no weight.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ParallelRow {
    pub(crate) versine: Row,
    pub(crate) cos: Row,
    pub(crate) sin: Row,
    pub(crate) weight: Row,
    /// The least y of them.
    pub(crate) growth: f64,
    /// The least cos θ of them.
    pub(crate) least_cos: f64,
}

/// A depth δ' and its rules.
#[derive(Debug)]
pub(crate) struct Depth {
    /// δ'.
    pub(crate) depth: f64,
    /// ln(1 + 1/δ'), the range of y.
    pub(crate) span: f64,
    rules: [OnceLock<Box<[ParallelRow]>>; MOST_ROWS],
}

/// Beyond this the powers of the gap are smooth in x itself.
pub(super) const LARGEST_DEPTH: f64 = 10.0;

/// Depths go down to 1e-15, below which a gap within rounding has no known size.
const DEPTHS: usize = 108;

/// The rows of the finest rule that is kept.
pub(super) const MOST_ROWS: usize = 7;

impl Depth {
    /// The largest depth that is not above this one, or the smallest.
    pub(crate) fn at_most(depth: f64) -> &'static Self {
        static KEPT: OnceLock<Box<[Depth]>> = OnceLock::new();
        let kept = KEPT.get_or_init(|| (0..DEPTHS).map(Self::new).collect());
        let place = (2.0 * libm::log2(LARGEST_DEPTH / depth)).ceil().max(0.0) as usize;
        &kept[place.min(DEPTHS - 1)]
    }

    fn new(place: usize) -> Self {
        let depth = LARGEST_DEPTH * libm::exp2(-0.5 * place as f64);
        Self { depth, span: libm::log1p(1.0 / depth), rules: [const { OnceLock::new() }; MOST_ROWS] }
    }

    /// The rule of at least so many points, [`MOST_ROWS`] rows at most.
    pub(crate) fn rule(&self, points: f64) -> &[ParallelRow] {
        let rows = (points as usize).div_ceil(WIDTH).clamp(1, MOST_ROWS);
        self.rules[rows - 1].get_or_init(|| {
            let half = 0.5 * self.span;
            let mut nodes = gauss_legendre(rows * WIDTH).iter().map(|node| {
                let y = half * (1.0 + node.at);
                let weight = self.depth * libm::exp(y) * half * node.weight;
                PolarNode { versine: self.depth * libm::expm1(y), weight, growth: y }
            });
            std::iter::from_fn(|| ParallelRow::gather(&mut nodes)).collect()
        })
    }
}

impl ParallelRow {
    /// Gathers at most [`WIDTH`] parallels; none if there are none.
    pub(crate) fn gather(nodes: &mut impl Iterator<Item = PolarNode>) -> Option<Self> {
        let first = nodes.next()?;
        let mut row = Self { growth: first.growth, least_cos: 1.0, ..Self::default() };
        row.set(0, &first, first.weight);
        let mut last = first;
        for lane in 1..WIDTH {
            let next = nodes.next();
            let weight = next.as_ref().map_or(0.0, |node| node.weight);
            last = next.unwrap_or(last);
            row.set(lane, &last, weight);
        }
        Some(row)
    }

    fn set(&mut self, lane: usize, node: &PolarNode, weight: f64) {
        self.versine[lane] = node.versine;
        self.cos[lane] = 1.0 - node.versine;
        self.sin[lane] = (node.versine * (2.0 - node.versine)).max(0.0).sqrt();
        self.weight[lane] = weight;
        self.growth = self.growth.min(node.growth);
        self.least_cos = self.least_cos.min(self.cos[lane]);
    }
}
