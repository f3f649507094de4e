//! Surfaces and the moments of a power of the gap over them: all that contact with a plane needs.
//!
//! Over a homogeneously moving body the gap to a plane and the velocity relative to it are affine in X. Every law of
//! `contact` is a power of the gap times a polynomial in X of degree two at most, so that its force, moment and power
//! follow from
//!
//!   A₀ = ∫ κ(d) dA,  A₁ = ∫ κ(d) X dA,  A₂ = ∫ κ(d) X⊗X dA,  A₃ = ∫ κ(d) X⊗X⊗X dA,   d = g₀ + m·X,
//!
//! over the reference surface, with κ = d^−ν (or ln d, for the potential at ν = 1). A₃ occurs only in derivatives. This
//! module knows no law, no velocity and no time.
//!
//! Which file runs, by shape and deformation; per reference area a body that deforms is integrated as a rigid one.
//! Smooth primitives stand in `curved`, what they share in `curved/rules`:
//!
//! | surface | rigid, or per reference area | per deformed area, k = \|cof(P) N\| |
//! |---|---|---|
//! | facets | `facets/sums` | the same, areas deformed; with normals `facets/oriented` |
//! | sphere | `sphere`: closed form | `deformed/ellipsoid`, with equal axes |
//! | ellipsoid | `ellipsoid`: `features`, `polar`, `parallels` | `deformed/ellipsoid`: the same rule |
//! | hemisphere | `hemisphere`: zone in closed form, arcs `graded` | `deformed/hemisphere`: `graded`, `points` |
//! | wall | `cylinder`, `cone`: `rulings` around a `ring` | `deformed/walls`: `weighted_rulings` around an `own_ring` |
//! | disk | `disk`: chords around a `ring` | the same times one weight |
//! | torus | `torus`: `closed_circle` or `ring` in a `ring` | `deformed/torus`: `own_ring` in `own_ring`, `points` |
//!
//! Which formula, by exponent, for a request of order n:
//!
//! | kernel | facets | sphere, zone of a hemisphere | walls | circles of a torus | all others |
//! |---|---|---|---|---|---|
//! | integer ν, n + 3 ≤ ν ≤ 24 | `facets/integer` | `line/kernel` | as `split` | `closed_circle` to 16 | products |
//! | other integer ν | `facets/split` | `line/kernel` | as `split` | `closed_circle` from 1 to 16 | products |
//! | half-integer ν | `facets/split` | `line/kernel` | as `split` | as others | products and a square root |
//! | any other ν | `facets/split` | `line/kernel` | as `split` | as others | exp(−ν ln d) |
//! | ln d | `facets/split` | `line/kernel` | as `split` | as others | ln d |
//!
//! - On facets, weights for ν are lowered from those for ν + 1 where a request of higher order has these
//!   (`facets/plan`).
//! - `facets/split` goes along segments as walls do. There `line/integer` takes integers from 1 to 10 up to the degree
//!   ν − 2 of a moment, and up to ν if that is 4 at most; `line/segments` takes all others. Degrees go to n for a
//!   cylinder, to n + 1 for a cone and for facets.
//! - Powers at the ends of segments are products for integers, in registers else those of `simd/pow`.
//! - All others evaluate their kernels at nodes (`rules/integrand`), by products for 0 ≤ ν < 16 only.

mod composite;
pub mod curved;
mod facets;
mod frame;
mod gap;
mod line;
mod moments;
mod oriented;
mod plan;

pub use composite::Surface;
pub use curved::{QuadratureNode, gauss_legendre};
pub use facets::{Facets, FacetsError};
pub use gap::{GapClosed, GapField, GapLack};
pub use line::LineKernel;
pub use moments::{AxialMoments, Kernel, MomentRequest, Moments};
pub use oriented::OrientedMoments;
pub use plan::MomentPlan;
pub(crate) use plan::request;
