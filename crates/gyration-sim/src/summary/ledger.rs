//! The ledger of a run in its summary: energies, works, residual, and whether it closes.

use super::verdict::{ADVICE, Balance, Verdict};
use crate::looseness::Looseness;
use crate::rows::Ledger;
use crate::run::Simulation;
use crate::run_state::DISSIPATION;
use gyration::dynamics::Workspace;
use gyration::model::Model;
use serde::{Serialize, Serializer};

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
    /// The energy in play [J]: the largest kinetic energy, or sum of |works|, at the end of any step.
    pub energy_in_play: f64,
    /// What contraction and viscosity took in the step in which they took least [J], by name; a negative one is the
    /// error of a step. Without those that the model does not have.
    #[serde(serialize_with = "as_map")]
    pub least_dissipation: Vec<(&'static str, f64)>,
    #[serde(skip)]
    balance: Balance,
}

impl LedgerSummary {
    /// The ledger of a run as far as it has got.
    pub(super) fn of(model: &Model, workspace: &mut Workspace, simulation: &Simulation) -> Self {
        let (state, run_state, tolerance) = (simulation.state(), simulation.run_state(), simulation.plan().tolerance);
        let none = || Ledger { energies: Vec::new(), works: Vec::new(), residual: f64::NAN };
        let end = Ledger::of(model, workspace, &state, Some(run_state.initial_energy)).unwrap_or_else(|_| none());
        let looseness = Looseness::of(model, workspace, &state, tolerance).unwrap_or_default();
        let balance = balance(simulation, &end.energies, looseness);
        Self {
            initial_energy: run_state.initial_energy,
            energies: model.energies().iter().map(|energy| energy.name()).zip(end.energies).collect(),
            works: model.works().iter().map(|work| work.name()).zip(end.works).collect(),
            residual: end.residual,
            largest_residual: balance.residual,
            allowed_residual: balance.allowed(tolerance),
            verdict: balance.verdict(tolerance),
            balance,
            energy_in_play: balance.in_play,
            least_dissipation: least_dissipation(model, simulation.largest_gains()),
        }
    }

    /// The residual of the run and what it is compared with.
    pub fn balance(&self) -> Balance {
        self.balance
    }

    /// What a user must be told of a ledger that is open.
    pub fn warning(&self) -> Option<String> {
        (self.verdict == Verdict::Open).then(|| {
            format!(
                "the energy balance is open: it misses by {:.1e} J, {:.1e} of the energy in play, where the tolerances \
                 let {:.1e} J pass. Do not trust the run: {ADVICE}.",
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

impl Verdict {
    /// The verdict on a run as far as it has got, which [`LedgerSummary::verdict`] would be.
    pub fn of(model: &Model, simulation: &Simulation) -> Self {
        // What closes without the state at the end closes with it, which is rarely needed.
        let without = balance(simulation, &[], Looseness::default()).verdict(simulation.plan().tolerance);
        match without {
            Self::Closed => Self::Closed,
            Self::Open => LedgerSummary::of(model, &mut Workspace::default(), simulation).verdict,
        }
    }
}

/// The residual of a run and what it is compared with; `energies` and looseness are those at the end.
fn balance(simulation: &Simulation, energies: &[f64], looseness: Looseness) -> Balance {
    let run_state = simulation.run_state();
    let looseness = run_state.looseness.over(looseness);
    let end: f64 = energies.iter().map(|value| value.abs()).sum();
    let total = run_state.initial_energy.abs().max(end);
    Balance {
        residual: run_state.largest_residual,
        in_play: simulation.energy_in_play(),
        total,
        loaded: looseness.of_lengths,
        of_energies: looseness.of_energies,
    }
}

/// Pairs as an object, in their order.
fn as_map<S: Serializer>(pairs: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().copied())
}

/// Of the works that only take and that the model has, once there was a step.
fn least_dissipation(model: &Model, largest_gains: [f64; 2]) -> Vec<(&'static str, f64)> {
    let entries = DISSIPATION.iter().zip(largest_gains);
    let present = entries.filter(|(work, gain)| model.works().contains(work) && gain.is_finite());
    // Adding zero turns −0 into 0.
    present.map(|(work, gain)| (work.name(), -gain + 0.0)).collect()
}
