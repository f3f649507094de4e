//! A recording whose fields can be had: its samples as granules.

use super::NoFields;
use crate::fields::{Granules, RecordedPair};
use crate::replay::{Replay, ReplayError};
use gyration::tensor::Vec3;
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
        if replay.model().bodies.iter().any(|body| body.history().is_some()) {
            return Err(NoFields::Remembers);
        }
        Ok(Self { recording: recording.clone(), replay })
    }

    /// The corners of the box of the centres of all samples \[m\]; the origin without any.
    ///
    /// # Errors
    /// Those of reading.
    pub fn corners(&self) -> Result<[Vec3; 2], NoFields> {
        let (recording, chunk) = (&self.recording, self.recording.chunk_rows().max(1));
        let mut corners: Option<[Vec3; 2]> = None;
        for from in (0..recording.rows()).step_by(chunk) {
            let rows = from..(from + chunk).min(recording.rows());
            let read = recording.read_rows("position", rows).map_err(ReplayError::Record)?;
            let places = read.data.chunks_exact(3).map(Vec3::from_column_slice).map(|place| [place; 2]);
            let both = |[low, high]: [Vec3; 2], [lower, higher]: [Vec3; 2]| [low.inf(&lower), high.sup(&higher)];
            corners = corners.into_iter().chain(places).reduce(both);
        }
        Ok(corners.unwrap_or([Vec3::zeros(); 2]))
    }

    /// The places of all bodies in the first sample \[m\]; none without a sample.
    ///
    /// # Errors
    /// Those of reading.
    pub fn first_places(&self) -> Result<Vec<Vec3>, NoFields> {
        let first = self.recording.read_rows("position", 0..self.recording.rows().min(1));
        let first = first.map_err(ReplayError::Record)?;
        Ok(first.data.chunks_exact(3).map(Vec3::from_column_slice).collect())
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
