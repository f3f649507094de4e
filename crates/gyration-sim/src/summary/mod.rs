//! What a run leaves to say: outcome, work of the solver, ledger, momenta, events.

mod ledger;
mod text;
mod verdict;

pub use ledger::LedgerSummary;
pub use verdict::{Balance, OpenLedgers, Verdict};

use crate::crowd::CrowdState;
use crate::events::EVENT_KINDS;
use crate::outcome::Outcome;
use crate::run::Simulation;
use gyration::balance::observe_at;
use gyration::dynamics::{Workspace, acting};
use gyration::model::Model;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::Attributes;
use nalgebra::{Rotation3, UnitQuaternion};
use serde::Serialize;
use serde_json::{Value, json};
use std::time::Duration;

/// Bodies whose momenta are listed; of more there is a summary.
const MOST_BODIES: usize = 8;

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
    /// What they do together at the end; none of few, and where that could not be looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crowd: Option<CrowdState>,
    /// Smallest gap to anything that a body has a contact with, over the samples and the closest approaches [m]; none
    /// without contacts.
    pub smallest_gap: Option<f64>,
    /// How many events of each kind.
    pub events: Value,
    /// The rows in one word ([`gyration_record::RowHash`]); none before it is recorded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub row_hash: Option<String>,
    /// What must be told of the run besides, its ledger apart; none before it is recorded to its end.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
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
    /// Speed of the centre of mass [m/s].
    #[serde(skip)]
    pub speed: f64,
    /// Linear momentum [kg m/s].
    pub linear_momentum: [f64; 3],
    /// Angular momentum about the origin [kg m²/s].
    pub angular_momentum: [f64; 3],
    /// Affine momentum K = P J Ṗᵀ, rows [kg m²/s].
    pub affine_momentum: [[f64; 3]; 3],
    /// How it stands and turns; none of a body that deforms, and of points.
    #[serde(skip)]
    pub attitude: Option<Attitude>,
}

/// How a rigid body stands and turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude {
    /// By how much it is turned [rad], from 0 to π.
    pub angle: f64,
    /// About which axis; none where it is not turned.
    pub axis: Option<[f64; 3]>,
    /// [rad/s].
    pub angular_velocity: [f64; 3],
    /// Which of its own axes, with its sign, looks along gravity; none where no axis does, or nothing pulls.
    pub below: Option<&'static str>,
}

impl Attitude {
    /// Of a rotation P and its rate, under gravity [m/s²].
    fn of(rotation: &Mat3, rate: &Mat3, gravity: &Vec3) -> Self {
        let turned = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
        let spin = rate * rotation.transpose();
        let down = gravity.try_normalize(0.0).map(|down| rotation.tr_mul(&down));
        let sides = [("+x", 0), ("-x", 0), ("+y", 1), ("-y", 1), ("+z", 2), ("-z", 2)];
        let lies_on = |(side, axis): &(&'static str, usize)| {
            let along = down.map_or(0.0, |down| down[*axis]);
            (if side.starts_with('+') { along } else { -along }) > LIES_ON
        };
        Self {
            angle: turned.angle(),
            axis: turned.axis().map(|axis| axis.into_inner().into()),
            angular_velocity: [
                0.5 * (spin[(2, 1)] - spin[(1, 2)]),
                0.5 * (spin[(0, 2)] - spin[(2, 0)]),
                0.5 * (spin[(1, 0)] - spin[(0, 1)]),
            ],
            below: sides.into_iter().find(lies_on).map(|(side, _)| side),
        }
    }
}

/// The cosine beyond which an axis counts as vertical: 8°.
const LIES_ON: f64 = 0.99;

impl RunSummary {
    /// The names of [`RunSummary::attributes`].
    pub const ATTRIBUTES: [&str; 10] = [
        "outcome",
        "outcome_in_words",
        "statistics",
        "ledger",
        "largest_residual",
        "energy_in_play",
        "least_dissipation",
        "events",
        "row_hash",
        "warnings",
    ];

    /// The summary of a run that has ended.
    pub fn of(model: &Model, simulation: &mut Simulation, outcome: Outcome, wall: Option<Duration>) -> Self {
        let state = simulation.state();
        let run_state = simulation.run_state();
        let mut workspace = Workspace::default();
        let ledger = LedgerSummary::of(model, &mut workspace, simulation);
        let events =
            EVENT_KINDS.iter().zip(run_state.events).map(|(kind, count)| ((*kind).to_string(), json!(count))).collect();
        let mut read = workspace.read(model, &state).ok();
        let bodies = (0..model.bodies.len())
            .filter_map(|index| {
                let (instant, scratch) = read.as_mut()?;
                let at = instant.at(index);
                let acting = acting(&at, scratch).ok()?;
                let seen = observe_at(&at, &acting, scratch).ok()?;
                let k = seen.affine_momentum;
                let (p, rate) = (&seen.motion.placement.gradient, &seen.motion.velocity.gradient_rate);
                let body = &model.bodies[index];
                Some(BodySummary {
                    name: model.name(index).to_owned(),
                    position: seen.motion.placement.position.into(),
                    gap: seen.gap.is_finite().then_some(seen.gap),
                    speed: seen.motion.velocity.velocity.norm(),
                    linear_momentum: seen.linear_momentum.into(),
                    angular_momentum: seen.angular_momentum.into(),
                    affine_momentum: [0, 1, 2].map(|row| [0, 1, 2].map(|col| k[(row, col)])),
                    attitude: (body.affine().is_none() && !body.is_point())
                        .then(|| Attitude::of(p, rate, &model.gravity)),
                })
            })
            .collect();
        let crowd = read.as_mut().filter(|_| model.bodies.len() > MOST_BODIES);
        let crowd = crowd.and_then(|(instant, scratch)| CrowdState::of(instant, scratch).ok());
        Self {
            crowd,
            in_words: outcome.in_words(),
            outcome,
            time: state.time,
            wall_time: wall.map(|wall| wall.as_secs_f64()),
            statistics: statistics(simulation),
            ledger,
            bodies,
            smallest_gap: Some(run_state.smallest_gap).filter(|gap| gap.is_finite()),
            events: Value::Object(events),
            row_hash: None,
            warnings: Vec::new(),
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
        if let Some(hash) = &self.row_hash {
            attributes.insert("row_hash".into(), json!(hash));
        }
        if !self.warnings.is_empty() {
            attributes.insert("warnings".into(), json!(self.warnings));
        }
        attributes
    }
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
        "largest_projection": simulation.largest_projection(),
    })
}
