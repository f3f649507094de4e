//! Smooth primitives, one file each: moments in the primitive's own frame, support points, area.
//!
//! Every primitive answers three questions. Its **moments** A_k = ∫ κ(g₀ + m·Y) Y^⊗k dA about its own origin; its
//! **support point** in a direction a, arg max a·Y, from which the smallest gap and the fastest point follow; its
//! **area**. Frames: origin at the centre of symmetry, axis along z. This module knows no body and no law.
//!
//! Moments are summed in whatever frame makes them sparse; the `AffineMap` that a primitive returns leads back.

mod cone;
mod cylinder;
mod deformed;
mod disk;
mod ellipsoid;
mod half_plane;
mod hemisphere;
mod patch;
mod rules;
mod sphere;
mod torus;
mod tube;

pub use cone::ConeWall;
pub use cylinder::CylinderWall;
pub use disk::Disk;
pub use ellipsoid::Ellipsoid;
pub use hemisphere::Hemisphere;
pub use patch::{Patch, Primitive};
pub use rules::graded::{QuadratureNode, gauss_legendre};
pub use sphere::Sphere;
pub use torus::Torus;
