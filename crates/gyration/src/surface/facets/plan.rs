//! How each of a few requests is evaluated over facets; made once for each contact.
//!
//! In order of cost:
//!
//! 1. *lowered* from another request with the exponent ν + 1 and a higher order: d^−ν = d · d^−(ν+1), and d is linear in λ;
//! 2. *integer*: for an integer ν ≥ order + 3 the integral is a polynomial in the reciprocal gaps (`integer`);
//! 3. *split* along the level lines of the middle corners (`split`), for any exponent and the logarithm.
//!
//! Derivatives ask for (ν, n) and (ν + 1, n + 1) together, so that their first half comes almost free.

use pulp::Simd;

use super::facet::{COMPONENTS, Facet, GapsSeen, LevelSplit, Weights, add_tensors};
use super::integer::IntegerExponent;
use super::pack::{FacetPack, Outline, SplatField};
use super::split::SplitKernel;
use crate::simd::{F64s, Row};
use crate::surface::{Kernel, MomentRequest};

/// Requests that share one pass over the facets.
pub(crate) const BATCH: usize = 4;

/// The most rows of sums that a plan asks for.
pub(super) const MOST_ROWS: usize = BATCH * COMPONENTS[3];

/// Exponents whose distance from ν + 1 is below this count as ν + 1: it changes d^−ν by less than 1e-14 |ln d|.
const SAME_EXPONENT: f64 = 1e-14;

/// The way to the weights of one request.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a plan may live on the stack: a call must not allocate")]
enum WeightMethod {
    /// From the weights of the step before.
    Lowered,
    Integer(IntegerExponent),
    Split(SplitKernel),
}

/// One request: how its weights are found, and where its moments go.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PlannedRequest {
    method: WeightMethod,
    order: usize,
    /// The first of its rows of sums.
    row: usize,
}

/// At most `BATCH` requests in the order in which they are evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FacetPlan {
    steps: [PlannedRequest; BATCH],
    count: usize,
    /// For each request its order and the first of its rows.
    places: [(usize, usize); BATCH],
    row_count: usize,
    splits: bool,
    needs_logs: bool,
}

impl FacetPlan {
    /// Plans at most `BATCH` requests.
    pub fn new(requests: &[MomentRequest]) -> Self {
        let requests = &requests[..requests.len().min(BATCH)];
        let unused = PlannedRequest { method: WeightMethod::Lowered, order: 0, row: 0 };
        let mut plan = Self {
            steps: [unused; BATCH],
            count: 0,
            places: [(0, 0); BATCH],
            row_count: 0,
            splits: false,
            needs_logs: false,
        };
        let mut planned = [false; BATCH];
        // Each request that is not lowered from another starts a chain of those that are lowered one from the other.
        let starts = (0..requests.len()).filter(|&to| !requests.iter().any(|from| lowers(from, &requests[to])));
        for start in starts.chain(0..requests.len()) {
            let mut next = Some(start).filter(|&start| !planned[start]);
            let mut method = own_method(&requests[start]);
            while let Some(place) = next {
                planned[place] = true;
                plan.push(place, method, requests[place].order.min(3));
                next = (0..requests.len()).find(|&to| !planned[to] && lowers(&requests[place], &requests[to]));
                method = WeightMethod::Lowered;
            }
        }
        plan
    }

    /// Appends the step of a request.
    fn push(&mut self, request: usize, method: WeightMethod, order: usize) {
        if let WeightMethod::Split(split) = &method {
            self.splits = true;
            self.needs_logs |= split.needs_logs();
        }
        self.places[request] = (order, self.row_count);
        self.steps[self.count] = PlannedRequest { method, order, row: self.row_count };
        self.row_count += COMPONENTS[order];
        self.count += 1;
    }

    /// How many requests there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many rows the sums of all requests take.
    pub fn row_count(&self) -> usize {
        self.row_count
    }

    /// The order of a request and the place of its first row.
    pub fn place(&self, request: usize) -> (usize, usize) {
        self.places[request]
    }

    /// Adds the moments of the facets in a register of a pack, which count with this area, to that register of the rows
    /// of sums, and their gaps to those that are seen.
    #[inline(always)]
    pub(super) fn add_register<S: Simd>(
        &self,
        (pack, register): (&FacetPack, usize),
        (field, spanned): (&SplatField<S>, F64s<S>),
        seen: &mut GapsSeen<S>,
        (rows, place): (&mut [Row], usize),
    ) {
        match pack.outline {
            Outline::Triangle => {
                let facet = Facet::<S, false>::new(pack, register, field, spanned);
                seen.add(&facet);
                self.add(&facet, place, rows);
            }
            Outline::Parallelogram => {
                let facet = Facet::<S, true>::new(pack, register, field, spanned);
                seen.add(&facet);
                self.add(&facet, place, rows);
            }
        }
    }

    /// Adds the moments of facets to a register of the rows of sums.
    #[inline(always)]
    fn add<S: Simd, const WHOLE: bool>(&self, facet: &Facet<S, WHOLE>, register: usize, sums: &mut [Row]) {
        let mut weights = [F64s::splat(facet.spanned.simd, 0.0); 10];
        let levels = if self.splits { Some(facet.levels(self.needs_logs)) } else { None };
        for step in &self.steps[..self.count] {
            let Some(sums) = sums.get_mut(step.row..) else { return };
            let at = RegisterOfFacets { facet, levels: levels.as_ref(), register };
            match step.order {
                0 => step.add::<S, 0, WHOLE>(&at, &mut weights, sums),
                1 => step.add::<S, 1, WHOLE>(&at, &mut weights, sums),
                2 => step.add::<S, 2, WHOLE>(&at, &mut weights, sums),
                _ => step.add::<S, 3, WHOLE>(&at, &mut weights, sums),
            };
        }
    }
}

/// The method of a request by itself.
fn own_method(request: &MomentRequest) -> WeightMethod {
    let integer = match request.kernel {
        Kernel::Power(exponent) => IntegerExponent::new(exponent, request.order.min(3)),
        Kernel::Log => None,
    };
    integer.map_or_else(|| WeightMethod::Split(SplitKernel::new(request)), WeightMethod::Integer)
}

/// Whether a request has the exponent of another plus one, and a higher order.
fn lowers(from: &MomentRequest, to: &MomentRequest) -> bool {
    match (from.kernel, to.kernel) {
        (Kernel::Power(higher), Kernel::Power(exponent)) => {
            (higher - exponent - 1.0).abs() < SAME_EXPONENT && from.order > to.order
        }
        _ => false,
    }
}

/// The facets of a register, which of the registers of a row it is, and what a split needs.
struct RegisterOfFacets<'a, S: Simd, const WHOLE: bool> {
    facet: &'a Facet<S, WHOLE>,
    levels: Option<&'a LevelSplit<S>>,
    register: usize,
}

impl PlannedRequest {
    /// Finds the weights of its request, up to ORDER, and adds the moments to rows of sums.
    #[inline(always)]
    fn add<S: Simd, const ORDER: usize, const WHOLE: bool>(
        &self,
        at: &RegisterOfFacets<S, WHOLE>,
        weights: &mut Weights<S>,
        sums: &mut [Row],
    ) {
        match (&self.method, at.levels) {
            (WeightMethod::Integer(integer), _) => integer.weights::<S, ORDER, WHOLE>(at.facet, weights),
            (WeightMethod::Split(split), Some(levels)) => split.weights::<S, ORDER, WHOLE>(at.facet, levels, weights),
            _ => lower::<S, ORDER, WHOLE>(weights, at.facet),
        }
        add_tensors::<S, ORDER, WHOLE>(sums, weights, at.facet, at.register);
    }
}

/// Lowers weights from ν + 1 to ν, up to ORDER: J_ab(ν) = d₀ J_ab + (d₁ − d₀) J_(a+1)b + (d₂ − d₀) J_a(b+1), all at ν +
/// 1; every term is positive.
#[inline(always)]
fn lower<S: Simd, const ORDER: usize, const WHOLE: bool>(weights: &mut Weights<S>, facet: &Facet<S, WHOLE>) {
    /// Places of J_(a+1)b and J_a(b+1) for the place of J_ab; they come after it, and are still those of ν + 1.
    const RAISED: [(usize, usize); 6] = [(1, 2), (3, 4), (4, 5), (6, 7), (7, 8), (8, 9)];
    const COUNT: [usize; 4] = [1, 3, 6, 6];
    let [low, middle, high] = facet.gaps;
    let (to_middle, to_high) = (middle - low, high - low);
    for (place, (one, two)) in RAISED.into_iter().enumerate().take(COUNT[ORDER]) {
        weights[place] = (low * weights[place] + to_middle * weights[one]) + to_high * weights[two];
    }
}
