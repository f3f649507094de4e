//! A rigid sphere with a history force: the balance with added mass, and the rates of the relaxation modes.
//!
//!   (m + m_a) p̈₀ = m g + f,   (I + I_a) Ω̇ = τ − Ω × IΩ
//!
//! f and τ with the loads of the history (`fluid::HistoryLoads`) that do not depend on the accelerations.

use crate::body::{RigidInertia, Slots};
use crate::fluid::{History, HistoryLoads, HistoryReaction};
use crate::instant::MotionAt;
use crate::load::Wrench;
use crate::state::Turn;
use crate::tensor::{Mat3, Vec3, cross_matrix};

/// Such a sphere at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RigidHistory<'a> {
    pub at: &'a MotionAt<'a>,
    pub history: &'a History,
    pub loads: HistoryLoads,
    pub turn: &'a Turn,
    /// L∞.
    pub flow: Mat3,
}

impl<'a> RigidHistory<'a> {
    /// None if the fluid forgets how the body moved.
    pub fn of(at: &'a MotionAt<'a>, turn: &'a Turn) -> Option<Self> {
        let MotionAt { model, time, body, motion, .. } = *at;
        let fluid = model.fluid.as_deref()?;
        let history = body.history()?;
        let flow = fluid.flow(time);
        let gradient = cross_matrix(&(motion.placement.gradient * turn.spin));
        let moving = (&motion.placement.position, &at.velocity(), &gradient);
        let loads = history.loads((fluid, &flow, time), moving, at.extra());
        Some(Self { at, history, loads, turn, flow: flow.gradient })
    }

    /// (I + I_a)⁻¹.
    pub fn inverse(&self, inertia: &RigidInertia) -> Mat3 {
        let total = inertia.tensor + Mat3::from_diagonal_element(self.history.added_inertia);
        // Positive definite, as I is.
        total.try_inverse().unwrap_or(inertia.inverse)
    }

    /// m + m_a.
    pub fn mass(&self) -> f64 {
        self.at.body.solid.mass.mass + self.history.added_mass
    }

    /// Force and moment of history and added mass at p̈₀ and Ω̇.
    pub fn reaction(&self, linear: &Vec3, angular: &Vec3) -> HistoryReaction {
        let turned = self.at.motion.placement.gradient * angular;
        let torque = self.loads.torque - self.history.added_inertia * turned;
        let mut couple = 0.5 * cross_matrix(&torque);
        if let Some(strain) = &self.loads.strain {
            couple += strain.couple;
        }
        HistoryReaction { force: self.loads.force - self.history.added_mass * linear, couple }
    }

    /// Solves the balance for the rates; gives the power of the history's loads [W].
    pub fn fill(&self, inertia: &RigidInertia, wrench: &Wrench, slots: &Slots, rates: &mut [f64]) -> f64 {
        let (loads, turn, motion) = (&self.loads, self.turn, self.at.motion);
        let rotation = &motion.placement.gradient;
        let weight = self.at.body.solid.mass.mass * self.at.model.gravity;
        let linear: Vec3 = (weight + wrench.force + loads.force) / self.mass();
        let torque = wrench.torque + rotation.tr_mul(&loads.torque);
        let spin = &turn.spin;
        let angular = self.inverse(inertia) * (torque - spin.cross(&(inertia.tensor * spin)));
        rates[slots.position()].copy_from_slice(motion.velocity.velocity.as_slice());
        rates[slots.attitude()].copy_from_slice(&turn.quaternion.rate(spin));
        rates[slots.velocity()].copy_from_slice(linear.as_slice());
        rates[slots.rate()].copy_from_slice(angular.as_slice());
        self.history.rates(loads, self.at.extra(), &mut rates[slots.extra()]);
        let force = loads.force - self.history.added_mass * linear;
        let torque = rotation.tr_mul(&loads.torque) - self.history.added_inertia * angular;
        force.dot(&motion.velocity.velocity) + torque.dot(spin)
    }
}
