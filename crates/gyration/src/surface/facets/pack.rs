//! Triangles and vertices laid out for lanes: eight of each in a pack, component by component.
//!
//! A pack of triangles holds the coordinates of its corners, so that nothing is gathered in a call: the gaps of a
//! vertex are computed anew in every triangle that it belongs to, by the same operations, to the same bytes. Unused
//! places repeat the last triangle without its area, or the last vertex. A body that deforms needs the area vectors 2A
//! N too: their images under the cofactor of P are those of the deformed triangles.

use pulp::Simd;

use crate::simd::{F64s, Row, WIDTH};
use crate::surface::GapField;
use crate::surface::gap::GapLack;
use crate::tensor::Vec3;

/// Three components in lanes.
pub(super) type Vector<S> = [F64s<S>; 3];

/// Eight points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PointPack(pub [Row; 3]);

/// Eight triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(super) struct TrianglePack {
    corners: [PointPack; 3],
    twice_area: Row,
    area_vectors: PointPack,
    used: usize,
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

impl TrianglePack {
    /// The triangles given by corners and twice the area vector [m²]; at most eight.
    pub fn new(triangles: &[([Vec3; 3], Vec3)]) -> Self {
        let corner = |k: usize| {
            let points: Vec<Vec3> = triangles.iter().map(|(corners, _)| corners[k]).collect();
            PointPack::new(&points)
        };
        let (mut twice_area, mut area_vectors) = ([0.0; WIDTH], [Vec3::zeros(); WIDTH]);
        for (place, (_, vector)) in triangles.iter().enumerate().take(WIDTH) {
            (twice_area[place], area_vectors[place]) = (vector.norm(), *vector);
        }
        Self {
            corners: [corner(0), corner(1), corner(2)],
            twice_area,
            area_vectors: PointPack::new(&area_vectors),
            used: triangles.len(),
        }
    }

    /// How many registers of this width the triangles fill.
    #[inline(always)]
    pub fn registers<S: Simd>(&self) -> usize {
        self.used.div_ceil(S::F64_LANES)
    }

    /// The corners of the triangles in a register.
    #[inline(always)]
    pub fn corners<S: Simd>(&self, simd: S, register: usize) -> [Vector<S>; 3] {
        let [a, b, c] = &self.corners;
        [a.load(simd, register), b.load(simd, register), c.load(simd, register)]
    }

    /// Twice the areas of the triangles in a register [m²].
    #[inline(always)]
    pub fn twice_area<S: Simd>(&self, simd: S, register: usize) -> F64s<S> {
        F64s::load(simd, &self.twice_area, register)
    }

    /// Twice the area vectors of the triangles in a register [m²].
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
