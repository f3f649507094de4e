//! Rigid spheres that feel one another through the fluid.
//!
//! ```text
//! coefficients   of the resistance of two spheres in powers of the inverse distance
//! functions      this resistance for all radii and distances: six numbers a block, and their derivatives
//! tensors        a block from its numbers; the mobility far away
//! symmetric      inverses of matrices
//! resistance     the loads on any number of spheres, and their derivatives
//! ```
//!
//! Exact for two spheres in a fluid at rest far away; of more, the far field and lubrication. Source:
//! `docs/theory-fluid.md`.

mod coefficients;
mod functions;
mod resistance;
mod symmetric;
mod tensors;
#[cfg(test)]
mod tests;

pub use resistance::{ImmersedSpheres, SphereLoads, SpheresTouch};
pub(super) use tensors::{Felt, Line, Mat6, Mat6x3, Scalars, Vec6, of_wrench, parts, spin};
