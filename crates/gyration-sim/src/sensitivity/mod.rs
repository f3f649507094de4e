//! Derivatives of the motion by any number of a scene, by the variational equations along the run.
//!
//!   S′ = J S + ∂f/∂p,   S(0) = ∂y₀/∂p,   dr/dp = ∂r/∂y S + ∂r/∂p
//!
//! for a number p (a dotted key, as in `--set`) and a recorded quantity r (a column of the CSV), at the end or at each
//! sample. The run is the usual one; S follows it step by step (`tangent`) with the exact Jacobian, by a method that
//! neither stiffness nor long steps harm (`collocation`). What depends on p at a fixed state is differentiated between
//! models of neighbouring scenes (`crate::variation`); where a kink of a signal moves with p, so does S (`kinks`).
//!
//! A derivative is one at a fixed time. Where it means nothing there is a [`Meaningless`] with the reason: see
//! `docs/sensitivities.md`.

mod blocks;
mod collocation;
mod flow;
mod history;
mod kinks;
mod probe;
mod quantity;
mod stage_equations;
mod tangent;
mod works;

pub use crate::variation::UnknownNumber;
pub(crate) use flow::{Flow, NoFlow, each_state};
pub(crate) use probe::SCALES;
pub(crate) use quantity::Quantities;

use crate::outcome::Outcome;
use crate::plan::RunPlan;
use crate::ports::RunError;
use crate::record::{MemorySink, Unwatched};
use crate::rows::Extras;
use crate::run::Simulation;
use crate::variation::{NOT_SMOOTH, SceneNumber, SceneVariation};
use gyration_ode::Integrator;
use gyration_scene::Scene;
use tangent::Tangent;

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
        let built = scene.built();
        let model = &built.model;
        let numbers = keys.iter().map(|key| SceneNumber::find(scene, key)).collect::<Result<Vec<_>, _>>()?;
        let mut quantities = Quantities::find(model, quantities)?;
        let mut this = Self {
            outcome: Outcome::Completed,
            times: Vec::new(),
            values: Vec::new(),
            numbers: numbers.iter().map(|number| number.value).collect(),
            derivatives: vec![Derivatives::default(); keys.len()],
            growth: 1.0,
        };
        // Rows with the columns that the quantities know.
        let plan = RunPlan { extras: Extras::default(), ..built.into() };
        // The tangent follows one stepper.
        let mut simulation = Simulation::together(model, &built.state, plan)?;
        let vary = |number| SceneVariation::new(scene, number).map_err(|reason| Meaningless { from: 0.0, reason });
        let variations = numbers.into_iter().map(vary).collect();
        let mut tangent = Tangent::new(model, &built.state, &plan, variations)?;
        if quantities.with_works {
            tangent.follow_works();
        }
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink)?;
        loop {
            let before = simulation.partition.islands[0].integrator.time();
            let ended = simulation.advance(&mut sink, &mut Unwatched)?;
            let after = simulation.partition.islands[0].integrator.time();
            if after > before {
                tangent.record(&simulation.partition.islands[0].integrator);
            }
            for (time, row) in sink.rows.drain(..) {
                let is_last = ended.is_some() || time >= plan.end;
                if at == At::End && !(is_last && time >= after) {
                    continue;
                }
                tangent.reach(time);
                this.note(time, quantities.of_row(&row));
                this.differentiate(&mut tangent, &mut quantities, &simulation.partition.islands[0].integrator);
            }
            if after > before {
                tangent.go_on();
                tangent.cross(&simulation.partition.islands[0].integrator, before);
            }
            if let Some(outcome) = ended {
                this.finish(outcome, &tangent, at);
                return Ok(this);
            }
        }
    }

    fn note(&mut self, time: f64, values: Vec<f64>) {
        self.times.push(time);
        self.values.push(values);
    }

    /// The derivatives at the time that the tangent has come to.
    fn differentiate(&mut self, tangent: &mut Tangent<'_>, quantities: &mut Quantities, run: &Integrator) {
        tangent.look(run);
        for (column, derivatives) in self.derivatives.iter_mut().enumerate() {
            match tangent.derivative(column, quantities) {
                Ok(row) => derivatives.rows.push(row),
                Err(lost) => derivatives.lost = derivatives.lost.take().or(Some(lost)),
            }
        }
    }

    /// Notes what the end of the run, or the neighbours of the numbers, leave without a meaning.
    fn finish(&mut self, outcome: Outcome, tangent: &Tangent<'_>, at: At) {
        self.growth = tangent.growth();
        for (derivatives, doubt) in self.derivatives.iter_mut().zip(tangent.doubts()) {
            if let Outcome::Stopped(stop) = &outcome
                && at == At::End
                && derivatives.lost.as_ref().is_none_or(|lost| lost.from >= stop.time)
            {
                let reason = format!("the run ends there, before its time: {}", stop.what);
                derivatives.lost = Some(Meaningless { from: stop.time, reason });
            }
            if derivatives.lost.is_none() && doubt > NOT_SMOOTH {
                let reason = "the equations are not smooth in it".to_owned();
                *derivatives = Derivatives { rows: Vec::new(), lost: Some(Meaningless { from: 0.0, reason }) };
            }
        }
        self.outcome = outcome;
    }
}
