//! Surfaces of revolution, half-plane by half-plane.
//!
//! In the half-plane at the azimuth φ a point is (ρ, z). A surface of revolution about e_z under the gap d = g₀ + m·Y
//! is symmetric about the plane of e_z and m. In the frame whose x axis points where the gap falls,
//!
//!   Y = ρ cos φ e_x + ρ sin φ e_y + z e_z,   d = (g₀ + m_z z) − μ ρ cos φ,   μ = |(m_x, m_y)|,
//!
//! and odd powers of sin φ cancel.

use crate::surface::GapField;
use crate::tensor::{Mat3, Vec3};

/// Where moments that a primitive has summed belong: Y = offset + linear · Z, Z the variable they were summed in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AffineMap {
    pub(crate) linear: Mat3,
    pub(crate) offset: Vec3,
}

impl AffineMap {
    /// The map of a frame about the primitive's origin.
    pub(crate) fn frame(linear: Mat3) -> Self {
        Self { linear, offset: Vec3::zeros() }
    }
}

/// A gap seen from a body of revolution: d = height + along · z − across · ρ cos φ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TiltedGap {
    /// g₀ [m].
    pub(crate) height: f64,
    /// m_z.
    pub(crate) along: f64,
    /// μ ≥ 0.
    pub(crate) across: f64,
    /// Columns e_x (where the gap falls fastest across the axis), e_y, e_z.
    pub(crate) frame: Mat3,
}

impl TiltedGap {
    pub(crate) fn new(field: &GapField) -> Self {
        let m = &field.direction;
        let across = libm::hypot(m.x, m.y);
        let (x, y) = if across > 0.0 { (-m.x / across, -m.y / across) } else { (1.0, 0.0) };
        let frame = Mat3::new(x, -y, 0.0, y, x, 0.0, 0.0, 0.0, 1.0);
        Self { height: field.height, along: m.z, across, frame }
    }
}
