//! A detached run: a run apart from its model, so that the model can be changed between two steps.
//!
//! A simulation borrows its model, which is frozen while it runs. Whoever changes loads or drives between steps
//! detaches the run, changes the model, and goes on with the two. Both ways move a few pointers and copy no numbers.

use crate::adapter::Prepared;
use crate::run::{Run, Simulation};
use gyration::model::Model;

/// What a simulation is without its model.
pub(crate) struct DetachedRun {
    prepared: Prepared,
    pub run: Run,
}

impl Simulation<'_> {
    /// Lets go of the model.
    pub(crate) fn detach(self) -> DetachedRun {
        DetachedRun { prepared: self.system.release(), run: self.run }
    }
}

impl DetachedRun {
    /// Goes on with a model of the same bodies.
    pub fn on(self, model: &Model) -> Simulation<'_> {
        Simulation { system: self.prepared.on(model), run: self.run }
    }
}
