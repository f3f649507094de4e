//! Where formulas of the model go over to others, as far as a run is known.

use gyration::state::State;
use std::collections::VecDeque;

/// The switching functions of a run, as far as it has been followed.
#[derive(Debug, Default)]
pub(super) struct Switching {
    /// When it started [s].
    pub start: f64,
    /// The sign of each where the run has come to; zero of one that has had none so far.
    pub sides: Vec<f64>,
    /// How large each has been.
    pub sizes: Vec<f64>,
    /// Where formulas change before S.
    pub ahead: VecDeque<Switch>,
    /// The last one that S has gone through.
    pub passed: Option<Switch>,
}

/// Where formulas change.
#[derive(Debug, Clone)]
pub(super) struct Switch {
    /// The last state before, and the first behind.
    pub states: [State; 2],
    /// ∂h/∂p for each column, of the functions that change their signs there; none where there is none.
    pub by_number: Vec<Option<Vec<f64>>>,
    /// How far from it each column looks at ∂f/∂p [s].
    pub margins: Vec<f64>,
    /// Which functions change their signs.
    pub which: Vec<usize>,
    /// How long the steps of the run are there [s].
    pub length: f64,
}

impl Switch {
    /// The times of the two states.
    pub fn times(&self) -> [f64; 2] {
        self.states.each_ref().map(|state| state.time)
    }
}
