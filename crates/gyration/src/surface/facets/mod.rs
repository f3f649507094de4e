//! Flat facets: triangles, over which the contact integrals are exact whatever the gap.
//!
//! Two that stand behind each other and make up a parallelogram, as the faces of a box do, are integrated as one.
//! Facets are kept in packs of eight, corner by corner and component by component (`pack`), and a call works on as many
//! of them at once as the registers of the processor hold (`simd`): gaps, corners put in order, the weights of each
//! request (`plan`), tensors, sums. A mesh of any size needs no scratch memory.
//!
//! Facets are for polyhedra and meshes: a cylinder made of facets does not roll. X is relative to the centre of mass.

mod facet;
mod integer;
mod oriented;
mod pack;
mod plan;
mod split;
mod sums;

pub(crate) use plan::{BATCH, FacetPlan};

use crate::simd::WIDTH;
use crate::surface::{GapClosed, GapField, MomentRequest, Moments, OrientedMoments};
use crate::tensor::{Mat3, Vec3};
use oriented::add_oriented;
use pack::{Corners, FacetPack, Outline, PointPack};
use sums::{add_deformed, add_moments, smallest_gap};

/// Vertices from which on registers pay.
const MANY: usize = 32;

/// Triangles with their areas, ready for contact integrals.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facets {
    /// The vertices that triangles use.
    vertices: Vec<Vec3>,
    /// Triangles as places of vertices.
    triangles: Vec<[usize; 3]>,
    points: Vec<PointPack>,
    packs: Vec<FacetPack>,
    area: f64,
}

/// What is wrong with a list of triangles.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum FacetsError {
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} names vertex {vertex}, but there are only {count} vertices (the first is 0)")]
    NoSuchVertex {
        /// Place of the triangle in its list.
        triangle: usize,
        /// The index it names.
        vertex: usize,
        /// How many vertices there are.
        count: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// Place of the vertex in its list.
        vertex: usize,
    },
}

impl Facets {
    /// Facets from vertices [m] and triangles (corner indices, counter-clockwise seen from outside).
    ///
    /// Vertices that no triangle uses and triangles without area make no contact and are dropped.
    ///
    /// # Errors
    /// `NoSuchVertex`, `NotFinite`.
    pub fn new(vertices: &[Vec3], triangles: &[[usize; 3]]) -> Result<Self, FacetsError> {
        if let Some(vertex) = vertices.iter().position(|point| !point.iter().all(|x| x.is_finite())) {
            return Err(FacetsError::NotFinite { vertex });
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&corner| corner >= vertices.len()) {
                return Err(FacetsError::NoSuchVertex { triangle, vertex, count: vertices.len() });
            }
        }
        Ok(Self::packed(vertices, triangles))
    }

    /// A box with the given edge lengths [m] about the origin.
    pub fn cuboid(edges: &Vec3) -> Self {
        // Bit i of a vertex's place tells on which side of axis i it is.
        let side = |place: usize, axis: usize| if place >> axis & 1 == 1 { 0.5 } else { -0.5 };
        let vertices: Vec<Vec3> =
            (0..8).map(|place| Vec3::from_fn(|axis, _| side(place, axis)).component_mul(edges)).collect();
        let mut triangles = Vec::with_capacity(12);
        for axis in 0..3 {
            let (one, two) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
            // Seen from outside both faces turn counter-clockwise.
            for (base, second, fourth) in [(0, two, one), (1 << axis, one, two)] {
                let opposite = base + one + two;
                triangles.push([base, base + second, opposite]);
                triangles.push([base, opposite, base + fourth]);
            }
        }
        Self::packed(&vertices, &triangles)
    }

    /// Lays out triangles whose corners exist.
    fn packed(vertices: &[Vec3], triangles: &[[usize; 3]]) -> Self {
        let mut facets = Self::default();
        let mut places = vec![None; vertices.len()];
        let mut proper = Vec::with_capacity(triangles.len());
        for corners in triangles {
            let [a, b, c] = corners.map(|corner| vertices[corner]);
            let area_vector = (b - a).cross(&(c - a));
            if area_vector.norm() <= 0.0 {
                continue;
            }
            facets.triangles.push(corners.map(|corner| {
                *places[corner].get_or_insert_with(|| {
                    facets.vertices.push(vertices[corner]);
                    facets.vertices.len() - 1
                })
            }));
            proper.push([a, b, c]);
            facets.area += 0.5 * area_vector.norm();
        }
        facets.points = facets.vertices.chunks(WIDTH).map(PointPack::new).collect();
        let (mut parallelograms, mut alone) = (Vec::new(), Vec::new());
        let mut rest = &proper[..];
        while let [first, others @ ..] = rest {
            if let Some(joined) = others.first().and_then(|second| Corners::joined(first, second)) {
                parallelograms.push(joined);
                rest = &others[1..];
            } else {
                let [a, b, c] = *first;
                alone.push(Corners([a, b, c, c]));
                rest = others;
            }
        }
        let packed = |outline| move |facets: &[Corners]| FacetPack::new(outline, facets);
        facets.packs = parallelograms.chunks(WIDTH).map(packed(Outline::Parallelogram)).collect();
        facets.packs.extend(alone.chunks(WIDTH).map(packed(Outline::Triangle)));
        facets
    }

    /// The triangles as corner points [m], in the order given.
    pub fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        self.triangles.iter().map(|corners| corners.map(|corner| self.vertices[corner]))
    }

    /// Whether there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The facets after X ↦ map · X + offset, for any matrix `map`.
    pub fn transformed(&self, map: &Mat3, offset: &Vec3) -> Self {
        let vertices: Vec<Vec3> = self.vertices.iter().map(|vertex| map * vertex + offset).collect();
        Self::packed(&vertices, &self.triangles)
    }

    /// These facets and those of `other` as one surface.
    pub fn merged(&self, other: &Self) -> Self {
        let shift = self.vertices.len();
        let shifted = other.triangles.iter().map(|corners| corners.map(|corner| corner + shift));
        let triangles: Vec<_> = self.triangles.iter().copied().chain(shifted).collect();
        Self::packed(&[self.vertices.as_slice(), &other.vertices].concat(), &triangles)
    }

    /// Area [m²].
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The smallest gap [m] and the vertex where it is, the first of several; infinite for no facets.
    ///
    /// The first gap that is not finite is returned at once.
    pub fn smallest_gap(&self, field: &GapField) -> (f64, Vec3) {
        let in_registers = self.vertices.len() >= MANY || field.lack.is_some();
        if in_registers && let Some((gap, place)) = smallest_gap(&self.points, field) {
            return (gap, self.vertices.get(place).copied().unwrap_or_default());
        }
        let mut smallest = (f64::INFINITY, Vec3::zeros());
        for vertex in &self.vertices {
            let gap = field.gap(vertex);
            if !gap.is_finite() {
                return (gap, *vertex);
            }
            if gap < smallest.0 {
                smallest = (gap, *vertex);
            }
        }
        smallest
    }

    /// Whether the gaps of all vertices are finite and above a floor [m].
    #[inline]
    pub(super) fn are_above(&self, field: &GapField, floor: f64) -> bool {
        let fits = |gap: f64| gap > floor && gap < f64::INFINITY;
        if self.vertices.len() < MANY {
            self.vertices.iter().all(|vertex| fits(field.gap(vertex)))
        } else {
            fits(self.smallest_gap(field).0)
        }
    }

    /// The largest speed |v + A X| [m/s] on the facets; it is convex in X, hence reached at a vertex.
    ///
    /// v velocity at the origin of X (3) [m/s], A = Ṗ (3×3) [1/s].
    pub fn fastest_point(&self, v: &Vec3, a: &Mat3) -> f64 {
        let squared = self.vertices.iter().map(|vertex| (v + a * vertex).norm_squared());
        squared.fold(0.0, f64::max).sqrt()
    }

    /// Adds the moments of `requests` about the origin of X to the entries of `out`.
    ///
    /// `out` has an entry for each request. The relative error, against ∫ |κ| |X|^n dA, is below 1e-10 for exponents
    /// from −1 to 17, of the facets whose vertex gaps are the computed ones.
    ///
    /// # Errors
    /// `GapClosed` if the gap of a vertex is not a positive, normal, finite number; `out` is then unchanged, if there
    /// are no more than four requests.
    pub fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Result<(), GapClosed> {
        debug_assert_eq!(requests.len(), out.len());
        if self.is_empty() {
            return Ok(());
        }
        for (requests, out) in requests.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            self.add_planned(field, &FacetPlan::new(requests), out)?;
        }
        Ok(())
    }

    /// Adds the moments of a plan to the entries of `out`.
    pub(super) fn add_planned(&self, field: &GapField, plan: &FacetPlan, out: &mut [Moments]) -> Result<(), GapClosed> {
        let open = self.is_empty() || add_moments(&self.packs, field, plan, out);
        self.closed_unless(open, field)
    }

    /// The same per deformed area, given the cofactor of P.
    pub(super) fn add_deformed(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        plan: &FacetPlan,
        out: &mut [Moments],
    ) -> Result<(), GapClosed> {
        let open = self.is_empty() || add_deformed(&self.packs, field, cofactor, plan, out);
        self.closed_unless(open, field)
    }

    /// The same weighted with the dyads of the current normals.
    pub(super) fn add_oriented(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        plan: &FacetPlan,
        out: &mut [OrientedMoments],
    ) -> Result<(), GapClosed> {
        let open = self.is_empty() || add_oriented(&self.packs, field, cofactor, plan, out);
        self.closed_unless(open, field)
    }

    fn closed_unless(&self, open: bool, field: &GapField) -> Result<(), GapClosed> {
        if open { Ok(()) } else { Err(GapClosed { gap: self.smallest_gap(field).0 }) }
    }
}
