//! What can be wrong with the parameters of a shape.

use super::polyhedron::PolyhedronError;

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
