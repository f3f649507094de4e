//! Keeps the events of a stepped run, and its rows where it is recorded.

use super::SteppedRun;
use crate::events::Event;
use crate::ports::{RunError, Sink, WindowEnd};
use crate::record::{Job, Provenance, RecordingSink};
use gyration::dynamics::Exchange;
use gyration_record::RecordError;
use gyration_scene::Scene;
use std::path::Path;

/// What is kept of a stepped run.
#[derive(Default)]
pub(super) struct Kept {
    /// All events so far.
    pub events: Vec<Event>,
    recording: Option<Recorder>,
    /// Why the recording could not go on: a step does not fail by it.
    failure: Option<RecordError>,
}

/// A recording that is on disk when it ends, however it ends.
struct Recorder(RecordingSink);

impl Drop for Recorder {
    fn drop(&mut self) {
        // Whoever wants to know whether that fails flushes before.
        let _unheard = self.0.flush(&[]);
    }
}

impl Kept {
    /// Events from before, and no recording.
    pub fn of(events: Vec<Event>) -> Self {
        Self { events, ..Self::default() }
    }

    /// Hands something on to the recording, which ends where that fails.
    fn hand_on(&mut self, write: impl FnOnce(&mut RecordingSink) -> Result<(), RecordError>) {
        if let Some(Err(failure)) = self.recording.as_mut().map(|recorder| write(&mut recorder.0)) {
            self.recording = None;
            self.failure.get_or_insert(failure);
        }
    }
}

impl Sink for Kept {
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        self.hand_on(|recording| recording.row(time, row));
        Ok(())
    }

    fn exchanges(&mut self, exchanges: &[Exchange]) -> Result<(), RecordError> {
        self.hand_on(|recording| recording.exchanges(exchanges));
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        self.events.push(*event);
        self.hand_on(|recording| recording.event(event));
        Ok(())
    }

    fn window_end(&mut self, at: &dyn WindowEnd) -> Result<(), RecordError> {
        self.hand_on(|recording| recording.window_end(at));
        Ok(())
    }
}

impl SteppedRun {
    /// Records the run from now on into a new folder: its present state, its events, and samples at the times k·sample
    /// of its scene.
    ///
    /// # Errors
    /// [`RunError::Record`] if nothing can be written there.
    pub fn record(&mut self, scene: &Scene, provenance: &Provenance, path: &Path) -> Result<(), RunError> {
        let job = Job::of(scene, provenance);
        // One that cannot be written leaves the one under way alone.
        let recorder = Recorder(job.begin_by_hand(self.simulation.model(), path)?);
        self.stop_recording()?;
        self.kept.recording = Some(recorder);
        let begun = self.simulation.sample_from_now(job.plan.sample, &mut self.kept)?;
        begun.map_err(RunError::at_start)?;
        self.flush()
    }

    /// Why the recording could not go on, once; it has ended there.
    pub fn recording_failure(&mut self) -> Option<RecordError> {
        self.kept.failure.take()
    }

    /// Brings all rows to the disk.
    ///
    /// # Errors
    /// [`RunError::Record`] if they cannot be written, now or since the last time; the recording has ended there.
    pub fn flush(&mut self) -> Result<(), RunError> {
        // Nobody goes on from it: what was applied stands nowhere in a recording.
        self.kept.hand_on(|recording| recording.flush(&[]));
        self.recording_failure().map_or(Ok(()), |failure| Err(failure.into()))
    }

    /// Ends the recording, if there is one.
    ///
    /// # Errors
    /// As for [`flush`](Self::flush).
    pub fn stop_recording(&mut self) -> Result<(), RunError> {
        self.simulation.plan.sample = f64::INFINITY;
        let flushed = self.flush();
        self.kept.recording = None;
        flushed
    }
}
