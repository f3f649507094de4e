//! The convex hull of points, by the quickhull of `parry3d-f64`; the only module that knows this library.
//!
//! The library takes a cloud for flat if the smallest eigenvalue of its covariance C is below 1e-7 of its squared size, which
//! real plates and needles reach. Hulls are affinely covariant, so a thin cloud is first made round,
//!
//!   Y = Λ^(−½) Eᵀ (X − mean),   C = E Λ Eᵀ,
//!
//! and only the triangles are taken from the library; the vertices are the points that were given. Its result is checked
//! (closed, outward, no point outside) before anybody relies on it.

use std::collections::HashMap;

use gyration::shape::{Polyhedron, PolyhedronError};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::Rotation3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

/// Thickness, relative to size, below which points lie in a plane: their own rounding is 1e-16 of their coordinates.
const FLAT: f64 = 1e-9;
/// Ratio of spreads below which a cloud is made round first; λ = 1e-4 is far from the library's 1e-7.
const THIN: f64 = 1e-2;
/// How often the algorithm is tried, each time in another frame. With one, 52 of 30000 random clouds went wrong (all with
/// dozens of points in a face up to rounding); with four, none of 100000.
const ATTEMPTS: usize = 4;
/// How far a point may lie outside of the result, relative to its size; rounding in the library is 1e-14.
const OUTSIDE: f64 = 1e-9;

/// Points that have no convex hull with a volume.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HullError {
    /// A coordinate is infinite or not a number, or too large to compute with.
    #[error("vertex {vertex} (counted from 0) has the coordinate {value}: it must be finite and below 1e100 m")]
    NotFinite {
        /// Index of the point.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
    /// Fewer than four different points.
    #[error("{distinct} different vertices (of {given}): a polyhedron needs at least 4 that do not lie in a plane")]
    TooFew {
        /// Number of points given.
        given: usize,
        /// Number of different ones.
        distinct: usize,
    },
    /// All points lie in a plane or on a line.
    #[error(
        "the {count} vertices lie {place}: they span {size:e} m, but only {thickness:e} m across; \
         a polyhedron needs a thickness above 1e-9 of its size"
    )]
    Flat {
        /// Number of different points.
        count: usize,
        /// "in a plane" or "on a line".
        place: &'static str,
        /// Extent along the longest principal axis [m].
        size: f64,
        /// Extent along the axis that is too short [m].
        thickness: f64,
    },
    /// The algorithm failed.
    #[error(
        "the convex hull of {count} vertices could not be found ({fault}): leave out vertices that nearly coincide"
    )]
    Failed {
        /// Number of different points.
        count: usize,
        /// What went wrong.
        fault: HullFault,
    },
}

/// What is wrong with the result of the algorithm.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HullFault {
    /// There is none; the library's message.
    #[error("{0}")]
    Algorithm(String),
    /// It is not a closed surface.
    #[error(transparent)]
    Surface(#[from] PolyhedronError),
    /// A point lies outside of it.
    #[error("a vertex lies {height:e} of the size outside")]
    Outside {
        /// Height over a triangle, relative to the size.
        height: f64,
    },
    /// It has a vertex that was not given.
    #[error("it has a vertex that was not given")]
    Foreign,
}

/// The convex hull of `points`: triangles counter-clockwise from outside, on those of the points that are needed.
///
/// Several triangles may share a face. Points within faces and repeated points are allowed.
///
/// # Errors
/// [`HullError`]: no volume, a coordinate that is not finite, or (not seen in the tests) a failure of the algorithm.
pub fn hull(points: &[Vec3]) -> Result<Polyhedron, HullError> {
    check_finite(points)?;
    let distinct = distinct(points);
    let count = distinct.len();
    if count < 4 {
        return Err(HullError::TooFew { given: points.len(), distinct: count });
    }
    let round = made_round(&distinct)?;
    let mut result = triangulated(&round, &distinct, 0);
    for attempt in 1..ATTEMPTS {
        if result.is_ok() {
            break;
        }
        result = triangulated(&round, &distinct, attempt);
    }
    result.map_err(|fault| HullError::Failed { count, fault })
}

/// The hull of `points`, computed on their affine image `round` and, from the second attempt on, in a turned frame.
fn triangulated(round: &[Vec3], points: &[Vec3], attempt: usize) -> Result<Polyhedron, HullFault> {
    // A radian at a time about an axis without a special direction: exact coincidences do not come back.
    let turn = Rotation3::new(Vec3::new(0.48, 0.6, 0.64) * attempt as f64);
    let cloud: Vec<Vector> = round.iter().map(|point| turn * point).map(|p| Vector::new(p.x, p.y, p.z)).collect();
    let (vertices, triangles) = try_convex_hull(&cloud).map_err(|error| HullFault::Algorithm(error.to_string()))?;
    let of_input = original_indices(&cloud, &vertices).ok_or(HullFault::Foreign)?;
    let triangles: Vec<_> = triangles.iter().map(|triangle| triangle.map(|index| index as usize)).collect();
    let corners = |cloud: &[Vec3]| of_input.iter().map(|&index| cloud[index]).collect();
    check_encloses(&Polyhedron { vertices: corners(round), triangles: triangles.clone() }, round)?;
    let result = Polyhedron { vertices: corners(points), triangles };
    result.validate()?;
    Ok(result)
}

fn check_finite(points: &[Vec3]) -> Result<(), HullError> {
    for (vertex, point) in points.iter().enumerate() {
        if let Some(&value) = point.iter().find(|value| value.is_nan() || value.abs() > 1e100) {
            return Err(HullError::NotFinite { vertex, value });
        }
    }
    Ok(())
}

/// The different points in the order of their first appearance.
fn distinct(points: &[Vec3]) -> Vec<Vec3> {
    let mut seen = std::collections::HashSet::with_capacity(points.len());
    points.iter().filter(|point| seen.insert(bits(point.as_slice()))).copied().collect()
}

/// Coordinates as a key; −0 counts as 0.
fn bits(coordinates: &[f64]) -> [u64; 3] {
    std::array::from_fn(|axis| (coordinates[axis] + 0.0).to_bits())
}

/// The points about their mean in units of their size; a thin cloud is also turned to its principal axes and stretched
/// to equal spreads.
fn made_round(points: &[Vec3]) -> Result<Vec<Vec3>, HullError> {
    let first = points[0];
    let size = points.iter().map(|point| (point - first).amax()).fold(0.0, f64::max);
    let mut scaled: Vec<Vec3> = points.iter().map(|point| (point - first) / size).collect();
    let mean = scaled.iter().sum::<Vec3>() / points.len() as f64;
    scaled.iter_mut().for_each(|point| *point -= mean);
    let axes = principal_axes(&scaled);
    let extents = axes.map(|axis| extent(&scaled, &axis));
    for (thickness, place) in [(extents[1], "on a line"), (extents[0], "in a plane")] {
        if thickness <= FLAT * extents[2] {
            let (size, thickness) = (extents[2] * size, thickness * size);
            return Err(HullError::Flat { count: points.len(), place, size, thickness });
        }
    }
    let spreads = axes.map(|axis| spread(&scaled, &axis));
    if spreads[0] > THIN * spreads[2] {
        return Ok(scaled);
    }
    let stretch = |point: Vec3| Vec3::from_fn(|k, _| axes[k].dot(&point) / spreads[k]);
    Ok(scaled.into_iter().map(stretch).collect())
}

/// Principal axes of a cloud about its mean, right-handed, by ascending spread.
fn principal_axes(points: &[Vec3]) -> [Vec3; 3] {
    let covariance: Mat3 = points.iter().map(|point| point * point.transpose()).sum();
    let eigen = covariance.symmetric_eigen();
    let axis = |k: usize| eigen.eigenvectors.column(k).into_owned();
    let mut axes = [axis(0), axis(1), axis(2)];
    // By the extent itself: an eigenvalue resolves it to 1e-8 of the size only.
    axes.sort_by(|a, b| extent(points, a).total_cmp(&extent(points, b)));
    axes[2] = axes[0].cross(&axes[1]);
    axes
}

fn extent(points: &[Vec3], axis: &Vec3) -> f64 {
    let heights = || points.iter().map(|point| point.dot(axis));
    heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
}

/// Root mean square distance from the mean along an axis.
fn spread(points: &[Vec3], axis: &Vec3) -> f64 {
    (points.iter().map(|point| point.dot(axis).powi(2)).sum::<f64>() / points.len() as f64).sqrt()
}

/// Which points of the cloud the hull's vertices are.
fn original_indices(cloud: &[Vector], vertices: &[Vector]) -> Option<Vec<usize>> {
    let by_place: HashMap<[u64; 3], usize> =
        cloud.iter().enumerate().map(|(index, point)| (bits(&point.to_array()), index)).collect();
    vertices.iter().map(|vertex| by_place.get(&bits(&vertex.to_array())).copied()).collect()
}

/// Checks that a surface is closed and that no point lies above any of its triangles.
///
/// The height over a triangle is weighted with its area: the normal of a sliver is rounding.
fn check_encloses(surface: &Polyhedron, points: &[Vec3]) -> Result<(), HullFault> {
    surface.validate()?;
    let size = points.iter().map(|point| point.norm()).fold(0.0, f64::max);
    for triangle in &surface.triangles {
        let [a, b, c] = surface.corners(triangle);
        let normal = (b - a).cross(&(c - a));
        let highest = points.iter().map(|point| normal.dot(&(point - a))).fold(0.0, f64::max);
        if highest > OUTSIDE * size.powi(3) {
            return Err(HullFault::Outside { height: highest / (normal.norm() * size) });
        }
    }
    Ok(())
}
