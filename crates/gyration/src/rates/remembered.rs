//! A rigid sphere that the fluid remembers: the balance with added mass, and the rates of the modes.
//!
//!   (m + m_a) p̈₀ = m g + f,   (I + I_a) Ω̇ = τ − Ω × IΩ
//!
//! f and τ with the loads of the memory (`fluid::Remembered`) that do not depend on the accelerations.

use crate::body::{Body, RigidInertia};
use crate::fluid::{Memory, Remembered};
use crate::load::Wrench;
use crate::model::Model;
use crate::state::{BodyMotion, Turn};
use crate::tensor::{Mat3, Vec3};

/// Where the modes of a free rigid body begin.
const MODES: usize = 13;

/// Such a sphere at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RigidMemory<'a> {
    pub body: &'a Body,
    pub memory: &'a Memory,
    pub loads: Remembered,
    pub modes: &'a [f64],
    pub motion: &'a BodyMotion,
    pub turn: &'a Turn,
    /// L∞.
    pub flow: Mat3,
}

impl<'a> RigidMemory<'a> {
    /// None if the fluid remembers nothing of the body; `block` is that of its state.
    pub fn of(
        model: &'a Model,
        time: f64,
        index: usize,
        (motion, turn, block): (&'a BodyMotion, &'a Turn, &'a [f64]),
    ) -> Option<Self> {
        let (body, fluid) = (&model.bodies[index], model.fluid.as_ref()?);
        let memory = body.memory()?;
        let (modes, flow) = (&block[MODES..], fluid.flow(time));
        let spin = motion.placement.gradient * turn.spin;
        let moving = (&motion.placement.position, &motion.velocity.velocity, &spin);
        let loads = memory.loads((fluid, &flow, time), moving, modes);
        Some(Self { body, memory, loads, modes, motion, turn, flow: flow.gradient })
    }

    /// (I + I_a)⁻¹.
    pub fn inverse(&self, inertia: &RigidInertia) -> Mat3 {
        let total = inertia.tensor + Mat3::from_diagonal_element(self.memory.added_inertia);
        // Positive definite, as I is.
        total.try_inverse().unwrap_or(inertia.inverse)
    }

    /// m + m_a.
    pub fn mass(&self) -> f64 {
        self.body.mass.mass + self.memory.added_mass
    }

    /// Solves the balance for the rates of the block; gives the power of the memory's loads [W].
    pub fn fill(&self, model: &Model, inertia: &RigidInertia, wrench: &Wrench, rates: &mut [f64]) -> f64 {
        let (loads, turn, motion) = (&self.loads, self.turn, self.motion);
        let rotation = &motion.placement.gradient;
        let linear: Vec3 = (self.body.mass.mass * model.gravity + wrench.force + loads.force) / self.mass();
        let torque = wrench.torque + rotation.tr_mul(&loads.torque);
        let spin = &turn.spin;
        let angular = self.inverse(inertia) * (torque - spin.cross(&(inertia.tensor * spin)));
        rates[..3].copy_from_slice(motion.velocity.velocity.as_slice());
        rates[3..7].copy_from_slice(&turn.quaternion.rate(spin));
        rates[7..10].copy_from_slice(linear.as_slice());
        rates[10..MODES].copy_from_slice(angular.as_slice());
        self.memory.rates(loads, self.modes, &mut rates[MODES..]);
        let force = loads.force - self.memory.added_mass * linear;
        let torque = rotation.tr_mul(&loads.torque) - self.memory.added_inertia * angular;
        force.dot(&motion.velocity.velocity) + torque.dot(spin)
    }
}
