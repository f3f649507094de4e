//! Facets and vertices laid out for lanes: eight of each in a pack, component by component.
//!
//! A pack of facets, all of them triangles or all parallelograms, holds the coordinates of its corners, so that nothing
//! is gathered in a call: the gaps of a vertex are computed anew in every facet that it belongs to, by the same
//! operations, to the same bytes. Unused places repeat the last facet without its area, or the last vertex. A body that
//! deforms needs the area vectors E₁×E₂ too: their images under the cofactor of P are those of the deformed facets.

use pulp::Simd;

use crate::extended::Extended;
use crate::simd::{F64s, Row, WIDTH};
use crate::surface::GapField;
use crate::surface::gap::GapLack;
use crate::tensor::Vec3;

/// Three components in lanes.
pub(super) type Vector<S> = [F64s<S>; 3];

/// Eight points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PointPack(pub [Row; 3]);

/// What facets are bounded by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outline {
    Triangle,
    Parallelogram,
}

/// A facet from its corners: a, a + E₁, a + E₂ and, of a parallelogram, the one opposite to a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corners(pub [Vec3; 4]);

/// Eight facets of one outline.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct FacetPack {
    pub outline: Outline,
    corners: [PointPack; 4],
    /// |E₁×E₂| [m²].
    spanned: Row,
    area_vectors: PointPack,
    used: usize,
}

impl Corners {
    /// E₁×E₂ [m²].
    pub fn area_vector(&self) -> Vec3 {
        let [a, b, c, _] = self.0;
        (b - a).cross(&(c - a))
    }

    /// The parallelogram that two triangles next to each other make up, if it is one to the last digit: gaps may have
    /// twice the digits of corners, and a face that is twisted by their rounding has no energy of which its forces are.
    pub fn joined(one: &[Vec3; 3], other: &[Vec3; 3]) -> Option<Self> {
        // The corner of each that the other has not.
        let alone = |own: &[Vec3; 3], other: &[Vec3; 3]| {
            let mut alone = (0..3).filter(|corner| !other.contains(&own[*corner]));
            Some(alone.next()?).filter(|_| alone.next().is_none())
        };
        let (from, opposite) = (alone(one, other)?, other[alone(other, one)?]);
        let [a, b, c] = [one[from], one[(from + 1) % 3], one[(from + 2) % 3]];
        let is_flat = (0..3).all(|axis| Extended::sum(b[axis], c[axis]) == Extended::sum(a[axis], opposite[axis]));
        is_flat.then_some(Self([a, b, c, opposite]))
    }
}

impl PointPack {
    /// The points given, at most eight, the last one repeated.
    pub fn new(points: &[Vec3]) -> Self {
        let mut rows = [[0.0; WIDTH]; 3];
        for place in 0..WIDTH {
            if let Some(point) = points.get(place).or(points.last()) {
                for (row, x) in rows.iter_mut().zip(point) {
                    row[place] = *x;
                }
            }
        }
        Self(rows)
    }

    /// The register of points at this place.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, register: usize) -> Vector<S> {
        let [x, y, z] = &self.0;
        [F64s::load(simd, x, register), F64s::load(simd, y, register), F64s::load(simd, z, register)]
    }
}

impl FacetPack {
    /// At most eight facets.
    pub fn new(outline: Outline, facets: &[Corners]) -> Self {
        let corner = |k: usize| {
            let points: Vec<Vec3> = facets.iter().map(|Corners(corners)| corners[k]).collect();
            PointPack::new(&points)
        };
        let (mut spanned, mut area_vectors) = ([0.0; WIDTH], [Vec3::zeros(); WIDTH]);
        for (place, corners) in facets.iter().enumerate().take(WIDTH) {
            let vector = corners.area_vector();
            (spanned[place], area_vectors[place]) = (vector.norm(), vector);
        }
        Self {
            outline,
            corners: [corner(0), corner(1), corner(2), corner(3)],
            spanned,
            area_vectors: PointPack::new(&area_vectors),
            used: facets.len(),
        }
    }

    /// How many registers of this width the facets fill.
    #[inline(always)]
    pub fn registers<S: Simd>(&self) -> usize {
        self.used.div_ceil(S::F64_LANES)
    }

    /// The first three corners of the facets in a register.
    #[inline(always)]
    pub fn corners<S: Simd>(&self, simd: S, register: usize) -> [Vector<S>; 3] {
        let [a, b, c, _] = &self.corners;
        [a.load(simd, register), b.load(simd, register), c.load(simd, register)]
    }

    /// The corners of parallelograms that are opposite to the first.
    #[inline(always)]
    pub fn opposite<S: Simd>(&self, simd: S, register: usize) -> Vector<S> {
        self.corners[3].load(simd, register)
    }

    /// |E₁×E₂| of the facets in a register [m²].
    #[inline(always)]
    pub fn spanned<S: Simd>(&self, simd: S, register: usize) -> F64s<S> {
        F64s::load(simd, &self.spanned, register)
    }

    /// E₁×E₂ of the facets in a register [m²].
    #[inline(always)]
    pub fn area_vectors<S: Simd>(&self, simd: S, register: usize) -> Vector<S> {
        self.area_vectors.load(simd, register)
    }
}

/// A gap field in every lane.
#[derive(Clone, Copy)]
pub(super) struct SplatField<S: Simd> {
    height: F64s<S>,
    direction: Vector<S>,
    lack: Option<(F64s<S>, Vector<S>)>,
}

impl<S: Simd> SplatField<S> {
    #[inline(always)]
    pub fn new(simd: S, field: &GapField) -> Self {
        let m = &field.direction;
        let splat = |x| F64s::splat(simd, x);
        let mut lack = None;
        if let Some(GapLack { height, direction: m }) = &field.lack {
            lack = Some((splat(*height), [splat(m.x), splat(m.y), splat(m.z)]));
        }
        Self { height: splat(field.height), direction: [splat(m.x), splat(m.y), splat(m.z)], lack }
    }

    /// The gaps of three points.
    #[inline(always)]
    pub fn gaps(&self, points: &[Vector<S>; 3]) -> [F64s<S>; 3] {
        let [a, b, c] = points;
        match &self.lack {
            None => [self.rounded_gap(a), self.rounded_gap(b), self.rounded_gap(c)],
            Some(lack) => {
                let mut gaps = [self.height; 3];
                for (gap, point) in gaps.iter_mut().zip(points) {
                    *gap = self.extended_gap(point, lack);
                }
                gaps
            }
        }
    }

    /// The gaps to twice the digits, rounded at the end.
    #[inline(always)]
    fn extended_gap(&self, [x, y, z]: &Vector<S>, (height, [lx, ly, lz]): &(F64s<S>, Vector<S>)) -> F64s<S> {
        let [mx, my, mz] = self.direction;
        let (first, second, third) = (mx.exact_product(*x), my.exact_product(*y), mz.exact_product(*z));
        let (sum, lost_first) = first.0.exact_sum(second.0);
        let (sum, lost_second) = sum.exact_sum(third.0);
        let (sum, lost_third) = self.height.exact_sum(sum);
        let products = (first.1 + second.1) + third.1;
        let lacks = *height + ((*lx * *x + *ly * *y) + *lz * *z);
        sum + (((lost_first + lost_second) + lost_third) + (products + lacks))
    }

    /// The gaps g₀ + m·X [m] of one point in each lane.
    #[inline(always)]
    pub fn gap(&self, point: &Vector<S>) -> F64s<S> {
        match &self.lack {
            None => self.rounded_gap(point),
            Some(lack) => self.extended_gap(point, lack),
        }
    }

    /// The gaps g₀ + m·X [m], rounded as [`GapField::gap`] does.
    #[inline(always)]
    fn rounded_gap(&self, [x, y, z]: &Vector<S>) -> F64s<S> {
        let [mx, my, mz] = self.direction;
        self.height + ((mx * *x + my * *y) + mz * *z)
    }
}
