//! An affine body: force and affine moment, and the balance solved for its rates.
//!
//!   m p̈₀ = m g + f,   P̈ J = M − V S;   pinned at r: P̈ J_p = M − (f + m g) ⊗ r − V S

use super::{Powers, Workspace, for_each_contact, spring_loads};
use crate::affine::AffineBalance;
use crate::body::{Affine, Body};
use crate::contact::{ContactLoads, LawKind};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::load::Loads;
use crate::model::Model;
use crate::state::BodyMotion;
use crate::tensor::{Mat3, Vec3};

/// An affine body at one instant: its motion, and P⁻¹.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AffineMotion<'a> {
    pub index: usize,
    pub affine: &'a Affine,
    pub motion: BodyMotion,
    pub inverse: Mat3,
}

/// What acts on an affine body.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct AffineLoads {
    /// f and M of the contacts.
    pub contact: Loads,
    /// f and M of all loads but gravity.
    pub total: Loads,
    pub(super) powers: Powers,
}

impl<'a> AffineMotion<'a> {
    /// The motion of the body of this index.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0.
    pub fn new(index: usize, affine: &'a Affine, motion: &BodyMotion) -> Result<Self, Inadmissible> {
        let volume = motion.placement.gradient.determinant();
        let inverse = motion.placement.gradient.try_inverse().filter(|_| volume > 0.0);
        let inverse = inverse.ok_or(Inadmissible { body: index, quantity: Quantity::Volume, value: volume })?;
        Ok(Self { index, affine, motion: *motion, inverse })
    }

    /// f and M of contacts, springs, couple and resistances, and the powers of their works.
    pub fn loads(&self, model: &Model, workspace: &mut Workspace, time: f64) -> Result<AffineLoads, Inadmissible> {
        let (placement, velocity) = (&self.motion.placement, &self.motion.velocity);
        let (mut loads, mut powers) = (Loads::default(), Powers::default());
        for_each_contact(model, time, self.index, &self.motion, |contact, meeting| {
            let contacts = ContactLoads::integrate(contact, meeting, &mut workspace.contact)?;
            let total = contacts.total();
            loads += total;
            powers.repulsion += contacts.relative_power(LawKind::Repulsion);
            powers.damping += contacts.relative_power(LawKind::Damping);
            powers.friction += contacts.relative_power(LawKind::Friction);
            powers.adhesion += contacts.relative_power(LawKind::Adhesion);
            powers.support += total.force.dot(&model.supports[contact.support].motion.velocity(time));
            Ok(())
        })?;
        let contact = loads;
        spring_loads(self.index, &model.bodies[self.index], &self.motion, |spring| {
            powers.load += spring.dashpot_power;
            loads += spring.total();
        })?;
        if let Some(couple) = &self.affine.couple {
            let moment = couple.moment(time, &self.inverse);
            powers.load += moment.dot(&velocity.gradient_rate);
            loads.moment += moment;
        }
        for resistance in &self.affine.resistances {
            let resisting = resistance.loads(&placement.gradient, &self.inverse, velocity);
            if resistance.dissipates() {
                powers.viscosity += resisting.power(&velocity.velocity, &velocity.gradient_rate);
            }
            loads += resisting;
        }
        Ok(AffineLoads { contact, total: loads, powers })
    }

    /// The affine moment about the centre of mass, or about the pin.
    pub fn moment(&self, model: &Model, loads: &Loads) -> Mat3 {
        let body = &model.bodies[self.index];
        match &body.pin {
            None => loads.moment,
            Some(pin) => loads.moment - (loads.force + body.mass.mass * model.gravity) * pin.point.transpose(),
        }
    }

    /// P̈, stress, pressure; there is one, since P can be inverted.
    pub fn balance(&self, model: &Model, loads: &Loads) -> Option<AffineBalance> {
        let (gradient, rate) = (&self.motion.placement.gradient, &self.motion.velocity.gradient_rate);
        self.affine.interior.balance(gradient, rate, &self.moment(model, loads))
    }

    /// Solves the balance for the rates of the block, and adds the powers of friction and constraint.
    pub fn fill(&self, model: &Model, loads: &mut AffineLoads, rates: &mut [f64]) {
        let body = &model.bodies[self.index];
        let velocity = &self.motion.velocity;
        let interior = &self.affine.interior;
        let Some(balance) = self.balance(model, &loads.total) else {
            return rates.fill(f64::NAN);
        };
        loads.powers.viscosity -= balance.dissipation;
        if let Some(pressure) = balance.pressure {
            loads.powers.constraint +=
                pressure * interior.volume * velocity.gradient_rate.dot(&self.inverse.transpose());
        }
        let linear = center_acceleration(body, &loads.total.force, &model.gravity);
        let parts = [
            linear.map(|_| velocity.velocity.as_slice()),
            Some(velocity.gradient_rate.as_slice()),
            linear.as_ref().map(|linear| linear.as_slice()),
            Some(balance.acceleration.as_slice()),
        ];
        let numbers = parts.into_iter().flatten().flatten();
        rates.iter_mut().zip(numbers).for_each(|(rate, number)| *rate = *number);
    }
}

/// p̈₀ = g + f/m; none of a pinned body, whose centre has no coordinates of its own.
fn center_acceleration(body: &Body, force: &Vec3, gravity: &Vec3) -> Option<Vec3> {
    body.pin.is_none().then(|| gravity + force / body.mass.mass)
}
