//! Smooth primitives of a body that deforms: the same moments with weights that vary over the surface.
//!
//! The rules of `rules` are asked for the singularities of the weight besides those of the kernel. A disk needs none of
//! this: its normal is the same everywhere.

mod ellipsoid;
mod hemisphere;
mod torus;
mod walls;
