//! A run with its tangent beside it: step after step of both, and derivatives where they are asked for.

use super::quantity::Quantities;
use super::tangent::Tangent;
use super::{Derivatives, Meaningless, Sensitivities, SensitivityCounts, SensitivityError};
use crate::events::Event;
use crate::outcome::Outcome;
use crate::plan::RunPlan;
use crate::ports::{Monitor, Sink};
use crate::rows::Extras;
use crate::run::Simulation;
use crate::variation::{NOT_SMOOTH, SceneNumber, SceneVariation};
use gyration_ode::Integrator;
use gyration_record::RecordError;
use gyration_scene::Scene;

/// A tangent that is lost this near to the end of a run that stopped, as a part of its time, is lost by that: a field
/// is singular there.
const AT_THE_END: f64 = 1.0 - 1e-12;

/// A run, its tangent, and the derivatives so far.
pub(super) struct Following<'a> {
    pub found: Sensitivities,
    /// As of the scene, with columns that the quantities know.
    pub plan: RunPlan,
    tangent: Tangent<'a>,
    quantities: Quantities,
    simulation: Simulation,
}

impl<'a> Following<'a> {
    /// A run that has not yet begun.
    pub fn new(scene: &'a Scene, keys: &[String], quantities: &[String]) -> Result<Self, SensitivityError> {
        let built = scene.built();
        let model = &built.model;
        let numbers = keys.iter().map(|key| SceneNumber::find(scene, key)).collect::<Result<Vec<_>, _>>()?;
        let quantities = Quantities::find(model, quantities)?;
        let found = Sensitivities {
            outcome: Outcome::Completed,
            times: Vec::new(),
            values: Vec::new(),
            numbers: numbers.iter().map(|number| number.value).collect(),
            derivatives: vec![Derivatives::default(); keys.len()],
            growth: 1.0,
            counts: SensitivityCounts::default(),
        };
        let plan = RunPlan { extras: Extras::default(), ..built.into() };
        // The tangent follows one stepper.
        let simulation = Simulation::together(model, &built.state, plan)?;
        let vary =
            |number| SceneVariation::along_run(scene, number).map_err(|reason| Meaningless { from: 0.0, reason });
        let variations = numbers.into_iter().map(vary).collect();
        let mut tangent = Tangent::new(model, &built.state, &plan, variations)?;
        if quantities.with_works {
            tangent.follow_works();
        }
        Ok(Self { found, plan, tangent, quantities, simulation })
    }

    /// Allows steps of S this error, relative to the largest entry of a column, where rtol asks for a smaller one.
    pub fn allow(&mut self, error: f64) {
        self.tangent.allow(error);
    }

    /// Begins the run.
    pub fn begin(&mut self, sink: &mut dyn Sink) -> Result<(), SensitivityError> {
        Ok(self.simulation.begin(sink)?)
    }

    /// Makes a step of the run. The tangent is still before it, and may be asked for derivatives within it; gives the
    /// time at which it began, and how the run has ended, if it has.
    pub fn advance(
        &mut self,
        sink: &mut dyn Sink,
        monitor: &mut dyn Monitor,
    ) -> Result<(f64, Option<Outcome>), SensitivityError> {
        let before = self.time();
        let ended = self.simulation.advance(sink, monitor)?;
        if self.time() > before {
            self.tangent.record(&self.simulation.partition.islands[0].integrator);
        }
        Ok((before, ended))
    }

    /// Takes the tangent over the last step, which began at this time.
    pub fn go_on(&mut self, before: f64) {
        if self.time() > before {
            self.tangent.go_on();
            self.tangent.cross(&self.simulation.partition.islands[0].integrator, before);
        }
    }

    /// The time that the run has come to [s].
    pub fn time(&self) -> f64 {
        self.integrator().time()
    }

    fn integrator(&self) -> &Integrator {
        &self.simulation.partition.islands[0].integrator
    }

    /// Notes the quantities at a time within the last step, and their derivatives.
    pub fn differentiate_at(&mut self, time: f64, row: &[f64]) {
        self.tangent.reach(time);
        self.found.times.push(time);
        self.found.values.push(self.quantities.of_row(row));
        self.tangent.look(&self.simulation.partition.islands[0].integrator);
        for (column, derivatives) in self.found.derivatives.iter_mut().enumerate() {
            match self.tangent.derivative(column, &mut self.quantities) {
                Ok(row) => derivatives.rows.push(row),
                Err(lost) => derivatives.lost = derivatives.lost.take().or(Some(lost)),
            }
        }
    }

    /// What was found; notes what the end of the run, or the neighbours of the numbers, leave without a meaning, where
    /// derivatives at the end are asked for or at any samples.
    pub fn finish(mut self, outcome: Outcome, at_end: bool) -> Sensitivities {
        self.found.growth = self.tangent.growth();
        self.found.counts = self.tangent.counts();
        for (derivatives, doubt) in self.found.derivatives.iter_mut().zip(self.tangent.doubts()) {
            if let Outcome::Stopped(stop) = &outcome
                && derivatives.lost.as_ref().map_or(at_end, |lost| lost.from >= AT_THE_END * stop.time)
            {
                let reason = format!("the run ends there, before its time: {}", stop.what);
                derivatives.lost = Some(Meaningless { from: stop.time, reason });
            }
            if derivatives.lost.is_none() && doubt > NOT_SMOOTH {
                let reason = "the equations are not smooth in it".to_owned();
                *derivatives = Derivatives { rows: Vec::new(), lost: Some(Meaningless { from: 0.0, reason }) };
            }
        }
        self.found.outcome = outcome;
        self.found
    }
}

/// Waits for an event.
pub(super) struct Wait<F> {
    pub is_wanted: F,
    /// Whether the last event was the one.
    has_come: bool,
    /// Its time [s] and row.
    pub found: Option<(f64, Vec<f64>)>,
}

impl<F: FnMut(&Event) -> bool> Wait<F> {
    pub fn new(is_wanted: F) -> Self {
        Self { is_wanted, has_come: false, found: None }
    }
}

impl<F: FnMut(&Event) -> bool> Sink for Wait<F> {
    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        self.has_come = self.found.is_none() && (self.is_wanted)(event);
        Ok(())
    }

    fn wants_event_rows(&self) -> bool {
        true
    }

    fn event_row(&mut self, event: &Event, row: &[f64]) -> Result<(), RecordError> {
        if std::mem::take(&mut self.has_come) {
            self.found = Some((event.time, row.to_vec()));
        }
        Ok(())
    }
}
