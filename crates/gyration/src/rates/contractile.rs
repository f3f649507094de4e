//! A contractile body: the loads of an affine one, and the balance solved together with the law of contraction.
//!
//!   P̈ J = M − V S,   μ_γ V_G = Fᵀ S Gᵀ − det G φ I + Q,   Ġ = V_G G

use super::affine::write;
use super::{AffineLoads, AffineMotion, nearest};
use crate::body::Contractile;
use crate::columns::Four;
use crate::contractile::{
    Command, ContractileBalance, ContractileSlopes, Decomposition, Feedback, Felt, Pull, Source, velocity_of,
};
use crate::inadmissible::{Inadmissible, Quantity};
use crate::load::Loads;
use crate::model::Model;
use crate::state::{BodyMotion, contraction};
use crate::tensor::Mat3;

/// A contractile body at one instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContractileMotion<'a> {
    /// What it has in common with an affine body.
    pub pulled: AffineMotion<'a>,
    pub contractile: &'a Contractile,
    pub decomposition: Decomposition,
    pub time: f64,
}

impl<'a> ContractileMotion<'a> {
    /// The body of this index in this motion, at a time and with its block of the state.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0.
    #[inline(always)]
    pub fn new(
        index: usize,
        contractile: &'a Contractile,
        (motion, time, block): (&'a BodyMotion, f64, &[f64]),
    ) -> Result<Self, Inadmissible> {
        let pulled = AffineMotion::new(index, &contractile.affine, motion)?;
        let contraction = contraction(&contractile.contraction, time, block);
        let decomposition = Decomposition::of(&motion.placement.gradient, &contraction);
        let decomposition =
            decomposition.map_err(|value| Inadmissible { body: index, quantity: Quantity::Contraction, value })?;
        Ok(Self { pulled, contractile, decomposition, time })
    }

    #[inline(always)]
    fn pull(&self) -> Pull<'_> {
        Pull {
            body: &self.contractile.affine.interior,
            contraction: &self.contractile.contraction,
            at: &self.pulled.gyration,
            decomposition: &self.decomposition,
        }
    }

    /// Q, or V_G.
    pub fn command(&self, model: &Model) -> Command {
        match &self.contractile.contraction.source {
            Source::Prescribed(signal) => velocity_of(&signal.jet(self.time), &self.decomposition),
            Source::Driven { drive, .. } => {
                let answers = self.felt(model).map(|(felt, feedback)| feedback.answer(felt.value).0);
                Command::Drive(drive.at(self.time) + answers.sum::<Mat3>())
            }
        }
    }

    /// The measures of the parts that answer to the body, and what they are for.
    pub fn felt(&self, model: &Model) -> impl Iterator<Item = (Felt, &'a Feedback)> {
        let parts = self.contractile.contraction.feedback();
        let BodyMotion { placement, velocity } = self.pulled.motion;
        let near = move || nearest(model, self.time, self.pulled.index, self.pulled.motion);
        parts.iter().map(move |part| (part.measure.of(placement, velocity, near), part))
    }

    /// P̈, V_G, stress, pressure.
    #[inline]
    pub fn balance(&self, model: &Model, loads: &Loads) -> ContractileBalance {
        let mut balance = self.pull().balance(&self.command(model), &self.pulled.moment(model, loads));
        let contraction = &self.contractile.contraction;
        if let Some(pressure) = balance.pressure.as_mut().filter(|_| !contraction.gives_pressure()) {
            let excess = self.pulled.excess(model, &balance.acceleration);
            *pressure -= excess;
            balance.stress += excess * self.pulled.gyration.inverse.transpose();
            if !contraction.is_driven() {
                // Q is what it takes, against the pressure too.
                balance.drive -= Mat3::from_diagonal_element(excess);
                let volume = self.contractile.affine.interior.volume;
                balance.drive_power -= volume * excess * balance.contraction_velocity.trace();
            }
        }
        balance
    }

    /// The derivatives of P̈ and Ġ, with Q or V_G as it is.
    #[inline(always)]
    pub fn slopes_in<F: Four>(&self, registers: F, command: &Command, moment: &Mat3) -> ContractileSlopes<'_, F> {
        self.pull().slopes_in(registers, command, moment)
    }

    /// Solves the balance for the rates of the block, and adds the powers of drive, contraction, friction and constraint.
    #[inline]
    pub fn fill(&self, model: &Model, loads: &mut AffineLoads, rates: &mut [f64]) {
        let balance = self.balance(model, &loads.total);
        loads.powers.viscosity -= balance.friction;
        loads.powers.contraction -= balance.drag;
        loads.powers.drive += balance.drive_power;
        if let Some(pressure) = balance.pressure {
            // Zero but for the error of a step: tr(Ḟ F⁻¹) = tr L − tr V_G.
            let growth = self.pulled.gyration.velocity_gradient.trace() - balance.contraction_velocity.trace();
            loads.powers.constraint += pressure * self.contractile.affine.interior.volume * growth;
        }
        write(model, &self.pulled, loads, &balance.acceleration, rates);
        if self.contractile.contraction.is_driven() {
            let at = rates.len() - 9;
            rates[at..].copy_from_slice(balance.contraction_rate.as_slice());
        }
    }
}
