//! The triangles of a surface, each ready to be integrated over.

use gyration::shape::Triangulation;
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};

/// The triangles of a surface, one by one; made once, used at every sample.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceCells {
    cells: Vec<Cell>,
}

/// A triangle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cell {
    /// Empty if the triangle has no area or a corner is not finite.
    pub surface: Surface,
    /// Two of its sides (from the same corner) \[m\].
    sides: [Vec3; 2],
}

impl SurfaceCells {
    /// Of a surface relative to the centre of mass.
    pub fn new(surface: &Triangulation) -> Self {
        let cell = |triangle: &[usize; 3]| {
            let [a, b, c] = surface.corners(triangle);
            let alone = Surface::from_triangles(&[a, b, c], &[[0, 1, 2]]);
            Cell { surface: alone.unwrap_or_default(), sides: [b - a, c - a] }
        };
        Self { cells: surface.triangles.iter().map(cell).collect() }
    }

    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Cell> {
        self.cells.iter()
    }
}

impl Cell {
    /// ½ |P a × P b| \[m²\].
    pub(super) fn current_area(&self, gradient: &Mat3) -> f64 {
        let [a, b] = self.sides.map(|side| gradient * side);
        0.5 * a.cross(&b).norm()
    }
}
