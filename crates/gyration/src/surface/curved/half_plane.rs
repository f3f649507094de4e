//! Surfaces of revolution, half-plane by half-plane.
//!
//! In the half-plane at the azimuth φ a point is (ρ, z). A surface of revolution about e_z under the gap d = g₀ + m·Y
//! is symmetric about the plane of e_z and m. In the frame whose x axis points where the gap falls,
//!
//!   Y = ρ cos φ e_x + ρ sin φ e_y + z e_z,   d = (g₀ + m_z z) − μ ρ cos φ,   μ = |(m_x, m_y)|,
//!
//! odd powers of sin φ cancel, and the moments follow from the sums S_ij = ∫ κ ρ^i z^j ds, i + j ≤ 3, of each
//! half-plane.

use crate::surface::{GapField, Moments};
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

/// The sums S_ij of one half-plane: S₀₀, S₁₀, S₀₁, S₂₀, S₁₁, S₀₂, S₃₀, S₂₁, S₁₂, S₀₃.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct HalfPlane(pub(crate) [f64; 10]);

impl HalfPlane {
    /// Adds the pair of half-planes at ±φ, of total weight w, to the moments in the frame of [`TiltedGap`].
    #[inline]
    pub(crate) fn turn(&self, w: f64, cos: f64, sin_squared: f64, order: usize, out: &mut Moments) {
        let s = &self.0;
        out.zeroth += w * s[0];
        if order == 0 {
            return;
        }
        let wc = w * cos;
        out.first.x += wc * s[1];
        out.first.z += w * s[2];
        if order == 1 {
            return;
        }
        let (wcc, wss) = (wc * cos, w * sin_squared);
        out.second.m11 += wcc * s[3];
        out.second.m22 += wss * s[3];
        out.second.m13 += wc * s[4];
        out.second.m33 += w * s[5];
        if order == 2 {
            return;
        }
        let third = &mut out.third.0;
        third[0] += wcc * cos * s[6];
        third[3] += wss * cos * s[6];
        third[2] += wcc * s[7];
        third[7] += wss * s[7];
        third[5] += wc * s[8];
        third[9] += w * s[9];
    }
}

/// Fills in the lower half of the second moments that [`HalfPlane::turn`] leaves out.
pub(crate) fn mirror(out: &mut Moments) {
    out.second.m31 = out.second.m13;
}
