//! Lines and points by which a picture shows a shape: a wireframe, and points whose projected hull is the silhouette.
//!
//! Nothing of the mechanics depends on them. Curves are chords of [`CIRCLE_POINTS`] points; a sphere of directions is
//! the Fibonacci lattice, whose points are evenly spread and need no poles.

use std::f64::consts::{PI, TAU};

use crate::tensor::{Mat3, Vec3};

/// Points on a drawn circle; the chords stay within 0.2 % of the radius.
pub(super) const CIRCLE_POINTS: usize = 48;
/// Upper limit of the points that describe a silhouette.
pub const SILHOUETTE_POINTS: usize = 400;

/// A wireframe in the frame of its shape.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outline {
    /// The points \[m\].
    pub points: Vec<Vec3>,
    /// Lines through points, by index; closed ones repeat their first point at the end.
    pub polylines: Vec<Vec<usize>>,
}

impl Outline {
    /// Adds an open line through new points.
    pub(super) fn add_line(&mut self, points: impl IntoIterator<Item = Vec3>) {
        let first = self.points.len();
        self.points.extend(points);
        self.polylines.push((first..self.points.len()).collect());
    }

    /// Adds the ellipse `center + cos φ u + sin φ v`, closed.
    pub(super) fn add_ellipse(&mut self, center: Vec3, u: Vec3, v: Vec3) {
        let first = self.points.len();
        self.points.extend(ellipse(CIRCLE_POINTS, center, u, v));
        self.polylines.push((first..self.points.len()).chain([first]).collect());
    }

    /// Adds another outline turned by `rotation` and then shifted by `offset`.
    pub fn add_transformed(&mut self, other: &Self, rotation: &Mat3, offset: &Vec3) {
        let first = self.points.len();
        self.points.extend(other.points.iter().map(|point| rotation * point + offset));
        let shifted = |line: &Vec<usize>| line.iter().map(|index| index + first).collect();
        self.polylines.extend(other.polylines.iter().map(shifted));
    }
}

/// `count` points of the ellipse `center + cos φ u + sin φ v`, without repeating the first.
pub(super) fn ellipse(count: usize, center: Vec3, u: Vec3, v: Vec3) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |k| {
        let (sine, cosine) = libm::sincos(TAU * k as f64 / count as f64);
        center + u * cosine + v * sine
    })
}

/// `count` points of the circle of radius `radius` about the z axis at the height `z`.
pub(super) fn circle(count: usize, radius: f64, z: f64) -> impl Iterator<Item = Vec3> {
    ellipse(count, Vec3::z() * z, Vec3::x() * radius, Vec3::y() * radius)
}

/// `count` directions spread evenly over the sphere: heights at the midpoints of equal bands, azimuths by the golden
/// angle.
pub(super) fn directions(count: usize) -> impl Iterator<Item = Vec3> {
    let golden_angle = PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |k| {
        let z = 1.0 - (2 * k + 1) as f64 / count as f64;
        let (sine, cosine) = libm::sincos(golden_angle * k as f64);
        let radius = (1.0 - z * z).sqrt();
        Vec3::new(radius * cosine, radius * sine, z)
    })
}

/// The points of a cloud that lie farthest in evenly spread directions, at most [`SILHOUETTE_POINTS`] of them.
pub(super) fn extreme_points(cloud: &[Vec3]) -> Vec<Vec3> {
    if cloud.len() <= SILHOUETTE_POINTS {
        return cloud.to_vec();
    }
    let farthest = |direction: Vec3| {
        let height = |index: &usize| cloud[*index].dot(&direction);
        (0..cloud.len()).max_by(|i, j| height(i).total_cmp(&height(j)))
    };
    let mut chosen: Vec<usize> = directions(SILHOUETTE_POINTS).filter_map(farthest).collect();
    chosen.sort_unstable();
    chosen.dedup();
    chosen.into_iter().map(|index| cloud[index]).collect()
}
