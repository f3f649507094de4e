//! Mechanics of bodies that move by homogeneous deformations,
//!
//!   p(X, t) = p₀(t) + P(t) (X − X₀).
//!
//! Shapes, mass, kinematics, contact laws, loads, bodies, rates and balances. No input or output, no clock, no
//! random numbers, no threads. Each module imports only what stands to its left:
//! `tensor → surface, shape, mass → kinematics → contact, load → body → model, state → rates, balance`.

pub mod surface;
pub mod tensor;
