//! The resistance of a shape in a viscous fluid, by boundary elements over its triangulation.
//!
//! The matrix is a number of the model, as a mass is, and is kept for the next model that has the same surface. Boxes
//! and polyhedra are divided into triangles of like size, of which they consist; on any other shape the corners lie on
//! the true surface, whose rise above the triangles is added to first order (`gyration_stokes`).

use gyration::load::Mat12;
use gyration::shape::{Shape, Triangulation};
use gyration::tensor::{Mat3, Vec3};
use gyration_stokes::{ClosedSurface, Faces, StokesError, StokesOptions, WallPlane};
use std::sync::{Mutex, PoisonError};

/// How a shape is to be resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryElements {
    /// About how many triangles; a polyhedron has its own at least.
    pub triangles: usize,
    /// The centre of motions and moments, in the shape's frame \[m\].
    pub center: Vec3,
    /// P: the resistance is that of the image of the shape, in the axes of its image.
    pub gradient: Mat3,
    /// A plane wall without slip.
    pub wall: Option<Wall>,
}

/// A plane wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// A point of it, from the image of the centre \[m\].
    pub point: Vec3,
    /// Its normal into the fluid.
    pub normal: Vec3,
}

/// A resistance matrix for viscosity 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryResistance {
    /// H of (f; N row by row) = −H (v; L row by row), in the axes of the image.
    pub matrix: Mat12,
    /// Estimated relative error of the power of any motion.
    pub error: f64,
    /// How many triangles there were.
    pub triangles: usize,
}

/// Why there is no matrix.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoResistance {
    /// A union or a set of points.
    #[error("a {0} has no single closed surface: give it as a `mesh` of one closed surface")]
    NoSurface(&'static str),
    /// There is no volume, and so no ellipsoid to compare with.
    #[error("the body has no extent in some direction")]
    Flat,
    /// The surface is not one that a flow can be computed around.
    #[error("boundary elements: {0}")]
    Surface(#[from] StokesError),
}

/// The triangles of a shape for boundary elements, and what they stand for.
fn triangulated(shape: &Shape, count: usize) -> Result<(Triangulation, Faces), NoResistance> {
    match shape {
        Shape::Union(_) => Err(NoResistance::NoSurface("union")),
        Shape::Points(_) => Err(NoResistance::NoSurface("set of points")),
        Shape::Box(_) | Shape::Polyhedron(_) => {
            let own = shape.triangulation(count);
            let each = (count as f64 / own.triangles.len().max(1) as f64).sqrt().ceil();
            Ok((own.subdivided(each.max(1.0) as usize), Faces::Flat))
        }
        _ => Ok((shape.triangulation(count), Faces::Curved)),
    }
}

/// What a matrix depends on, bit by bit.
type Key = Vec<u64>;
/// Matrices kept, the latest last.
static KEPT: Mutex<Vec<(Key, BoundaryResistance)>> = Mutex::new(Vec::new());
/// How many are kept.
const MOST_KEPT: usize = 32;

/// The resistance matrix of a shape about a centre.
///
/// # Errors
/// [`NoResistance`]: no single closed surface, or one around which no flow can be computed.
pub fn boundary_resistance(shape: &Shape, elements: &BoundaryElements) -> Result<BoundaryResistance, NoResistance> {
    let (mesh, faces) = triangulated(shape, elements.triangles)?;
    let mesh = mesh.mapped(|point| elements.gradient * (point - elements.center));
    let key = key(&mesh, faces, elements);
    let kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, found)) = kept.iter().find(|(known, _)| *known == key) {
        return Ok(*found);
    }
    drop(kept);
    let points: Vec<[f64; 3]> = mesh.points.iter().map(|point| (*point).into()).collect();
    let triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(|triangle| triangle.map(|corner| corner as u32)).collect();
    let wall = elements.wall.map(|Wall { point, normal }| WallPlane { point: point.into(), normal: normal.into() });
    let options = StokesOptions { faces, wall, ..StokesOptions::default() };
    let found = ClosedSurface::new(&points, &triangles)?.resistance(&options)?;
    let matrix = Mat12::from_fn(|row, column| found.matrix[row][column]);
    let found = BoundaryResistance { matrix, error: found.error, triangles: triangles.len() };
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.len() == MOST_KEPT {
        kept.remove(0);
    }
    kept.push((key, found));
    Ok(found)
}

fn key(mesh: &Triangulation, faces: Faces, elements: &BoundaryElements) -> Key {
    let vector = |vector: &Vec3| [vector.x, vector.y, vector.z].map(f64::to_bits);
    let mut key = vec![u64::from(faces == Faces::Flat), mesh.points.len() as u64];
    key.extend(mesh.points.iter().flat_map(vector));
    key.extend(mesh.triangles.iter().flatten().map(|corner| *corner as u64));
    if let Some(Wall { point, normal }) = &elements.wall {
        key.extend(vector(point).into_iter().chain(vector(normal)));
    }
    key
}
