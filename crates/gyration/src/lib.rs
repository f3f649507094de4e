//! Mechanics of bodies that move by homogeneous deformations,
//!
//!   p(X, t) = p₀(t) + P(t) (X − X₀).
//!
//! Shapes, mass, kinematics, contact laws, loads, bodies, rates and balances. No input or output, no clock, no random
//! numbers, no threads of its own. `ARCHITECTURE.md` has the order of the modules. Read [`dynamics::rates`] first.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod acting;
pub mod affine;
pub mod balance;
pub mod body;
pub mod contact;
pub mod contractile;
pub mod dynamics;
mod ellipsoid_moments;
pub mod extended;
pub mod fluid;
pub mod homogeneous;
pub mod immersion;
mod inadmissible;
pub mod instant;
pub mod joint;
pub mod kinematics;
pub mod lattice;
pub mod ledger;
pub mod load;
pub mod mass;
pub mod material;
pub mod model;
pub mod neighbours;
pub mod pair;
mod party;
pub mod shape;
pub mod signal;
mod simd;
pub mod solid_support;
pub mod state;
pub mod support;
pub mod surface;
mod team;
pub mod tensor;

pub use inadmissible::{FormulaOf, Inadmissible, Quantity};
pub use party::Party;
pub use team::{EachOnThreads, Team};
