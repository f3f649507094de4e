//! Flat facets: triangles, over which the contact integrals are exact whatever the gap.
//!
//! The triangles are kept in clusters of a dozen vertices. A call evaluates the gap and its powers once for each
//! vertex of a cluster, on the stack, and then every triangle from its three corners: a box costs eight powers a law at most,
//! a mesh of any size needs no scratch memory.
//!
//! Facets are for polyhedra and meshes: a cylinder made of facets does not roll. X is relative to the centre of mass.

use std::ops::Range;

use super::facets_plan::{BATCH, CLUSTER, Plan};
use super::facets_triangle::{Corner, Triangle, add_tensors};
use super::{GapClosed, GapField, MomentRequest, Moments};
use crate::tensor::{Mat3, Vec3};

/// Triangles with their areas, ready for contact integrals.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facets {
    /// Vertices, cluster after cluster; those on a seam occur once in each cluster.
    vertices: Vec<Vec3>,
    triangles: Vec<Facet>,
    clusters: Vec<Cluster>,
    area: f64,
}

/// A triangle of a cluster.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Facet {
    /// Corners as places in the cluster.
    corners: [u8; 3],
    /// Twice the area [m²].
    twice_area: f64,
}

/// Consecutive vertices and the triangles between them.
#[derive(Debug, Clone, PartialEq)]
struct Cluster {
    vertices: Range<usize>,
    triangles: Range<usize>,
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
        let mut facets = Self::default();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&corner| corner >= vertices.len()) {
                return Err(FacetsError::NoSuchVertex { triangle, vertex, count: vertices.len() });
            }
            facets.push(corners.map(|corner| vertices[corner]));
        }
        Ok(facets)
    }

    /// A box with the given edge lengths [m] about the origin.
    pub fn cuboid(edges: &Vec3) -> Self {
        let mut facets = Self::default();
        for axis in 0..3 {
            for side in [-0.5, 0.5] {
                let corner = |a: f64, b: f64| {
                    let mut unit = Vec3::zeros();
                    unit[axis] = side;
                    unit[(axis + 1) % 3] = a;
                    // Seen from outside both faces turn counter-clockwise.
                    unit[(axis + 2) % 3] = b * side.signum();
                    unit.component_mul(edges)
                };
                let (p, q) = (corner(-0.5, -0.5), corner(0.5, 0.5));
                facets.push([p, corner(0.5, -0.5), q]);
                facets.push([p, q, corner(-0.5, 0.5)]);
            }
        }
        facets
    }

    /// Adds a triangle to the last cluster, or to a new one when that is full.
    fn push(&mut self, corners: [Vec3; 3]) {
        let twice_area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).norm();
        if twice_area <= 0.0 {
            return;
        }
        let room = |cluster: &Cluster| cluster.vertices.len() + 3 <= CLUSTER;
        if !self.clusters.last().is_some_and(room) {
            let (vertex, triangle) = (self.vertices.len(), self.triangles.len());
            self.clusters.push(Cluster { vertices: vertex..vertex, triangles: triangle..triangle });
        }
        let Some(cluster) = self.clusters.last_mut() else { return };
        let corners = corners.map(|corner| {
            let known = &self.vertices[cluster.vertices.clone()];
            let place = known.iter().position(|vertex| *vertex == corner).unwrap_or(known.len());
            if place == known.len() {
                self.vertices.push(corner);
                cluster.vertices.end += 1;
            }
            place as u8
        });
        self.triangles.push(Facet { corners, twice_area });
        cluster.triangles.end += 1;
        self.area += 0.5 * twice_area;
    }

    /// The triangles as corner points [m], in the order given.
    pub fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        self.clusters.iter().flat_map(move |cluster| {
            let points = &self.vertices[cluster.vertices.clone()];
            let facets = self.triangles[cluster.triangles.clone()].iter();
            facets.map(move |facet| facet.corners.map(|corner| points[usize::from(corner)]))
        })
    }

    /// Whether there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// The facets after X ↦ map · X + offset, for any matrix `map`.
    pub fn transformed(&self, map: &Mat3, offset: &Vec3) -> Self {
        let mut facets = Self::default();
        for corners in self.triangles() {
            facets.push(corners.map(|corner| map * corner + offset));
        }
        facets
    }

    /// These facets and those of `other` as one surface.
    pub fn merged(&self, other: &Self) -> Self {
        let mut facets = self.clone();
        for corners in other.triangles() {
            facets.push(corners);
        }
        facets
    }

    /// Area [m²].
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The smallest gap [m] and the vertex where it is; infinite for no facets.
    ///
    /// The first gap that is not finite is returned at once.
    pub fn smallest_gap(&self, field: &GapField) -> (f64, Vec3) {
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

    /// The largest speed |v + A X| [m/s] on the facets; it is convex in X, hence reached at a vertex.
    ///
    /// v velocity at the origin of X (3) [m/s], A = Ṗ (3×3) [1/s].
    pub fn fastest_point(&self, v: &Vec3, a: &Mat3) -> f64 {
        let squared = self.vertices.iter().map(|vertex| (v + a * vertex).norm_squared());
        squared.fold(0.0, f64::max).sqrt()
    }

    /// Adds the moments of `requests` about the origin of X to the entries of `out`.
    ///
    /// `out` has an entry for each request. The relative error, against ∫ |κ| |X|^n dA, is below 1e-10 for exponents from
    /// −1 to 17, of the facets whose vertex gaps are the computed ones.
    ///
    /// # Errors
    /// `GapClosed` if the gap of a vertex is not a positive finite number; `out` is then unchanged.
    pub fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Result<(), GapClosed> {
        debug_assert_eq!(requests.len(), out.len());
        if self.is_empty() {
            return Ok(());
        }
        let (gap, _) = self.smallest_gap(field);
        if !gap.is_finite() || gap <= 0.0 {
            return Err(GapClosed { gap });
        }
        for (requests, out) in requests.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let plan = Plan::new(requests);
            for cluster in &self.clusters {
                self.add_cluster(cluster, field, &plan, out);
            }
        }
        Ok(())
    }

    /// Adds the planned moments over one cluster.
    fn add_cluster(&self, cluster: &Cluster, field: &GapField, plan: &Plan, out: &mut [Moments]) {
        let points = &self.vertices[cluster.vertices.clone()];
        let (mut gaps, mut inverses) = ([1.0; CLUSTER], [1.0; CLUSTER]);
        for ((gap, inverse), point) in gaps.iter_mut().zip(&mut inverses).zip(points) {
            *gap = field.gap(point);
            *inverse = 1.0 / *gap;
        }
        let mut table = plan.table(&gaps[..points.len()]);
        for facet in &self.triangles[cluster.triangles.clone()] {
            let corners = facet.corners.map(|corner| {
                // Always less than CLUSTER; said so that no bound is checked below.
                let place = usize::from(corner) % CLUSTER;
                Corner { place, gap: gaps[place], inverse: inverses[place] }
            });
            let triangle = Triangle::new(corners, points, facet.twice_area);
            plan.visit(&triangle, &mut table, |place, order, weights| {
                add_tensors(&mut out[place], weights, &triangle, order);
            });
        }
    }
}
