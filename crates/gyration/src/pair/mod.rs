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
//! | `side`        | one of the bodies: its gaps, and its moments X̃ and X̃⊗X̃          |
//! | `fault`       | why there is no plane between two bodies                         |
//! | `overlap`     | two bodies that no plane separates                              |
//! | `deepest`     | the shortest way apart of these                                 |
//! | `gjk`         | a plane between them to begin with, guessed or found             |
//! | `plane`       | a plane, and where it may be                                    |
//! | `equilibrium` | the plane of least potential, by Newton's method on log U        |
//! | `balls`       | the plane of least potential and its loads of two balls          |
//! | `state`       | a pair whose plane is found, and what both ends have of it       |
//! | `mediator`    | damping and friction against the velocities of the plane        |
//! | `loads`       | forces, moments, energy and powers                               |
//! | `slopes`      | their derivatives by the coordinates and velocities of both      |

mod balls;
mod deepest;
mod equilibrium;
mod fault;
mod gjk;
mod laws;
mod loads;
mod mediator;
mod overlap;
mod plane;
mod side;
mod slopes;
mod state;

pub use fault::PairFault;
pub use laws::{PairLaws, PairLawsError};
pub use loads::PairLoads;
pub use overlap::Overlap;
pub use plane::Guess;
pub use side::Side;
pub use slopes::PairSlopes;
pub use state::{PairGap, PairScratch};

use crate::load::Interaction;
use crate::surface::Surface;
use crate::tensor::Vec3;
use balls::{Balls, PlacedBalls};
use nalgebra::{Matrix3x4, Matrix4, Vector4};
use std::sync::Arc;

/// (p₀ | P), (ṗ₀ | Ṗ) or (f | M).
pub(crate) type Mat34 = Matrix3x4<f64>;
type Mat4 = Matrix4<f64>;
type Vec4 = Vector4<f64>;

/// The part of a reach at whose end a pair is out of it already, lest the last digit of a distance decides: χ, of fifth
/// order there, is below any digit of U.
pub const EDGE: f64 = 1e-9;

/// The least slab, of what is not two balls, that digits tell, and the least part of one that is on one side of the
/// plane, as parts of the size of the smaller body. Gaps are known to some 1e-16 of the size: so small a part to 1e-5,
/// its traction, which goes with a power of it, to 1e-4. What that leaves of the energy is told by the ledger.
const LEAST_SLAB: f64 = 1e-8;
const LEAST_PART: f64 = 1e-11;
/// The same of two balls, whose gap comes from two places alone.
const LEAST_BALLS: f64 = 1e-12;

/// Two bodies of a model that meet, or convex parts of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The indices of the two bodies, A and B, which differ.
    pub bodies: [usize; 2],
    /// Which part of each.
    pub parts: [usize; 2],
    /// What acts between them.
    pub laws: Arc<PairLaws>,
    /// The distance at which it begins [m]; none if it is everywhere.
    pub reach: Option<f64>,
    /// U_c [J]: below it nothing acts.
    threshold: f64,
    /// The radius of each about its centre of mass, in the reference shape [m].
    radii: [f64; 2],
    /// What both are, if they are balls about their centres of mass.
    balls: Option<Balls>,
}

impl Pair {
    /// Of two parts of bodies, given their surfaces.
    pub fn new(
        bodies: [usize; 2],
        parts: [usize; 2],
        laws: Arc<PairLaws>,
        reach: Option<f64>,
        surfaces: [&Surface; 2],
    ) -> Self {
        Self::of_radii(bodies, parts, laws, reach, surfaces, surfaces.map(Surface::radius))
    }

    /// The same, given the radii of both about their centres of mass [m], which are those of their surfaces.
    pub fn of_radii(
        bodies: [usize; 2],
        parts: [usize; 2],
        laws: Arc<PairLaws>,
        reach: Option<f64>,
        surfaces: [&Surface; 2],
        radii: [f64; 2],
    ) -> Self {
        let threshold = reach.map_or(0.0, |reach| laws.most(reach, surfaces.map(Surface::area)));
        let balls = match surfaces.map(Surface::ball) {
            [Some(one), Some(other)] => Some(Balls::new(&laws, [one, other])),
            _ => None,
        };
        Self { bodies, parts, laws, reach, threshold, radii, balls }
    }

    /// Whether the energy at which it begins is a number; zero without a reach.
    pub fn has_range(&self) -> bool {
        self.reach.is_none() || self.threshold.is_normal()
    }

    /// What two rigid balls do out of reach, nothing, with the gap between them, given the place of A from B and that
    /// of B [m]; none of other shapes.
    pub fn apart(&self, between: &Vec3, place: &Vec3) -> Option<PairLoads> {
        let distance = between.norm();
        let normal = between / distance;
        let gap = distance - self.radii[0] - self.radii[1];
        let point = place + (self.radii[1] + 0.5 * gap) * normal;
        self.balls.is_some().then(|| PairLoads { gap, normal, point, ..PairLoads::default() })
    }

    /// How near the plane has come to one of two bodies [m], the smaller of which has this size, if that is so near
    /// that digits do not tell it from touch.
    pub fn touch(&self, slab: &PairGap, size: f64) -> Option<f64> {
        let part = slab.gap * slab.share.min(1.0 - slab.share);
        let touches = match self.balls.is_some() {
            true => slab.gap < LEAST_BALLS * size,
            false => slab.gap < LEAST_SLAB * size || part < LEAST_PART * size,
        };
        touches.then_some(part)
    }

    /// The plane between two rigid balls; none of other bodies.
    fn balls(&self, sides: [&Side; 2]) -> Option<Result<PlacedBalls<'_>, PairFault>> {
        self.balls.as_ref()?.place(sides)
    }

    /// The distance of the centres at which two rigid bodies are as far apart as the half of their reach at least [m].
    pub fn half_cutoff(&self) -> Option<f64> {
        self.reach.map(|reach| reach + self.radii[0] + self.radii[1] - 0.5 * reach)
    }

    /// The distance of the centres from which on two rigid bodies do nothing to each other [m]; none if there is none.
    pub fn cutoff(&self) -> Option<f64> {
        self.reach.map(|reach| reach * (1.0 - EDGE) + self.radii[0] + self.radii[1])
    }
}

impl Interaction for Pair {
    fn bodies(&self) -> [usize; 2] {
        self.bodies
    }

    fn renumbered(&self, bodies: [usize; 2]) -> Self {
        Self { bodies, ..self.clone() }
    }
}
