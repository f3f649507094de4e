//! What is conserved, exchanged and audited: energies, works, momenta.
//!
//!   kinetic ½ m|ṗ₀|² + ½ tr(Ṗ J Ṗᵀ),   gravity −m g·p₀,   elastic V φ (V det G φ of a contractile body),   contact ∫U(d) dA,   load Σ ½k(l − l₀)²
//!   K = P J Ṗᵀ (affine momentum; its antisymmetric part is angular momentum)
//!
//! U(d) = α d₀ (d/d₀)^(1−ν)/(ν−1); at ν = 1, −α d₀ ln(d/d₀). Works are done on the bodies since t = 0; the residual
//! of the ledger is (Σ energies) − (Σ energies at 0) − Σ works. Source: `physics.md` §2, §3, §6.

use crate::body::{Body, BodyKind};
use crate::contact::{ContactLoads, contact_potential};
use crate::contractile::{self, Decomposition};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::kinematics::Velocity;
use crate::ledger::Energy;
use crate::load::Loads;
use crate::model::Model;
use crate::rates::{AffineMotion, ContractileMotion, Workspace, for_each_contact, nearest, settled_motion};
use crate::shape::{MassPoint, Points, Shape};
use crate::state::{BodyMotion, State};
use crate::tensor::{Mat3, Vec3};

/// What is recorded of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyObservation {
    /// Placement, velocity, spin.
    pub motion: BodyMotion,
    /// Smallest distance to a support [m]; infinite without supports or surface.
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
    let body = &model.bodies[index];
    let motion = settled_motion(model, workspace, state, index)?;
    let (contact, pressure, effort) = match &body.kind {
        BodyKind::Rigid(_) => (contact_loads(model, workspace, state.time, index, &motion)?, None, None),
        BodyKind::Affine(affine) => {
            let moving = AffineMotion::new(index, affine, &motion)?;
            let loads = moving.loads(model, workspace, state.time)?;
            let balance = moving.balance(model, &loads.total);
            (loads.contact, balance.pressure, None)
        }
        BodyKind::Contractile(contractile) => {
            let block = &state.bodies[model.blocks()[index].clone()];
            let moving = ContractileMotion::new(index, contractile, (&motion, state.time, block))?;
            let loads = moving.pulled.loads(model, workspace, state.time)?;
            let balance = moving.balance(model, &loads.total);
            let effort = Effort {
                contraction: moving.decomposition.contraction,
                velocity: balance.contraction_velocity,
                drive: balance.drive,
            };
            (loads.contact, balance.pressure, Some(effort))
        }
    };
    let (placement, velocity) = (&motion.placement, &motion.velocity);
    let affine_momentum = placement.gradient * body.mass.euler_tensor * velocity.gradient_rate.transpose();
    let linear_momentum = body.mass.mass * velocity.velocity;
    Ok(BodyObservation {
        motion,
        gap: smallest_gap(model, state.time, index, &motion),
        contact_force: contact.force,
        linear_momentum,
        // K_ij = ∫ρ x_i ẋ_j: angular momentum is ε_ijk K_jk = −axial(K)_i in the convention of `axial`.
        angular_momentum: placement.position.cross(&linear_momentum) - crate::tensor::axial(&affine_momentum),
        affine_momentum,
        pressure,
        effort,
    })
}

/// f and M of the contacts of a body.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn contact_loads(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    index: usize,
    motion: &BodyMotion,
) -> Result<Loads, Inadmissible> {
    let mut loads = Loads::default();
    for_each_contact(model, time, index, motion, |contact, meeting| {
        loads += ContactLoads::integrate(contact, meeting, &mut workspace.contact)?.total();
        Ok(())
    })?;
    Ok(loads)
}

/// The smallest distance of a body's surface to any support [m]; infinite without supports or surface.
pub fn smallest_gap(model: &Model, time: f64, index: usize, motion: &BodyMotion) -> f64 {
    nearest(model, time, index, motion).map_or(f64::INFINITY, |nearest| nearest.gap)
}

/// The speed of a body's fastest material point [m/s].
///
/// Without a surface, that of the fastest mass point; of a body given by its mass properties alone, the bound
/// |ṗ₀| + |Ṗ| r with the radius of gyration r = √(tr J/m).
pub fn fastest_speed(body: &Body, motion: &BodyMotion) -> f64 {
    let velocity = &motion.velocity;
    if let Some(surface) = &body.surface {
        return surface.fastest_point(&velocity.velocity, &velocity.gradient_rate);
    }
    match &body.shape {
        Shape::Points(Points { points }) if points.len() > 1 => {
            let speed = |point: &MassPoint| velocity.at(&(point.at - body.mass.center)).norm();
            points.iter().map(speed).fold(0.0, f64::max)
        }
        _ => {
            let radius = (body.mass.euler_tensor.trace() / body.mass.mass).sqrt();
            velocity.velocity.norm() + velocity.gradient_rate.norm() * radius
        }
    }
}

/// The energies [J] of all bodies together, in the order of `Model::energies`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn energies(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    values: &mut [f64],
) -> Result<(), Inadmissible> {
    for (energy, value) in model.energies().iter().zip(values) {
        *value = 0.0;
        for (index, body) in model.bodies.iter().enumerate() {
            let motion = state.motion(model, index);
            *value += match energy {
                // A body without inertia is still here: its kinetic energy takes no part in its balance.
                Energy::Kinetic => kinetic_energy(body, &motion),
                Energy::Gravity => -body.mass.mass * model.gravity.dot(&motion.placement.position),
                Energy::Elastic => elastic_energy(model, state, index, &motion)?,
                Energy::Contact => contact_energy(model, workspace, state.time, index, &motion)?,
                Energy::Load => body.springs.iter().map(|spring| spring.energy(&motion.placement)).sum(),
            };
        }
    }
    Ok(())
}

/// V φ(P), or V det G φ(P G⁻¹) [J].
fn elastic_energy(model: &Model, state: &State, index: usize, motion: &BodyMotion) -> Result<f64, Inadmissible> {
    let gradient = &motion.placement.gradient;
    Ok(match &model.bodies[index].kind {
        BodyKind::Rigid(_) => 0.0,
        BodyKind::Affine(affine) => affine.interior.energy(gradient),
        BodyKind::Contractile(contractile) => {
            let contraction = state.contraction(model, index).unwrap_or_else(Mat3::identity);
            let decomposition = Decomposition::of(gradient, &contraction).map_err(|value| Inadmissible {
                body: index,
                quantity: Quantity::Contraction,
                value,
            })?;
            contractile::energy(&contractile.affine.interior, &decomposition)
        }
    })
}

/// ½ m|ṗ₀|² + ½ tr(Ṗ J Ṗᵀ) [J].
pub fn kinetic_energy(body: &Body, motion: &BodyMotion) -> f64 {
    let Velocity { velocity, gradient_rate } = &motion.velocity;
    let spread = (gradient_rate * body.mass.euler_tensor).dot(gradient_rate);
    0.5 * (body.mass.mass * velocity.norm_squared() + spread)
}

/// The potential of the central laws over a body's surface [J].
fn contact_energy(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    index: usize,
    motion: &BodyMotion,
) -> Result<f64, Inadmissible> {
    let mut total = 0.0;
    for_each_contact(model, time, index, motion, |contact, meeting| {
        total += contact_potential(contact, meeting, &mut workspace.contact)?;
        Ok(())
    })?;
    Ok(total)
}
