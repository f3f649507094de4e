//! A rigid body: force and torque, and the balance solved for its rates.

use super::{Powers, Workspace, for_each_contact, spring_loads};
use crate::body::{Body, RigidInertia};
use crate::contact::{ContactLoads, LawKind, Meeting, RigidLoads, RigidMotion};
use crate::fluid::{Form, RigidDrag};
use crate::inadmissible::Inadmissible;
use crate::load::{Loads, Wrench, WrenchSlope};
use crate::model::Model;
use crate::state::{BodyMotion, Turn};
use crate::tensor::{Mat3, Vec3, cross_matrix};

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
    if let Some(applied) = model.applied(index) {
        let held = applied.wrench(rotation);
        powers.load += held.force.dot(&motion.velocity.velocity) + held.torque.dot(&turn.spin);
        wrench += held;
    }
    if let Some(immersed) = RigidImmersion::of(model, time, index, (motion, turn)) {
        let fluid = immersed.wrench();
        powers.fluid += fluid.force.dot(&motion.velocity.velocity) + fluid.torque.dot(&turn.spin);
        wrench += fluid;
    }
    Ok((wrench, powers))
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
    pub fn of(model: &'a Model, time: f64, index: usize, (motion, turn): (&BodyMotion, &Turn)) -> Option<Self> {
        let (fluid, inclusion) = (model.fluid.as_ref()?, model.bodies[index].inclusion.as_ref()?);
        let Form::Fixed(form) = &inclusion.form else { return None };
        let flow = fluid.flow(time);
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
    let gyroscopic = if body.has_inertia() { spin.cross(&(inertia.tensor * spin)) } else { Vec3::zeros() };
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
