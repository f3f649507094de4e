//! From a scene to a recording on disk: fresh or resumed.
//!
//! The directory, the scene and the row t = 0 are on disk before the first step; rows are flushed with a checkpoint at
//! least once a second of wall time. Nothing in the directory tells when or where it was made: the same scene leaves
//! the same bytes. An interrupted run leaves no outcome, so that a resumed one ends with the bytes of an uninterrupted
//! one.

mod describe;
mod differences;
pub(crate) mod pairs;
mod ranks;
mod same_scene;
pub(crate) mod surfaces;

use self::describe::{describe_solid_support, describe_support};
pub use self::differences::differences;
pub use self::pairs::pairs_csv;
use self::ranks::Nowhere;
use self::surfaces::Surfaces;
use crate::events::{EVENT_KINDS, Event};
use crate::outcome::{Outcome, Reason};
use crate::period::period;
use crate::plan::RunPlan;
use crate::ports::{Communicator, Monitor, Progress, RunError, Sink, WindowEnd};
use crate::rows::Fields;
use crate::run::Simulation;
use crate::scene_files::FILES;
use crate::summary::RunSummary;
use crate::survey::remarks::{LeftOut, Remarks, Stretched};
use gyration::body::{BodyKind, Solid};
use gyration::dynamics::Exchange;
use gyration::model::Model;
use gyration::state::State;
use gyration_record::{Attributes, Layout, RecordError, Recording, RowHash, Writer, chunk_rows_for};
use gyration_scene::{Built, Scene};
use gyration_threads::Interruption;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Wall time between flushes; the contract asks for one a second at least. A flush of 8 MiB of chunks takes 0.03 s.
const FLUSH_EVERY: Duration = Duration::from_millis(800);

/// Wall time for the summary of a run that was given up, beyond which some of it is left out.
const TO_TELL: Duration = Duration::from_millis(500);

/// A model ready to run, with what its recording says of it.
#[derive(Debug, Clone)]
pub struct Job<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its first state.
    pub start: &'a State,
    /// How to run it.
    pub plan: RunPlan,
    /// How long it may take; the recording can be resumed after that.
    pub max_wall_time: Option<Duration>,
    /// The processes that share it out, if there are several; the first of them records.
    ranks: Option<Arc<dyn Communicator>>,
    /// What it was made from.
    scene: &'a Scene,
    /// Which program runs it.
    provenance: Provenance,
}

/// A run that has a start within the model: its first row is known.
pub struct BegunRun<'a> {
    job: Job<'a>,
    simulation: Simulation,
    first: MemorySink,
}

/// The end of a recorded run.
#[derive(Debug)]
pub enum RecordingEnd {
    /// It ran, now.
    Ran(Box<RunSummary>),
    /// It had ended before: there was nothing to resume.
    AlreadyFinished(Attributes),
}

/// Which program runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// Commit it was built from, if known.
    pub commit: Option<String>,
}

impl<'a> Job<'a> {
    /// A scene ready to run.
    pub fn of(scene: &'a Scene, provenance: &Provenance) -> Self {
        let Built { model, state, plan, .. } = scene.built();
        Self {
            model,
            start: state,
            plan: RunPlan::alone(scene.built()),
            max_wall_time: plan.wall_time(),
            ranks: None,
            scene,
            provenance: provenance.clone(),
        }
    }

    /// The name of its scene.
    pub fn scene_name(&self) -> &str {
        self.scene.name()
    }

    /// Runs the scene into a new recording.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn record(&self, path: &Path, watch: &mut dyn Monitor) -> Result<RecordingEnd, RunError> {
        self.interruption().within(|| {
            if self.follows() {
                let mut simulation = self.shared_out(Simulation::new(self.model, self.start, self.plan)?);
                simulation.begin(&mut Nowhere)?;
                return self.follow(simulation, watch);
            }
            self.begun()?.record_in_time(path, watch)
        })
    }

    /// The run at its start, of which nothing is on disk yet.
    ///
    /// # Errors
    /// [`RunError`] if the start is outside the model.
    pub fn begun(&self) -> Result<BegunRun<'a>, RunError> {
        let mut simulation = self.shared_out(Simulation::new(self.model, self.start, self.plan)?);
        let mut first = MemorySink::default();
        simulation.begin(&mut first)?;
        Ok(BegunRun { job: self.clone(), simulation, first })
    }

    /// Begins a new recording of a run of this model that somebody steps by hand.
    ///
    /// # Errors
    /// [`RecordError`] if it cannot be written there.
    pub(crate) fn begin_by_hand(&self, model: &Model, path: &Path) -> Result<RecordingSink, RecordError> {
        let Self { start, plan, max_wall_time, scene, .. } = *self;
        let provenance = self.provenance.clone();
        let job = Job { model, start, plan, max_wall_time, ranks: None, scene, provenance };
        let writer = Writer::create(path, &job.layout(), job.all_attributes())?;
        Ok(RecordingSink::new(model.clone(), writer, RowHash::default()))
    }

    /// The interruption in force, and from now on for as long as the run may take.
    pub fn interruption(&self) -> Interruption {
        Interruption::in_force().after(self.max_wall_time)
    }

    /// Goes on with a recording of the same scene.
    ///
    /// # Errors
    /// [`RunError`]; `OtherScene` if the recording is of another scene.
    pub fn resume(&self, path: &Path, watch: &mut dyn Monitor) -> Result<RecordingEnd, RunError> {
        if self.follows() {
            return self.follow_from_checkpoint(watch);
        }
        if let Some(recorded) = self.finished_attributes(path)? {
            self.tell_checkpoint(&[])?;
            return Ok(RecordingEnd::AlreadyFinished(recorded));
        }
        let resumed = Writer::resume_finished(path, &RunSummary::ATTRIBUTES)?;
        // Once more, now that nobody else writes.
        let hash = RowHash::of_recording(&Recording::open(path)?, resumed.rows)?;
        self.tell_checkpoint(&resumed.checkpoint)?;
        self.interruption().within(|| {
            let simulation = Simulation::resume(self.model, self.start, self.plan, &resumed.checkpoint)?;
            let simulation = self.shared_out(simulation);
            let sink = RecordingSink::new(self.model.clone(), resumed.writer, hash);
            self.finish(path, simulation, sink, watch)
        })
    }

    /// The attributes of a recording of this scene that is complete; none if there is something left to do.
    fn finished_attributes(&self, path: &Path) -> Result<Option<Attributes>, RunError> {
        let recording = Recording::open(path)?;
        let recorded = recording.attributes();
        if !self.is_recorded_in(recorded) {
            return Err(self.other_scene(path, recorded));
        }
        // A checkpoint that is damaged is needed no more.
        let is_complete = recorded.contains_key("outcome") && !recording.is_ahead_of_its_checkpoint().unwrap_or(false);
        Ok(is_complete.then(|| recorded.clone()))
    }

    /// What must be told of the run before it begins.
    pub fn remarks(&self) -> Remarks {
        Remarks::at_start(self.model, self.start, &self.plan)
    }

    fn finish(
        &self,
        path: &Path,
        mut simulation: Simulation,
        mut sink: RecordingSink,
        watch: &mut dyn Monitor,
    ) -> Result<RecordingEnd, RunError> {
        let began = Instant::now();
        let outcome = simulation.run(&mut sink, watch)?;
        let elapsed = Some(began.elapsed());
        let RecordingSink { writer, hash, .. } = sink;
        let summary = self.close(path, (&mut simulation, outcome, elapsed), (writer, hash))?;
        Ok(RecordingEnd::Ran(Box::new(summary)))
    }

    /// Ends a recording of the rows with this hash by what came of its run; a run that is not over is left as it may be
    /// resumed.
    ///
    /// # Errors
    /// Those of writing, and of reading what has been written.
    pub fn close(
        &self,
        path: &Path,
        (simulation, outcome, elapsed): (&mut Simulation, Outcome, Option<Duration>),
        (mut writer, hash): (Writer, RowHash),
    ) -> Result<RunSummary, RunError> {
        // What has been done is told though no time is left; of a run that was given up, unless that takes long.
        let told = match outcome.is_final() {
            true => Interruption::in_force().however_long(),
            false => Interruption::default().after(Some(TO_TELL)),
        };
        let mut summary = told.within(|| RunSummary::of(self.model, simulation, outcome, elapsed));
        let checkpoint = simulation.checkpoint();
        if summary.outcome.is_final() {
            summary.row_hash = Some(hash.to_string());
            summary.warnings = Remarks::without_fluid(self.model, self.start, &self.plan).warnings;
            if LeftOut::may_be(self.model) {
                // What came near is asked of the rows: they must be there.
                writer.flush(&checkpoint)?;
                let left_out = LeftOut::in_rows(self.model, &Recording::open(path)?)?;
                summary.warnings.extend(left_out.warnings(self.model));
            }
            if Stretched::may_be(self.model) {
                writer.flush(&checkpoint)?;
                let stretched = Stretched::in_rows(self.model, &Recording::open(path)?)?;
                summary.warnings.extend(stretched.warning(self.model));
            }
            writer.finish(summary.attributes(), &checkpoint)?;
        } else if simulation.is_whole() {
            writer.flush(&checkpoint)?;
        }
        // Within a step there is nothing to add to what the last flush has left.
        Ok(summary)
    }

    /// What the recording holds.
    pub fn layout(&self) -> Layout {
        let (arrays, csv_order) = Fields::new(self.model, &self.plan.extras).arrays(self.model);
        let row_len = arrays.iter().map(gyration_record::ArraySpec::row_len).sum();
        let expected = (self.plan.end / self.plan.sample).ceil() as usize + 1;
        Layout {
            arrays,
            fixed: Surfaces::of(self.model).arrays(),
            ragged: self.plan.pairs.then(|| pairs::layout(self.model)),
            csv_order,
            labels: self.labels(),
            event_kinds: EVENT_KINDS.map(String::from).into(),
            chunk_rows: chunk_rows_for(row_len, expected),
        }
    }

    /// The names of bodies, and of joints if there are any.
    fn labels(&self) -> Vec<(String, Vec<String>)> {
        let bodies = self.model.names().map(str::to_owned).collect();
        let joints: Vec<String> = self.model.joints().iter().map(|joint| joint.name.to_string()).collect();
        let joints = (!joints.is_empty()).then(|| ("joint".into(), joints));
        std::iter::once(("body".into(), bodies)).chain(joints).collect()
    }

    /// The attributes of the recording before the run has ended: scene, resolved form, version, commit; bodies,
    /// supports, gravity; the files that the scene names.
    pub fn all_attributes(&self) -> Attributes {
        let Self { scene, provenance, plan, .. } = self;
        let mut attributes = Attributes::new();
        attributes.insert("title".into(), json!(scene.file().title));
        attributes.insert("scene_name".into(), json!(scene.name()));
        attributes.insert("scene".into(), json!(scene.text()));
        attributes.insert("overrides".into(), json!(scene.overrides()));
        attributes.insert("resolved".into(), scene.resolved());
        attributes.insert("version".into(), json!(provenance.version));
        attributes.insert("commit".into(), json!(provenance.commit));
        let (rtol, atol) = (plan.tolerance.rtol, plan.tolerance.atol);
        attributes.insert("tolerances".into(), json!({ "rtol": rtol, "atol": atol }));
        let surfaces = Surfaces::of(self.model);
        let bodies = self.model.bodies.iter().zip(self.model.names()).zip(surfaces.of_bodies());
        attributes.insert(
            "bodies".into(),
            bodies.map(|((body, name), surface)| describe_body(body, name, *surface)).collect(),
        );
        attributes.insert("outlines".into(), surfaces.distinct().iter().map(|solid| describe_outline(solid)).collect());
        attributes.insert("supports".into(), self.model.supports.iter().map(describe_support).collect());
        if !self.model.solid_supports.is_empty() {
            let supports = self.model.solid_supports.iter().zip(surfaces.of_supports());
            let described = supports.map(|(support, surface)| describe_solid_support(support, *surface));
            attributes.insert("solid_supports".into(), described.collect());
        }
        attributes.insert("gravity".into(), json!(self.model.gravity.as_slice()));
        if !scene.file_sums().is_empty() {
            attributes.insert(FILES.into(), json!(scene.file_sums()));
        }
        let warnings = self.remarks().warnings;
        if !warnings.is_empty() {
            attributes.insert("warnings".into(), json!(warnings));
        }
        attributes
    }
}

impl BegunRun<'_> {
    /// Goes on into a new recording.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn record(self, path: &Path, watch: &mut dyn Monitor) -> Result<RecordingEnd, RunError> {
        self.job.interruption().within(|| self.record_in_time(path, watch))
    }

    fn record_in_time(self, path: &Path, watch: &mut dyn Monitor) -> Result<RecordingEnd, RunError> {
        let Self { job, simulation, first } = self;
        let writer = Writer::create(path, &job.layout(), job.all_attributes())?;
        let mut sink = RecordingSink::new(job.model.clone(), writer, RowHash::default());
        first.hand_on(&mut sink)?;
        sink.writer.flush(&simulation.checkpoint())?;
        job.finish(path, simulation, sink, watch)
    }
}

/// Wireframe and silhouette of a solid, relative to the centre of mass.
fn describe_outline(solid: &Solid) -> Value {
    let outline = solid.shape.outline();
    let relative = |points: &[gyration::tensor::Vec3]| {
        points.iter().map(|point| json!((point - solid.mass.center).as_slice())).collect::<Value>()
    };
    json!({
        "outline": { "points": relative(&outline.points), "polylines": outline.polylines },
        "silhouette": relative(&solid.shape.silhouette_points()),
    })
}

/// What a drawing needs of a body: which of the surfaces and outlines is its own, or its own outline if it has no
/// surface; of one that contracts also volume [m³] and period of what drives it [s].
fn describe_body(body: &gyration::body::Body, name: &str, surface: Option<usize>) -> Value {
    let mut described = json!({
        "name": name,
        "kind": match body.kind {
            BodyKind::Rigid(_) => "rigid",
            BodyKind::Affine(_) => "affine",
            BodyKind::Contractile(_) => "contractile",
        },
        "mass": body.solid.mass.mass,
        "center": body.solid.mass.center.as_slice(),
        "euler_tensor": body.solid.mass.euler_tensor.as_slice(),
        "size": body.size,
        "surface": surface,
    });
    if surface.is_none()
        && let (Value::Object(own), Some(all)) = (describe_outline(&body.solid), described.as_object_mut())
    {
        all.extend(own);
    }
    if let BodyKind::Contractile(contractile) = &body.kind {
        described["volume"] = json!(contractile.affine.interior.volume);
        described["period"] = json!(period(contractile.contraction.signal()));
    }
    described
}

/// Writes to disk, and flushes now and then.
pub(crate) struct RecordingSink {
    model: Model,
    writer: Writer,
    flushed: Instant,
    /// Of the rows so far.
    hash: RowHash,
    /// Scratch: entries of a sample.
    entries: Vec<f64>,
}

impl RecordingSink {
    fn new(model: Model, writer: Writer, hash: RowHash) -> Self {
        Self { model, writer, flushed: Instant::now(), hash, entries: Vec::new() }
    }

    /// Brings all rows to the disk.
    pub fn flush(&mut self, checkpoint: &[u8]) -> Result<(), RecordError> {
        self.writer.flush(checkpoint)
    }
}

impl Sink for RecordingSink {
    fn exchanges(&mut self, exchanges: &[Exchange]) -> Result<(), RecordError> {
        self.writer.append_entries(pairs::entries(&self.model, exchanges, &mut self.entries))
    }

    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        self.hash.add_row(time, row);
        self.writer.append(time, row)
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        let Event { time, kind, body } = *event;
        self.writer.append_event(gyration_record::Event { time, kind, body: Some(body) })
    }

    fn window_end(&mut self, at: &dyn WindowEnd) -> Result<(), RecordError> {
        if self.flushed.elapsed() >= FLUSH_EVERY {
            self.writer.flush(&at.checkpoint())?;
            self.flushed = Instant::now();
        }
        Ok(())
    }
}

/// Watches nothing.
pub struct Unwatched;

impl Monitor for Unwatched {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        None
    }
}

/// Keeps rows and events in memory, for tests and for callers who want no files.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MemorySink {
    /// Time and row of each sample.
    pub rows: Vec<(f64, Vec<f64>)>,
    /// Events.
    pub events: Vec<Event>,
    /// What acts between two at each sample, where a scene asks for it.
    pub exchanges: Vec<Vec<Exchange>>,
}

impl MemorySink {
    /// Gives rows, and what acts between two at each, to another sink; there must be no event yet.
    ///
    /// # Errors
    /// Those of the other sink.
    pub fn hand_on(&self, sink: &mut dyn Sink) -> Result<(), RecordError> {
        debug_assert!(self.events.is_empty(), "events would have to stand between the rows");
        for (row, (time, numbers)) in self.rows.iter().enumerate() {
            if let Some(exchanges) = self.exchanges.get(row) {
                sink.exchanges(exchanges)?;
            }
            sink.row(*time, numbers)?;
        }
        Ok(())
    }
}

impl Sink for MemorySink {
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        self.rows.push((time, row.to_vec()));
        Ok(())
    }

    fn exchanges(&mut self, exchanges: &[Exchange]) -> Result<(), RecordError> {
        self.exchanges.push(exchanges.to_vec());
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        self.events.push(*event);
        Ok(())
    }
}

impl Outcome {
    /// The outcome as it stands in the attributes.
    pub fn attribute(&self) -> Value {
        serde_json::to_value(self).unwrap_or(Value::Null)
    }
}
