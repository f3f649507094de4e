//! Bodies in a viscous fluid: what slow flow does to them.
//!
//! ```text
//! ambient      the fluid and the flow that it has far from the bodies
//! remembered   the loads of that memory, and its modes
//! moments      integrals of the ellipsoid's shape, without loss of digits from needle to disc
//! ellipsoid    force and stress of the fluid on an ellipsoid that moves and deforms in a linear flow, and their derivatives
//! inclusion    a body in the fluid, and the loads on one that deforms as an ellipsoid
//! fixed        the loads on a body whose form does not change: one resistance matrix
//! memory       a sphere in a fluid with inertia: history, and small vibrations
//! ```
//!
//! Stokes flow: u∞ = U∞ + L∞ x far away, tr L∞ = 0. Source: Sławianowski §4; `physics.md` §7.

mod ambient;
mod ellipsoid;
mod fixed;
mod inclusion;
pub mod memory;
mod moments;
mod remembered;
#[cfg(test)]
mod tests;

pub use ambient::{Flow, Fluid};
pub use ellipsoid::{Ellipsoid, FormSlope, Stress};
pub use fixed::{DragSlopes, FixedForm, RigidDrag};
pub use inclusion::{Form, ImmersedEllipsoid, Inclusion};
pub use moments::Moments;
pub use remembered::{Memory, Remembered};
