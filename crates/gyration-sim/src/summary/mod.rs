//! What a run leaves to say: outcome, work of the solver, ledger, momenta, events.

mod text;
mod verdict;

pub use verdict::{Balance, Verdict};

use crate::events::EVENT_KINDS;
use crate::outcome::Outcome;
use crate::rows::Ledger;
use crate::run::Simulation;
use crate::run_state::{DISSIPATION, RunState};
use gyration::balance::observe_at;
use gyration::dynamics::{Workspace, acting};
use gyration::model::Model;
use gyration_record::Attributes;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use std::time::Duration;

/// The summary of a run.
#[derive(Debug, Clone, Serialize)]
pub struct RunSummary {
    /// How it ended.
    pub outcome: Outcome,
    /// The outcome in words.
    pub in_words: String,
    /// Where it ended [s].
    pub time: f64,
    /// Wall time of this part of the run [s]; not recorded, and none of a run that is told from its recording.
    pub wall_time: Option<f64>,
    /// Counters of the solver.
    pub statistics: Value,
    /// The ledger at the end.
    pub ledger: LedgerSummary,
    /// The bodies at the end.
    pub bodies: Vec<BodySummary>,
    /// Smallest gap over the samples [m]; none without supports.
    pub smallest_gap: Option<f64>,
    /// How many events of each kind.
    pub events: Value,
}

/// The ledger of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LedgerSummary {
    /// Σ energies at t = 0 [J].
    pub initial_energy: f64,
    /// Energies at the end [J], by name.
    #[serde(serialize_with = "as_map")]
    pub energies: Vec<(&'static str, f64)>,
    /// Works [J], by name.
    #[serde(serialize_with = "as_map")]
    pub works: Vec<(&'static str, f64)>,
    /// Residual at the end [J].
    pub residual: f64,
    /// Largest |residual| over the samples [J].
    pub largest_residual: f64,
    /// The largest |residual| [J] that the tolerances let pass.
    pub allowed_residual: f64,
    /// Whether the balance closes.
    pub verdict: Verdict,
    /// The energy in play [J]: the largest kinetic energy, or sum of |works|, over the samples.
    pub energy_in_play: f64,
    /// What contraction and viscosity took in the step in which they took least [J], by name; a negative one is the
    /// error of a step. Without those that the model does not have.
    #[serde(serialize_with = "as_map")]
    pub least_dissipation: Vec<(&'static str, f64)>,
}

impl LedgerSummary {
    /// The residual of the run and what it is compared with.
    pub fn balance(&self) -> Balance {
        let end: f64 = self.energies.iter().map(|(_, value)| value.abs()).sum();
        let total = self.initial_energy.abs().max(end);
        Balance { residual: self.largest_residual, in_play: self.energy_in_play, total }
    }

    /// What a user must be told of a ledger that is open.
    pub fn warning(&self) -> Option<String> {
        (self.verdict == Verdict::Open).then(|| {
            format!(
                "the energy balance is open: it misses by {:.1e} J, {:.1e} of the energy in play, where the tolerances \
                 let {:.1e} J pass. Do not trust the run: take a smaller solver.rtol, and look for gaps and \
                 coefficients out of proportion with the bodies.",
                self.largest_residual,
                self.largest_residual / self.energy_in_play,
                self.allowed_residual,
            )
        })
    }

    /// A work [J] by its name, if the ledger has it.
    pub fn work(&self, name: &str) -> Option<f64> {
        self.works.iter().find(|(work, _)| *work == name).map(|(_, value)| *value)
    }
}

/// Pairs as an object, in their order.
fn as_map<S: Serializer>(pairs: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().copied())
}

/// One body at the end of a run.
#[derive(Debug, Clone, Serialize)]
pub struct BodySummary {
    /// Its name.
    pub name: String,
    /// Position of the centre of mass [m].
    pub position: [f64; 3],
    /// Smallest distance to a support [m]; none without supports.
    pub gap: Option<f64>,
    /// Linear momentum [kg m/s].
    pub linear_momentum: [f64; 3],
    /// Angular momentum about the origin [kg m²/s].
    pub angular_momentum: [f64; 3],
    /// Affine momentum K = P J Ṗᵀ, rows [kg m²/s].
    pub affine_momentum: [[f64; 3]; 3],
}

impl RunSummary {
    /// The names of [`RunSummary::attributes`].
    pub const ATTRIBUTES: [&str; 8] = [
        "outcome",
        "outcome_in_words",
        "statistics",
        "ledger",
        "largest_residual",
        "energy_in_play",
        "least_dissipation",
        "events",
    ];

    /// The summary of a run that has ended.
    pub fn of(model: &Model, simulation: &mut Simulation, outcome: Outcome, wall: Option<Duration>) -> Self {
        let state = simulation.state();
        let run_state = simulation.run_state();
        let none = || Ledger { energies: Vec::new(), works: Vec::new(), residual: f64::NAN };
        let mut workspace = Workspace::default();
        let ledger =
            Ledger::of(model, &mut workspace, &state, Some(run_state.initial_energy)).unwrap_or_else(|_| none());
        let events =
            EVENT_KINDS.iter().zip(run_state.events).map(|(kind, count)| ((*kind).to_string(), json!(count))).collect();
        let mut read = workspace.read(model, &state).ok();
        let bodies = (0..model.bodies.len())
            .filter_map(|index| {
                let (instant, scratch) = read.as_mut()?;
                let at = instant.at(model, index);
                let seen = observe_at(&at, &acting(&at, scratch).ok()?);
                let k = seen.affine_momentum;
                Some(BodySummary {
                    name: model.bodies[index].name.clone(),
                    position: seen.motion.placement.position.into(),
                    gap: seen.gap.is_finite().then_some(seen.gap),
                    linear_momentum: seen.linear_momentum.into(),
                    angular_momentum: seen.angular_momentum.into(),
                    affine_momentum: [0, 1, 2].map(|row| [0, 1, 2].map(|col| k[(row, col)])),
                })
            })
            .collect();
        let mut ledger = LedgerSummary {
            initial_energy: run_state.initial_energy,
            energies: model.energies().iter().map(|energy| energy.name()).zip(ledger.energies).collect(),
            works: model.works().iter().map(|work| work.name()).zip(ledger.works).collect(),
            residual: ledger.residual,
            largest_residual: run_state.largest_residual,
            allowed_residual: f64::NAN,
            verdict: Verdict::Open,
            energy_in_play: run_state.energy_in_play,
            least_dissipation: least_dissipation(model, run_state),
        };
        let (balance, tolerance) = (ledger.balance(), simulation.plan().tolerance);
        ledger.allowed_residual = balance.allowed(tolerance);
        ledger.verdict = balance.verdict(tolerance);
        Self {
            in_words: outcome.in_words(),
            outcome,
            time: state.time,
            wall_time: wall.map(|wall| wall.as_secs_f64()),
            statistics: statistics(simulation),
            ledger,
            bodies,
            smallest_gap: Some(run_state.smallest_gap).filter(|gap| gap.is_finite()),
            events: Value::Object(events),
        }
    }

    /// What of it is recorded: everything but wall time.
    pub fn attributes(&self) -> Attributes {
        let mut attributes = Attributes::new();
        attributes.insert("outcome".into(), self.outcome.attribute());
        attributes.insert("outcome_in_words".into(), json!(self.in_words));
        attributes.insert("statistics".into(), self.statistics.clone());
        attributes.insert("ledger".into(), json!(self.ledger.verdict));
        attributes.insert("largest_residual".into(), json!(self.ledger.largest_residual));
        attributes.insert("energy_in_play".into(), json!(self.ledger.energy_in_play));
        if !self.ledger.least_dissipation.is_empty() {
            let entries = self.ledger.least_dissipation.iter().map(|(name, value)| ((*name).to_owned(), json!(value)));
            attributes.insert("least_dissipation".into(), Value::Object(entries.collect()));
        }
        attributes.insert("events".into(), self.events.clone());
        attributes
    }
}

/// Of the works that only take and that the model has, once there was a step.
fn least_dissipation(model: &Model, run_state: &RunState) -> Vec<(&'static str, f64)> {
    let entries = DISSIPATION.iter().zip(run_state.largest_gains);
    let present = entries.filter(|(work, gain)| model.works().contains(work) && gain.is_finite());
    // Adding zero turns −0 into 0.
    present.map(|(work, gain)| (work.name(), -gain + 0.0)).collect()
}

fn statistics(simulation: &Simulation) -> Value {
    let s = simulation.statistics();
    json!({
        "explicit_steps": s.explicit_steps,
        "implicit_steps": s.implicit_steps,
        "rejected_for_error": s.rejected_error,
        "rejected_for_domain": s.rejected_domain,
        "newton_failures": s.newton_failures,
        "rate_evaluations": s.rate_evaluations,
        "jacobians": s.jacobians,
        "factorizations": s.factorizations,
        "switches": s.switches,
        "smallest_step": s.smallest_step,
        "largest_step": s.largest_step,
        "largest_projection": simulation.run_state().largest_projection,
    })
}
