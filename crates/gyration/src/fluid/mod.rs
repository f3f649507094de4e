//! Bodies in a viscous fluid: what slow flow does to them.
//!
//! ```text
//! ambient      the fluid and the flow that it has far from the bodies
//! history      the history force as loads, and its relaxation modes
//! straining    the same of its strain and growth
//! ellipsoid    force and stress of the fluid on an ellipsoid that deforms in a linear flow, and their derivatives
//! immersed     what the fluid does to a body that deforms, whatever its form
//! inclusion    a body in the fluid, and the loads on one that deforms as an ellipsoid
//! fixed        the loads on a body whose form does not change: one resistance matrix
//! surface      the loads on a body of any form that deforms
//! stretch      that form as five numbers
//! lattice      nodes in these five, and what is linear between them
//! reference    the ellipsoid against which the resistance of a form is measured
//! table        matrices at the nodes, computed when they are needed, and the error between them
//! spheres      rigid spheres that feel one another
//! wall         a rigid sphere beside plane walls
//! unsteady     a sphere in a fluid with inertia: kernels, relaxation modes, small vibrations
//! ```
//!
//! Stokes flow: u∞ = U∞ + L∞ x far away, tr L∞ = 0. Source: Sławianowski §4; `docs/theory-fluid.md`.

mod ambient;
mod ellipsoid;
mod fixed;
mod history;
mod immersed;
mod inclusion;
mod lattice;
mod reference;
mod spheres;
mod straining;
mod stretch;
mod surface;
mod table;
#[cfg(test)]
mod tests;
pub mod unsteady;
mod wall;

pub use ambient::{Flow, Fluid};
pub use ellipsoid::{FluidEllipsoid, FormSlope, Stress};
pub use fixed::{DragSlopes, FixedForm, RigidDrag};
pub(crate) use history::HistoryReaction;
pub use history::{History, HistoryLoads};
pub use immersed::Immersed;
pub use inclusion::{Form, ImmersedEllipsoid, Inclusion, MOST_SLENDER, SurfaceForm};
pub use spheres::{ImmersedSpheres, SphereLoads, SpheresTouch};
pub(crate) use straining::{STRAIN_NUMBERS, deviator, strain_numbers, strain_of};
pub use straining::{StrainHistory, StrainLoads};
pub use surface::ImmersedSurface;
pub use table::{NoMatrix, ResistanceSource, ResistanceTable, Resolution, UnresolvedForm, largest_error};
pub use wall::WallLoads;
