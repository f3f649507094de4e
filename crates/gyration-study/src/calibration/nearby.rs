//! Measurements whose numbers differ by little, as those of a difference do: each is looked for where the one before
//! was found, and comes out the same but for rounding.

use gyration::model::Model;
use gyration::state::State;
use gyration_scene::Override;
use gyration_sim::modes::{Rest, rest};

/// What is known of a measurement from its computation with other numbers nearby.
#[derive(Default)]
pub(super) struct Nearby {
    /// The body at rest.
    still: Option<State>,
    /// The part of gravity that presses on its slope.
    pub gravity: Option<Override>,
    /// The logarithm of the gap of the largest pull [m].
    pub pull: Option<f64>,
}

impl Nearby {
    /// The rest state of a body, looked for from where it was nearby, which is Newton's last steps.
    pub fn rest(&mut self, model: &Model, start: &State, index: usize) -> Result<Rest, String> {
        let known = self.still.as_ref().filter(|still| still.bodies.len() == start.bodies.len());
        let found = known.and_then(|still| rest(model, still, index).ok());
        let found = found.map_or_else(|| rest(model, start, index).map_err(|none| none.to_string()), Ok)?;
        // Always the first one, so that each comes out the same whichever was computed before it.
        self.still.get_or_insert_with(|| {
            let mut still = start.clone();
            still.bodies[model.blocks()[index].clone()].copy_from_slice(found.block());
            still
        });
        Ok(found)
    }
}
