//! Moments over an ellipsoid.
//!
//! X = A s, |s| = 1, A = diag(a, b, c), is the image of a sphere; dA = |B s| dΩ with the cofactor B = diag(bc, ca, ab).
//! With s = cos θ f + sin θ (cos φ e₁ + sin φ e₂), f = −Am/|Am| the lowest point, the gap
//!
//!   d = g₀ − |Am| cos θ
//!
//! does not depend on φ: κ is evaluated once for a parallel, and the rest, ∮ |B s| s⊗… dφ, is geometry, the same for
//! the parallel at π − θ but for signs. `features` chooses the parallels, `parallels` sums around them.

use super::half_plane::AffineMap;
use super::rules::features::Features;
use super::rules::integrand::Integrand;
use super::rules::parallels::{AreaElement, ParallelSweep};
use super::sphere::frame_along;
use crate::surface::{GapField, MomentRequest, Moments};
use crate::tensor::{Mat3, Vec3};

/// An ellipsoid about the origin, its axes along x, y, z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    /// Semi-axes [m].
    pub semi_axes: Vec3,
}

impl Ellipsoid {
    /// The area ∫ |B s| dΩ [m²].
    pub fn area(&self) -> f64 {
        let field = GapField::new(1.0, Vec3::zeros());
        let request = MomentRequest { kernel: crate::surface::Kernel::Power(0.0), order: 0 };
        let mut out = [Moments::default()];
        self.moments(&field, &[request], &mut out);
        out[0].zeroth
    }

    /// The point farthest along `direction`: A² a/|A a|.
    pub fn support(&self, direction: &Vec3) -> Vec3 {
        let image = self.semi_axes.component_mul(direction);
        let length = image.norm();
        if length > 0.0 { self.semi_axes.component_mul(&image) / length } else { Vec3::new(0.0, 0.0, self.semi_axes.z) }
    }

    /// Sums the moments of s in the frame (e₁, e₂, f); every gap must be positive.
    pub(crate) fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> AffineMap {
        let image = self.semi_axes.component_mul(&field.direction);
        let frame = frame_along(&-image);
        let reach = image.norm();
        let near = field.height - reach;
        let a = &self.semi_axes;
        let cofactor = Vec3::new(a.y * a.z, a.z * a.x, a.x * a.y);
        let element = AreaElement::new(&cofactor, &frame);
        let integrand = Integrand::new(requests);
        let features = Features::new(near, reach, &cofactor, &frame.column(2).into(), &integrand);
        let (gap, element, integrand) = ((near, reach), &element, &integrand);
        ParallelSweep { features: &features, element, gap, integrand, factors: &[] }.collect(requests, out);
        AffineMap::frame(Mat3::from_diagonal(a) * frame)
    }
}
