//! A sphere in a fluid with inertia: its history force, and how it answers small vibrations.
//!
//! Linearised unsteady Stokes flow about a sphere of radius R, ρ ∂u/∂t = −∇q + η ∇²u, div u = 0; τ = ρR²/η [s] is the
//! time in which vorticity spreads over R. With w the velocity and Ω the angular velocity of the sphere relative to the
//! fluid,
//!
//!   force  = −6πηR  [w + (τ/9) w′ + ∫₀ᵗ w′(s) κ(t − s) ds],    κ(t) = √(τ/(πt))                       (Basset 1888)
//!   torque = −8πηR³ [Ω + ∫₀ᵗ Ω′(s) κ(t − s) ds],               κ(t) = ⅓ (√(τ/(πt)) − e^(t/τ) erfc √(t/τ))
//!
//! with a jump of w(0) at t = 0, where the motion relative to the fluid begins. [`Exponentials`] puts sums of decaying
//! exponentials with positive weights in place of the kernels; their modes are state. [`vibration`] gives the
//! resistances to e^(iωt), and [`settling`] and [`spinning`] are motions in closed form. Nothing here knows a body, a
//! scene or a stepper: these are functions of numbers, called at set-up.

mod cut;
mod erfc;
pub mod exponentials;
mod fit;
mod interpolant;
pub mod kernel;
mod points;
pub mod settling;
pub mod spinning;
#[cfg(test)]
mod talbot;
pub mod vibration;

pub use exponentials::Exponentials;
pub use fit::UnresolvedHistory;
