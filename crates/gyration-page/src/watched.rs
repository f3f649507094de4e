//! A scene that runs as it is watched: header and surfaces, rows, how far it is, how it ended.

use crate::besides::{has_network, recorded_besides};
use crate::blob;
use crate::header::{ArrayEntry, Header};
use crate::kept::KeptRun;
use crate::places::ScenePlaces;
use crate::store::Store;
use gyration::dynamics::Exchange;
use gyration::model::Model;
use gyration_record::{ArraySpec, Layout, RowHash};
use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Outcome, Progress, Provenance, RunSummary, Simulation, limit_in_words, network};
use serde_json::{Value, json};
use std::time::Duration;

/// Numbers of all rows together at most, 200 MB: a longer run is sampled more coarsely.
const MOST_NUMBERS: u64 = 50_000_000;

/// What is to be run of a scene, with what the page shows beside what the scene records.
pub struct WatchedRun<'a> {
    /// The run.
    pub job: Job<'a>,
    /// What the scene records.
    recorded: Layout,
    layout: Layout,
    /// The samples kept, and those of the scene, if these would be too many.
    thinned: Option<(usize, usize)>,
}

/// The hash of the rows as `gyration run` records them, from those that the page is given.
pub struct SceneHash {
    hash: RowHash,
    places: ScenePlaces,
}

impl<'a> WatchedRun<'a> {
    /// Of a scene, by this program.
    pub fn of(scene: &'a Scene, provenance: &Provenance) -> Self {
        let mut job = Job::of(scene, provenance);
        let recorded = job.layout();
        for quantity in recorded_besides(job.model) {
            job.plan.extras = job.plan.extras.and(quantity);
        }
        job.plan.pairs |= has_network(job.model);
        let layout = job.layout();
        let thinned = thin(&mut job, &layout);
        Self { job, recorded, layout, thinned }
    }

    /// The simulation after its first row, or in words why there is none.
    ///
    /// # Errors
    /// These words.
    pub fn begun(&self, first: &mut MemorySink) -> Result<Simulation, String> {
        let Job { model, start, plan, .. } = self.job;
        let mut simulation = Simulation::new(model, start, plan).map_err(|error| error.to_string())?;
        simulation.begin(first).map_err(|error| error.to_string())?;
        Ok(simulation)
    }

    /// Begins it in the store.
    pub fn publish(&self, store: &mut Store) {
        let mut header = Header::of_layout(&self.layout, self.job.all_attributes(), store.next_run());
        if let Some((kept, of)) = self.thinned {
            header.thinned = self.thinned;
            header
                .notes
                .push(format!("The run is long: some {kept} of {of} samples are kept here. `gyration run` keeps all."));
        }
        header.network = has_network(self.job.model);
        let fixed = self.layout.fixed.iter().filter_map(|array| {
            let (surface, part) = array.spec.name.strip_prefix("surface_")?.split_once('_')?;
            let bytes = if part == "triangles" { blob::indices(&array.values) } else { blob::singles(&array.values) };
            Some((format!("surface/{surface}/{part}"), bytes))
        });
        let strides = header.arrays.iter().map(ArrayEntry::stride).collect();
        store.begin(&header.to_json(), fixed.collect(), strides);
    }

    /// The hash before its first row; none where rows are left out.
    pub fn hash(&self) -> Option<SceneHash> {
        if self.thinned.is_some() {
            return None;
        }
        Some(SceneHash { hash: RowHash::default(), places: self.places()? })
    }

    /// The run before its first row, to be saved as far as it has got; what acts between two bodies is left out.
    pub fn kept(&self) -> Option<KeptRun> {
        let layout = Layout { ragged: None, ..self.recorded.clone() };
        Some(KeptRun::new(self.job.scene_name(), layout, self.job.all_attributes(), self.places()?))
    }

    /// Who tells the network of forces; none where bodies do not meet.
    pub fn network(&self) -> Option<NetworkTeller> {
        has_network(self.job.model).then(|| NetworkTeller { model: self.job.model.clone() })
    }

    fn places(&self) -> Option<ScenePlaces> {
        ScenePlaces::among(&self.recorded.arrays, &self.layout.arrays)
    }
}

/// Tells the store how a run has ended, in so much time [s], if that is known.
pub fn finish(
    store: &mut Store,
    simulation: &mut Simulation,
    outcome: Outcome,
    (elapsed, hash): (Option<Duration>, Option<SceneHash>),
) {
    let model = simulation.model().clone();
    let summary = RunSummary::of(&model, simulation, outcome, elapsed).attributes();
    let outcome = summary.get("outcome").cloned().unwrap_or(Value::Null);
    let hash = hash.map(|hash| hash.hash.to_string());
    store.finish(json!({ "type": "done", "outcome": outcome, "summary": summary, "hash": hash }));
}

/// Tells a store who pushes whom.
pub struct NetworkTeller {
    model: Model,
}

impl NetworkTeller {
    /// At the sample whose row comes next.
    pub fn tell(&self, store: &mut Store, exchanges: &[Exchange]) {
        store.network(&blob::network(&network(&self.model, exchanges.to_vec())));
    }
}

impl SceneHash {
    /// Goes on with a row.
    pub fn add_row(&mut self, time: f64, row: &[f64]) {
        self.hash.add(&[time]);
        self.places.of(row).for_each(|numbers| self.hash.add(numbers));
    }
}

/// How far a run is, as a page is told it.
pub fn progress(progress: &Progress) -> Value {
    let step = progress.step;
    json!({
        "time": progress.time,
        "end": progress.end,
        "steps": progress.statistics.accepted(),
        "step": step.end - step.start,
        "limited_by": limit_in_words(progress.model, &step.limit),
    })
}

/// Samples more coarsely what would be too long to keep; the samples kept, and those of the scene.
fn thin(job: &mut Job, layout: &Layout) -> Option<(usize, usize)> {
    let numbers: usize = layout.arrays.iter().map(ArraySpec::row_len).sum();
    let samples = (job.plan.end / job.plan.sample).ceil() as usize + 1;
    let every = thinning(samples, numbers);
    if every <= 1 {
        return None;
    }
    job.plan.sample *= every as f64;
    Some((samples.div_ceil(every), samples))
}

/// Of how many samples one is kept. The product needs 64 bits, which a page's own sizes lack.
fn thinning(samples: usize, numbers: usize) -> usize {
    (samples as u64).saturating_mul(numbers as u64).div_ceil(MOST_NUMBERS) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_fits_whatever_the_size_of_a_word() {
        assert_eq!(thinning(1001, 60), 1);
        // 6e9 numbers are more than 32 bits count.
        assert_eq!(thinning(100_000_000, 60), 120);
    }
}
