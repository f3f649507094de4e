//! The resistance of a closed surface in slow viscous flow, by boundary elements.
//!
//! Plain numbers in, plain numbers out: points and triangles give the 12×12 matrix from velocity and velocity gradient
//! to force and affine moment, for a fluid of viscosity one. [`ClosedSurface`] is the mesh, [`StokesOptions`] say about
//! which centre and what the triangles stand for, [`StokesResistance`] is the answer with its estimated error. The
//! method stands in `resistance.rs`.
//!
//! ```
//! use gyration_stokes::{ClosedSurface, StokesOptions};
//! let sphere = ClosedSurface::icosphere(2)?;
//! let drag = sphere.resistance(&StokesOptions::default())?;
//! assert!((drag.matrix[0][0] / (6.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3);
//! # Ok::<(), gyration_stokes::StokesError>(())
//! ```
//!
//! The same bytes come out on any number of threads. Nothing here knows of bodies, scenes or time.

#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod assembly;
mod coarse;
mod curvature;
mod dense;
mod error;
mod estimate;
mod inner;
mod mesh;
mod motion;
mod pair;
mod panel;
mod resistance;
mod rule;
mod surface;
mod vector;
mod wall;

pub use error::StokesError;
pub use mesh::MAX_REFINEMENTS;
pub use resistance::{DEFAULT_MAX_BYTES, Faces, StokesOptions, StokesResistance};
pub use surface::ClosedSurface;
pub use wall::WallPlane;
