//! The bodies of all islands at one time.

use crate::island::Island;
use crate::sum::Sum;
use gyration::model::Model;
use gyration::state::State;

/// The state of a run, put together from those of its islands.
#[derive(Debug, Clone)]
pub(super) struct Joined {
    pub state: State,
    works: Vec<Sum>,
}

impl Joined {
    /// At the start of a run.
    pub fn new(model: &Model, start: &State) -> Self {
        let state = State { low: vec![0.0; start.bodies.len()], ..start.clone() };
        Self { state, works: vec![Sum::default(); model.works().len()] }
    }

    /// Begins with a time [s], at which every island is then to be added, in order.
    pub fn begin(&mut self, time: f64) {
        self.state.time = time;
        self.works.fill(Sum::default());
    }

    /// Adds the state of an island.
    pub fn add(&mut self, island: &Island, part: &State) {
        for (own, place) in island.places() {
            self.state.bodies[place.clone()].copy_from_slice(&part.bodies[own.clone()]);
            self.state.low[place.clone()].copy_from_slice(&part.low[own.clone()]);
        }
        for (value, place) in part.works.iter().zip(island.works()) {
            self.works[*place].add(*value);
        }
    }

    /// Ends with the sums of the works.
    pub fn end(&mut self) {
        for (work, sum) in self.state.works.iter_mut().zip(&self.works) {
            *work = sum.value();
        }
    }
}
