//! The threads that run a scene again and again, as pages ask for it: one looks whether a run can begin with the
//! numbers asked for, the other runs. A number that is refused stops nothing.

use super::shared::LiveState;
use crate::blob;
use crate::computed::recorded_besides;
use crate::header::Header;
use gyration_record::{Layout, RecordError};
use gyration_scene::Scene;
use gyration_sim::events::Event;
use gyration_sim::{
    Job, Monitor, Outcome, Progress, Provenance, Reason, RunError, RunSummary, Simulation, Sink, WindowEnd,
    limit_in_words,
};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Numbers of all rows together at most, 200 MB: a longer run is sampled more coarsely.
const MOST_NUMBERS: usize = 50_000_000;
/// Between two calls of the pages.
const NEWS_EVERY: Duration = Duration::from_millis(30);
/// Between two words on progress.
const PROGRESS_EVERY: Duration = Duration::from_millis(150);

/// Which scene, and which program runs it.
#[derive(Debug, Clone)]
pub(super) struct Subject {
    pub(super) scene: String,
    pub(super) provenance: Provenance,
}

/// Looks at what is asked for, for ever: what the scene takes is run, the rest refused in words.
pub(super) fn look(shared: &LiveState, subject: &Subject) {
    let mut given_up = None;
    loop {
        let overrides = shared.next_asked();
        let interruption = shared.until_overtaken();
        match interruption.within(|| accepted(subject, &overrides)) {
            Ok(scene) => {
                given_up = None;
                shared.supersede(scene);
            }
            // What was given up for other numbers is asked for again if those are refused.
            Err(_) if interruption.is_due().is_some() => given_up = Some(overrides),
            Err(problem) => {
                shared.store().problem(json!({ "message": problem, "set": overrides }));
                shared.announce();
                if let Some(before) = given_up.take() {
                    shared.ask_again(before);
                }
            }
        }
    }
}

/// The scene with these overrides, if a run of it can begin.
fn accepted(subject: &Subject, overrides: &[String]) -> Result<Scene, String> {
    let scene = gyration_sim::open(&subject.scene, overrides).map_err(|error| error.to_string())?;
    begun(&prepared(&scene, subject), &mut FirstRow::default())?;
    Ok(scene)
}

/// Runs what is wanted, for ever.
pub(super) fn run(shared: &LiveState, subject: &Subject) {
    loop {
        let scene = shared.next_wanted();
        let interruption = shared.until_superseded();
        let ran = interruption.within(|| run_once(shared, subject, &scene));
        // What was given up for another run is nobody's problem.
        if let Err(problem) = ran
            && interruption.is_due().is_none()
        {
            shared.store().problem(json!({ "message": problem }));
        }
        shared.announce();
    }
}

/// What is to be run of a scene, with what the page shows beside what the scene records.
fn prepared<'a>(scene: &'a Scene, subject: &Subject) -> Job<'a> {
    let mut job = Job::of(scene, &subject.provenance);
    for quantity in recorded_besides(job.model) {
        job.plan.extras = job.plan.extras.and(quantity);
    }
    job
}

/// The simulation of a job after its first row, or in words why there is none.
fn begun(job: &Job, first: &mut FirstRow) -> Result<Simulation, String> {
    let start = Simulation::new(job.model, job.start, job.plan);
    let mut simulation = start.map_err(|error| error.to_string())?;
    simulation.begin(first).map_err(|error| error.to_string())?;
    Ok(simulation)
}

/// Runs the scene once, or says in words why not.
fn run_once(shared: &LiveState, subject: &Subject, scene: &Scene) -> Result<(), String> {
    let mut job = prepared(scene, subject);
    let layout = job.layout();
    let thinned = thin(&mut job, &layout);
    let mut first = FirstRow::default();
    let mut simulation = begun(&job, &mut first)?;
    let strides = publish(shared, &job, &layout, thinned);
    let mut sink = Publisher { shared, told: Instant::now(), stride: strides };
    let told = first.0.map_or(Ok(()), |(time, row)| sink.row(time, &row));
    let began = Instant::now();
    let mut watch = LiveMonitor { shared, told: Instant::now() };
    let outcome = told.map_err(RunError::from).and_then(|()| simulation.run(&mut sink, &mut watch));
    let outcome = outcome.map_err(|error| error.to_string())?;
    if is_superseded(&outcome) {
        return Ok(());
    }
    let summary = RunSummary::of(job.model, &mut simulation, outcome, Some(began.elapsed())).attributes();
    let outcome = summary.get("outcome").cloned().unwrap_or(Value::Null);
    shared.store().finish(json!({ "type": "done", "outcome": outcome, "summary": summary }));
    Ok(())
}

/// Whether the run was left for another.
fn is_superseded(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Stopped(stop) if stop.reason == Reason::Interrupted)
}

/// Samples more coarsely what would be too long to keep; the samples kept, and those of the scene.
fn thin(job: &mut Job, layout: &Layout) -> Option<(usize, usize)> {
    let numbers: usize = layout.arrays.iter().map(gyration_record::ArraySpec::row_len).sum();
    let samples = (job.plan.end / job.plan.sample).ceil() as usize + 1;
    let every = samples.saturating_mul(numbers).div_ceil(MOST_NUMBERS);
    if every <= 1 {
        return None;
    }
    job.plan.sample *= every as f64;
    Some((samples.div_ceil(every), samples))
}

/// Begins a run in the store; the numbers in a row.
fn publish(shared: &LiveState, job: &Job, layout: &Layout, thinned: Option<(usize, usize)>) -> usize {
    let mut store = shared.store();
    let mut header = Header::of_layout(layout, job.all_attributes(), store.next_run());
    if let Some((kept, of)) = thinned {
        header.thinned = thinned;
        header
            .notes
            .push(format!("The run is long: some {kept} of {of} samples are kept here. `gyration run` keeps all."));
    }
    let fixed = layout.fixed.iter().filter_map(|array| {
        let (surface, part) = array.spec.name.strip_prefix("surface_")?.split_once('_')?;
        let bytes = if part == "triangles" { blob::indices(&array.values) } else { blob::singles(&array.values) };
        Some((format!("surface/{surface}/{part}"), bytes))
    });
    let strides: Vec<usize> = header.arrays.iter().map(crate::header::ArrayEntry::stride).collect();
    let stride = strides.iter().sum();
    store.begin(&header.to_json(), fixed.collect(), strides);
    stride
}

/// Keeps the first row until the run is known to have one.
#[derive(Default)]
struct FirstRow(Option<(f64, Vec<f64>)>);

impl Sink for FirstRow {
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        self.0 = Some((time, row.to_vec()));
        Ok(())
    }
}

/// Publishes rows and events.
struct Publisher<'a> {
    shared: &'a LiveState,
    told: Instant,
    stride: usize,
}

impl Sink for Publisher<'_> {
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        debug_assert_eq!(row.len(), self.stride);
        self.shared.store().row(time, row);
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        let Event { time, kind, body } = *event;
        self.shared.store().event(gyration_record::Event { time, kind, body: Some(body) });
        Ok(())
    }

    fn window_end(&mut self, _: &dyn WindowEnd) -> Result<(), RecordError> {
        if self.told.elapsed() >= NEWS_EVERY {
            self.told = Instant::now();
            self.shared.announce();
        }
        Ok(())
    }
}

/// Halts the run while it is paused, ends it for another, and says how far it is.
struct LiveMonitor<'a> {
    shared: &'a LiveState,
    told: Instant,
}

impl Monitor for LiveMonitor<'_> {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        if self.told.elapsed() >= PROGRESS_EVERY {
            self.told = Instant::now();
            let step = progress.step;
            self.shared.store().progress(json!({
                "time": progress.time,
                "end": progress.end,
                "steps": progress.statistics.accepted(),
                "step": step.end - step.start,
                "limited_by": limit_in_words(progress.model, &step.limit),
            }));
        }
        self.shared.is_superseded().then_some(Reason::Interrupted)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Cursor;
    use super::super::store::Store;
    use serde_json::json;

    /// A store is all that pages see; this one stands for a page that takes everything.
    #[test]
    fn a_store_is_handed_on_once_and_in_order() {
        let mut store = Store::default();
        store.begin(&json!({ "run": store.next_run() }), vec![("surface/0/points".into(), vec![0; 12])], vec![1, 2]);
        for k in 0..3 {
            store.row(f64::from(k), &[1.0, 2.0, 3.0]);
        }
        let mut cursor = Cursor::default();
        assert_eq!(store.take(&mut cursor).len(), 4, "header, surface, rows, progress");
        assert!(store.take(&mut cursor).is_empty());
        store.finish(json!({ "type": "done" }));
        assert_eq!(store.take(&mut cursor).len(), 1);
        store.begin(&json!({}), Vec::new(), vec![1]);
        assert_eq!(store.take(&mut cursor).len(), 2, "header and progress of the next run");
    }
}
