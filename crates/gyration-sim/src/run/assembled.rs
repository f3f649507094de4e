//! The bodies of all islands at one time.

use crate::island::Island;
use crate::plan::RunPlan;
use crate::run_state::Settled;
use crate::sum::Sum;
use gyration::model::Model;
use gyration::state::State;

/// The state of a run, put together from those of its islands.
#[derive(Debug, Clone)]
pub(super) struct Assembled {
    pub state: State,
    /// Works and, behind them, impulses.
    works: Vec<Sum>,
}

impl Assembled {
    /// At the start of a run.
    pub fn new(model: &Model, start: &State, plan: &RunPlan) -> Self {
        let state = State { low: vec![0.0; start.bodies.len()], ..start.clone() };
        Self { state, works: vec![Sum::default(); plan.count_quadratures(model)] }
    }

    /// Begins with a time [s] and what islands have done that are no more; every island is then to be added, in order.
    pub fn begin(&mut self, time: f64, settled: &Settled) {
        self.state.time = time;
        self.works.fill(Sum::default());
        for (work, settled) in self.works.iter_mut().zip(&settled.works) {
            *work = *settled;
        }
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

    /// ∫ f dt of the contacts of each body since the start [N s], one behind the other; none where that is not asked
    /// for.
    pub fn impulses(&self) -> impl Iterator<Item = f64> {
        self.works.iter().skip(self.state.works.len()).map(Sum::value)
    }

    /// Ends with the sums of the works.
    pub fn end(&mut self) {
        for (work, sum) in self.state.works.iter_mut().zip(&self.works) {
            *work = sum.value();
        }
    }
}
