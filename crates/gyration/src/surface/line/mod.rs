//! Moments of a kernel along straight segments, from which facets, walls and spheres are built.
//!
//! [`LineKernel`] is a kernel prepared for a degree, and has the formulas for one segment (`kernel`); `segments` has
//! them for as many segments as a register holds, and `integer` those for an integer exponent there.

mod end_kernel;
mod ends;
mod integer;
mod kernel;
mod segments;

pub(crate) use end_kernel::EndKernel;
pub(crate) use ends::{End, HIGHEST_DEGREE, LineMoments};
pub use kernel::LineKernel;
pub(crate) use segments::line_moments;
