//! A contractile body: the balance solved together with the law of contraction.
//!
//!   P̈ J = M − V S,   μ_γ V_G = Fᵀ S Gᵀ − det G φ I + Q,   Ġ = V_G G

use super::affine::{excess, moment, write};
use super::contacts::nearest;
use super::loads::Acting;
use crate::affine::Gyration;
use crate::body::{Contractile, Slots};
use crate::contractile::{
    ContractileBalance, ContractileSlopes, ContractionCommand, ContractionSource, Decomposition, Feedback, Felt, Pull,
    velocity_of,
};
use crate::instant::MotionAt;
use crate::ledger::Work;
use crate::load::Loads;
use crate::simd::F64x4;
use crate::tensor::Mat3;

/// A contractile body at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContractileMotion<'a> {
    pub at: &'a MotionAt<'a>,
    pub contractile: &'a Contractile,
    pub gyration: &'a Gyration,
    pub decomposition: &'a Decomposition,
}

impl<'a> ContractileMotion<'a> {
    #[inline(always)]
    fn pull(&self) -> Pull<'a> {
        Pull {
            body: &self.contractile.affine.interior,
            contraction: &self.contractile.contraction,
            at: self.gyration,
            decomposition: self.decomposition,
        }
    }

    /// Q, or V_G.
    pub fn command(&self) -> ContractionCommand {
        let time = self.at.time;
        match &self.contractile.contraction.source {
            ContractionSource::Prescribed(signal) => velocity_of(&signal.jet(time), self.decomposition),
            ContractionSource::Driven { drive, .. } => {
                let answers = self.felt().map(|(felt, feedback)| feedback.answer(felt.value).0);
                ContractionCommand::Drive(drive.at(time) + answers.sum::<Mat3>())
            }
        }
    }

    /// The measures of the parts that answer to the body, and what they are for.
    pub fn felt(&self) -> impl Iterator<Item = (Felt, &'a Feedback)> {
        let MotionAt { model, time, index, motion, .. } = *self.at;
        let near = move || nearest(model, time, index, motion);
        let parts = self.contractile.contraction.feedback().iter();
        parts.map(move |part| (part.measure.of(&motion.placement, &motion.velocity, near), part))
    }

    /// P̈, V_G, stress, pressure, with inertia and without a guide.
    pub fn free_balance(&self, loads: &Loads) -> ContractileBalance {
        self.pull().balance(&self.command(), &moment(self.at, loads))
    }

    /// P̈, V_G, stress, pressure.
    #[inline]
    pub fn balance(&self, loads: &Loads) -> ContractileBalance {
        let mut balance = self.free_balance(loads);
        let Contractile { affine, contraction, .. } = self.contractile;
        let keeps_volume = balance.pressure.is_some() && !contraction.gives_pressure();
        let excess = excess(self.at, &affine.interior, self.gyration, &mut balance.acceleration, keeps_volume);
        if let Some(pressure) = balance.pressure.as_mut().filter(|_| keeps_volume) {
            *pressure -= excess;
            balance.stress += excess * self.gyration.inverse.transpose();
            if !contraction.is_driven() {
                // Q is what it takes, against the pressure too.
                balance.drive -= Mat3::from_diagonal_element(excess);
                balance.drive_power -= affine.interior.volume * excess * balance.contraction_velocity.trace();
            }
        }
        balance
    }

    /// The derivatives of P̈ and Ġ, with Q or V_G as it is.
    #[inline(always)]
    pub fn slopes_in<F: F64x4>(
        &self,
        registers: F,
        command: &ContractionCommand,
        moment: &Mat3,
    ) -> ContractileSlopes<'a, F> {
        self.pull().slopes_in(registers, command, moment)
    }

    /// Solves the balance for the rates, and adds the powers of drive, contraction, friction and constraint.
    #[inline]
    pub fn fill(&self, acting: &mut Acting, slots: &Slots, rates: &mut [f64]) {
        let balance = self.balance(&acting.total);
        let powers = &mut acting.powers;
        powers[Work::Viscosity] -= balance.friction;
        powers[Work::Contraction] -= balance.drag;
        powers[Work::Drive] += balance.drive_power;
        if let Some(pressure) = balance.pressure {
            // Zero but for the error of a step: tr(Ḟ F⁻¹) = tr L − tr V_G.
            let growth = self.gyration.velocity_gradient.trace() - balance.contraction_velocity.trace();
            powers[Work::Constraint] += pressure * self.contractile.affine.interior.volume * growth;
        }
        write(self.at, acting, &balance.acceleration, slots, rates);
        if self.contractile.contraction.is_driven() {
            rates[slots.extra()].copy_from_slice(balance.contraction_rate.as_slice());
        }
    }
}
