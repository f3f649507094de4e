//! What somebody who steps a run by hand asks of it: changes between two steps, and all bodies at one time.

use super::Simulation;
use crate::island::Island;
use crate::outcome::Stop;
use crate::ports::{RunError, Sink};
use gyration::model::Model;
use gyration::state::{BodyMotion, State};

impl Simulation {
    /// Restarts the stepper of the island of a body after a change of its loads or drive.
    pub(crate) fn restart(&mut self, body: usize) -> Result<(), Stop> {
        let (island, _) = self.partition.island_of(body);
        self.partition.islands[island].restart()
    }

    /// Changes loads or drive of a body, by its place in a model; what `change` says of it.
    pub(crate) fn change<T>(&mut self, body: usize, mut change: impl FnMut(&mut Model, usize) -> T) -> T {
        let (island, place) = self.partition.island_of(body);
        change(self.partition.islands[island].system.model_mut(), place);
        change(&mut self.model, body)
    }

    /// Records the present state, and from now on samples of this spacing [s]; infinite: none.
    ///
    /// # Errors
    /// [`RunError::Record`] if the row cannot be stored; within, a stop if the state is outside the model.
    pub(crate) fn sample_from_now(&mut self, sample: f64, sink: &mut dyn Sink) -> Result<Result<(), Stop>, RunError> {
        let time = self.state.time;
        self.plan.sample = sample;
        self.state.next_sample = self.plan.next_sample(time);
        self.sample(time);
        self.record(sink)
    }

    /// Lets all islands that are beyond the time of the run end a step there.
    pub(crate) fn land(&mut self) {
        let time = self.state.time;
        self.plan.end = time;
        let beyond = |island: &&mut Island| island.time() > time && island.restart_point.is_some();
        for island in self.partition.islands.iter_mut().filter(beyond) {
            let landed = island.come_to(time, &self.plan);
            debug_assert!(landed.is_ok(), "a step that was made can be cut");
        }
        self.commit(self.least_time());
    }

    /// The state from which its scales come.
    pub(crate) fn start(&self) -> &State {
        &self.start
    }

    /// The speed scale of a body [m/s].
    pub(crate) fn speed(&self, body: usize) -> f64 {
        self.speeds[body]
    }

    /// Placement and velocity of a body after the last step of its island.
    pub(crate) fn motion(&self, body: usize) -> &BodyMotion {
        let (island, place) = self.partition.island_of(body);
        &self.partition.islands[island].step_ends[place].motion
    }

    /// The shortest step that one of several islands would make [s]; none of one island, which makes it by itself.
    ///
    /// # Errors
    /// [`Stop`] if one of them has no rates.
    pub(crate) fn shortest_step(&mut self) -> Result<Option<f64>, Stop> {
        if self.partition.islands.len() == 1 {
            return Ok(None);
        }
        let steps = self.partition.islands.iter_mut().map(|island| island.next_size());
        steps.collect::<Result<Vec<_>, _>>().map(|steps| steps.into_iter().reduce(f64::min))
    }
}
