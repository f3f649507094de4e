//! Rest states of bodies, and the small motions about them.
//!
//!   rest: a(q, 0) = 0, a the accelerations;   about it  ξ̈ + C ξ̇ + K ξ = 0,   ξ ∝ e^{λt},   λ = −δ ± iω
//!
//! q are the coordinates of one body (bodies do not act on each other), ξ small changes of them along which the mass is
//! one (`coordinates`): twelve of an affine body, nine of a pinned one, one less each if it is incompressible, six or
//! three of a rigid one. K and C come from the exact Jacobian; neither needs to be symmetric, since tractions per
//! deformed area, couples and gyroscopic loads have no potential. `equilibrium` finds the rest state downhill from the
//! start of a run, `spectrum` solves for λ, `words` says what a mode is.
//!
//! Everything is about t = 0: supports and couples are frozen as they are then, and what the bodies' velocities would
//! be does not matter. Nothing here steps in time.

mod canonical;
mod coordinates;
mod equilibrium;
mod frozen;
mod shape;
mod spectrum;
mod words;

pub use shape::ModeShape;

use coordinates::Coordinates;
use frozen::FrozenBody;
use gyration::Inadmissible;
use gyration::kinematics::Placement;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_threads::Interruption;
use nalgebra::{Complex, ComplexField};

/// Where a body rests.
#[derive(Debug, Clone, PartialEq)]
pub struct Rest {
    /// p₀ [m] and P.
    pub placement: Placement,
    /// Principal stretches, the singular values of P, the largest first; ones of a rigid body.
    pub stretches: Vec3,
    /// π [Pa] of an incompressible body.
    pub pressure: Option<f64>,
    /// Smallest distance to a support whose laws act on it [m]; infinite without one.
    pub gap: f64,
    /// The body's block of the state, at rest.
    pub(crate) block: Vec<f64>,
}

impl Rest {
    /// The body's block of the state, at rest.
    pub fn block(&self) -> &[f64] {
        &self.block
    }
}

/// Why a body has no rest state, or none was found.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoRest {
    /// No load but gravity acts on its centre.
    #[error("nothing holds the body against gravity: it falls")]
    Falls,
    /// Gravity has a part along the supports.
    #[error(
        "no support pushes back along ({:.4}, {:.4}, {:.4}), where gravity pulls with {acceleration:.4} m/s²: the body slides on",
        along.x, along.y, along.z
    )]
    Slides {
        /// Unit direction.
        along: Vec3,
        /// The part of gravity along it [m/s²].
        acceleration: f64,
    },
    /// The loads drive it ever farther.
    #[error("the loads drive the body away: {distance:.1e} m from where it starts they still push")]
    DrivenAway {
        /// How far the search followed it [m].
        distance: f64,
    },
    /// Nothing resists its deformation enough.
    #[error("the loads deform the body without end: at a stretch of {stretch:.1e} they still do; has it a material?")]
    Deforms {
        /// The stretch that is farthest from one.
        stretch: f64,
    },
    /// The body has no inertia.
    #[error("the body has no inertia: it has no modes, but the velocities that the fluid lets it have")]
    WithoutInertia,
    /// Other bodies act on it.
    #[error("other bodies act on the body: the rest of several bodies together is not looked for")]
    Joined,
    /// The search came to no end.
    #[error(
        "no rest state was found in {steps} steps from the start: accelerations of up to {acceleration:.2e} (m/s², 1/s²) are \
         left; a couple or a load without potential may turn the body for ever"
    )]
    NotFound {
        /// Steps taken.
        steps: usize,
        /// The largest acceleration left, in numbers of the state.
        acceleration: f64,
    },
    /// The search was given up.
    #[error("the search for it was given up: it takes longer than solver.max_wall_time")]
    Interrupted,
    /// The start is outside the model.
    #[error("the start is outside the model: {0}")]
    Start(#[from] Inadmissible),
}

/// What a small motion does in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeBehaviour {
    /// λ = −δ ± iω, δ ≥ 0.
    Oscillates,
    /// Two real λ < 0.
    Creeps,
    /// λ = 0: nothing brings the body back. The other λ is 0 too, or the rate at which the motion dies out.
    Free,
    /// A λ with positive real part: the rest state is unstable.
    Grows,
}

/// A small motion about rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// λ₁, λ₂ [1/s]: a conjugate pair, the positive frequency first, or two real numbers, the slower motion first.
    pub eigenvalues: [Complex<f64>; 2],
    /// What it does in time.
    pub motion: ModeBehaviour,
    /// How the body moves.
    pub shape: ModeShape,
    /// The part of the motion that is a quarter of a period ahead; none if all points move in step.
    pub quadrature: Option<ModeShape>,
    /// What it is: "translation along z", "shear in the plane xy".
    pub in_words: String,
}

/// The eigenvalues could not be found to working precision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the eigenvalues of the motion about rest could not be found: the iteration did not end")]
pub struct NoSpectrum;

impl Mode {
    /// ω = |Im λ| [rad/s]; 0 of a motion that does not oscillate.
    pub fn frequency(&self) -> f64 {
        self.eigenvalues[0].im.abs()
    }

    /// δ = −Re λ of both eigenvalues [1/s]; negative where the motion grows.
    pub fn decay_rates(&self) -> [f64; 2] {
        // Zero has no sign.
        self.eigenvalues.map(|eigenvalue| 0.0 - eigenvalue.re)
    }

    /// ζ = −(λ₁ + λ₂)/(2√(λ₁λ₂)), below one where it oscillates; none of a free or unstable motion.
    pub fn damping_ratio(&self) -> Option<f64> {
        let [first, second] = self.eigenvalues;
        let product = (first * second).re;
        let bound = matches!(self.motion, ModeBehaviour::Oscillates | ModeBehaviour::Creeps) && product > 0.0;
        bound.then(|| 0.0 - (first + second).re / (2.0 * product.sqrt()))
    }
}

/// The rest state that the body of this index gets to from its start, if it is led there without inertia.
///
/// # Errors
/// [`NoRest`].
pub fn rest(model: &Model, start: &State, body: usize) -> Result<Rest, NoRest> {
    if !model.bodies[body].has_inertia() {
        return Err(NoRest::WithoutInertia);
    }
    if model.is_joined(body) {
        return Err(NoRest::Joined);
    }
    let mut frozen = FrozenBody::new(model, start, body);
    match equilibrium::find(&mut frozen) {
        Err(_) if Interruption::due().is_some() => Err(NoRest::Interrupted),
        found => found,
    }
}

/// The small motions about a rest state, by frequency: those that grow first, then free, creeping, oscillating ones.
///
/// # Errors
/// [`NoSpectrum`]; none for bodies of moderate numbers.
pub fn modes(model: &Model, start: &State, body: usize, rest: &Rest) -> Result<Vec<Mode>, NoSpectrum> {
    let mut frozen = FrozenBody::new(model, start, body);
    let slopes = frozen.slopes(&rest.block).map_err(|_| NoSpectrum)?;
    let coordinates = Coordinates::at(frozen.body(), &rest.block);
    let (stiffness, resistance) = (coordinates.stiffness(&slopes), coordinates.resistance(&slopes));
    let basis = canonical::basis(&stiffness, &coordinates.patterns(frozen.body(), &rest.placement.gradient));
    let found = spectrum::solve(&stiffness, &resistance, &basis)?;
    let mut modes: Vec<Mode> = found
        .iter()
        .map(|pair| {
            let (real, mut imaginary) = shape::in_step(&pair.shape);
            if pair.eigenvalues[0].im == 0.0 {
                imaginary.fill(0.0);
            }
            let (shape, quadrature) = coordinates.scaled_shape(frozen.body(), &real, &imaginary);
            let in_words = words::of(&shape, frozen.body(), &rest.placement);
            Mode { eigenvalues: pair.eigenvalues, motion: pair.motion, shape, quadrature, in_words }
        })
        .collect();
    modes.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
    Ok(modes)
}

/// Free first, then by the size of the slower eigenvalue.
fn order(mode: &Mode) -> (u8, f64) {
    let rank = match mode.motion {
        ModeBehaviour::Grows => 0,
        ModeBehaviour::Free => 1,
        ModeBehaviour::Creeps => 2,
        ModeBehaviour::Oscillates => 3,
    };
    (rank, mode.eigenvalues[0].modulus().max(if rank == 1 { mode.eigenvalues[1].modulus() } else { 0.0 }))
}
