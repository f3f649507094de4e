//! What an island notes at the end of each step: what dissipates, the energy in play, since when its bodies are slow.

use crate::island::Island;
use crate::island::step_end::StepEnd;
use crate::plan::RunPlan;
use crate::run_state::DISSIPATION;
use gyration::balance::{fastest_speed, kinetic_energy};
use gyration_ode::StepReport;

/// The parts of a step at which speeds are looked at besides its ends: what swings in half a period is fastest
/// half-way.
const LOOKS: [f64; 3] = [0.25, 0.5, 0.75];

impl Island {
    /// The works of [`DISSIPATION`] after the last step [J]; zero where the ledger has none.
    pub fn dissipation(&self) -> [f64; 2] {
        let entries = self.model().works().iter().zip(self.integrator.quadratures());
        DISSIPATION.map(|work| entries.clone().find(|(entry, _)| **entry == work).map_or(0.0, |(_, value)| *value))
    }

    /// The kinetic energy of some of its bodies, by their places, at the end of the last step [J].
    pub fn kinetic_energy(&self, places: impl Iterator<Item = usize>) -> f64 {
        places.map(|place| kinetic_energy(&self.model().bodies[place], &self.step_ends[place].motion)).sum()
    }

    /// Notes the energy in play.
    pub fn note_in_play(&mut self) {
        let kinetic = self.kinetic_energy(0..self.members().len());
        self.state.in_play.note(kinetic, &self.integrator.quadratures()[..self.system.model().works().len()]);
    }

    /// Whether every body's fastest material point is slower than the speed of rest.
    pub fn is_slow(&self, plan: &RunPlan) -> bool {
        let Some(rest) = plan.stop_at_rest else { return false };
        // The centre is never the fastest: looked at first, it spares the search in a body that moves.
        let speed = |end: &StepEnd| end.motion.velocity.velocity.norm();
        let bodies = self.model().bodies.iter().zip(&self.step_ends);
        self.step_ends.iter().all(|end| speed(end) < rest.speed)
            && bodies.into_iter().all(|(body, end)| fastest_speed(body, &end.motion) < rest.speed)
    }

    /// Notes since when all bodies have been slow, after a step: at its end, and, where they are slow at both, within.
    pub fn note_rest(&mut self, plan: &RunPlan, step: &StepReport) {
        if !self.is_slow(plan) {
            self.state.slow_since = f64::NAN;
        } else if self.state.slow_since.is_nan() || self.is_fast_within(plan, step) {
            self.state.slow_since = step.end;
        }
    }

    /// Whether a body is as fast as the speed of rest at a quarter, at half or at three quarters of the last step.
    fn is_fast_within(&mut self, plan: &RunPlan, step: &StepReport) -> bool {
        let Some(rest) = plan.stop_at_rest else { return false };
        LOOKS.iter().any(|part| {
            self.sample(step.start + part * (step.end - step.start));
            let model = self.system.model();
            let motion = |body: usize| self.sampled.motion(model, body);
            (0..model.bodies.len()).any(|body| fastest_speed(&model.bodies[body], &motion(body)) >= rest.speed)
        })
    }
}
