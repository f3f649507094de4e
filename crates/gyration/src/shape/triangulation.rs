//! A shape's surface as triangles that share their points: what pictures and exports show.
//!
//! Nothing of the mechanics depends on it: contact integrates over the true [`Surface`](crate::surface::Surface). The
//! points lie on the true surface, so that of a convex shape the triangles enclose a little less than its volume,
//!
//!   V = Σ a·(b×c)/6,
//!
//! with a deficit that falls as one over their number. Boxes and polyhedra are shown by their own triangles.

use std::collections::BTreeMap;

use crate::tensor::{Mat3, Vec3};

/// A closed surface of triangles in the frame of its shape; a union has one of each part, points have none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Triangulation {
    /// The points \[m\].
    pub points: Vec<Vec3>,
    /// Indices of points, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
}

impl Triangulation {
    /// The signed volume \[m³\] that the triangles enclose.
    ///
    /// About the first point, so that a surface far from its origin loses nothing.
    pub fn volume(&self) -> f64 {
        let Some(&origin) = self.points.first() else { return 0.0 };
        let signed = |triangle: &[usize; 3]| {
            let [a, b, c] = self.corners(triangle).map(|corner| corner - origin);
            a.dot(&b.cross(&c)) / 6.0
        };
        self.triangles.iter().map(signed).sum()
    }

    /// The corners of a triangle \[m\].
    pub fn corners(&self, triangle: &[usize; 3]) -> [Vec3; 3] {
        triangle.map(|index| self.points[index])
    }

    /// The same surface with its points moved.
    pub fn mapped(mut self, place: impl Fn(&Vec3) -> Vec3) -> Self {
        self.points.iter_mut().for_each(|point| *point = place(point));
        self
    }

    /// The same surface with every triangle divided into n² alike, n ≥ 1; neighbours share the points between them.
    pub fn subdivided(&self, n: usize) -> Self {
        if n < 2 {
            return self.clone();
        }
        let mut fine = Self::default();
        // A point by the corners that it lies between, with their weights, which add up to n.
        let mut known = BTreeMap::new();
        for corners in &self.triangles {
            let mut point = |i: usize, j: usize| {
                let mut key: Vec<(usize, usize)> = corners.iter().copied().zip([n - i - j, i, j]).collect();
                key.retain(|(_, weight)| *weight > 0);
                key.sort_unstable();
                let sum: Vec3 = key.iter().map(|&(corner, weight)| self.points[corner] * weight as f64).sum();
                *known.entry(key).or_insert_with(|| {
                    fine.points.push(sum / n as f64);
                    fine.points.len() - 1
                })
            };
            for i in 0..n {
                for j in 0..n - i {
                    fine.triangles.push([point(i, j), point(i + 1, j), point(i, j + 1)]);
                    if i + j + 1 < n {
                        fine.triangles.push([point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
                    }
                }
            }
        }
        fine
    }

    /// Adds another surface turned by `rotation` and then shifted by `offset`.
    pub(super) fn add_transformed(&mut self, other: &Self, rotation: &Mat3, offset: &Vec3) {
        let first = self.points.len();
        self.points.extend(other.points.iter().map(|point| rotation * point + offset));
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|index| index + first)));
    }
}
