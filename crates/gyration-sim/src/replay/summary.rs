//! The summary of a run from its recording alone.
//!
//! The checkpoint holds the last state and the run state, from which a resumed run goes on to the same bytes: what is
//! told of the recording is what was told when the run ended, but for the time that it took, which nothing records.

use super::error::ReplayError;
use super::rebuild;
use crate::outcome::{Outcome, Reason, Stop};
use crate::plan::RunPlan;
use crate::run::Simulation;
use crate::summary::RunSummary;
use gyration_record::Recording;
use gyration_scene::Scene;
use serde::Deserialize;

impl RunSummary {
    /// The scene of a recording, and the summary of its run up to the last checkpoint; of a run that has not ended, the
    /// outcome is `Interrupted`.
    ///
    /// # Errors
    /// Those of [`Replay::open`](super::Replay::open); `Checkpoint` if another version of the program has left it.
    pub fn of_recording(recording: &Recording) -> Result<(Scene, Self), ReplayError> {
        let scene = rebuild::scene(recording)?;
        let checkpoint = recording.checkpoint()?;
        let (model, start) = (&scene.built().model, &scene.built().state);
        let resumed = Simulation::resume(model, start, RunPlan::from(scene.built()), &checkpoint);
        let mut simulation = resumed.map_err(|error| ReplayError::Checkpoint {
            path: recording.path().to_path_buf(),
            reason: error.to_string(),
        })?;
        let attribute = recording.attributes().get("outcome");
        // An outcome beyond the checkpoint has no summary yet.
        let attribute = attribute.filter(|_| !recording.is_ahead_of_its_checkpoint().unwrap_or(false));
        let ended = attribute.and_then(|told| Outcome::deserialize(told).ok());
        let time = simulation.state().time;
        let outcome = ended.clone().unwrap_or_else(|| Outcome::Stopped(Stop::by_request(time, Reason::Interrupted)));
        let mut summary = Self::of(model, &mut simulation, outcome, None);
        let hash = recording.attributes().get("row_hash").filter(|_| ended.is_some());
        summary.row_hash = hash.and_then(|hash| Some(hash.as_str()?.to_owned()));
        if ended.is_none() {
            summary.in_words =
                format!("not ended at t = {time:.9} s: it is under way, or was interrupted and can be resumed");
        }
        Ok((scene, summary))
    }
}
