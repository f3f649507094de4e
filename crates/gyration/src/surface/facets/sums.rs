//! The passes over packs: moments of all facets, smallest gap of all vertices.
//!
//! Sums are kept in rows of eight logical lanes, whatever the width of the registers, and folded once, at the end.

use pulp::{Simd, WithSimd};

use super::facet::GapsSeen;
use super::pack::{FacetPack, PointPack, SplatField, Vector};
use super::plan::{FacetPlan, MOST_ROWS};
use crate::simd::{F64s, Row, WIDTH, dispatch, fold, registers_mut};
use crate::surface::{GapField, Moments};
use crate::tensor::{Mat3, Vec3};

/// Adds the moments of a plan over packs to `out`; leaves it alone and returns false if a gap is not positive and
/// finite.
pub(super) fn add_moments(packs: &[FacetPack], field: &GapField, plan: &FacetPlan, out: &mut [Moments]) -> bool {
    add::<false>(&FacetRequest { packs, field, plan, cofactor: &Mat3::identity() }, out)
}

/// The same per deformed area, given the cofactor of P.
pub(super) fn add_deformed(
    packs: &[FacetPack],
    field: &GapField,
    cofactor: &Mat3,
    plan: &FacetPlan,
    out: &mut [Moments],
) -> bool {
    add::<true>(&FacetRequest { packs, field, plan, cofactor }, out)
}

fn add<const DEFORMED: bool>(request: &FacetRequest, out: &mut [Moments]) -> bool {
    // Few rows need not be cleared where few are used.
    match request.plan.row_count() {
        0..=16 => in_rows::<16, DEFORMED>(request, out),
        17..=48 => in_rows::<48, DEFORMED>(request, out),
        _ => in_rows::<MOST_ROWS, DEFORMED>(request, out),
    }
}

fn in_rows<const ROWS: usize, const DEFORMED: bool>(request: &FacetRequest, out: &mut [Moments]) -> bool {
    let mut rows = [[0.0; WIDTH]; ROWS];
    let admissible = dispatch(MomentPass::<DEFORMED> { request, rows: &mut rows });
    if admissible {
        for (place, moments) in out.iter_mut().enumerate() {
            let (order, row) = request.plan.place(place);
            add_folded(moments, &rows[row..], order);
        }
    }
    admissible
}

/// Adds rows of components to moments.
pub(super) fn add_folded(moments: &mut Moments, rows: &[Row], order: usize) {
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

/// What is integrated over which packs.
#[derive(Clone, Copy)]
pub(super) struct FacetRequest<'a> {
    pub packs: &'a [FacetPack],
    pub field: &'a GapField,
    pub plan: &'a FacetPlan,
    /// det P P⁻ᵀ, for deformed areas.
    pub cofactor: &'a Mat3,
}

/// The moments of a plan over packs; whether every gap is positive and finite.
struct MomentPass<'a, const DEFORMED: bool> {
    request: &'a FacetRequest<'a>,
    rows: &'a mut [Row],
}

impl<const DEFORMED: bool> WithSimd for MomentPass<'_, DEFORMED> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let FacetRequest { packs, field, plan, cofactor } = *self.request;
        let field = SplatField::new(simd, field);
        let cofactor = SplatMatrix::new(simd, cofactor);
        let mut seen = GapsSeen::new(simd);
        for pack in packs {
            for register in 0..pack.registers::<S>().min(WIDTH / S::F64_LANES) {
                let spanned = if DEFORMED {
                    length(&cofactor.image(&pack.area_vectors(simd, register)))
                } else {
                    pack.spanned(simd, register)
                };
                plan.add_register((pack, register), (&field, spanned), &mut seen, (self.rows, register));
            }
        }
        seen.are_open()
    }
}

/// A 3×3 matrix in every lane, row by row.
#[derive(Clone, Copy)]
pub(super) struct SplatMatrix<S: Simd>([Vector<S>; 3]);

impl<S: Simd> SplatMatrix<S> {
    // Written out: what `map` calls is not compiled for the instruction set.
    #[inline(always)]
    pub fn new(simd: S, a: &Mat3) -> Self {
        let splat = |x| F64s::splat(simd, x);
        Self([
            [splat(a.m11), splat(a.m12), splat(a.m13)],
            [splat(a.m21), splat(a.m22), splat(a.m23)],
            [splat(a.m31), splat(a.m32), splat(a.m33)],
        ])
    }

    /// The product with vectors.
    #[inline(always)]
    pub fn image(&self, v: &Vector<S>) -> Vector<S> {
        let [x, y, z] = &self.0;
        [dot(x, v), dot(y, v), dot(z, v)]
    }
}

#[inline(always)]
fn dot<S: Simd>(a: &Vector<S>, b: &Vector<S>) -> F64s<S> {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}

/// The lengths of vectors.
#[inline(always)]
pub(super) fn length<S: Simd>(v: &Vector<S>) -> F64s<S> {
    dot(v, v).sqrt()
}

/// The smallest gap and the place of the vertex where it is, the first of several; none if one is not finite.
pub(super) fn smallest_gap(points: &[PointPack], field: &GapField) -> Option<(f64, usize)> {
    dispatch(Smallest { points, field })
}

struct Smallest<'a> {
    points: &'a [PointPack],
    field: &'a GapField,
}

impl WithSimd for Smallest<'_> {
    type Output = Option<(f64, usize)>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let field = SplatField::new(simd, self.field);
        let mut lowest = F64s::splat(simd, f64::INFINITY);
        let mut total = F64s::splat(simd, 0.0);
        let mut step_of_lowest = F64s::splat(simd, 0.0);
        let mut step = 0.0;
        for points in self.points {
            for register in 0..WIDTH / S::F64_LANES {
                let gap = field.gap(&points.load(simd, register));
                let lower = gap.less_than(lowest);
                lowest = lower.select(gap, lowest);
                step_of_lowest = lower.select(F64s::splat(simd, step), step_of_lowest);
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
    use super::super::Facets;
    use super::*;
    use crate::surface::{Kernel, MomentRequest, Surface};
    use pulp::Arch;

    /// The rows of a plan, undeformed and deformed added and folded, and the smallest gap, with one instruction set.
    fn evaluate(arch: Arch, facets: &Facets, field: &GapField, plan: &FacetPlan) -> (Vec<f64>, Option<(f64, usize)>) {
        let mut rows = [[0.0; WIDTH]; MOST_ROWS];
        let cofactor = Mat3::new(1.2, 0.1, -0.2, 0.0, 0.9, 0.15, 0.1, -0.1, 0.8);
        let request = FacetRequest { packs: &facets.packs, field, plan, cofactor: &cofactor };
        assert!(arch.dispatch(MomentPass::<false> { request: &request, rows: &mut rows }));
        assert!(arch.dispatch(MomentPass::<true> { request: &request, rows: &mut rows }));
        (rows.iter().map(fold).collect(), arch.dispatch(Smallest { points: &facets.points, field }))
    }

    fn kernels() -> impl Iterator<Item = Kernel> {
        let powers = [6.0, 7.0, 3.0, 4.0, 6.3, 7.3, 1.0, 2.2, -1.0, 12.0].map(Kernel::Power);
        powers.into_iter().chain([Kernel::Log])
    }

    /// A box, and the same of triangles in an order in which no two behind each other make up a face.
    fn boxes() -> [Facets; 2] {
        let whole = Facets::cuboid(&Vec3::new(0.1, 0.14, 0.2));
        let order = (0..12).step_by(2).chain((1..12).step_by(2));
        let triangles: Vec<_> = order.map(|place| whole.triangles[place]).collect();
        let halves = Facets::new(&whole.vertices, &triangles).unwrap();
        assert_eq!([&whole, &halves].map(|facets| facets.packs.len()), [1, 2]);
        [whole, halves]
    }

    #[test]
    fn faces_are_whole_to_the_last_digit_or_not_at_all() {
        // Off the origin faces stay what they are; corners that are turned are rounded, and off by that.
        let [whole, _] = boxes();
        let moved = whole.transformed(&Mat3::identity(), &Vec3::new(0.3, 1e3, -0.7));
        let turn = *nalgebra::Rotation3::new(Vec3::new(0.4, -1.1, 0.3)).matrix();
        let turned = whole.transformed(&turn, &Vec3::zeros());
        assert_eq!([&whole, &moved, &turned].map(|facets| facets.packs.len()), [1, 1, 2]);
    }

    #[test]
    fn parallelograms_are_two_triangles() {
        let [whole, halves] = boxes();
        let size = 0.25;
        let mut worst: f64 = 0.0;
        let directions = [
            Vec3::z(),
            Vec3::new(1e-9, -3e-9, 1.0),
            Vec3::new(0.6, 0.0, 0.8),
            Vec3::new(-0.3, 0.5, 1.0),
            whole.vertices[5],
        ];
        let leasts = [1e-12, 1e-9, 1e-5, 0.01, 3.0];
        let surface = Surface::from_facets(whole.clone());
        for (direction, least) in directions.iter().flat_map(|along| leasts.map(|least| (along.normalize(), least))) {
            let lowest = whole.smallest_gap(&GapField::new(0.0, direction)).0;
            for field in [GapField::new(least - lowest, direction), surface.field_at(least, direction)] {
                for kernel in kernels() {
                    for order in 0..4 {
                        let requests = [MomentRequest { kernel, order }];
                        let [mut one, mut other] = [[Moments::default()]; 2];
                        whole.moments(&field, &requests, &mut one).unwrap();
                        halves.moments(&field, &requests, &mut other).unwrap();
                        let ([one], [other]) = (one, other);
                        let apart = (one.first - other.first).norm() / size
                            + (one.second - other.second).norm() / size.powi(2)
                            + one.third.0.iter().zip(&other.third.0).map(|(a, b)| (a - b).abs()).sum::<f64>()
                                / size.powi(3);
                        let error = ((one.zeroth - other.zeroth).abs() + apart) / other.zeroth.abs();
                        worst = worst.max(error);
                        assert!(error < 1e-13, "{kernel:?}, order {order}, {direction:?}, {least:e} m: {error:e}");
                    }
                }
            }
        }
        println!("worst relative difference {worst:.1e}");
    }

    #[test]
    fn every_width_gives_the_same_bytes() {
        let directions = [(0.15, Vec3::z()), (0.2, Vec3::new(0.6, 0.0, 0.8)), (3.0, Vec3::x())];
        for ((height, direction), facets) in directions.into_iter().flat_map(|at| boxes().map(|facets| (at, facets))) {
            let field = GapField::new(height, direction);
            for kernel in kernels() {
                for order in 0..4 {
                    let plan = FacetPlan::new(&[MomentRequest { kernel, order }]);
                    let widest = evaluate(Arch::new(), &facets, &field, &plan);
                    let single = evaluate(Arch::Scalar, &facets, &field, &plan);
                    assert_eq!(widest, single, "{kernel:?}, order {order}, height {height}");
                }
            }
        }
    }
}
