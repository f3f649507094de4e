//! An affine body: force and affine moment, and the balance solved for its rates.
//!
//!   m p̈₀ = m g + f,   P̈ J = M − V S;   pinned at r: P̈ J_p = M − (f + m g) ⊗ r − V S

use super::{Encounter, Powers, Workspace, spring_loads};
use crate::affine::{AffineBalance, Gyration};
use crate::body::Affine;
use crate::contact::{ContactLoads, Deformation, LawKind};
use crate::fluid::{Immersed, Unresolved};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::load::Loads;
use crate::model::Model;
use crate::state::BodyMotion;
use crate::tensor::Mat3;

/// An affine body at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AffineMotion<'a> {
    pub index: usize,
    pub affine: &'a Affine,
    pub motion: &'a BodyMotion,
    pub gyration: Gyration,
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
    /// The body of this index in this motion.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0.
    #[inline(always)]
    pub fn new(index: usize, affine: &'a Affine, motion: &'a BodyMotion) -> Result<Self, Inadmissible> {
        let gyration = Gyration::of(&motion.placement.gradient, &motion.velocity.gradient_rate);
        let gyration = gyration.map_err(|value| Inadmissible { body: index, quantity: Quantity::Volume, value })?;
        Ok(Self { index, affine, motion, gyration })
    }

    /// Whether anything but gravity acts on the body.
    #[inline]
    pub fn is_loaded(&self, model: &Model) -> bool {
        let body = &model.bodies[self.index];
        let touched = !body.contacts.is_empty() || !body.springs.is_empty();
        let immersed = model.fluid.is_some() && body.inclusion.is_some();
        let held = self.affine.couple.is_some() || model.applied(self.index).is_some();
        touched || immersed || held || !self.affine.resistances.is_empty()
    }

    /// f and M of contacts, springs, couple, controller and resistances, and the powers of their works.
    #[inline]
    pub fn loads(&self, model: &Model, workspace: &mut Workspace, time: f64) -> Result<AffineLoads, Inadmissible> {
        if self.is_loaded(model) { self.summed(model, workspace, time) } else { Ok(AffineLoads::default()) }
    }

    /// The body about to meet its supports.
    #[inline]
    fn encounter<'b>(&'b self, model: &'b Model, time: f64) -> Encounter<'b> {
        let Gyration { inverse, volume_ratio, .. } = &self.gyration;
        let deformation = Deformation { inverse: *inverse, cofactor: *volume_ratio * inverse.transpose() };
        Encounter { model, time, index: self.index, motion: self.motion, deformation: Some(deformation) }
    }

    fn summed(&self, model: &Model, workspace: &mut Workspace, time: f64) -> Result<AffineLoads, Inadmissible> {
        let (placement, velocity) = (&self.motion.placement, &self.motion.velocity);
        let (mut loads, mut powers) = (Loads::default(), Powers::default());
        self.encounter(model, time).for_each_contact(|contact, meeting| {
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
        spring_loads(self.index, &model.bodies[self.index], self.motion, |spring| {
            powers.load += spring.dashpot_power;
            loads += spring.total();
        })?;
        if let Some(couple) = &self.affine.couple {
            let moment = couple.moment(time, &self.gyration.inverse);
            powers.load += moment.dot(&velocity.gradient_rate);
            loads.moment += moment;
        }
        if let Some(applied) = model.applied(self.index) {
            let held = applied.loads(&self.gyration.inverse);
            powers.load += held.power(&velocity.velocity, &velocity.gradient_rate);
            loads += held;
        }
        for resistance in &self.affine.resistances {
            let resisting = resistance.loads(&placement.gradient, &self.gyration.inverse, velocity);
            if resistance.dissipates() {
                powers.viscosity += resisting.power(&velocity.velocity, &velocity.gradient_rate);
            }
            loads += resisting;
        }
        if let Some(immersed) = self.immersion(model, time)? {
            let fluid = immersed.loads(&self.gyration);
            powers.fluid += fluid.power(&velocity.velocity, &velocity.gradient_rate);
            loads += fluid;
        }
        Ok(AffineLoads { contact, total: loads, powers })
    }

    /// The body in the fluid; none if it is not immersed.
    ///
    /// # Errors
    /// [`Inadmissible`] where the resistance of its form is not known.
    #[inline]
    pub fn immersion<'b>(&'b self, model: &'b Model, time: f64) -> Result<Option<Immersed<'b>>, Inadmissible> {
        let (Some(fluid), Some(inclusion)) = (&model.fluid, &model.bodies[self.index].inclusion) else {
            return Ok(None);
        };
        let BodyMotion { placement, velocity } = self.motion;
        let around = (fluid, &fluid.flow(time), &model.gravity);
        let unresolved = |Unresolved { quantity, value }| Inadmissible { body: self.index, quantity, value };
        Immersed::of(inclusion, around, (placement, velocity), &self.gyration).map_err(unresolved)
    }

    /// The affine moment about the centre of mass, or about the pin.
    #[inline]
    pub fn moment(&self, model: &Model, loads: &Loads) -> Mat3 {
        let body = &model.bodies[self.index];
        match &body.pin {
            None => loads.moment,
            Some(pin) => loads.moment - (loads.force + body.mass.mass * model.gravity) * pin.point.transpose(),
        }
    }

    /// P̈, stress, pressure.
    #[inline]
    pub fn balance(&self, model: &Model, loads: &Loads) -> AffineBalance {
        let mut balance = self.affine.interior.balance(&self.gyration, &self.moment(model, loads));
        if let Some(pressure) = &mut balance.pressure {
            let excess = self.excess(model, &balance.acceleration);
            *pressure -= excess;
            balance.stress += excess * self.gyration.inverse.transpose();
        }
        balance
    }

    /// λ/V, by which the pressure that keeps det P is less where the body has no inertia \[Pa\]: P̈ = λ Y is then no
    /// acceleration but what that pressure takes back.
    pub fn excess(&self, model: &Model, acceleration: &Mat3) -> f64 {
        if model.bodies[self.index].has_inertia() {
            return 0.0;
        }
        let across = self.gyration.inverse.transpose();
        let way = across * self.affine.interior.inverse;
        acceleration.dot(&across) / (way.dot(&across) * self.affine.interior.volume)
    }

    /// Solves the balance for the rates of the block, and adds the powers of friction and constraint.
    #[inline]
    pub fn fill(&self, model: &Model, loads: &mut AffineLoads, rates: &mut [f64]) {
        let balance = self.balance(model, &loads.total);
        loads.powers.viscosity -= balance.dissipation;
        if let Some(pressure) = balance.pressure {
            let growth = self.gyration.velocity_gradient.trace();
            loads.powers.constraint += pressure * self.affine.interior.volume * growth;
        }
        write(model, self, loads, &balance.acceleration, rates);
    }
}

/// Writes the rates of p₀, P, ṗ₀ and Ṗ, those of the velocities from the force and P̈.
#[inline]
pub(super) fn write(model: &Model, moving: &AffineMotion, loads: &AffineLoads, acceleration: &Mat3, rates: &mut [f64]) {
    let (body, velocity) = (&model.bodies[moving.index], &moving.motion.velocity);
    if body.pin.is_some() {
        rates[..9].copy_from_slice(velocity.gradient_rate.as_slice());
        rates[9..18].copy_from_slice(acceleration.as_slice());
        return;
    }
    let linear = model.gravity + loads.total.force / body.mass.mass;
    rates[..3].copy_from_slice(velocity.velocity.as_slice());
    rates[3..12].copy_from_slice(velocity.gradient_rate.as_slice());
    rates[12..15].copy_from_slice(linear.as_slice());
    rates[15..24].copy_from_slice(acceleration.as_slice());
}
