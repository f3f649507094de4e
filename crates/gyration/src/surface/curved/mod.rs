//! Smooth primitives, one file each: moments in the primitive's own frame, support points, area.
//!
//! Every primitive answers three questions. Its **moments** A_k = ∫ κ(g₀ + m·Y) Y^⊗k dA about its own origin; its
//! **support point** in a direction a, arg max a·Y, from which the smallest gap and the fastest point follow; its
//! **area**. Frames: origin at the centre of symmetry, axis along z. This module knows no body and no law.
//!
//! Moments are summed in whatever frame makes them sparse; the `Chart` that a primitive returns leads back.

mod cone;
mod cylinder;
mod disk;
mod ellipsoid;
mod features;
mod half_plane;
mod hemisphere;
mod hemisphere_points;
mod image;
mod integrand;
mod own_ring;
mod parallels;
mod points;
mod ring;
mod rulings;
mod rulings_weighted;
mod sphere;
mod torus;
mod torus_points;
mod walls;
mod weight;

pub use cone::ConeWall;
pub use cylinder::CylinderWall;
pub use disk::Disk;
pub use ellipsoid::Ellipsoid;
pub(crate) use half_plane::Chart;
pub use hemisphere::Hemisphere;
pub(crate) use integrand::GROUP;
pub use sphere::Sphere;
pub use torus::Torus;
pub(crate) use weight::{AREA, Deformed, Weighted, Weights};
