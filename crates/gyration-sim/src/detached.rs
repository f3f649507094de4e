//! A detached run: all of it but its model, so that the model can be changed between two steps.
//!
//! A simulation borrows its model, which is frozen while it runs. Whoever changes loads or drives between steps
//! detaches the run, changes the model, and goes on with the two. Both ways move a few pointers and copy no numbers.

use crate::adapter::Prepared;
use crate::events::Event;
use crate::plan::RunPlan;
use crate::rows::{Fields, RowScratch};
use crate::run::Simulation;
use crate::tally::Tally;
use crate::views::View;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::Integrator;

/// What a simulation is without its model.
pub(crate) struct Detached {
    prepared: Prepared,
    integrator: Integrator,
    plan: RunPlan,
    tally: Tally,
    views: Vec<View>,
    sampled: State,
    forces: Vec<f64>,
    found: Vec<Event>,
    since: Vec<[f64; 3]>,
    fields: Fields,
    rows: RowScratch,
    recorded: f64,
}

impl Simulation<'_> {
    /// Lets go of the model.
    pub(crate) fn detach(self) -> Detached {
        let Self { system, integrator, plan, tally, views, sampled, forces, found, since, fields, rows, recorded } =
            self;
        let prepared = system.release();
        Detached { prepared, integrator, plan, tally, views, sampled, forces, found, since, fields, rows, recorded }
    }
}

impl Detached {
    /// Goes on with a model of the same bodies.
    pub fn on(self, model: &Model) -> Simulation<'_> {
        let Self { prepared, integrator, plan, tally, views, sampled, forces, found, since, fields, rows, recorded } =
            self;
        let system = prepared.on(model);
        Simulation { system, integrator, plan, tally, views, sampled, forces, found, since, fields, rows, recorded }
    }

    /// The steps so far.
    pub fn integrator(&self) -> &Integrator {
        &self.integrator
    }

    /// What rows hold.
    pub fn fields(&self) -> &Fields {
        &self.fields
    }

    /// The bodies after the last step.
    pub fn views(&self) -> &[View] {
        &self.views
    }
}
