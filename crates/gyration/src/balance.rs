//! What is conserved, exchanged and audited: energies, works, momenta.
//!
//!   kinetic ½ m|ṗ₀|² + ½ tr(Ṗ J Ṗᵀ),   gravity −m g·p₀,   elastic V φ (V det G φ of a contractile body),
//!   contact ∫U(d) dA,   load Σ ½k(l − l₀)²
//!   K = P J Ṗᵀ (affine momentum; its antisymmetric part is angular momentum)
//!
//! U(d) = α d₀ (d/d₀)^(1−ν)/(ν−1); at ν = 1, −α d₀ ln(d/d₀). Works are done on the bodies since t = 0; the residual of
//! the ledger is (Σ energies) − (Σ energies at 0) − Σ works. Source: `docs/theory-rigid.md`.

use crate::body::Body;
use crate::contractile;
use crate::dynamics::{
    Acting, ContractileMotion, Scratch, Workspace, acting, affine_balance, gap_at, of_history, stored_energy,
};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, Instant, KindAt, MotionAt};
use crate::kinematics::{Placement, Velocity};
use crate::ledger::Energy;
use crate::model::Model;
use crate::shape::{MassPoint, Points, Shape};
use crate::state::{BodyMotion, State};
use crate::tensor::{Mat3, Vec3};

/// What is recorded of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyObservation {
    /// Placement, velocity, spin.
    pub motion: BodyMotion,
    /// The smallest gap to anything that it has a contact with [m]: see [`gap_at`].
    pub gap: f64,
    /// Contact force [N].
    pub contact_force: Vec3,
    /// m ṗ₀ [kg m/s].
    pub linear_momentum: Vec3,
    /// p₀ × m ṗ₀ + the body's own, about the origin [kg m²/s].
    pub angular_momentum: Vec3,
    /// K = P J Ṗᵀ [kg m²/s].
    pub affine_momentum: Mat3,
    /// π [Pa] of an incompressible body.
    pub pressure: Option<f64>,
    /// What a contractile body does by itself.
    pub effort: Option<Effort>,
}

/// What a contractile body does by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// G.
    pub contraction: Mat3,
    /// V_G = Ġ G⁻¹ [1/s].
    pub velocity: Mat3,
    /// Q [Pa], given or what a prescribed G takes.
    pub drive: Mat3,
}

/// What is recorded of one body in a state.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn observe(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    index: usize,
) -> Result<BodyObservation, Inadmissible> {
    let (instant, scratch) = workspace.read(model, state)?;
    let at = instant.at(index);
    let acting = acting(&at, scratch)?;
    observe_at(&at, &acting, scratch)
}

/// What is recorded of one body at an instant, given what acts on it.
///
/// # Errors
/// [`Inadmissible`] if no plane separates it from another body.
pub fn observe_at(at: &BodyAt, acting: &Acting, scratch: &mut Scratch) -> Result<BodyObservation, Inadmissible> {
    let (pressure, effort) = match at.kind() {
        KindAt::Rigid(..) => (None, None),
        KindAt::Affine(affine, gyration) => {
            let mut loads = acting.total;
            loads += of_history(at, scratch)?;
            (affine_balance(at, affine, gyration, &loads).pressure, None)
        }
        KindAt::Contractile(contractile, gyration, decomposition) => {
            let moving = ContractileMotion { at, contractile, gyration, decomposition };
            let balance = moving.balance(&acting.total);
            let effort = Effort {
                contraction: decomposition.contraction,
                velocity: balance.contraction_velocity,
                drive: balance.drive,
            };
            (balance.pressure, Some(effort))
        }
    };
    let MotionAt { body, motion, .. } = **at;
    let BodyMotion { placement, velocity } = motion;
    let position = at.model.in_space(at.index, &placement.position);
    let affine_momentum = body.affine_momentum(&placement.gradient, &velocity.gradient_rate);
    let linear_momentum = body.solid.mass.mass * velocity.velocity;
    Ok(BodyObservation {
        motion: BodyMotion { placement: Placement { position, ..*placement }, velocity: *velocity },
        gap: gap_at(at, scratch)?,
        contact_force: acting.contact.force,
        linear_momentum,
        // K_ij = ∫ρ x_i ẋ_j: angular momentum is ε_ijk K_jk = −axial(K)_i in the convention of `axial`.
        angular_momentum: position.cross(&linear_momentum) - crate::tensor::axial(&affine_momentum),
        affine_momentum,
        pressure,
        effort,
    })
}

/// The smallest gap of each body to anything that it has a contact with [m], in a state: see [`gap_at`].
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn gaps(model: &Model, workspace: &mut Workspace, state: &State) -> Result<Vec<f64>, Inadmissible> {
    let (instant, scratch) = workspace.read(model, state)?;
    (0..model.bodies.len()).map(|index| gap_at(&instant.at(index), scratch)).collect()
}

/// The speed of a body's fastest material point [m/s].
///
/// Without a surface, that of the fastest mass point; of a body given by its mass properties alone, the bound
/// |ṗ₀| + |Ṗ| r with the radius of gyration r = √(tr J/m).
pub fn fastest_speed(body: &Body, motion: &BodyMotion) -> f64 {
    let velocity = &motion.velocity;
    if let Some(surface) = &body.solid.surface {
        return surface.fastest_point(&velocity.velocity, &velocity.gradient_rate);
    }
    match &body.solid.shape {
        Shape::Points(Points { points }) if points.len() > 1 => {
            let speed = |point: &MassPoint| velocity.at(&(point.at - body.solid.mass.center)).norm();
            points.iter().map(speed).fold(0.0, f64::max)
        }
        _ => {
            let radius = (body.solid.mass.euler_tensor.trace() / body.solid.mass.mass).sqrt();
            velocity.velocity.norm() + velocity.gradient_rate.norm() * radius
        }
    }
}

/// The energies [J] of all bodies together in a state, in the order of `Model::energies`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn energies(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    values: &mut [f64],
) -> Result<(), Inadmissible> {
    let (instant, scratch) = workspace.read(model, state)?;
    energies_at(&instant, scratch, values)
}

/// The energies [J] of all bodies together at an instant, in the order of `Model::energies`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn energies_at(instant: &Instant, scratch: &mut Scratch, values: &mut [f64]) -> Result<(), Inadmissible> {
    let model = instant.model();
    for (energy, value) in model.energies().iter().zip(values) {
        *value = 0.0;
        for index in 0..model.bodies.len() {
            let at = instant.at(index);
            *value += match energy {
                Energy::Kinetic => kinetic_energy(at.body, at.motion),
                Energy::Gravity => {
                    let position = model.in_space(at.index, &at.motion.placement.position);
                    -at.body.solid.mass.mass * model.gravity.dot(&position)
                }
                Energy::Elastic => elastic_energy(&at),
                Energy::Contact | Energy::Load => stored_energy(&at, scratch, *energy)?,
            };
        }
    }
    Ok(())
}

/// V φ(P), or V det G φ(P G⁻¹) [J].
fn elastic_energy(at: &BodyAt) -> f64 {
    match at.kind() {
        KindAt::Rigid(..) => 0.0,
        KindAt::Affine(affine, gyration) => affine.interior.energy(&gyration.gradient),
        KindAt::Contractile(contractile, _, decomposition) => {
            contractile::energy(&contractile.affine.interior, decomposition)
        }
    }
}

/// ½ m|ṗ₀|² + ½ Ṗ·∂T/∂Ṗ [J], the latter ½ tr(Ṗ J Ṗᵀ) unless the kinetic energy of the body is another; none of a body
/// without inertia, since it takes no part in its balance.
pub fn kinetic_energy(body: &Body, motion: &BodyMotion) -> f64 {
    if !body.has_inertia() {
        return 0.0;
    }
    let Velocity { velocity, gradient_rate } = &motion.velocity;
    let spread = body.canonical_momentum(&motion.placement.gradient, gradient_rate).dot(gradient_rate);
    0.5 * (body.solid.mass.mass * velocity.norm_squared() + spread)
}
