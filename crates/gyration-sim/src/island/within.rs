//! States of an island within its last step, by its interpolant.

use crate::island::Island;
use crate::projection::project;
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{ExtendedMut, Integrator};

impl Island {
    /// Samples the state at a time within the last step, or after it.
    pub fn sample(&mut self, time: f64) {
        let (model, workspace) = self.system.observed();
        sample(&self.integrator, (model, workspace), time, &mut self.sampled);
    }

    /// The state at a time within the last step, or after it.
    pub fn state_at(&self, time: f64) -> State {
        let mut state = self.sampled.clone();
        sample(&self.integrator, (self.model(), &mut Workspace::default()), time, &mut state);
        state
    }
}

/// The state at a time within the last step, or after it.
fn sample(integrator: &Integrator, (model, workspace): (&Model, &mut Workspace), time: f64, sampled: &mut State) {
    let State { time: at, bodies, low, works } = sampled;
    *at = time;
    if time >= integrator.time() {
        bodies.copy_from_slice(integrator.state());
        low.copy_from_slice(integrator.state_low());
        works.copy_from_slice(integrator.quadratures());
        return;
    }
    integrator.interpolate_extended(time, bodies, works, Some(low));
    // Between the ends of a step the interpolant is off its manifold by its error.
    project(model, workspace, time, ExtendedMut { high: bodies, low }, works);
}
