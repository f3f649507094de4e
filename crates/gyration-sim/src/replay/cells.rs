//! The triangles that show a body, each ready to be integrated over.
//!
//! A triangle of a curved body is a chord: near a support the gap below it is larger than that of the surface by up to
//! the bulge s, and a law d^−ν is missed by ν s/d. There the triangle is divided in four, pushed out onto the true
//! surface, which leaves a quarter of the bulge, and so on; everywhere else it serves as it is. Over a triangle the
//! integrals are exact.

use gyration::body::Solid;
use gyration::shape::{Shape, Triangulation};
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3};
use std::borrow::Cow;

/// The part of its traction by which a triangle may be wrong.
const MISSED: f64 = 2e-3;
/// How often a triangle is divided in four at most.
const MOST_DIVISIONS: usize = 12;

/// The surface of a body, triangle by triangle; made once, used at every sample.
#[derive(Debug, Clone)]
pub struct SurfaceCells {
    surface: Triangulation,
    cells: Vec<Cell>,
    leaves: Vec<Leaf>,
}

/// A place in a triangle, by the weights of its corners.
type Weights = [f64; 3];

/// How a law sees the surface of a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached {
    /// The distance of its points from the plane.
    pub field: GapField,
    /// The largest exponent of the powers of it.
    pub exponent: f64,
    /// The smallest distance of the whole surface \[m\].
    pub nearest: f64,
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

/// The corners of a triangle, by their weights.
const CORNERS: [Weights; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// The corners, the middles of the sides and the middle: where the bulge of a triangle is looked at.
const PROBES: [Weights; 7] = [
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

    /// The triangles of a part of the body.
    pub(super) fn of_part(&self, part: usize) -> impl Iterator<Item = usize> {
        (0..self.cells.len()).filter(move |cell| self.cells[*cell].leaf == part)
    }

    /// The surface over a triangle, as finely as a law asks for.
    pub(super) fn over(&self, cell: usize, reached: &Reached) -> Cow<'_, Surface> {
        let cell = &self.cells[cell];
        let leaf = &self.leaves[cell.leaf];
        let mut points = Vec::new();
        leaf.divide(cell, &CORNERS, 0, reached, &mut points);
        if points.len() == CORNERS.len() {
            return Cow::Borrowed(&cell.flat);
        }
        let triangles: Vec<[usize; 3]> = (0..points.len() / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        Cow::Owned(Surface::from_triangles(&points, &triangles).unwrap_or_default())
    }
}

impl Leaf {
    fn cell(&self, leaf: usize, corners: [Vec3; 3]) -> Cell {
        let flat =
            Surface::from_triangles(&corners.map(|corner| self.place(&corner)), &[[0, 1, 2]]).unwrap_or_default();
        let off = |weights: &Weights| {
            let chord: Vec3 = corners.iter().zip(weights).map(|(corner, weight)| corner * *weight).sum();
            (self.shape.over(&corners, weights) - chord).norm()
        };
        Cell { leaf, corners, flat, bulge: PROBES.iter().map(off).fold(0.0, f64::max) }
    }

    /// A point of the leaf's frame, from the centre of mass.
    fn place(&self, point: &Vec3) -> Vec3 {
        self.rotation * point + self.offset
    }

    /// Adds the corners of the triangles of a part of a cell, which has been divided so many times.
    fn divide(&self, cell: &Cell, weights: &[Weights; 3], times: usize, reached: &Reached, out: &mut Vec<Vec3>) {
        let corners = weights.map(|weights| self.place(&self.shape.over(&cell.corners, &weights)));
        let Reached { field, exponent, nearest } = reached;
        let bulge = cell.bulge * field.direction.norm() * libm::exp2(-2.0 * times as f64);
        let gap = corners.iter().map(|corner| field.gap(corner)).fold(f64::INFINITY, f64::min);
        // Not a number, or beyond the plane, is the law's to tell.
        let is_coarse = exponent * bulge > MISSED * nearest.max(gap - bulge);
        if times == MOST_DIVISIONS || cell.is_flat() || !is_coarse {
            out.extend(corners);
            return;
        }
        let [a, b, c] = *weights;
        let middle = |one: Weights, other: Weights| [0, 1, 2].map(|i| 0.5 * (one[i] + other[i]));
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        for part in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
            self.divide(cell, &part, times + 1, reached, out);
        }
    }
}

impl Cell {
    /// Whether it bulges by rounding alone.
    fn is_flat(&self) -> bool {
        self.bulge <= 1e-12 * self.corners.iter().map(Vec3::norm).fold(0.0, f64::max)
    }
}
