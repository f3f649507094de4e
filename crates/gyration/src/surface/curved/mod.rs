//! Smooth primitives, one file each: moments in the primitive's own frame, support points, area.
//!
//! Every primitive answers three questions. Its **moments** A_k = ∫ κ(g₀ + m·Y) Y^⊗k dA about its own origin; its
//! **support point** in a direction a, arg max a·Y, from which the smallest gap and the fastest point follow; its
//! **area**. Frames: origin at the centre of symmetry, axis along z. This module knows no body and no law.

mod integrand;
mod sphere;

pub(crate) use integrand::GROUP;
pub use sphere::Sphere;
