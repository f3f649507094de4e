//! What an island notes at the end of each step: what dissipates, the energy in play, since when its bodies are slow.

use crate::island::Island;
use crate::island::step_end::StepEnd;
use crate::plan::RunPlan;
use crate::run_state::DISSIPATION;
use gyration::balance::{fastest_speed, kinetic_energy};
use gyration::body::{Body, Slots};
use gyration::dynamics::{Workspace, rates};
use gyration::model::Model;
use gyration::state::BodyMotion;
use gyration_ode::{CrossingDirection, StepReport, find_crossing};
use std::sync::Arc;

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

    /// Notes since when all bodies have been slow, after a step at whose end they are, or that they are not.
    pub fn note_rest(&mut self, plan: &RunPlan, step: &StepReport) {
        if !self.is_slow(plan) {
            self.state.slow_since = f64::NAN;
            return;
        }
        let was_slow = self.state.slow_since.is_finite();
        let looks = LOOKS.map(|part| step.start + part * (step.end - step.start));
        let is_slow = |island: &mut Self, time: f64| island.excess_speed(plan, time) < 0.0;
        let fast = looks.iter().rposition(|time| !is_slow(self, *time));
        let (from, until) = match fast {
            Some(last) => (looks[last], looks.get(last + 1).copied().unwrap_or(step.end)),
            None if was_slow => return,
            None => (step.start, looks[0]),
        };
        // Without a crossing it is at one of the ends, by rounding.
        let at_end = |island: &mut Self| if island.excess_speed(plan, from) <= 0.0 { from } else { until };
        self.state.slow_since = self.slowed_down(plan, (from, until)).unwrap_or_else(|| at_end(self));
    }

    /// By how much the fastest material point of all is faster than the speed of rest, at a time within the last step
    /// [m/s].
    fn excess_speed(&mut self, plan: &RunPlan, time: f64) -> f64 {
        self.sample(time);
        let (model, workspace) = self.system.observed();
        excess_speed(plan, (model, workspace), time, &self.sampled.bodies)
    }

    /// When the last of all bodies gets slow between two times of the last step [s].
    fn slowed_down(&mut self, plan: &RunPlan, times: (f64, f64)) -> Option<f64> {
        let Self { system, integrator, .. } = self;
        let (model, workspace) = system.observed();
        let excess = |time: f64, bodies: &[f64], _: &[f64]| excess_speed(plan, (model, workspace), time, bodies);
        find_crossing(integrator, times, excess, CrossingDirection::Falling, 1)
    }
}

/// By how much the fastest material point of all bodies is faster than the speed of rest [m/s]; the velocity of one
/// without inertia is a rate.
fn excess_speed(plan: &RunPlan, (model, workspace): (&Model, &mut Workspace), time: f64, state: &[f64]) -> f64 {
    let slow = plan.stop_at_rest.map_or(f64::INFINITY, |rest| rest.speed);
    let mut slopes = Vec::new();
    if model.bodies.iter().any(|body| !body.has_inertia()) {
        slopes.resize(model.dimension(), 0.0);
        let mut powers = vec![0.0; model.works().len()];
        if rates(model, workspace, time, state.into(), &mut slopes, &mut powers).is_err() {
            return f64::NAN;
        }
    }
    let motion = |body: &Body, slots: &Slots| match body.has_inertia() {
        true => BodyMotion::read(body, slots, state),
        false => BodyMotion::of_rates(body, slots, state, &slopes),
    };
    let bodies = model.bodies.iter().enumerate();
    let speed = |(index, body): (usize, &Arc<Body>)| fastest_speed(body, &motion(body, model.slots(index)));
    bodies.map(speed).fold(0.0, f64::max) - slow
}
