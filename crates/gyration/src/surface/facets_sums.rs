//! The passes over packs: moments of all triangles, smallest gap of all vertices.
//!
//! Sums are kept in rows of eight logical lanes, whatever the width of the registers, and folded once, at the end.

use pulp::{Simd, WithSimd};

use super::facets_pack::{FieldLanes, Pack, Points};
use super::facets_plan::{MOST_ROWS, Plan};
use super::facets_triangle::Triangle;
use super::lanes::{Lanes, Row, WIDTH, dispatch, fold, registers_mut};
use super::{GapField, Moments};
use crate::tensor::{Mat3, Vec3};

/// Adds the moments of a plan over packs to `out`; leaves it alone and returns false if a gap is not positive and finite.
pub(super) fn add_moments(packs: &[Pack], field: &GapField, plan: &Plan, out: &mut [Moments]) -> bool {
    // Few rows need not be cleared where few are used.
    match plan.row_count() {
        0..=16 => in_rows::<16>(packs, field, plan, out),
        17..=48 => in_rows::<48>(packs, field, plan, out),
        _ => in_rows::<MOST_ROWS>(packs, field, plan, out),
    }
}

fn in_rows<const ROWS: usize>(packs: &[Pack], field: &GapField, plan: &Plan, out: &mut [Moments]) -> bool {
    let mut rows = [[0.0; WIDTH]; ROWS];
    let admissible = dispatch(Integrate { packs, field, plan, rows: &mut rows });
    if admissible {
        for (request, moments) in out.iter_mut().enumerate() {
            let (order, row) = plan.place(request);
            add_folded(moments, &rows[row..], order);
        }
    }
    admissible
}

/// Adds rows of components to moments.
fn add_folded(moments: &mut Moments, rows: &[Row], order: usize) {
    moments.zeroth += fold(&rows[0]);
    if order >= 1 {
        moments.first += Vec3::new(fold(&rows[1]), fold(&rows[2]), fold(&rows[3]));
    }
    if order >= 2 {
        let (xx, xy, xz) = (fold(&rows[4]), fold(&rows[5]), fold(&rows[6]));
        let (yy, yz, zz) = (fold(&rows[7]), fold(&rows[8]), fold(&rows[9]));
        moments.second += Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    }
    if order >= 3 {
        for (sum, row) in moments.third.0.iter_mut().zip(&rows[10..]) {
            *sum += fold(row);
        }
    }
}

/// The moments of a plan over packs; whether every gap is positive and finite.
struct Integrate<'a> {
    packs: &'a [Pack],
    field: &'a GapField,
    plan: &'a Plan,
    rows: &'a mut [Row],
}

impl WithSimd for Integrate<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let field = FieldLanes::new(simd, self.field);
        let mut lowest = Lanes::splat(simd, f64::INFINITY);
        let mut total = Lanes::splat(simd, 0.0);
        for pack in self.packs {
            for register in 0..pack.registers::<S>().min(WIDTH / S::F64_LANES) {
                let triangle = Triangle::new(pack, simd, register, &field);
                let [low, middle, high] = triangle.gaps;
                lowest = low.less_than(lowest).select(low, lowest);
                total += (low + middle) + high;
                self.plan.add(&triangle, register, self.rows);
            }
        }
        // A sum of gaps is finite if all of them are; what is smaller than a normal number has no reciprocal.
        let mut sums = [0.0; WIDTH];
        total.add_to(&mut sums, 0);
        lowest.smallest() >= f64::MIN_POSITIVE && fold(&sums).is_finite()
    }
}

/// The smallest gap and the place of the vertex where it is, the first of several; none if one is not finite.
pub(super) fn smallest_gap(points: &[Points], field: &GapField) -> Option<(f64, usize)> {
    dispatch(Smallest { points, field })
}

struct Smallest<'a> {
    points: &'a [Points],
    field: &'a GapField,
}

impl WithSimd for Smallest<'_> {
    type Output = Option<(f64, usize)>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let field = FieldLanes::new(simd, self.field);
        let mut lowest = Lanes::splat(simd, f64::INFINITY);
        let mut total = Lanes::splat(simd, 0.0);
        let mut step_of_lowest = Lanes::splat(simd, 0.0);
        let mut step = 0.0;
        for points in self.points {
            for register in 0..WIDTH / S::F64_LANES {
                let gap = field.gap(&points.load(simd, register));
                let lower = gap.less_than(lowest);
                lowest = lower.select(gap, lowest);
                step_of_lowest = lower.select(Lanes::splat(simd, step), step_of_lowest);
                total += gap;
                step += 1.0;
            }
        }
        let (mut gaps, mut steps, mut totals) = ([0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH]);
        registers_mut::<S>(&mut gaps)[0] = lowest.values;
        registers_mut::<S>(&mut steps)[0] = step_of_lowest.values;
        registers_mut::<S>(&mut totals)[0] = total.values;
        if !fold(&totals).is_finite() {
            return None;
        }
        let mut best = (f64::INFINITY, usize::MAX);
        for lane in 0..S::F64_LANES {
            let candidate = (gaps[lane], steps[lane] as usize * S::F64_LANES + lane);
            if candidate.0 < best.0 || (candidate.0 == best.0 && candidate.1 < best.1) {
                best = candidate;
            }
        }
        Some(best)
    }
}

#[cfg(test)]
mod tests {
    use super::super::facets::Facets;
    use super::super::{Kernel, MomentRequest};
    use super::*;
    use pulp::Arch;

    /// The rows of a plan, folded, and the smallest gap, with one instruction set.
    fn evaluate(arch: Arch, facets: &Facets, field: &GapField, plan: &Plan) -> (Vec<f64>, Option<(f64, usize)>) {
        let mut rows = [[0.0; WIDTH]; MOST_ROWS];
        assert!(arch.dispatch(Integrate { packs: facets.packs(), field, plan, rows: &mut rows }));
        (rows.iter().map(fold).collect(), arch.dispatch(Smallest { points: facets.points(), field }))
    }

    #[test]
    fn every_width_gives_the_same_bytes() {
        let kernels = [6.0, 7.0, 3.0, 4.0, 6.3, 7.3, 1.0, 2.2, -1.0].map(Kernel::Power);
        // A turned box: sixteen registers of one triangle, or two of eight with places to spare.
        let turn = *nalgebra::Rotation3::new(Vec3::new(0.4, -1.1, 0.3)).matrix();
        let facets = Facets::cuboid(&Vec3::new(0.1, 0.14, 0.2)).transformed(&turn, &Vec3::zeros());
        for (height, direction) in [(0.15, Vec3::z()), (0.2, Vec3::new(0.6, 0.0, 0.8)), (3.0, turn * Vec3::x())] {
            let field = GapField { height, direction };
            for kernel in kernels.into_iter().chain([Kernel::Log]) {
                for order in 0..4 {
                    let plan = Plan::new(&[MomentRequest { kernel, order }]);
                    let widest = evaluate(Arch::new(), &facets, &field, &plan);
                    let single = evaluate(Arch::Scalar, &facets, &field, &plan);
                    assert_eq!(widest, single, "{kernel:?}, order {order}, height {height}");
                }
            }
        }
    }
}
