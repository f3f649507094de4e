//! A rigid body: force and torque, and the balance solved for its rates.

use super::{Powers, Workspace, for_each_contact, spring_loads};
use crate::body::{Body, RigidInertia};
use crate::contact::{ContactLoads, LawKind, Meeting, RigidLoads, RigidMotion};
use crate::inadmissible::Inadmissible;
use crate::load::Wrench;
use crate::model::Model;
use crate::state::{BodyMotion, Turn};

/// Force and torque of the contacts and springs of a rigid body, and the powers of their works.
pub(super) fn wrench(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    index: usize,
    (motion, turn): (&BodyMotion, &Turn),
) -> Result<(Wrench, Powers), Inadmissible> {
    let rotation = &motion.placement.gradient;
    let (mut wrench, mut powers) = (Wrench::default(), Powers::default());
    for_each_contact(model, time, index, motion, |contact, meeting| {
        let relative = RigidMotion::new(&meeting.motion, rotation, turn.spin);
        let Meeting { surface, field, .. } = meeting;
        let loads = RigidLoads::integrate(contact, surface, field, &relative, &mut workspace.contact)?;
        wrench += loads.wrench;
        if model.central_laws_work() {
            let contacts = ContactLoads::integrate(contact, meeting, &mut workspace.contact)?;
            powers.repulsion += contacts.relative_power(LawKind::Repulsion);
            powers.adhesion += contacts.relative_power(LawKind::Adhesion);
        }
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

/// Solves the balance of a rigid body for the rates of its block.
pub(super) fn fill(
    model: &Model,
    body: &Body,
    inertia: &RigidInertia,
    (motion, turn): (&BodyMotion, &Turn),
    wrench: &Wrench,
    rates: &mut [f64],
) {
    let spin = &turn.spin;
    let gyroscopic = spin.cross(&(inertia.tensor * spin));
    let quaternion = turn.quaternion.rate(spin);
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
