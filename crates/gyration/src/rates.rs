//! The rates of the state: the function to read first.
//!
//!   m p̈₀ = m g + f                        f = ∫_∂D q dA
//!   I Ω̇ = τ − Ω × IΩ                      τ = ∫_∂D X × Rᵀq dA      (rigid, body axes)
//!
//! per body: kinematics → contact → loads → balance solved for the rates, and the powers whose integrals are the
//! works of the ledger. A pinned body takes torques about its pin: τ_p = τ − r × Rᵀ(f + m g), r = X_p − X₀.
//! Source: `physics.md` §2.

use crate::body::{Body, BodyKind, RigidInertia};
use crate::contact::{Contact, ContactScratch, RelativeMotion, RigidLoads, RigidMotion};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::ledger::Work;
use crate::load::{SpringLoads, Wrench};
use crate::model::Model;
use crate::state::BodyMotion;
use crate::surface::{GapClosed, GapField, Surface};

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
        match &body.kind {
            BodyKind::Rigid(inertia) => {
                let (wrench, done) = rigid_wrench(model, workspace, time, index, &motion)?;
                for (work, power) in model.works().iter().zip(powers.iter_mut()) {
                    *power += done.of(*work);
                }
                rigid_rates(model, body, inertia, &motion, &wrench, &mut rates[block.clone()]);
            }
        }
    }
    Ok(())
}

/// The powers [W] of the works done on one body.
#[derive(Debug, Clone, Copy, Default)]
struct Powers {
    damping: f64,
    friction: f64,
    load: f64,
    support: f64,
}

impl Powers {
    fn of(&self, work: Work) -> f64 {
        match work {
            Work::Damping => self.damping,
            Work::Friction => self.friction,
            Work::Load => self.load,
            Work::Support => self.support,
        }
    }
}

/// Force and torque of the contacts and springs of a rigid body, and the powers of their works.
fn rigid_wrench(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    index: usize,
    motion: &BodyMotion,
) -> Result<(Wrench, Powers), Inadmissible> {
    let rotation = &motion.placement.gradient;
    let (mut wrench, mut powers) = (Wrench::default(), Powers::default());
    for_each_contact(model, time, index, motion, |meeting| {
        let Meeting { contact, surface, field, .. } = meeting;
        let loads = RigidLoads::integrate(contact, surface, field, &meeting.rigid(motion), &mut workspace.contact)?;
        wrench += loads.wrench;
        powers.damping += loads.damping_power;
        powers.friction += loads.friction_power;
        let carried = model.supports[contact.support].motion.velocity(time);
        powers.support += loads.wrench.force.dot(&carried);
        Ok(())
    })?;
    spring_loads(index, &model.bodies[index], motion, |spring| {
        powers.load += spring.dashpot_power;
        wrench += spring.wrench(rotation);
    })?;
    Ok((wrench, powers))
}

/// A contact of a body at one instant: what its integrals need.
pub(crate) struct Meeting<'a> {
    pub contact: &'a Contact,
    pub surface: &'a Surface,
    pub field: GapField,
    pub motion: RelativeMotion,
}

impl Meeting<'_> {
    /// The relative motion of a rigid body.
    pub fn rigid(&self, motion: &BodyMotion) -> RigidMotion {
        RigidMotion::new(&self.motion, &motion.placement.gradient, motion.spin)
    }
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
    wrench: &Wrench,
    rates: &mut [f64],
) {
    let spin = &motion.spin;
    let gyroscopic = spin.cross(&(inertia.tensor * spin));
    let quaternion = motion.quaternion.rate(spin);
    if let Some(pin) = &body.pin {
        let force = motion.placement.gradient.tr_mul(&(wrench.force + body.mass.mass * model.gravity));
        let torque = wrench.torque - pin.point.cross(&force);
        rates[..4].copy_from_slice(&quaternion);
        rates[4..7].copy_from_slice((inertia.inverse * (torque - gyroscopic)).as_slice());
        return;
    }
    let linear = model.gravity + wrench.force / body.mass.mass;
    rates[..3].copy_from_slice(motion.velocity.velocity.as_slice());
    rates[3..7].copy_from_slice(&quaternion);
    rates[7..10].copy_from_slice(linear.as_slice());
    rates[10..13].copy_from_slice((inertia.inverse * (wrench.torque - gyroscopic)).as_slice());
}
