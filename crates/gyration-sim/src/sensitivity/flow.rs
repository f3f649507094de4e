//! The flow over a time, and its derivative by the start.
//!
//!   y(T) = φ_T(y₀),   S(T) = ∂φ_T/∂y₀ · S(0)

use super::tangent::Tangent;
use crate::outcome::Outcome;
use crate::plan::RunPlan;
use crate::ports::RunError;
use crate::record::{MemorySink, Unwatched};
use crate::rows::Extras;
use crate::run::Simulation;
use gyration::model::Model;
use gyration::state::State;
use nalgebra::DMatrix;

/// Where a start comes to, and where its neighbours do.
pub(crate) struct Flow {
    /// y(T).
    pub end: State,
    /// S(T), a column for each direction.
    pub derivative: DMatrix<f64>,
}

/// Why there is no flow over that time.
#[derive(Debug, thiserror::Error)]
pub(crate) enum NoFlow {
    /// The run could not begin.
    #[error(transparent)]
    Run(#[from] RunError),
    /// It ended early, or its derivative means nothing.
    #[error("{0}")]
    Lost(String),
}

impl Flow {
    /// From a start at t = 0 to the end of a plan; directions as columns.
    pub fn of(model: &Model, start: &State, plan: &RunPlan, directions: &DMatrix<f64>) -> Result<Self, NoFlow> {
        let (plan, mut simulation, mut sink) = begun(model, start, plan)?;
        let mut tangent = Tangent::of_directions(model, start, &plan, directions)?;
        loop {
            let before = simulation.partition.islands[0].integrator.time();
            let ended = simulation.advance(&mut sink, &mut Unwatched)?;
            let run = &simulation.partition.islands[0].integrator;
            if run.time() > before {
                tangent.record(run);
                if ended.is_none() && run.time() < plan.end {
                    tangent.go_on();
                    tangent.cross(run, before);
                }
            }
            match ended {
                None => {}
                Some(Outcome::Stopped(stop)) => return Err(NoFlow::Lost(stop.what)),
                Some(_) => break,
            }
        }
        tangent.reach(plan.end);
        tangent.look(&simulation.partition.islands[0].integrator);
        if let Some(lost) = tangent.columns.iter().find_map(|followed| followed.as_ref().err()) {
            return Err(NoFlow::Lost(lost.to_string()));
        }
        let derivative = tangent.state.columns(0, directions.ncols()).into_owned();
        Ok(Self { end: tangent.at.clone(), derivative })
    }
}

/// A run of all bodies together to the end of a plan, of which nothing but the end is recorded.
fn begun(model: &Model, start: &State, plan: &RunPlan) -> Result<(RunPlan, Simulation, MemorySink), RunError> {
    let plan = RunPlan { sample: plan.end, stop_at_rest: None, extras: Extras::default(), pairs: false, ..*plan };
    let mut simulation = Simulation::together(model, start, plan)?;
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink)?;
    Ok((plan, simulation, sink))
}

/// So many places of each step are looked at.
const LOOKED_AT: usize = 16;

/// Hands over the states of a run, each step at places of its own.
///
/// # Errors
/// [`NoFlow`] where it does not begin, or ends early.
pub(crate) fn each_state(
    model: &Model,
    start: &State,
    plan: &RunPlan,
    mut each: impl FnMut(&State),
) -> Result<(), NoFlow> {
    let (plan, mut simulation, mut sink) = begun(model, start, plan)?;
    let mut state = start.clone();
    state.low.clear();
    loop {
        let before = simulation.partition.islands[0].integrator.time();
        let ended = simulation.advance(&mut sink, &mut Unwatched)?;
        let run = &simulation.partition.islands[0].integrator;
        let after = run.time().min(plan.end);
        for k in 1..=LOOKED_AT {
            if after > before {
                state.time = before + (after - before) * k as f64 / LOOKED_AT as f64;
                run.interpolate(state.time, &mut state.bodies, &mut state.works);
                each(&state);
            }
        }
        match ended {
            None => {}
            Some(Outcome::Stopped(stop)) => return Err(NoFlow::Lost(stop.what)),
            Some(_) => return Ok(()),
        }
    }
}
