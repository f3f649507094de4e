//! A rigid body: force and torque, and the balance solved for its rates.

use super::contacts::{carrying, meet};
use super::powers::Powers;
use super::{Acting, Scratch};
use crate::acting::Load;
use crate::body::{RigidInertia, Slots};
use crate::contact::{Contact, ContactLoads, LawKind, Meeting, RigidLoads, RigidMotion};
use crate::fluid::{Form, RigidDrag};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt};
use crate::ledger::Work;
use crate::load::{Loads, Wrench, WrenchSlope};
use crate::state::Turn;
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// Force and torque of all loads on a rigid body, and the powers of their works.
pub(super) fn wrench(at: &BodyAt, turn: &Turn, scratch: &mut Scratch) -> Result<(Wrench, Powers), Inadmissible> {
    let (mut wrench, mut powers) = (Wrench::default(), Powers::default());
    let mut others: Option<Acting> = None;
    at.try_each_load(|load| match &load {
        Load::Contact(contact) => {
            let Some(loads) = contact_loads(at, turn, contact, scratch, &mut powers)? else { return Ok(()) };
            wrench += loads.wrench;
            powers[Work::Damping] += loads.damping_power;
            powers[Work::Friction] += loads.friction_power;
            powers[Work::Support] += loads.wrench.force.dot(&carrying(at, contact));
            Ok(())
        }
        Load::Fluid(..) => {
            let Some(immersed) = RigidImmersion::of(at) else { return Ok(()) };
            let fluid = immersed.wrench();
            let velocity = &at.motion.velocity.velocity;
            powers[Work::Fluid] += fluid.force.dot(velocity) + fluid.torque.dot(&turn.spin);
            wrench += fluid;
            Ok(())
        }
        load => others.get_or_insert_default().add(load, at, scratch),
    })?;
    if let Some(others) = &others {
        wrench += others.total.wrench(&at.motion.placement.gradient);
        powers += others.powers;
    }
    Ok((wrench, powers))
}

/// The laws of a contact; the powers of central ones only where the ledger has them as works.
#[inline]
fn contact_loads(
    at: &BodyAt,
    turn: &Turn,
    contact: &Contact,
    scratch: &mut Scratch,
    powers: &mut Powers,
) -> Result<Option<RigidLoads>, Inadmissible> {
    meet(at, contact, |meeting| {
        let Meeting { surface, field, .. } = meeting;
        let relative = RigidMotion::new(&meeting.motion, &at.motion.placement.gradient, turn.spin);
        if at.model.central_laws_work() {
            let loads = ContactLoads::integrate(&contact.law_set, meeting, &mut scratch.contact)?;
            for law in [LawKind::Repulsion, LawKind::Adhesion] {
                powers.add(law, loads.relative_power(law));
            }
        }
        RigidLoads::integrate(&contact.law_set, surface, field, &relative, &mut scratch.contact)
    })
}

/// A rigid body in the fluid at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RigidImmersion<'a> {
    pub drag: RigidDrag<'a>,
    /// −ρ_f V g in the axes of space [N].
    lift: Vec3,
    /// The same in those of the body, and where it acts.
    seen: Vec3,
    arm: Vec3,
    /// 2ηV sym L∞, in the axes of space [N m].
    pub ambient: Mat3,
}

impl<'a> RigidImmersion<'a> {
    /// None if the body is not immersed.
    pub fn of(at: &BodyAt<'a>) -> Option<Self> {
        let BodyAt { model, body, motion, .. } = at;
        let (fluid, inclusion) = (model.fluid.as_ref()?, body.inclusion.as_ref()?);
        let (Form::Fixed(form), KindAt::Rigid(_, turn)) = (&inclusion.form, at.kind()) else { return None };
        let flow = fluid.flow(at.time);
        let drag = form.drag((fluid, &flow), (&motion.placement, &motion.velocity), &turn.spin);
        let lift = -(fluid.density * inclusion.volume) * model.gravity;
        let seen = motion.placement.gradient.tr_mul(&lift);
        let ambient = (flow.gradient + flow.gradient.transpose()) * (fluid.viscosity * inclusion.volume);
        Some(Self { drag, lift, seen, arm: inclusion.center, ambient })
    }

    /// Force and torque of the fluid.
    pub fn wrench(&self) -> Wrench {
        let mut wrench = self.drag.wrench();
        wrench += Wrench { force: self.lift, torque: self.arm.cross(&self.seen) };
        wrench
    }

    /// The same as a force and an affine moment M = N R; the stress of the undisturbed flow included.
    pub fn loads(&self, rotation: &Mat3) -> Loads {
        let force = self.drag.force() + self.lift;
        let moment = (self.drag.couple() + self.ambient) * rotation + self.lift * self.arm.transpose();
        Loads { force, moment }
    }

    /// The derivative of the torque of the lift by a turn.
    pub fn lift_by_turn(&self) -> WrenchSlope {
        WrenchSlope { force: Mat3::zeros(), torque: cross_matrix(&self.arm) * cross_matrix(&self.seen) }
    }
}

/// Solves the balance of a rigid body for its rates.
#[inline]
pub(super) fn fill(
    at: &BodyAt,
    inertia: &RigidInertia,
    turn: &Turn,
    wrench: &Wrench,
    slots: &Slots,
    rates: &mut [f64],
) {
    let (model, body, motion) = (at.model, at.body, at.motion);
    let spin = &turn.spin;
    let gyroscopic = if body.has_inertia() { spin.cross(&(inertia.tensor * spin)) } else { Vec3::zeros() };
    let torque = match &body.pin {
        None => {
            let linear = model.gravity + wrench.force / body.mass.mass;
            rates[slots.position()].copy_from_slice(motion.velocity.velocity.as_slice());
            rates[slots.velocity()].copy_from_slice(linear.as_slice());
            wrench.torque
        }
        Some(pin) => {
            let force = motion.placement.gradient.tr_mul(&(wrench.force + body.mass.mass * model.gravity));
            wrench.torque - pin.point.cross(&force)
        }
    };
    rates[slots.attitude()].copy_from_slice(&turn.quaternion.rate(spin));
    rates[slots.rate()].copy_from_slice((inertia.inverse * (torque - gyroscopic)).as_slice());
}
