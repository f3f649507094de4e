//! The triangles that show a body, each ready to be integrated over.
//!
//! A triangle of a curved body is a chord: near a support the gap below it is larger than that of the surface by up to
//! the bulge s, and a law d^−ν is missed by ν s/d. There the triangle is divided in n² and pushed out onto the true
//! surface, which leaves ν s/(n² d); everywhere else it serves as it is. Over a triangle the integrals are exact.

use gyration::body::Solid;
use gyration::contact::{Contact, ContactLaw};
use gyration::shape::{Shape, Triangulation};
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3};
use std::borrow::Cow;

/// The part of its traction by which a triangle may be wrong.
const MISSED: f64 = 2e-3;
/// How often a side is divided at most.
const MOST_DIVISIONS: usize = 64;

/// The surface of a body, triangle by triangle; made once, used at every sample.
#[derive(Debug, Clone)]
pub struct SurfaceCells {
    surface: Triangulation,
    cells: Vec<Cell>,
    leaves: Vec<Leaf>,
}

/// A shape that is no union, and where it stands from the centre of mass.
#[derive(Debug, Clone)]
struct Leaf {
    shape: Shape,
    rotation: Mat3,
    offset: Vec3,
}

/// A triangle.
#[derive(Debug, Clone)]
struct Cell {
    leaf: usize,
    /// In the frame of its leaf \[m\].
    corners: [Vec3; 3],
    /// The triangle from the centre of mass; empty if it has no area.
    flat: Surface,
    /// Distance of the true surface from the triangle, at most \[m\].
    bulge: f64,
}

/// The corners, the middles of the sides and the middle: where the gap under a triangle is looked at.
const PROBES: [[f64; 3]; 7] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.5],
    [0.5, 0.0, 0.5],
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
];

impl SurfaceCells {
    /// The surface of a solid in about `count` triangles; flat faces are divided until they are as many.
    pub fn of(solid: &Solid, count: usize) -> Self {
        let mut this = Self { surface: Triangulation::default(), cells: Vec::new(), leaves: Vec::new() };
        this.add(&solid.shape, Mat3::identity(), -solid.mass.center, count);
        this
    }

    fn add(&mut self, shape: &Shape, rotation: Mat3, offset: Vec3, count: usize) {
        if let Shape::Union(union) = shape {
            for part in &union.parts {
                self.add(&part.shape, rotation * part.rotation, rotation * part.offset + offset, count);
            }
            return;
        }
        let coarse = shape.triangulation(count);
        let divisions = (count as f64 / coarse.triangles.len().max(1) as f64).sqrt().round();
        let own = coarse.subdivided(divisions as usize);
        let leaf = Leaf { shape: shape.clone(), rotation, offset };
        self.cells.extend(own.triangles.iter().map(|triangle| leaf.cell(self.leaves.len(), own.corners(triangle))));
        self.leaves.push(leaf);
        let first = self.surface.points.len();
        self.surface.triangles.extend(own.triangles.iter().map(|triangle| triangle.map(|corner| corner + first)));
        self.surface.points.extend(own.points.iter().map(|point| rotation * point + offset));
    }

    /// The triangles, from the centre of mass.
    pub fn surface(&self) -> &Triangulation {
        &self.surface
    }

    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The surface over a triangle, as finely as the laws of a contact ask for at these gaps.
    pub(super) fn over(&self, cell: usize, contact: &Contact, field: &GapField) -> Cow<'_, Surface> {
        let cell = &self.cells[cell];
        let leaf = &self.leaves[cell.leaf];
        let divisions = leaf.divisions(cell, contact, field);
        if divisions < 2 { Cow::Borrowed(&cell.flat) } else { Cow::Owned(leaf.divided(cell, divisions)) }
    }
}

impl Leaf {
    fn cell(&self, leaf: usize, corners: [Vec3; 3]) -> Cell {
        let flat =
            Surface::from_triangles(&corners.map(|corner| self.place(&corner)), &[[0, 1, 2]]).unwrap_or_default();
        let off = |weights: &[f64; 3]| {
            let chord: Vec3 = corners.iter().zip(weights).map(|(corner, weight)| corner * *weight).sum();
            (self.shape.over(&corners, weights) - chord).norm()
        };
        Cell { leaf, corners, flat, bulge: PROBES.iter().map(off).fold(0.0, f64::max) }
    }

    /// A point of the leaf's frame, from the centre of mass.
    fn place(&self, point: &Vec3) -> Vec3 {
        self.rotation * point + self.offset
    }

    /// n, so that ν s/(n² d) is small enough.
    fn divisions(&self, cell: &Cell, contact: &Contact, field: &GapField) -> usize {
        let exponent = contact.law_set.laws().iter().map(ContactLaw::leading_exponent).fold(0.0, f64::max);
        let bulge = cell.bulge * field.direction.norm();
        // Flat faces bulge by rounding.
        if bulge <= 1e-12 * cell.corners.iter().map(Vec3::norm).fold(0.0, f64::max) {
            return 1;
        }
        let gap = |weights: &[f64; 3]| field.gap(&self.place(&self.shape.over(&cell.corners, weights)));
        let smallest = PROBES.iter().map(gap).fold(f64::INFINITY, f64::min);
        let wanted = (exponent * bulge / (MISSED * smallest)).sqrt().ceil();
        // Not a number, or beyond the plane, is the law's to tell.
        if wanted.is_finite() { (wanted as usize).clamp(1, MOST_DIVISIONS) } else { 1 }
    }

    /// The true surface over a triangle, in n² triangles.
    fn divided(&self, cell: &Cell, n: usize) -> Surface {
        let row = |i: usize| (0..=n - i).map(move |j| [n - i - j, i, j].map(|weight| weight as f64 / n as f64));
        let points: Vec<Vec3> =
            (0..=n).flat_map(row).map(|weights| self.place(&self.shape.over(&cell.corners, &weights))).collect();
        // Row i begins behind rows of n + 1, n, …, n + 2 − i points.
        let at = |i: usize, j: usize| i * (n + 1) - i * i.saturating_sub(1) / 2 + j;
        let mut triangles = Vec::with_capacity(n * n);
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
            if i + j + 1 < n {
                triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        Surface::from_triangles(&points, &triangles).unwrap_or_default()
    }
}
