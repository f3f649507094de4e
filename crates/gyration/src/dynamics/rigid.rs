//! A rigid body: force and torque, and the balance solved for its rates.

use super::Scratch;
use super::contacts::{carrying, meet, turning_of};
use super::immersed::RigidImmersion;
use super::loads::Acting;
use super::powers::Powers;
use crate::acting::Load;
use crate::body::{RigidInertia, Slots};
use crate::contact::{Contact, ContactLoads, LawKind, Meeting, RelativeMotion, RigidLoads, RigidMotion};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, MotionAt};
use crate::ledger::Work;
use crate::load::Wrench;
use crate::state::Turn;
use crate::tensor::Vec3;

/// Force and torque of all loads on a rigid body, and the powers of their works.
pub(super) fn wrench(at: &BodyAt, turn: &Turn, scratch: &mut Scratch) -> Result<(Wrench, Powers), Inadmissible> {
    let (mut wrench, mut powers) = (Wrench::default(), Powers::default());
    let mut others: Option<Acting> = None;
    at.try_each_load(|load| match &load {
        Load::Contact(contact) if is_negligible(at, turn, contact) => Ok(()),
        Load::Contact(contact) => {
            let Some(loads) = contact_loads(at, turn, contact, scratch, &mut powers)? else { return Ok(()) };
            wrench += loads.wrench;
            powers[Work::Damping] += loads.damping_power;
            powers[Work::Friction] += loads.friction_power;
            let (carried, placement) = (carrying(at, contact), &at.motion.placement);
            powers[Work::Support] += loads.wrench.force.dot(&carried.at(&placement.position));
            if let Some(spin) = &carried.spin {
                powers[Work::Support] += loads.wrench.torque.dot(&placement.gradient.tr_mul(spin));
            }
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

/// Whether a contact does nothing that the digits of the motion tell.
#[inline]
pub(super) fn is_negligible(at: &MotionAt, turn: &Turn, contact: &Contact) -> bool {
    contact.negligible.holds(at.motion, turn.spin.norm(), &at.model.supports[contact.support])
}

/// The laws of a contact; the powers of central ones only where the ledger has them as works.
#[inline]
fn contact_loads(
    at: &MotionAt,
    turn: &Turn,
    contact: &Contact,
    scratch: &mut Scratch,
    powers: &mut Powers,
) -> Result<Option<RigidLoads>, Inadmissible> {
    meet(at, contact, |meeting| {
        let Meeting { surface, field, .. } = meeting;
        let relative = relative_motion(at, turn, contact, &meeting.motion);
        if at.model.central_laws_work() {
            let loads = ContactLoads::integrate(&contact.law_set, meeting, &mut scratch.contact)?;
            for law in [LawKind::Repulsion, LawKind::Adhesion] {
                powers.add(law, loads.relative_power(law));
            }
        }
        RigidLoads::integrate(&contact.law_set, surface, field, &relative, &mut scratch.contact)
    })
}

/// The motion of a rigid body relative to a support: that of its centre, and its spin less that of the support.
#[inline]
pub(super) fn relative_motion(at: &MotionAt, turn: &Turn, contact: &Contact, center: &RelativeMotion) -> RigidMotion {
    let rotation = &at.motion.placement.gradient;
    let spin = turning_of(at, contact).map_or(turn.spin, |spin| turn.spin - rotation.tr_mul(&spin));
    RigidMotion::new(center, rotation, spin)
}

/// Solves the balance of a rigid body for its rates.
#[inline]
pub(super) fn fill(
    at: &MotionAt,
    inertia: &RigidInertia,
    turn: &Turn,
    wrench: &Wrench,
    slots: &Slots,
    rates: &mut [f64],
) {
    if at.body.pin.is_none() {
        let linear = at.model.gravity + wrench.force / at.body.solid.mass.mass;
        rates[slots.position()].copy_from_slice(at.motion.velocity.velocity.as_slice());
        rates[slots.velocity()].copy_from_slice(linear.as_slice());
    }
    rates[slots.attitude()].copy_from_slice(&turn.quaternion.rate(&turn.spin));
    rates[slots.rate()].copy_from_slice((inertia.inverse * unbalanced(at, inertia, turn, wrench)).as_slice());
}

/// I Ω̇ = τ − Ω × IΩ about the centre of mass or the pin \[N m\].
#[inline]
pub(super) fn unbalanced(at: &MotionAt, inertia: &RigidInertia, turn: &Turn, wrench: &Wrench) -> Vec3 {
    let (body, spin) = (at.body, &turn.spin);
    let gyroscopic = if body.has_inertia() { spin.cross(&(inertia.tensor * spin)) } else { Vec3::zeros() };
    let torque = match &body.pin {
        None => wrench.torque,
        Some(pin) => {
            let force = wrench.force + body.solid.mass.mass * at.model.gravity;
            wrench.torque - pin.point.cross(&at.motion.placement.gradient.tr_mul(&force))
        }
    };
    torque - gyroscopic
}
