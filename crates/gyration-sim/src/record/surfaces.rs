//! The surfaces that a recording shows: each distinct one once, as fixed arrays, and which of them each body and each
//! support with a shape has.
//!
//! `surface_K_points` (m, relative to the centre of mass in the reference placement: p = p₀ + P X) and
//! `surface_K_triangles` (indices of points, counter-clockwise seen from outside). Bodies of equal shape and centre
//! share one. They stand in arrays and not in the attributes, which are written anew at every flush.

use gyration::body::Solid;
use gyration::model::Model;
use gyration::shape::Triangulation;
use gyration_record::{ArraySpec, Dimension, FixedArray};
use std::sync::Arc;

/// Triangles of a surface, where a recording has few of them.
const MOST_TRIANGLES: usize = 1600;
/// Triangles of a surface, where it has many; a body is then small in any picture.
const FEWEST_TRIANGLES: usize = 300;
/// Triangles of all surfaces together, as long as each has the fewest.
const ALL_TRIANGLES: usize = 100_000;

/// Distinct surfaces, and that of each body and support.
#[derive(Debug, Clone)]
pub(crate) struct Surfaces<'a> {
    /// The first solid of each distinct surface.
    distinct: Vec<&'a Arc<Solid>>,
    /// Index of each body's surface; none for points.
    of_body: Vec<Option<usize>>,
    /// The same of each support with a shape.
    of_support: Vec<Option<usize>>,
}

impl<'a> Surfaces<'a> {
    pub(crate) fn of(model: &'a Model) -> Self {
        let mut distinct: Vec<&Arc<Solid>> = Vec::new();
        let mut one = |solid: &'a Arc<Solid>| {
            solid.shape.sharpest_feature()?;
            let alike = |other: &&Arc<Solid>| {
                Arc::ptr_eq(other, solid) || other.shape == solid.shape && other.mass.center == solid.mass.center
            };
            // From the end: equal bodies often stand together.
            let known = distinct.iter().rposition(alike);
            Some(known.unwrap_or_else(|| {
                distinct.push(solid);
                distinct.len() - 1
            }))
        };
        let of_body = model.bodies.iter().map(|body| one(&body.solid)).collect();
        let of_support = model.solid_supports.iter().map(|support| one(&support.solid)).collect();
        Self { distinct, of_body, of_support }
    }

    /// The index of each body's surface; none for points.
    pub(crate) fn of_bodies(&self) -> &[Option<usize>] {
        &self.of_body
    }

    /// The index of the surface of each support with a shape.
    pub(super) fn of_supports(&self) -> &[Option<usize>] {
        &self.of_support
    }

    /// The first solid of each distinct surface.
    pub(crate) fn distinct(&self) -> &[&'a Arc<Solid>] {
        &self.distinct
    }

    /// The fixed arrays of all surfaces.
    pub(super) fn arrays(&self) -> Vec<FixedArray> {
        let each = (ALL_TRIANGLES / self.distinct.len().max(1)).clamp(FEWEST_TRIANGLES, MOST_TRIANGLES);
        let surface = |(k, solid): (usize, &&Arc<Solid>)| {
            let center = solid.mass.center;
            arrays(k, &solid.shape.triangulation(each).mapped(|point| point - center))
        };
        self.distinct.iter().enumerate().flat_map(surface).collect()
    }
}

fn arrays(k: usize, surface: &Triangulation) -> [FixedArray; 2] {
    let spec = |what: &str, size: usize, inner: &str, units: &str, description: &str| ArraySpec {
        name: format!("surface_{k}_{what}s"),
        dims: vec![Dimension::new(format!("surface_{k}_{what}"), size), Dimension::new(inner, 3)],
        units: units.into(),
        description: description.into(),
        columns: Vec::new(),
    };
    let (points, triangles) = (&surface.points, &surface.triangles);
    [
        FixedArray {
            spec: spec("point", points.len(), "row", "m", "points of a surface, relative to the centre of mass"),
            values: points.iter().flat_map(|point| [point.x, point.y, point.z]).collect(),
        },
        FixedArray {
            spec: spec("triangle", triangles.len(), "corner", "1", "points of each triangle, from 0, outward"),
            values: triangles.iter().flatten().map(|&index| index as f64).collect(),
        },
    ]
}
