//! Runs a scene and looks at the end of every step: gaps, ledger, outcome.

use gyration::balance::energies;
use gyration::contact::Contact;
use gyration::dynamics::{Workspace, gap_to_supports};
use gyration::model::Model;
use gyration::state::State;
use gyration_record::RecordError;
use gyration_scene::Scene;
use gyration_sim::events::Event;
use gyration_sim::rows::Ledger;
use gyration_sim::{Job, Monitor, Outcome, Progress, Provenance, Reason, RunError, Simulation, Sink, WindowEnd};

/// The most evaluations of a run: enough for some hundred steps. A longer one is audited up to there.
const MOST_EVALUATIONS: u64 = 6000;

/// Figures of a run.
pub struct RunFigures {
    /// How it ended.
    pub outcome: Outcome,
    /// Accepted steps.
    pub steps: u64,
    /// Evaluations of the rates.
    pub evaluations: u64,
    /// Smallest gap over samples and ends of steps, as a fraction of the smallest body's size.
    pub gap: f64,
    /// Largest residual of the ledger over samples and ends of steps, as a fraction of the energy in play.
    pub residual: f64,
    /// The energy needed to bring the bodies nearer than numbers can tell, against the energy there is.
    pub barrier: f64,
}

/// Runs a scene.
///
/// # Errors
/// What [`Simulation`] returns: the start is outside the model, or a row cannot be stored.
pub fn run(scene: &Scene) -> Result<RunFigures, RunError> {
    let job = Job::of(scene, &Provenance { version: "test".into(), commit: None });
    let initial = Ledger::of(job.model, &mut Workspace::default(), job.start, None).unwrap().energies.iter().sum();
    let mut auditor = Auditor { model: job.model, initial, gap: f64::INFINITY, residual: 0.0, play: 0.0 };
    let mut simulation = Simulation::new(job.model, job.start, job.plan)?;
    simulation.begin(&mut auditor)?;
    let outcome = simulation.run(&mut auditor, &mut limit())?;
    let (statistics, state) = (simulation.statistics(), simulation.state());
    let size = job.model.bodies.iter().map(|body| body.size).fold(f64::INFINITY, f64::min);
    Ok(RunFigures {
        outcome,
        steps: statistics.explicit_steps + statistics.implicit_steps,
        evaluations: statistics.rate_evaluations,
        gap: auditor.gap / size,
        residual: auditor.residual / auditor.play,
        barrier: barrier(job.model, &state) / auditor.play,
    })
}

/// Ends a run that takes too many evaluations.
struct Limit(u64);

/// As many as `GYRATION_EVALUATIONS` says, if it does.
fn limit() -> Limit {
    Limit(std::env::var("GYRATION_EVALUATIONS").map_or(MOST_EVALUATIONS, |number| number.parse().unwrap()))
}

impl Monitor for Limit {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        (progress.statistics.rate_evaluations >= self.0).then_some(Reason::Interrupted)
    }
}

/// Audits each sample and the end of each step.
struct Auditor<'a> {
    model: &'a Model,
    initial: f64,
    gap: f64,
    residual: f64,
    /// The energy in play [J]: the largest of any store or work, and of what has been exchanged.
    play: f64,
}

impl Auditor<'_> {
    fn audit(&mut self, state: &State) {
        for index in 0..self.model.bodies.len() {
            let gap = gap_to_supports(self.model, state.time, index, &state.motion(self.model, index));
            self.gap = self.gap.min(gap);
        }
        let ledger = Ledger::of(self.model, &mut Workspace::default(), state, Some(self.initial)).unwrap();
        let exchanged: f64 = ledger.works.iter().map(|work| work.abs()).sum();
        self.play = self.play.max(ledger.energies[0]).max(exchanged);
        self.residual = self.residual.max(ledger.residual.abs());
    }
}

impl Sink for Auditor<'_> {
    fn row(&mut self, _: f64, row: &[f64]) -> Result<(), RecordError> {
        assert!(row.iter().all(|number| !number.is_nan()), "a row holds what is not a number: {row:?}");
        // Position, P, velocity and Ṗ of every body stand before the gaps, the residual at the end.
        let bodies = self.model.bodies.len();
        self.gap = row[24 * bodies..25 * bodies].iter().copied().fold(self.gap, f64::min);
        self.residual = self.residual.max(row.last().copied().unwrap_or(0.0).abs());
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        assert!(event.time.is_finite());
        Ok(())
    }

    fn window_end(&mut self, at: &dyn WindowEnd) -> Result<(), RecordError> {
        self.audit(&at.state());
        Ok(())
    }
}

/// The contact energy [J] that it takes to bring the nearest body to a gap of 1e-9 of its size, turned as it is.
///
/// Far below, gaps drown in the rounding of places. Infinite without a body near a support.
fn barrier(model: &Model, state: &State) -> f64 {
    const NEAREST: f64 = 1e-9;
    let mut lowest = f64::INFINITY;
    for (index, body) in model.bodies.iter().enumerate().filter(|(_, body)| body.pin.is_none()) {
        for contact in model.contacts_of(index) {
            let only = Model::new(model.gravity, vec![model.supports[contact.support].clone()], [body.clone()]);
            let only = only.with_contacts(vec![Contact::new(0, 0, contact.law_set.clone())]);
            let block = model.blocks()[index].clone();
            let mut moved =
                State { time: state.time, bodies: state.bodies[block].to_vec(), low: Vec::new(), works: Vec::new() };
            let gap = gap_to_supports(&only, state.time, 0, &moved.motion(&only, 0));
            let normal = only.supports[0].normal;
            for axis in 0..3 {
                moved.bodies[axis] -= (gap - NEAREST * body.size) * normal[axis];
            }
            let mut values = vec![0.0; only.energies().len()];
            if energies(&only, &mut Workspace::default(), &moved, &mut values).is_ok() {
                let contact = only.energies().iter().position(|energy| energy.name() == "contact");
                lowest = lowest.min(contact.map_or(0.0, |index| values[index]));
            }
        }
    }
    lowest
}
