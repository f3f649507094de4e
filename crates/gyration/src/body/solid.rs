//! A body before it moves: what equal bodies share.

use crate::mass::MassProperties;
use crate::shape::Shape;
use crate::surface::Surface;

/// Shape, mass and surface; ten thousand equal grains have one.
#[derive(Debug, Clone)]
pub struct Solid {
    /// The shape in its own frame, for whoever draws it.
    pub shape: Shape,
    /// Mass, centre and Euler tensor.
    pub mass: MassProperties,
    /// The surface relative to the centre of mass; none for mass points.
    pub surface: Option<Surface>,
}

impl Solid {
    /// A shape with its mass properties in the frame of the shape.
    pub fn new(shape: Shape, mass: MassProperties) -> Self {
        let surface = shape.surface().map(|surface| surface.translated(&-mass.center));
        Self { shape, mass, surface }
    }
}
