//! How each of a few requests is evaluated over a triangle; made once a call.
//!
//! In order of cost:
//!
//! 1. *lowered* from another request with the exponent ν + 1 and a higher order: d^−ν = d · d^−(ν+1), and d is linear in λ;
//! 2. *whole*: for an integer ν ≥ order + 3 the integral is a polynomial in the reciprocal gaps (`facets_whole`);
//! 3. *split* along the level line of the middle corner (`facets_split`), for any exponent and the logarithm.
//!
//! Derivatives ask for (ν, n) and (ν + 1, n + 1) together, so that their first half comes almost free.

use super::facets_split::split_weights;
use super::facets_triangle::{Corner, Triangle, Weights};
use super::facets_whole::WholeExponent;
use super::power::{GapSample, LineKernel};
use super::{Kernel, MomentRequest};

/// Requests that share one pass over the triangles.
pub(super) const BATCH: usize = 4;

/// Vertices of a cluster: enough to share most of them, few enough for a table on the stack.
pub(super) const CLUSTER: usize = 16;

/// Exponents whose distance from ν + 1 is below this count as ν + 1: it changes d^−ν by less than 1e-14 |ln d|.
const SAME_EXPONENT: f64 = 1e-14;

/// The way to the weights of one request.
#[derive(Debug, Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "a plan lives on the stack: a call must not allocate")]
enum Method {
    /// From the weights of the request at this place.
    Lowered(usize),
    Whole(WholeExponent),
    Split(LineKernel),
}

/// The methods of at most `BATCH` requests, and the order in which they are evaluated.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    methods: [Method; BATCH],
    orders: [usize; BATCH],
    /// Places of the requests: those that others are lowered from come first.
    sequence: [usize; BATCH],
    count: usize,
}

/// The functions of the gap at the vertices of one cluster, and the weights over its triangle in hand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Table {
    samples: [[GapSample; CLUSTER]; BATCH],
    weights: [Weights; BATCH],
}

impl Plan {
    /// Plans at most `BATCH` requests.
    pub fn new(requests: &[MomentRequest]) -> Self {
        let mut plan = Self {
            methods: [Method::Lowered(0); BATCH],
            orders: [0; BATCH],
            sequence: [0, 1, 2, 3],
            count: requests.len().min(BATCH),
        };
        for (place, request) in requests.iter().enumerate().take(BATCH) {
            plan.orders[place] = request.order.min(3);
            plan.methods[place] = match (source(requests, request), request.kernel) {
                (Some(from), _) => Method::Lowered(from),
                (None, Kernel::Power(exponent)) => match WholeExponent::new(exponent, plan.orders[place]) {
                    Some(whole) => Method::Whole(whole),
                    None => Method::Split(LineKernel::up_to(request.kernel, plan.orders[place] + 1)),
                },
                (None, Kernel::Log) => Method::Split(LineKernel::up_to(Kernel::Log, plan.orders[place] + 1)),
            };
        }
        let rank = |place: &usize| match requests[*place].kernel {
            Kernel::Power(exponent) => -exponent,
            Kernel::Log => f64::INFINITY,
        };
        plan.sequence[..plan.count].sort_unstable_by(|a, b| rank(a).total_cmp(&rank(b)));
        plan
    }

    /// The table for vertices with these gaps.
    pub fn table(&self, gaps: &[f64]) -> Table {
        let mut samples = [[GapSample::UNIT; CLUSTER]; BATCH];
        for (samples, method) in samples.iter_mut().zip(&self.methods).take(self.count) {
            if let Method::Split(kernel) = method {
                for (sample, gap) in samples.iter_mut().zip(gaps) {
                    *sample = kernel.sample(*gap);
                }
            }
        }
        Table { samples, weights: [[0.0; 10]; BATCH] }
    }

    /// Calls `each` with the place, the order and the weights of every request over a triangle.
    #[inline]
    pub fn visit(&self, triangle: &Triangle, table: &mut Table, mut each: impl FnMut(usize, usize, &Weights)) {
        let Table { samples, weights } = table;
        for &place in &self.sequence[..self.count] {
            let order = self.orders[place];
            weights[place] = match &self.methods[place] {
                Method::Lowered(from) => lowered(&weights[*from], triangle, order),
                Method::Whole(whole) => whole.weights(triangle),
                Method::Split(kernel) => split_weights(triangle, kernel, &samples[place], order),
            };
            each(place, order, &weights[place]);
        }
    }
}

/// The place of a request with the exponent ν + 1 and a higher order.
fn source(requests: &[MomentRequest], request: &MomentRequest) -> Option<usize> {
    let Kernel::Power(exponent) = request.kernel else { return None };
    requests.iter().position(|other| match other.kernel {
        Kernel::Power(higher) => (higher - exponent - 1.0).abs() < SAME_EXPONENT && other.order > request.order,
        Kernel::Log => false,
    })
}

/// J_ab(ν) = d₀ J_ab + (d₁ − d₀) J_(a+1)b + (d₂ − d₀) J_a(b+1), all at ν + 1; every term is positive.
#[inline]
fn lowered(higher: &Weights, triangle: &Triangle, order: usize) -> Weights {
    /// Places of J_(a+1)b and J_a(b+1) for the place of J_ab.
    const RAISED: [(usize, usize); 6] = [(1, 2), (3, 4), (4, 5), (6, 7), (7, 8), (8, 9)];
    const COUNT: [usize; 4] = [1, 3, 6, 6];
    let [low, middle, high] = triangle.corners.map(|Corner { gap, .. }| gap);
    let mut weights = [0.0; 10];
    for (place, (one, two)) in RAISED.into_iter().enumerate().take(COUNT[order]) {
        weights[place] = low * higher[place] + (middle - low) * higher[one] + (high - low) * higher[two];
    }
    weights
}
