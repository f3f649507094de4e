//! Two bodies that meet: one massless plane between them, which both feel as they feel a plane.
//!
//! A plane y = (n, c), |n| = 1, has the points n·x = c; body A is above it, body B below. With q_i = (p₀ | P) of a
//! body, a 3×4 matrix, and X̃ = (1; X), the gap of a point is
//!
//!   d_i = z_i·X̃,   z_i = σ_i (q_iᵀn − c e₀),   σ_A = 1, σ_B = −1
//!   U_i(y) = ∫ α d₀ (d_i/d₀)^(1−ν)/(ν−1) dA,   D_i = (U_i/αd₀)^(−1/(ν−1))
//!   √Φ = √(w_A D_A) + √(w_B D_B),   U = αd₀ · min over the planes of Φ^(−(ν−1))
//!   w_A = ℓ_B/(ℓ_A + ℓ_B),   w_B = ℓ_A/(ℓ_A + ℓ_B),   ℓ = √(reference surface)
//!
//! Φ is concave, so that there is one such plane, if the convex hulls of the two can be separated, and it moves
//! analytically with them. Having no mass it is in balance: what one body exerts on it, the other takes. Source:
//! `docs/theory-meetings.md`.
//!
//! | file          | what                                                            |
//! |---------------|-----------------------------------------------------------------|
//! | `laws`        | what acts between two bodies, and the moments that it needs      |
//! | `form`        | laws, reach and radii of two parts of bodies                    |
//! | `pull`        | adhesion, as powers of the gap beside what places the plane      |
//! | `held`        | the gap at which faces that adhere hold each other               |
//! | `reach`       | where the force of a pair begins                                |
//! | `side`        | one of the bodies: its gaps, and its moments X̃ and X̃⊗X̃          |
//! | `fault`       | why there is no plane between two bodies                         |
//! | `overlap`     | two bodies that no plane separates                              |
//! | `deepest`     | the shortest way apart of these                                 |
//! | `gjk`         | a plane between them to begin with, guessed or found             |
//! | `plane`       | a plane, and where it may be                                    |
//! | `mean`        | U of both sides from U of each                                  |
//! | `expansion`   | log U about a plane, to second order                            |
//! | `equilibrium` | the plane of least potential, by Newton's method on log U        |
//! | `placed`      | the plane in balance, and where its force begins                 |
//! | `exchange`    | loads, derivatives and slab, as they are told                   |
//! | `balls`       | the plane of two balls, their loads and derivatives             |
//! | `state`       | a pair whose plane is found, and what both ends have of it       |
//! | `pulled`      | adhesion at the plane that something else places                |
//! | `pulled_slopes` | how this changes with the places of both                      |
//! | `directions`  | the one or two directions of damping and friction               |
//! | `mediator`    | damping and friction against the velocities of the plane        |
//! | `mediator_slopes` | how these change with the places of both                    |
//! | `areas`       | how moments change with the area factors of bodies that deform  |
//! | `tension`     | what makes tractions per deformed area derive from a potential  |
//! | `opening`     | damping that hardly pulls on what recedes                       |
//! | `loads`       | forces, moments, energy and powers                               |
//! | `tractions`   | forces on parts of the surfaces of both                          |
//! | `slopes`      | their derivatives by the coordinates and velocities of both      |

mod areas;
mod balls;
mod deepest;
mod directions;
mod equilibrium;
mod exchange;
mod expansion;
mod fault;
mod form;
mod gjk;
mod held;
mod laws;
mod loads;
mod mean;
mod mediator;
mod mediator_slopes;
mod opening;
mod overlap;
mod placed;
mod plane;
mod pull;
mod pulled;
mod pulled_slopes;
mod reach;
mod side;
mod slopes;
mod state;
mod tension;
mod tractions;

pub use exchange::{PairGap, PairLoads, PairSlopes};
pub use fault::PairFault;
pub use form::{EDGE, PairForm, cutoff, half_cutoff};
pub use laws::{PairLaws, PairLawsError};
pub use overlap::Overlap;
pub use plane::Guess;
pub use reach::{Falling, Mass, Reach, Threshold};
pub use side::Side;
pub use state::PairScratch;
pub use tractions::PairTractions;

use nalgebra::{Matrix3x4, Matrix4, Vector4};

/// (p₀ | P), (ṗ₀ | Ṗ) or (f | M).
pub(crate) type Mat34 = Matrix3x4<f64>;
type Mat4 = Matrix4<f64>;
type Vec4 = Vector4<f64>;
