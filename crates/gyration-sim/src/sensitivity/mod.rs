//! Derivatives of the motion by any number of a scene, by the variational equations along the run.
//!
//!   S′ = J S + ∂f/∂p,   S(0) = ∂y₀/∂p,   dr/dp = ∂r/∂y S + ∂r/∂p
//!
//! for a number p (a dotted key, as in `--set`) and a recorded quantity r (a column of the CSV), at the end or at each
//! sample. The run is the usual one; S follows it step by step (`tangent`) with the exact Jacobian, by a method that
//! neither stiffness nor long steps harm (`collocation`). What depends on p at a fixed state is differentiated between
//! models of neighbouring scenes (`crate::variation`); where a kink of a signal moves with p, so does S (`kinks`);
//! where a formula goes over to another, S goes along (`switching`).
//!
//! A derivative is one at a fixed time. Where it means nothing there is a [`Meaningless`] with the reason: see
//! `docs/sensitivities.md`.

mod blocks;
mod collocation;
mod flow;
mod following;
mod history;
mod kinks;
mod last_powers;
mod probe;
mod quantity;
mod stage_equations;
mod switches;
mod switching;
mod tangent;
mod works;

pub use crate::variation::UnknownNumber;
pub(crate) use flow::{Flow, NoFlow, each_state};
pub(crate) use probe::SCALES;
pub(crate) use quantity::Quantities;

use crate::events::Event;
use crate::outcome::Outcome;
use crate::ports::{Monitor, RunError};
use crate::record::{MemorySink, Unwatched};
use following::{Following, Wait};
use gyration_scene::Scene;

/// The part of the motion that may be lost to the growth of errors: rtol times growth.
const GROWN: f64 = 0.1;

/// When derivatives are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum At {
    /// At the end of the run.
    End,
    /// At each sample.
    Samples,
}

/// Derivatives of recorded quantities by numbers of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivities {
    /// How the run ended.
    pub outcome: Outcome,
    /// The times at which values are known [s]: all samples, or the end.
    pub times: Vec<f64>,
    /// The quantities at each of the times.
    pub values: Vec<Vec<f64>>,
    /// The numbers, in the order of the keys.
    pub numbers: Vec<f64>,
    /// The derivatives by each number, in the order of the keys.
    pub derivatives: Vec<Derivatives>,
    /// How many times what is not known of the start has grown, in units of gaps and speeds.
    pub growth: f64,
    /// What it took.
    pub counts: SensitivityCounts,
}

/// What derivatives along a run take, in counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SensitivityCounts {
    /// Steps of the run.
    pub run_steps: u64,
    /// Steps of S that were tried, each with five Jacobians and one factorization.
    pub steps: u64,
    /// Evaluations of the rates, of the scene and its neighbours, for ∂f/∂p.
    pub evaluations: u64,
}

/// The derivatives of quantities by one number.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Derivatives {
    /// Of each quantity at each of the times, as far as they have a meaning.
    pub rows: Vec<Vec<f64>>,
    /// Why there are no more.
    pub lost: Option<Meaningless>,
}

/// Why a derivative means nothing, and since when.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("from t = {from} s: {reason}")]
pub struct Meaningless {
    /// Since when [s].
    pub from: f64,
    /// Why, in a sentence without its full stop.
    pub reason: String,
}

/// Why there are no sensitivities at all.
#[derive(Debug, thiserror::Error)]
pub enum SensitivityError {
    /// A key that names no number.
    #[error(transparent)]
    Key(#[from] UnknownNumber),
    /// A name that is no column.
    #[error("{name}: not a quantity that has derivatives; {help}")]
    Quantity {
        /// The name.
        name: String,
        /// What to do.
        help: String,
    },
    /// The run could not begin.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl Derivatives {
    /// The derivatives at the end of the run.
    ///
    /// # Errors
    /// Why they mean nothing.
    pub fn at_end(&self) -> Result<&[f64], &Meaningless> {
        match &self.lost {
            Some(lost) => Err(lost),
            None => Ok(self.rows.last().map_or(&[], Vec::as_slice)),
        }
    }
}

impl Sensitivities {
    /// Runs a scene and follows the derivatives of quantities (columns of the CSV) by the numbers at keys.
    ///
    /// # Errors
    /// [`SensitivityError`] for a key or a quantity that there is not, or a start outside the model. A derivative that
    /// means nothing is no error, but told in its place.
    pub fn along(scene: &Scene, keys: &[String], quantities: &[String], at: At) -> Result<Self, SensitivityError> {
        let mut following = Following::new(scene, keys, quantities)?;
        let mut sink = MemorySink::default();
        following.begin(&mut sink)?;
        loop {
            let (before, ended) = following.advance(&mut sink, &mut Unwatched)?;
            for (time, row) in sink.rows.drain(..) {
                let is_last = ended.is_some() || time >= following.plan.end;
                if at == At::Samples || (is_last && time >= following.time()) {
                    following.differentiate_at(time, &row);
                }
            }
            following.go_on(before);
            if let Some(outcome) = ended {
                return Ok(following.finish(outcome, at == At::End));
            }
        }
    }

    /// The same at the time of the first event that is wanted, where the run is then left. Without one before the end,
    /// or before `monitor` stops the run, there are no times and no derivatives.
    ///
    /// Derivatives are at that fixed time, not along the event. A step of S may have this error, relative to the
    /// largest entry of a column, where rtol asks for a smaller one: the run itself, and the quantities, are not
    /// touched by it.
    ///
    /// # Errors
    /// As of [`Sensitivities::along`].
    pub fn at_event(
        scene: &Scene,
        keys: &[String],
        quantities: &[String],
        error: f64,
        is_wanted: impl FnMut(&Event) -> bool,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, SensitivityError> {
        let mut following = Following::new(scene, keys, quantities)?;
        following.allow(error);
        let mut wait = Wait::new(is_wanted);
        following.begin(&mut wait)?;
        loop {
            let (before, ended) = following.advance(&mut wait, monitor)?;
            if let Some((time, row)) = wait.found.take() {
                following.differentiate_at(time, &row);
                return Ok(following.finish(Outcome::Completed, false));
            }
            following.go_on(before);
            if let Some(outcome) = ended {
                return Ok(following.finish(outcome, true));
            }
        }
    }
}
