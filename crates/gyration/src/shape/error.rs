//! What can be wrong with the parameters of a shape.

use super::edges::Edge;

/// Parameters that describe no shape.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// A length, a mass or a density is zero, negative, infinite or not a number.
    #[error("{parameter} of the {shape} is {value}: it must be finite and > 0")]
    NotPositive {
        /// Name of the shape.
        shape: &'static str,
        /// Name of the parameter, as in the scene file.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A coordinate is infinite or not a number.
    #[error("{parameter} of the {shape} has the component {value}: it must be finite")]
    NotFinite {
        /// Name of the shape.
        shape: &'static str,
        /// Name of the parameter, as in the scene file.
        parameter: &'static str,
        /// The component.
        value: f64,
    },
    /// The tube of a torus closes its hole.
    #[error("major_radius of the torus is {major} and minor_radius {minor}: major_radius must be the larger")]
    TorusWithoutHole {
        /// Distance from the axis to the middle of the tube \[m\].
        major: f64,
        /// Radius of the tube \[m\].
        minor: f64,
    },
    /// A polyhedron that does not bound a volume.
    #[error(transparent)]
    Polyhedron(#[from] PolyhedronError),
    /// A union without parts, or points without a point.
    #[error("the {shape} is empty: give at least one of its {parameter}")]
    Empty {
        /// Name of the shape.
        shape: &'static str,
        /// Name of the list.
        parameter: &'static str,
    },
    /// The matrix that turns a part is no rotation.
    #[error("rotation is not a rotation matrix: |RᵀR − 1| is {defect:e} and det R is {determinant}")]
    NotARotation {
        /// Largest entry of RᵀR − 1.
        defect: f64,
        /// det R.
        determinant: f64,
    },
    /// Something is wrong with one member of a union or of a set of points.
    #[error("{member} {index} of the {shape}: {source}")]
    Member {
        /// Name of the shape.
        shape: &'static str,
        /// What a member is called.
        member: &'static str,
        /// Its index, from 0.
        index: usize,
        /// What is wrong with it.
        source: Box<ShapeError>,
    },
}

/// Triangles that do not bound a volume.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolyhedronError {
    /// Not even a tetrahedron.
    #[error("{triangles} triangles on {vertices} vertices: a volume needs at least 4 of each")]
    TooFew {
        /// Number of vertices.
        vertices: usize,
        /// Number of triangles.
        triangles: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} (counted from 0) has the coordinate {value}: it must be finite")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
    /// A triangle refers to no vertex.
    #[error("triangle {triangle} refers to vertex {index}, but there are {vertices} (both counted from 0)")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// Index of the vertex.
        index: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// A triangle names a vertex twice.
    #[error("triangle {triangle} (counted from 0) has a vertex twice: remove it")]
    RepeatedVertex {
        /// Index of the triangle.
        triangle: usize,
    },
    /// The surface has a hole.
    #[error("the surface is not closed: {}; fill the holes", places(*.count, "edge with one triangle", "edges with one triangle", .first))]
    Open {
        /// Number of edges at the hole.
        count: usize,
        /// The first few.
        first: Vec<Edge>,
    },
    /// More than two triangles meet in an edge.
    #[error("the surface branches: {}; remove inner walls, separate solids that share an edge",
        places(*.count, "edge with more than two triangles", "edges with more than two triangles", .first))]
    NonManifold {
        /// Number of such edges.
        count: usize,
        /// The first few.
        first: Vec<Edge>,
    },
    /// Neighbouring triangles disagree about which side is out.
    #[error("neighbouring triangles face opposite ways: {}; recompute the orientation so that all face out",
        places(*.count, "edge", "edges", .first))]
    Misoriented {
        /// Number of edges between such neighbours.
        count: usize,
        /// The first few.
        first: Vec<Edge>,
    },
    /// All triangles lie in one plane, or have no area.
    #[error("the surface encloses no volume: {volume:e} m³ at a size of {size:e} m")]
    NoVolume {
        /// The signed volume \[m³\].
        volume: f64,
        /// Largest side of the bounding box \[m\].
        size: f64,
    },
    /// The triangles face inward.
    #[error("the surface faces inward (signed volume {volume:e} m³): flip all triangles")]
    InsideOut {
        /// The signed volume \[m³\].
        volume: f64,
    },
}

/// "3 edges with one triangle: (0, 0, 0) to (1, 0, 0), …".
fn places(count: usize, one: &str, many: &str, first: &[Edge]) -> String {
    let listed: Vec<String> = first.iter().map(Edge::to_string).collect();
    let more = if count > first.len() { ", …" } else { "" };
    format!("{count} {}, at {}{more}", if count == 1 { one } else { many }, listed.join(", "))
}

/// Checks that a parameter is finite and > 0.
pub(super) fn positive(shape: &'static str, parameter: &'static str, value: f64) -> Result<(), ShapeError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(ShapeError::NotPositive { shape, parameter, value }) }
}

/// Checks that all components of a parameter are finite.
pub(super) fn finite(shape: &'static str, parameter: &'static str, components: &[f64]) -> Result<(), ShapeError> {
    match components.iter().find(|component| !component.is_finite()) {
        Some(&value) => Err(ShapeError::NotFinite { shape, parameter, value }),
        None => Ok(()),
    }
}
