//! Rest states of bodies, and the small motions about them.
//!
//!   rest: a(q, 0) = 0, a the accelerations;   about it  ξ̈ + C ξ̇ + K ξ = 0,   ξ ∝ e^{λt},   λ = −δ ± iω
//!
//! q are the coordinates of one body, or of a system: bodies that springs, bonds, joints or contacts join. ξ are small
//! changes of them along which the mass is one (`coordinates`): twelve of an affine body, nine of a pinned one, one
//! less each if it is incompressible, six or three of a rigid one; those of a system are those of its bodies, one after
//! the other (`system`), within their joints (`tangent`). K and C come from the exact Jacobian; neither needs to be
//! symmetric, since tractions per deformed area, couples and gyroscopic loads have no potential. `equilibrium` finds
//! the rest state downhill from the start of a run, `spectrum` solves for λ, `words` says what a mode is.
//!
//! The contraction G of a body that drives itself is a state of first order (`contraction`): at rest it stands still
//! too, in the state next to the one that the body gets to while G is held. Where there is none G stays held.
//!
//! Everything is about t = 0: supports, couples and drives are frozen as they are then, and what the bodies' velocities
//! would be does not matter. Nothing here steps in time.

pub mod bands;
mod barriers;
mod canonical;
mod contraction;
mod coordinates;
mod equilibrium;
mod frozen;
mod participation;
mod parts;
mod settling;
mod shape;
mod slopes;
mod spectrum;
mod system;
mod tangent;
mod weightless;
mod words;

pub use participation::{PARTS, Participation};
pub use shape::ModeShape;

use coordinates::Coordinates;
use frozen::{FrozenContraction, FrozenSystem};
use gyration::Inadmissible;
use gyration::body::matrix;
use gyration::kinematics::Placement;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};
use gyration_threads::Interruption;
use nalgebra::{Complex, ComplexField};
use settling::settled;

use spectrum::{EigenMotion, FirstOrder};
use system::SystemCoordinates;

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
    /// What its contraction does there; none of a body without one, or whose contraction is prescribed.
    pub contraction: Option<RestContraction>,
    /// The body's block of the state, at rest; without G where that is held.
    pub(crate) block: Vec<f64>,
}

impl Rest {
    /// The body's block of the state, at rest.
    pub fn block(&self) -> &[f64] {
        &self.block
    }
}

/// What the contraction of a body that drives itself does in its rest state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RestContraction {
    /// It stands still, at this G, under the drive of the start.
    Stands(Mat3),
    /// It goes on with this |V_G| [1/s], and no state is near in which it would stand still: G is held.
    GoesOn(f64),
}

/// Why a body has no rest state, or none was found.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoRest {
    /// No load but gravity acts on its centre.
    #[error("nothing holds the body against gravity: it falls")]
    Falls,
    /// Gravity has a part along the supports.
    #[error(
        "no support pushes back along ({:.4}, {:.4}, {:.4}), where gravity pulls with {acceleration:.4} m/s²: \
         the body slides on",
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
    /// The fluid remembers how it moved.
    #[error(
        "the fluid remembers how a body moved (`history`), which its small motions would have to go on with: write \
         history = false to leave that out"
    )]
    Remembered,
    /// Its kinetic energy changes with its form.
    #[error("the kinetic energy of the body is another (`kinetic`): modes are those of a constant mass")]
    NoConstantMass,
    /// Other bodies act on it.
    #[error("others act on the body: `gyration modes` looks for the rest that they have together")]
    ActedOn,
    /// The search came to no end.
    #[error(
        "no rest state was found in {steps} steps from the start: accelerations of up to {acceleration:.2e} (m/s², \
         1/s²) are left; a couple or a load without potential may turn the body for ever"
    )]
    NotFound {
        /// Steps taken.
        steps: usize,
        /// The largest acceleration left, in numbers of the state.
        acceleration: f64,
    },
    /// The search came to an edge of the model.
    #[error(
        "no rest state was found: the way downhill ends where the model does, after {steps} steps from the start, with \
         accelerations of up to {acceleration:.2e} (m/s², 1/s²) left"
    )]
    Blocked {
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
    /// λ₁, λ₂ [1/s]: a conjugate pair, the positive frequency first, or two real numbers, the slower motion first; one
    /// real number of a motion that the contraction adds.
    pub eigenvalues: Vec<Complex<f64>>,
    /// What it does in time.
    pub motion: ModeBehaviour,
    /// How the bodies move, each of them.
    pub shapes: Vec<ModeShape>,
    /// The part of the motion that is a quarter of a period ahead; none if all points move in step.
    pub quadratures: Option<Vec<ModeShape>>,
    /// What it is: "translation along z", "shear in the plane xy".
    pub in_words: String,
    /// What moves, as shares of the kinetic energy.
    pub participation: Participation,
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

    /// δ = −Re λ of its eigenvalues [1/s]; negative where the motion grows.
    pub fn decay_rates(&self) -> Vec<f64> {
        // Zero has no sign.
        self.eigenvalues.iter().map(|eigenvalue| 0.0 - eigenvalue.re).collect()
    }

    /// ζ = −(λ₁ + λ₂)/(2√(λ₁λ₂)), below one where it oscillates; none of a free or unstable motion, or of one λ.
    pub fn damping_ratio(&self) -> Option<f64> {
        let [first, second] = self.eigenvalues[..] else { return None };
        let product = (first * second).re;
        let bound = matches!(self.motion, ModeBehaviour::Oscillates | ModeBehaviour::Creeps) && product > 0.0;
        bound.then(|| 0.0 - (first + second).re / (2.0 * product.sqrt()))
    }
}

/// The rest state that the body of this index gets to from its start, if it is led there without inertia.
///
/// # Errors
/// [`NoRest`], also where other bodies act on it ([`system_rest`]).
pub fn rest(model: &Model, start: &State, body: usize) -> Result<Rest, NoRest> {
    if !model.bodies[body].has_inertia() {
        return Err(NoRest::WithoutInertia);
    }
    if model.is_joined(body) {
        return Err(NoRest::ActedOn);
    }
    system_rest(model, start, &[body]).map(|mut rests| rests.swap_remove(0))
}

/// The rest state that bodies get to together from their start, led there without inertia: their indices ascend, and
/// all that is between them acts.
///
/// # Errors
/// [`NoRest`].
pub fn system_rest(model: &Model, start: &State, members: &[usize]) -> Result<Vec<Rest>, NoRest> {
    if members.iter().any(|body| model.bodies[*body].history().is_some()) {
        return Err(NoRest::Remembered);
    }
    let is_of_own_mass = |body: &usize| model.bodies[*body].affine().is_some_and(|it| it.interior.kinetic.is_some());
    if members.iter().any(is_of_own_mass) {
        return Err(NoRest::NoConstantMass);
    }
    let (mut frozen, held) = held_rest(model, start, members)?;
    let rests = equilibrium::rest_at(&mut frozen, &held);
    if are_driven(model, members.iter().copied()) { contracting(model, start, members, rests) } else { Ok(rests) }
}

/// Whether a contraction of some bodies moves by its law.
fn are_driven(model: &Model, mut members: impl Iterator<Item = usize>) -> bool {
    members.any(|body| model.bodies[body].contraction().is_some_and(|law| law.is_driven()))
}

/// The bodies with their contractions held, and their numbers at rest.
fn held_rest(model: &Model, start: &State, members: &[usize]) -> Result<(FrozenSystem, Vec<f64>), NoRest> {
    let mut frozen = FrozenSystem::new(model, start, members, FrozenContraction::Held);
    match equilibrium::find(&mut frozen) {
        Err(_) if Interruption::due().is_some() => Err(NoRest::Interrupted),
        found => found.map(|held| (frozen, held)),
    }
}

/// The rest state of bodies whose contractions move, next to the one that they have while these are held.
fn contracting(model: &Model, start: &State, members: &[usize], held: Vec<Rest>) -> Result<Vec<Rest>, NoRest> {
    let mut frozen = FrozenSystem::new(model, start, members, FrozenContraction::Driven);
    let mut numbers = Vec::new();
    for (body, rest) in held.iter().enumerate() {
        numbers.extend(frozen.at_rest(body, &rest.block));
        if frozen.is_driven(body) {
            numbers.extend_from_slice(&frozen.start[frozen.contraction(body)]);
        }
    }
    let rates = frozen.rates(&numbers)?;
    let speeds = SystemCoordinates::at(&mut frozen, &numbers)?.contraction_velocities(&frozen, &numbers, &rates);
    match settled(&mut frozen, numbers)? {
        Some(numbers) => {
            let stands =
                |body: usize| speeds[body].map(|_| RestContraction::Stands(matrix(&numbers[frozen.contraction(body)])));
            let stands: Vec<Option<RestContraction>> = (0..members.len()).map(stands).collect();
            let rests = equilibrium::rest_at(&mut frozen, &numbers).into_iter().zip(stands);
            Ok(rests.map(|(rest, contraction)| Rest { contraction, ..rest }).collect())
        }
        None if Interruption::due().is_some() => Err(NoRest::Interrupted),
        None => {
            let goes_on = |speed: Option<Mat3>| speed.map(|speed| RestContraction::GoesOn(speed.norm()));
            Ok(held.into_iter().zip(speeds).map(|(rest, speed)| Rest { contraction: goes_on(speed), ..rest }).collect())
        }
    }
}

/// The small motions about a rest state, by frequency: those that grow first, then free, creeping, oscillating ones.
///
/// # Errors
/// [`NoSpectrum`]; none for bodies of moderate numbers.
pub fn modes(model: &Model, start: &State, body: usize, rest: &Rest) -> Result<Vec<Mode>, NoSpectrum> {
    let mut modes = found_modes(model, start, &[body], std::slice::from_ref(rest))?;
    modes.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
    Ok(modes)
}

/// The small motions of bodies about the rest state that they have together: free ones first, then by frequency.
///
/// # Errors
/// [`NoSpectrum`]; none for bodies of moderate numbers.
pub fn system_modes(model: &Model, start: &State, members: &[usize], rests: &[Rest]) -> Result<Vec<Mode>, NoSpectrum> {
    let mut modes = found_modes(model, start, members, rests)?;
    let order = |mode: &Mode| (mode.motion != ModeBehaviour::Free, mode.frequency(), mode.eigenvalues[0].modulus());
    modes.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
    Ok(modes)
}

/// How many coordinates of small motions a body has, the joints and all that acts aside.
pub fn coordinate_count(model: &Model, start: &State, body: usize) -> usize {
    Coordinates::at(&model.bodies[body], &start.bodies[model.slots(body).block()]).count()
}

/// The numbers of bodies at rest.
fn at_rest(frozen: &FrozenSystem, rests: &[Rest]) -> Vec<f64> {
    rests.iter().enumerate().flat_map(|(body, rest)| frozen.at_rest(body, &rest.block)).collect()
}

fn found_modes(model: &Model, start: &State, members: &[usize], rests: &[Rest]) -> Result<Vec<Mode>, NoSpectrum> {
    let stands = rests.iter().any(|rest| matches!(rest.contraction, Some(RestContraction::Stands(_))));
    let follows = if stands { FrozenContraction::Driven } else { FrozenContraction::Held };
    let mut frozen = FrozenSystem::new(model, start, members, follows);
    let numbers = at_rest(&frozen, rests);
    let slopes = frozen.slopes(&numbers).map_err(|_| NoSpectrum)?;
    let coordinates = SystemCoordinates::at(&mut frozen, &numbers).map_err(|_| NoSpectrum)?;
    let resistance = coordinates.resistance(&slopes);
    let (stiffness, first) = match coordinates.contracts() {
        false => {
            let stiffness = coordinates.stiffness(&slopes);
            let none = FirstOrder::none(stiffness.nrows());
            (stiffness, none)
        }
        true => {
            let rates = frozen.rates(&numbers).map_err(|_| NoSpectrum)?;
            let velocities = coordinates.contraction_velocities(&frozen, &numbers, &rates);
            coordinates.first_order(&velocities, &slopes)
        }
    };
    let inertial = coordinates.inertial(&frozen);
    let (stiffness, resistance, first) = match inertial.weightless.is_empty() {
        true => (stiffness, resistance, first),
        false => inertial.condensed_real((&stiffness, &resistance), &first).ok_or(NoSpectrum)?,
    };
    let patterns = coordinates.patterns(&frozen, &numbers).into_iter().map(|pattern| inertial.moving_part(pattern));
    let basis = canonical::basis(&stiffness, &patterns.collect::<Vec<_>>());
    let found = spectrum::solve((&stiffness, &resistance), &first, &basis)?;
    let names: Vec<&str> = members.iter().map(|body| model.name(*body)).collect();
    let mode = |found: &EigenMotion| {
        let (real, mut imaginary) = shape::in_step(&inertial.placed(&found.shape, &found.following));
        if found.eigenvalues[0].im == 0.0 {
            imaginary.fill(0.0);
        }
        let (shapes, quadratures) = coordinates.scaled_shapes(&frozen, &real, &imaginary);
        let placements: Vec<Placement> = rests.iter().map(|rest| rest.placement).collect();
        let contracts = found.eigenvalues.len() == 1;
        let along = inertial.contractions(&found.contraction).map(|entry| entry.re);
        let strain = |body: usize| coordinates.strain(body, &along).filter(|_| contracts);
        let strains: Vec<Option<Mat3>> = (0..members.len()).map(strain).collect();
        let in_words = words::of_system(&names, frozen.bodies(), &placements, &shapes, &strains);
        let ahead = quadratures.as_deref().unwrap_or_default();
        let participation = Participation::of(frozen.bodies(), &placements, [&shapes, ahead]);
        Mode {
            eigenvalues: found.eigenvalues.clone(),
            motion: found.motion,
            shapes,
            quadratures,
            in_words,
            participation,
        }
    };
    Ok(found.iter().map(mode).collect())
}

/// Free first, then by the size of the slower eigenvalue.
fn order(mode: &Mode) -> (u8, f64) {
    let rank = match mode.motion {
        ModeBehaviour::Grows => 0,
        ModeBehaviour::Free => 1,
        ModeBehaviour::Creeps => 2,
        ModeBehaviour::Oscillates => 3,
    };
    let counted = if rank == 1 { &mode.eigenvalues[..] } else { &mode.eigenvalues[..1] };
    (rank, counted.iter().map(|value| value.modulus()).fold(0.0, f64::max))
}
