//! A recording whose fields can be had: its samples as granules.

use super::NoFields;
use crate::fields::{Granules, RecordedPair};
use crate::replay::{Replay, ReplayError};
use gyration_record::Recording;

/// A recording and its replay.
#[derive(Debug)]
pub(super) struct FieldSource {
    recording: Recording,
    pub replay: Replay,
}

impl FieldSource {
    /// Of the samples that it has now.
    ///
    /// # Errors
    /// [`NoFields`] if its model is not to be had, or lacks what is between bodies.
    pub fn open(recording: &Recording) -> Result<Self, NoFields> {
        let replay = Replay::open(recording)?;
        let meet = (0..replay.model().bodies.len()).any(|body| replay.model().meets_bodies(body));
        if meet && recording.ragged().is_none() {
            return Err(NoFields::NoPairs);
        }
        Ok(Self { recording: recording.clone(), replay })
    }

    /// The bodies of a sample, and what is between two, as recorded if it is.
    ///
    /// # Errors
    /// Those of reading and of [`Replay::state`].
    pub fn sample(&mut self, row: usize) -> Result<Granules, NoFields> {
        let bodies = self.replay.model().bodies.len();
        let recorded = match self.recording.ragged() {
            Some(_) => Some(RecordedPair::of_row(&self.recording, row, bodies).map_err(ReplayError::Record)?),
            None => None,
        };
        Ok(self.replay.granules(row, recorded.as_deref())?)
    }
}
