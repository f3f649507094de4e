//! Running a scene or a hand-made model in memory, and finding the instant at which something happens.
//!
//! A programming mistake in a test, such as a scene with errors, panics with the message of the program.

use gyration::balance;
use gyration::body::BodyKind;
use gyration::dynamics::{Workspace, rates};
use gyration::model::Model;
use gyration::state::{BodyMotion, State};
use gyration::tensor::{Mat3, Vec3};
use gyration_ode::Options;
use gyration_scene::{Recorded, Scene};
use gyration_sim::events::Event;
use gyration_sim::rows::{Extras, Fields};
use gyration_sim::{MemorySink, Outcome, RunPlan, Simulation, Tolerance, Unwatched, complete};
use std::ops::Range;
use std::path::Path;

/// A model, its start, and how to run it.
#[derive(Debug, Clone)]
pub struct Experiment {
    /// The model.
    pub model: Model,
    /// The state at t = 0.
    pub start: State,
    /// End, samples, tolerances, method.
    pub plan: RunPlan,
}

/// A run that has ended.
#[derive(Debug, Clone)]
pub struct Run {
    /// Times of the samples [s].
    pub times: Vec<f64>,
    /// The events.
    pub events: Vec<Event>,
    /// How it ended.
    pub outcome: Outcome,
    /// The last state.
    pub end: State,
    /// Largest |residual| of the ledger over the samples [J].
    pub largest_residual: f64,
    /// Largest kinetic energy, or sum of |works|, over the samples [J].
    pub energy_in_play: f64,
    /// Accepted steps of both methods.
    pub steps: u64,
    arrays: Vec<Array>,
    rows: Vec<Vec<f64>>,
}

/// Numbers of one name in a row.
#[derive(Debug, Clone)]
struct Array {
    name: String,
    /// Names of the columns of the CSV; none for numbers that are not in it.
    columns: Vec<String>,
    /// Where they stand in the row.
    range: Range<usize>,
}

impl Experiment {
    /// The experiment that a scene describes.
    ///
    /// # Panics
    /// If the scene has errors.
    pub fn of_scene(text: &str) -> Self {
        let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).and_then(complete);
        let scene = scene.unwrap_or_else(|errors| panic!("{errors}"));
        Self::of(&scene)
    }

    /// The experiment of a scene of the gallery, with overrides as in `--set`.
    ///
    /// # Panics
    /// If the gallery has no such scene, or an override is wrong.
    pub fn of_gallery(name: &str, overrides: &[&str]) -> Self {
        let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        Self::of(&gyration_sim::open(name, &overrides).unwrap_or_else(|errors| panic!("{errors}")))
    }

    fn of(scene: &Scene) -> Self {
        let built = scene.built();
        Self { model: built.model.clone(), start: built.state.clone(), plan: RunPlan::from(built) }
    }

    /// An experiment with a model made by hand, the method chosen by the program.
    pub fn of_model(model: Model, start: State, tolerance: Tolerance) -> Self {
        let (options, extras) = (Options::default(), Extras::default());
        let plan = RunPlan {
            end: 1.0,
            sample: 1.0,
            stop_at_rest: None,
            tolerance,
            options,
            extras,
            pairs: false,
            threads: None,
        };
        Self { model, start, plan }
    }

    /// The same until another end [s], sampled there only.
    pub fn until(&self, end: f64) -> Self {
        Self { plan: RunPlan { end, sample: end, ..self.plan }, ..self.clone() }
    }

    /// The same with samples at this spacing [s].
    pub fn sampled(&self, sample: f64) -> Self {
        Self { plan: RunPlan { sample, ..self.plan }, ..self.clone() }
    }

    /// The same with further quantities in each row; total affine momentum about the origin.
    pub fn recording(&self, quantities: impl IntoIterator<Item = Recorded>) -> Self {
        let extras = Extras::new(quantities, Vec3::zeros());
        Self { plan: RunPlan { extras, ..self.plan }, ..self.clone() }
    }

    /// Runs it.
    ///
    /// # Panics
    /// If the run cannot begin, or stops early.
    pub fn run(&self) -> Run {
        let run = self.attempt();
        assert!(!matches!(run.outcome, Outcome::Stopped(_)), "{}", run.outcome.in_words());
        run
    }

    /// Runs it to whatever end.
    ///
    /// # Panics
    /// If the run cannot begin.
    pub fn attempt(&self) -> Run {
        let fail = |error| -> ! { panic!("{error}") };
        let mut sink = MemorySink::default();
        let mut simulation = Simulation::new(&self.model, &self.start, self.plan).unwrap_or_else(|e| fail(e));
        simulation.begin(&mut sink).unwrap_or_else(|e| fail(e));
        let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap_or_else(|e| fail(e));
        let (times, rows) = sink.rows.into_iter().unzip();
        Run {
            times,
            rows,
            events: sink.events,
            outcome,
            end: simulation.state(),
            largest_residual: simulation.run_state().largest_residual,
            energy_in_play: simulation.energy_in_play(),
            steps: simulation.statistics().accepted(),
            arrays: arrays(&self.model, &self.plan.extras),
        }
    }

    /// The motion of the first body at a time [s].
    pub fn motion_at(&self, time: f64) -> BodyMotion {
        self.until(time).run().end.motion(&self.model, 0)
    }

    /// The time [s] near `guess` at which a function of the first body's motion vanishes, by secants over whole runs.
    ///
    /// # Panics
    /// If the secants do not converge to rounding.
    pub fn time_when(&self, guess: f64, function: impl Fn(&BodyMotion) -> f64) -> f64 {
        let value = |time: f64| function(&self.motion_at(time));
        let (mut before, mut now) = (guess * (1.0 - 1e-6), guess);
        let (mut value_before, mut value_now) = (value(before), value(now));
        for _ in 0..20 {
            let step = -value_now * (now - before) / (value_now - value_before);
            (before, value_before) = (now, value_now);
            now += step;
            if step.abs() <= 1e-14 * now {
                return now;
            }
            value_now = value(now);
            if value_now == value_before {
                return now;
            }
        }
        panic!("no instant found near {guess} s: the last step was from {before} s to {now} s");
    }

    /// Force of all contacts on the first body at t = 0 [N].
    ///
    /// # Panics
    /// If the start is outside the model.
    pub fn contact_force(&self) -> Vec3 {
        let seen = balance::observe(&self.model, &mut Workspace::default(), &self.start, 0);
        seen.unwrap_or_else(|error| panic!("{error:?}")).contact_force
    }

    /// Torque I Ω̇ on the first body, which does not spin, at t = 0, in body axes [N m].
    ///
    /// # Panics
    /// If the start is outside the model, or the body is not rigid.
    pub fn torque(&self) -> Vec3 {
        let mut slopes = vec![0.0; self.model.dimension()];
        let mut powers = vec![0.0; self.model.works().len()];
        let bodies = &self.start.bodies;
        rates(&self.model, &mut Workspace::default(), 0.0, bodies.into(), &mut slopes, &mut powers)
            .unwrap_or_else(|error| panic!("{error:?}"));
        let body = &self.model.bodies[0];
        let BodyKind::Rigid(inertia) = &body.kind else { panic!("{} is not rigid", self.model.name(0)) };
        // A block ends with Ω; in the block of the rates with Ω̇.
        inertia.tensor * gyration::body::vector(&slopes[self.model.slots(0).rate()])
    }
}

/// What a row holds, in its order.
fn arrays(model: &Model, extras: &Extras) -> Vec<Array> {
    let mut start = 0;
    let specifications = Fields::new(model, extras).arrays(model).0.into_iter();
    specifications
        .map(|array| {
            let range = start..start + array.row_len();
            start = range.end;
            Array { name: array.name, columns: array.columns, range }
        })
        .collect()
}

impl Run {
    /// The samples of a column of the CSV, `ball.z`.
    ///
    /// # Panics
    /// If there is no such column.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let place = |array: &Array| {
            array.columns.iter().position(|column| column == name).map(|offset| array.range.start + offset)
        };
        let index = self.arrays.iter().find_map(place).unwrap_or_else(|| {
            let columns: Vec<&String> = self.arrays.iter().flat_map(|array| &array.columns).collect();
            panic!("no column {name}; there are {columns:?}")
        });
        self.rows.iter().map(|row| row[index]).collect()
    }

    /// Whether there is such a column of the CSV.
    pub fn has(&self, name: &str) -> bool {
        self.arrays.iter().any(|array| array.columns.iter().any(|column| column == name))
    }

    /// The samples of an array of matrices (`gradient_rate`, `stress`), of the first body.
    ///
    /// # Panics
    /// If there is no such array.
    pub fn matrices(&self, name: &str) -> Vec<Mat3> {
        self.matrices_of(0, name)
    }

    /// The samples of an array of matrices, of the body of this index.
    ///
    /// # Panics
    /// If there is no such array or body.
    pub fn matrices_of(&self, body: usize, name: &str) -> Vec<Mat3> {
        self.numbers_of(body, name, 9).map(Mat3::from_row_slice).collect()
    }

    /// The samples of an array of vectors (`drag`, `semi_axes`), of the body of this index.
    ///
    /// # Panics
    /// If there is no such array or body.
    pub fn vectors_of(&self, body: usize, name: &str) -> Vec<Vec3> {
        self.numbers_of(body, name, 3).map(Vec3::from_column_slice).collect()
    }

    /// The samples of an array of numbers (`inclination`, `orbit_constant`), of the body of this index.
    ///
    /// # Panics
    /// If there is no such array or body.
    pub fn scalars_of(&self, body: usize, name: &str) -> Vec<f64> {
        self.numbers_of(body, name, 1).map(|numbers| numbers[0]).collect()
    }

    /// The samples of an array with so many numbers a body.
    fn numbers_of(&self, body: usize, name: &str, count: usize) -> impl Iterator<Item = &[f64]> {
        let found = self.arrays.iter().find(|array| array.name == name);
        let range = found.unwrap_or_else(|| panic!("no array {name}: {:?}", self.arrays)).range.clone();
        let wanted = range.start + count * body..range.start + count * (body + 1);
        assert!(wanted.end <= range.end, "{name} has no numbers of body {body}");
        self.rows.iter().map(move |row| &row[wanted.clone()])
    }

    /// The times [s] of the events of a kind (`apex`, `closest_approach`, `lift_off`).
    pub fn times_of(&self, kind: &str) -> Vec<f64> {
        let of_kind = |event: &&Event| gyration_sim::events::EVENT_KINDS[event.kind] == kind;
        self.events.iter().filter(of_kind).map(|event| event.time).collect()
    }

    /// The largest residual of the ledger as a fraction of the energy in play.
    pub fn relative_residual(&self) -> f64 {
        self.largest_residual / self.energy_in_play
    }
}
