//! What chooses one of a family of orbits, and energies of a state.

use gyration::Inadmissible;
use gyration::balance::{energies, kinetic_energy};
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::state::State;

/// What chooses one of a family of orbits.
pub enum Choice<'a> {
    /// The period \[s\].
    Period,
    /// The energy \[J\].
    Energy(f64),
    /// The value of a quantity of the start.
    Quantity(&'a dyn Fn(&State) -> Result<f64, Inadmissible>, f64),
    /// Nothing: the orbit stands alone.
    Alone,
}

/// By how much the value that an orbit is chosen by is off, as a part of what is wanted.
pub(super) fn wanted(model: &Model, choice: &Choice<'_>, start: &State) -> Result<f64, Inadmissible> {
    match choice {
        Choice::Period | Choice::Alone => Ok(0.0),
        Choice::Energy(_) | Choice::Quantity(..) => value(model, choice, start),
    }
}

/// (value − wanted)/|wanted|, absolute where zero is wanted.
pub(super) fn value(model: &Model, choice: &Choice<'_>, state: &State) -> Result<f64, Inadmissible> {
    let (found, wanted) = match choice {
        Choice::Energy(wanted) => (energy(model, state)?, *wanted),
        Choice::Quantity(quantity, wanted) => (quantity(state)?, *wanted),
        Choice::Period | Choice::Alone => (0.0, 0.0),
    };
    Ok(if wanted == 0.0 { found } else { (found - wanted) / wanted.abs() })
}

/// The energy of all bodies, and the kinetic part of it \[J\].
pub(super) fn seen(model: &Model, state: &State) -> Result<[f64; 2], Inadmissible> {
    let moving = |index: usize| kinetic_energy(&model.bodies[index], &state.motion(model, index));
    Ok([energy(model, state)?, (0..model.bodies.len()).map(moving).sum()])
}

/// The energy of all bodies \[J\].
pub fn energy(model: &Model, state: &State) -> Result<f64, Inadmissible> {
    let mut values = vec![0.0; model.energies().len()];
    energies(model, &mut Workspace::default(), state, &mut values)?;
    Ok(values.iter().sum())
}
