//! The quantities of the theory of homogeneous strains, and the audit of its balance law.
//!
//!   K = P J Ṗᵀ,   K_o = K + (p₀ − o) ⊗ m ṗ₀,   N = P Mᵀ,   Ω = Ṗ P⁻¹,   power tr(N Ω)
//!   dK/dt = Ṗ J Ṗᵀ + N − V (S Pᵀ)ᵀ,   S Pᵀ symmetric
//!
//! M is that of all loads, about the centre of mass or the pin, and so is J. The mean stress of a rigid body is the one
//! that its balance asks for, S = (M − P̈ J)/V: its S Pᵀ is then symmetric as well. Source: Sławianowski (1975), 2.7–3.9;
//! `physics.md` §2.

use crate::balance::contact_loads;
use crate::body::{Body, BodyKind};
use crate::inadmissible::Inadmissible;
use crate::load::Loads;
use crate::model::Model;
use crate::rates::{AffineMotion, ContractileMotion, RigidImmersion, Workspace, rates, settled_motion, spring_loads};
use crate::state::{BodyMotion, State, Turn};
use crate::tensor::{Mat3, Polar, Vec3, axial, cross_matrix};

/// What the theory of homogeneous strains tells of one body at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HomogeneousObservation {
    /// Ω = L = Ṗ P⁻¹ [1/s].
    pub velocity_gradient: Mat3,
    /// K_o, internal and orbital, about the origin asked for [kg m²/s].
    pub total_affine_momentum: Mat3,
    /// J Ṗᵀ P⁻ᵀ: the co-moving components P⁻¹ K P⁻ᵀ of K [kg m²/s].
    pub comoving_affine_momentum: Mat3,
    /// N [N m].
    pub affine_moment: Mat3,
    /// tr(N Ω) [W].
    pub moment_power: f64,
    /// What is left of the balance of K, P J P̈ᵀ − N + V (S Pᵀ)ᵀ [N m]: rounding.
    pub momentum_residual: Mat3,
    /// The eigenvalues of U = √(PᵀP), descending.
    pub principal_stretches: Vec3,
    /// R, P = R U.
    pub rotation: Mat3,
    /// S, first Piola stress with the pressure [Pa]; NaN without a volume.
    pub stress: Mat3,
    /// σ = S Pᵀ/det P [Pa]; NaN without a volume.
    pub cauchy_stress: Mat3,
}

/// Observes one body; K_o is about `origin` [m].
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn observe_homogeneous(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    index: usize,
    origin: &Vec3,
) -> Result<HomogeneousObservation, Inadmissible> {
    let body = &model.bodies[index];
    let motion = settled_motion(model, workspace, state, index)?;
    let (p, rate) = (&motion.placement.gradient, &motion.velocity.gradient_rate);
    let interior = interior(model, workspace, state, index, &motion)?;
    let Interior { euler_tensor, moment, acceleration, stress } = interior;
    let polar = Polar::of(p);
    let inverse = p.try_inverse().unwrap_or(Mat3::from_element(f64::NAN));
    let velocity_gradient = rate * inverse;
    let affine_moment = p * moment.transpose();
    let momentum = p * body.mass.euler_tensor * rate.transpose();
    let arm = motion.placement.position - origin;
    let stretches = polar.stretch.symmetric_eigenvalues();
    let mut stretches: [f64; 3] = stretches.into();
    stretches.sort_by(|a, b| b.total_cmp(a));
    let tension = body.mass.volume * (stress * p.transpose()).transpose();
    Ok(HomogeneousObservation {
        velocity_gradient,
        total_affine_momentum: momentum + body.mass.mass * arm * motion.velocity.velocity.transpose(),
        comoving_affine_momentum: body.mass.euler_tensor * (inverse * rate).transpose(),
        affine_moment,
        moment_power: affine_moment.dot(&velocity_gradient.transpose()),
        momentum_residual: residual(body, &(p * euler_tensor * acceleration.transpose() - affine_moment), &tension),
        principal_stretches: stretches.into(),
        rotation: polar.rotation,
        stress,
        cauchy_stress: stress * p.transpose() / p.determinant(),
    })
}

/// Without a volume there is no stress to balance anything.
fn residual(body: &Body, unbalanced: &Mat3, tension: &Mat3) -> Mat3 {
    if body.mass.volume > 0.0 { unbalanced + tension } else { *unbalanced }
}

/// What the balance of P is made of, about the centre of mass or the pin.
struct Interior {
    euler_tensor: Mat3,
    moment: Mat3,
    acceleration: Mat3,
    stress: Mat3,
}

fn interior(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    index: usize,
    motion: &BodyMotion,
) -> Result<Interior, Inadmissible> {
    let body = &model.bodies[index];
    match &body.kind {
        BodyKind::Affine(affine) => {
            let moving = AffineMotion::new(index, affine, motion)?;
            let loads = moving.loads(model, workspace, state.time)?.total;
            let balance = moving.balance(model, &loads);
            Ok(Interior {
                euler_tensor: affine.interior.euler_tensor,
                moment: moving.moment(model, &loads),
                acceleration: inertial(body, &balance.acceleration),
                stress: balance.stress,
            })
        }
        BodyKind::Contractile(contractile) => {
            let block = &state.bodies[model.blocks()[index].clone()];
            let moving = ContractileMotion::new(index, contractile, (motion, state.time, block))?;
            let loads = moving.pulled.loads(model, workspace, state.time)?.total;
            let balance = moving.balance(model, &loads);
            Ok(Interior {
                euler_tensor: contractile.affine.interior.euler_tensor,
                moment: moving.pulled.moment(model, &loads),
                acceleration: inertial(body, &balance.acceleration),
                stress: balance.stress,
            })
        }
        BodyKind::Rigid(_) => {
            let mut loads = contact_loads(model, workspace, state.time, index, motion)?;
            spring_loads(index, body, motion, |spring| loads += spring.total())?;
            if let Some(applied) = model.applied(index) {
                loads += applied.loads(&motion.placement.gradient.transpose());
            }
            if let Some(fluid) = immersed_loads(model, state, index, motion) {
                loads += fluid;
            }
            let acceleration = rigid_acceleration(model, workspace, state, index, motion)?;
            let (euler_tensor, moment) = about_pin(model, body, &loads);
            let stress = (moment - acceleration * euler_tensor) / body.mass.volume;
            Ok(Interior { euler_tensor, moment, acceleration, stress })
        }
    }
}

/// P̈, which takes nothing of a body without inertia.
fn inertial(body: &Body, acceleration: &Mat3) -> Mat3 {
    if body.has_inertia() { *acceleration } else { Mat3::zeros() }
}

/// J and M about the pin, if there is one.
fn about_pin(model: &Model, body: &Body, loads: &Loads) -> (Mat3, Mat3) {
    let Some(pin) = &body.pin else { return (body.mass.euler_tensor, loads.moment) };
    let (r, mass) = (&pin.point, body.mass.mass);
    (
        body.mass.euler_tensor + mass * r * r.transpose(),
        loads.moment - (loads.force + mass * model.gravity) * r.transpose(),
    )
}

/// f and M of the fluid on a rigid body; none if it is not immersed.
fn immersed_loads(model: &Model, state: &State, index: usize, motion: &BodyMotion) -> Option<Loads> {
    let rotation = &motion.placement.gradient;
    // Ω from Ṗ = R [Ω]×.
    let spin = 0.5 * axial(&rotation.tr_mul(&motion.velocity.gradient_rate));
    let turn = Turn { spin, ..Turn::unpack(&model.bodies[index], &state.bodies[model.blocks()[index].clone()]) };
    Some(RigidImmersion::of(model, state.time, index, (motion, &turn))?.loads(rotation))
}

/// P̈ = R ([Ω̇]× + [Ω]×²).
fn rigid_acceleration(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    index: usize,
    motion: &BodyMotion,
) -> Result<Mat3, Inadmissible> {
    if !model.bodies[index].has_inertia() {
        return Ok(Mat3::zeros());
    }
    let mut slopes = vec![0.0; model.dimension()];
    let mut powers = vec![0.0; model.works().len()];
    rates(model, workspace, state.time, &state.bodies, &mut slopes, &mut powers)?;
    let block = model.blocks()[index].clone();
    let body = &model.bodies[index];
    let spin = cross_matrix(&Turn::unpack(body, &state.bodies[block.clone()]).spin);
    let turning = cross_matrix(&Turn::unpack(body, &slopes[block]).spin);
    Ok(motion.placement.gradient * (turning + spin * spin))
}
