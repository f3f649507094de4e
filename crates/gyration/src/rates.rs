//! The rates of the state: the function to read first.
//!
//!   m p̈₀ = m g + f                       M = ∫_∂D q ⊗ (X − X₀) dA
//!   I Ω̇ = τ − Ω × IΩ,  τ_i = ε_ijk (RᵀM)_kj      (rigid, body axes)
//!
//! per body: kinematics → contact → loads → balance solved for the rates, and the powers whose integrals are the
//! works of the ledger. A pinned body takes moments about its pin: M_p = M − (f + m g) ⊗ r, r = X_p − X₀.
//! Source: `physics.md` §2.

use crate::body::{Body, BodyKind, RigidInertia};
use crate::contact::{Contact, ContactLoads, ContactScratch, LawKind, RelativeMotion};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::ledger::Work;
use crate::load::{Loads, SpringLoads};
use crate::model::Model;
use crate::state::BodyMotion;
use crate::surface::{GapClosed, GapField, Surface};
use crate::tensor::Vec3;

/// Scratch of the mechanics, reused from call to call.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    pub(crate) contact: ContactScratch,
}

/// The rates of all bodies and the powers of all works at time t.
///
/// `bodies` and `rates` are laid out as `Model::blocks`, `powers` [W] as `Model::works`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model: a gap or a spring's length not above zero.
pub fn rates(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    bodies: &[f64],
    rates: &mut [f64],
    powers: &mut [f64],
) -> Result<(), Inadmissible> {
    powers.fill(0.0);
    for (index, (body, block)) in model.bodies.iter().zip(model.blocks()).enumerate() {
        let motion = BodyMotion::unpack(body, &bodies[block.clone()]);
        let mut loads = Loads::default();
        for_each_contact(model, time, index, &motion, |meeting| {
            let Meeting { contact, surface, field, motion } = meeting;
            let contact_loads = ContactLoads::integrate(contact, surface, field, *motion, &mut workspace.contact)?;
            let total = contact_loads.total();
            let carried = model.supports[contact.support].motion.velocity(time);
            for (work, power) in model.works().iter().zip(powers.iter_mut()) {
                *power += match work {
                    Work::Damping => contact_loads.relative_power(LawKind::Damping),
                    Work::Friction => contact_loads.relative_power(LawKind::Friction),
                    Work::Support => total.force.dot(&carried),
                    _ => 0.0,
                };
            }
            loads += total;
            Ok(())
        })?;
        spring_loads(index, body, &motion, |spring| {
            if let Some(at) = model.works().iter().position(|work| *work == Work::Load) {
                powers[at] += spring.dashpot_power;
            }
            loads += spring.total();
        })?;
        match &body.kind {
            BodyKind::Rigid(inertia) => {
                rigid_rates(model, body, inertia, &motion, &loads, &mut rates[block.clone()]);
            }
        }
    }
    Ok(())
}

/// A contact of a body at one instant: what its integrals need.
pub(crate) struct Meeting<'a> {
    pub contact: &'a Contact,
    pub surface: &'a Surface,
    pub field: GapField,
    pub motion: RelativeMotion,
}

/// Hands each contact of a body to `each`, and says which support a closed gap belongs to.
pub(crate) fn for_each_contact(
    model: &Model,
    time: f64,
    index: usize,
    motion: &BodyMotion,
    mut each: impl FnMut(&Meeting) -> Result<(), GapClosed>,
) -> Result<(), Inadmissible> {
    let body = &model.bodies[index];
    let Some(surface) = &body.surface else {
        return Ok(());
    };
    for contact in &body.contacts {
        let (field, relative) = meet(model, contact.support, time, motion);
        let (gap, _) = surface.smallest_gap(&field);
        let meeting = Meeting { contact, surface, field, motion: relative };
        let result = if body.is_apart(gap, &field) { each(&meeting) } else { Err(GapClosed { gap }) };
        result.map_err(|closed| {
            let quantity = Quantity::Gap { support: contact.support };
            Inadmissible { body: index, quantity, value: closed.gap }
        })?;
    }
    Ok(())
}

/// The gap field of a support over a body, d(X) = (p₀ − o)·n + (Pᵀn)·X, and the body's motion relative to it.
pub fn meet(model: &Model, support: usize, time: f64, motion: &BodyMotion) -> (GapField, RelativeMotion) {
    let support = &model.supports[support];
    let field = GapField {
        height: support.gap(&motion.placement.position, time),
        direction: motion.placement.gradient.tr_mul(&support.normal),
    };
    let relative = RelativeMotion {
        normal: support.normal,
        velocity: motion.velocity.velocity - support.motion.velocity(time),
        gradient_rate: motion.velocity.gradient_rate,
    };
    (field, relative)
}

/// Hands the loads of each spring of a body to `each`.
pub(crate) fn spring_loads(
    index: usize,
    body: &Body,
    motion: &BodyMotion,
    mut each: impl FnMut(&SpringLoads),
) -> Result<(), Inadmissible> {
    for (number, spring) in body.springs.iter().enumerate() {
        let loads = spring.loads(&motion.placement, &motion.velocity).ok_or_else(|| {
            let quantity = Quantity::SpringLength { spring: number };
            Inadmissible { body: index, quantity, value: spring.length(&motion.placement) }
        })?;
        each(&loads);
    }
    Ok(())
}

/// Solves the balance of a rigid body for the rates of its block.
fn rigid_rates(
    model: &Model,
    body: &Body,
    inertia: &RigidInertia,
    motion: &BodyMotion,
    loads: &Loads,
    rates: &mut [f64],
) {
    let torque = rigid_torque(model, body, motion, loads);
    let spin = &motion.spin;
    let angular = inertia.inverse * (torque - spin.cross(&(inertia.tensor * spin)));
    let quaternion = motion.quaternion.rate(spin);
    if body.pin.is_some() {
        rates[..4].copy_from_slice(&quaternion);
        rates[4..7].copy_from_slice(angular.as_slice());
        return;
    }
    let linear = model.gravity + loads.force / body.mass.mass;
    rates[..3].copy_from_slice(motion.velocity.velocity.as_slice());
    rates[3..7].copy_from_slice(&quaternion);
    rates[7..10].copy_from_slice(linear.as_slice());
    rates[10..13].copy_from_slice(angular.as_slice());
}

/// The torque in body axes about the centre of mass, or about the pin, where gravity has an arm as well.
fn rigid_torque(model: &Model, body: &Body, motion: &BodyMotion, loads: &Loads) -> Vec3 {
    let rotation = &motion.placement.gradient;
    let torque = loads.body_torque(rotation);
    match body.pin {
        None => torque,
        Some(pin) => {
            let force = loads.force + body.mass.mass * model.gravity;
            torque - pin.point.cross(&rotation.tr_mul(&force))
        }
    }
}
