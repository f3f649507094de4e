//! The resistance of a body that deforms, of any shape: boundary elements over the images of its surface.
//!
//! Which images, and how exact it is between them, is the matter of `gyration::fluid::Table`; here is what computes one
//! matrix. The triangles are those of the undeformed shape, taken along, so that matrices of neighbouring forms have
//! the same small error.

use super::elements::{BoundaryElements, BoundaryResistance, NoResistance, boundary_resistance};
use gyration::fluid::{NoMatrix, ResistanceSource, ResistanceTable, Resolution};
use gyration::load::Mat12;
use gyration::shape::Shape;
use gyration::tensor::{Mat3, Vec3};
use gyration_stokes::StokesError;
use gyration_threads::Interruption;

/// The largest error that the elements may tell of themselves. Beyond it, the terms that their correction for curvature
/// leaves out are no longer small against it, and the estimate means little.
const MOST_OF_ELEMENTS: f64 = 0.1;

/// A shape as boundary elements see it.
#[derive(Debug, Clone)]
pub struct DeformingSurface {
    shape: Shape,
    triangles: usize,
    /// Of the volume, in the shape's frame \[m\].
    center: Vec3,
    /// ∫ x ⊗ x dV/V about it \[m²\].
    second: Mat3,
}

impl DeformingSurface {
    /// A shape with about so many triangles.
    pub fn new(shape: &Shape, triangles: usize) -> Self {
        let filled = shape.mass_properties(1.0);
        let second = filled.euler_tensor / filled.volume;
        Self { shape: shape.clone(), triangles, center: filled.center, second }
    }

    /// The resistance of its image under E, about the centre of its volume.
    ///
    /// # Errors
    /// [`NoResistance`]: no single closed surface, or one around which no flow can be computed.
    pub fn resistance(&self, stretch: &Mat3) -> Result<BoundaryResistance, NoResistance> {
        let Self { triangles, center, .. } = *self;
        boundary_resistance(&self.shape, &BoundaryElements { triangles, center, gradient: *stretch, wall: None })
    }

    /// Its table; none of a shape without volume.
    pub fn table(self, resolution: Resolution) -> Option<ResistanceTable> {
        let second = self.second;
        ResistanceTable::new(Box::new(self), &second, resolution)
    }
}

impl ResistanceSource for DeformingSurface {
    fn matrix(&self, stretch: &Mat3) -> Result<Mat12, NoMatrix> {
        // Many steps may be tried until one is given up.
        if Interruption::due().is_some() {
            return Err(NoMatrix::Interrupted);
        }
        let found = self.resistance(stretch).map_err(|none| match none {
            NoResistance::Surface(StokesError::Interrupted) => NoMatrix::Interrupted,
            _ => NoMatrix::Inexact(f64::NAN),
        })?;
        if found.error <= MOST_OF_ELEMENTS { Ok(found.matrix) } else { Err(NoMatrix::Inexact(found.error)) }
    }
}
