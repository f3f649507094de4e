//! Moments over deformed facets weighted with products of the components of their current normals.
//!
//! The deformed facet has the area vector v = cof(P) E₁×E₂, hence the area factor k = |v|/|E₁×E₂| and the normal m =
//! v/|v|, both constant: moments weighted with m_a m_b are those of the facet times that number. So the plan runs once
//! on a register of facets, into rows of its own, and the rows are multiplied and added to those of the six pairs, lane
//! by lane. For requests of order 0 the fifteen products of four components are formed likewise.

use pulp::{Simd, WithSimd};

use super::facet::GapsSeen;
use super::pack::{FacetPack, SplatField, Vector};
use super::plan::{BATCH, FacetPlan, MOST_ROWS};
use super::sums::{FacetRequest, SplatMatrix, add_folded, length};
use crate::simd::{F64s, Row, WIDTH, dispatch, fold};
use crate::surface::oriented::{FOURTH, PAIRS};
use crate::surface::{GapField, OrientedMoments};
use crate::tensor::Mat3;

/// Adds the oriented moments of a plan to `out`; leaves it alone and returns false if a gap is not positive and finite.
pub(super) fn add_oriented(
    packs: &[FacetPack],
    field: &GapField,
    cofactor: &Mat3,
    plan: &FacetPlan,
    out: &mut [OrientedMoments],
) -> bool {
    let request = FacetRequest { packs, field, plan, cofactor };
    match plan.row_count() {
        0..=16 => in_rows::<16>(&request, out),
        17..=48 => in_rows::<48>(&request, out),
        _ => in_rows::<MOST_ROWS>(&request, out),
    }
}

fn in_rows<const ROWS: usize>(request: &FacetRequest, out: &mut [OrientedMoments]) -> bool {
    let mut own = [[0.0; WIDTH]; ROWS];
    let mut pairs = [[[0.0; WIDTH]; ROWS]; PAIRS.len()];
    let mut fourth = [[[0.0; WIDTH]; FOURTH.len()]; BATCH];
    let [a, b, c, d, e, f] = &mut pairs;
    let views: [&mut [Row]; PAIRS.len()] = [a, b, c, d, e, f];
    if !dispatch(OrientedPass { request, own: &mut own, pairs: views, fourth: &mut fourth }) {
        return false;
    }
    for (place, (moments, fourth)) in out.iter_mut().zip(&fourth).enumerate() {
        let (order, row) = request.plan.place(place);
        for (moments, rows) in moments.pairs.iter_mut().zip(&pairs) {
            add_folded(moments, &rows[row..], order);
        }
        for (sum, row) in moments.fourth.iter_mut().zip(fourth) {
            *sum += fold(row);
        }
    }
    true
}

/// The pass over packs; whether every gap is positive and finite.
struct OrientedPass<'a> {
    request: &'a FacetRequest<'a>,
    /// Rows of one register of facets.
    own: &'a mut [Row],
    /// The same weighted with the pairs, summed over all facets.
    pairs: [&'a mut [Row]; PAIRS.len()],
    fourth: &'a mut [[Row; FOURTH.len()]; BATCH],
}

impl WithSimd for OrientedPass<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> bool {
        let FacetRequest { packs, field, plan, cofactor } = *self.request;
        let field = SplatField::new(simd, field);
        let cofactor = SplatMatrix::new(simd, cofactor);
        let mut seen = GapsSeen::new(simd);
        for pack in packs {
            for register in 0..pack.registers::<S>().min(WIDTH / S::F64_LANES) {
                let vector = cofactor.image(&pack.area_vectors(simd, register));
                let spanned = length(&vector);
                let used = plan.row_count().min(self.own.len());
                self.own[..used].fill([0.0; WIDTH]);
                plan.add_register((pack, register), (&field, spanned), &mut seen, (self.own, 0));
                self.add(&products(&vector, spanned), used, register);
            }
        }
        seen.are_open()
    }
}

impl OrientedPass<'_> {
    /// Adds the rows of one register of facets, weighted with the products m_a m_b and their squares.
    #[inline(always)]
    fn add<S: Simd>(&mut self, products: &[F64s<S>; PAIRS.len()], used: usize, register: usize) {
        let simd = products[0].simd;
        for (product, rows) in products.iter().zip(&mut self.pairs) {
            for (own, sum) in self.own[..used].iter().zip(rows.iter_mut()) {
                (*product * F64s::load(simd, own, 0)).add_to(sum, register);
            }
        }
        for (request, sums) in self.fourth.iter_mut().enumerate().take(self.request.plan.count()) {
            let (order, row) = self.request.plan.place(request);
            if order == 0 {
                let own = F64s::load(simd, &self.own[row], 0);
                for (sum, (one, other)) in sums.iter_mut().zip(FOURTH_PRODUCTS) {
                    (products[one] * products[other] * own).add_to(sum, register);
                }
            }
        }
    }
}

/// The components of the fourth power as products of two of the pairs.
const FOURTH_PRODUCTS: [(usize, usize); FOURTH.len()] = {
    let mut products = [(0, 0); FOURTH.len()];
    let mut place = 0;
    while place < FOURTH.len() {
        let [a, b, c, d] = FOURTH[place];
        products[place] = (pair(a, b), pair(c, d));
        place += 1;
    }
    products
};

/// The place of ab, a ≤ b, in xx, xy, xz, yy, yz, zz.
const fn pair(a: usize, b: usize) -> usize {
    a * (5 - a) / 2 + b
}

/// m_a m_b from the area vectors; those of facets without area, which have no normal, are zero.
#[inline(always)]
fn products<S: Simd>(vector: &Vector<S>, length: F64s<S>) -> [F64s<S>; PAIRS.len()] {
    let zero = F64s::splat(length.simd, 0.0);
    let inverse = zero.less_than(length).select(1.0 / length, zero);
    let [x, y, z] = [vector[0] * inverse, vector[1] * inverse, vector[2] * inverse];
    [x * x, x * y, x * z, y * y, y * z, z * z]
}
