//! Sparse matrices of dense blocks: where blocks stand, and their factors. No mechanics, no steps.
//!
//! A [`BlockMatrix`] has blocks where a [`Pattern`] has pairs of them. Blocks that hang together through any chain are
//! a component ([`Components`]); an [`Analysis`] finds once in which order its blocks are eliminated and which blocks
//! the factors have, and [`BlockLu`] factorizes s I − A and solves, for real and complex s, as often as the numbers
//! change. [`RealLu`] and [`ComplexLu`] are the factors of a single block.
//!
//! | to read | file |
//! |---|---|
//! | which blocks couple | `pattern`, `block_matrix` |
//! | factors of one block | `linear` |
//! | factors of several | `analysis`, `reduction`, `elimination`, `kernel` |
//!
//! Nothing is allocated while the pattern stays, and sums run in an order that follows from the pattern alone.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod analysis;
mod block_matrix;
mod elimination;
mod kernel;
mod linear;
mod pattern;
mod reduction;

pub use analysis::Analysis;
pub use block_matrix::BlockMatrix;
pub use elimination::BlockLu;
pub use kernel::{BlockArithmetic, Complex, Real};
pub use linear::{ComplexLu, RealLu, Singular};
pub use pattern::{Components, Pattern};
