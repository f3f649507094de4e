//! The rows of a recording that a replay reads, chunk by chunk: one after the other they cost one reading each.

use super::error::ReplayError;
use gyration::model::Model;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::{RecordError, Recording};
use std::ops::Range;

/// The rows at hand.
#[derive(Debug, Clone)]
pub(super) struct Window {
    recording: Recording,
    rows: Range<usize>,
    arrays: WindowArrays,
    /// Works of the row last asked for, in the order of `Model::works`.
    works: Vec<f64>,
}

#[derive(Debug, Clone, Default)]
struct WindowArrays {
    time: Vec<f64>,
    position: Vec<f64>,
    gradient: Vec<f64>,
    velocity: Vec<f64>,
    gradient_rate: Vec<f64>,
    /// Empty without contractile bodies.
    contraction: Vec<f64>,
    /// One array a work.
    works: Vec<Vec<f64>>,
}

/// One row.
#[derive(Debug, Clone, Copy)]
pub(super) struct WindowRow<'a> {
    arrays: &'a WindowArrays,
    works: &'a [f64],
    at: usize,
    bodies: usize,
}

impl Window {
    pub(super) fn new(recording: &Recording) -> Self {
        Self { recording: recording.clone(), rows: 0..0, arrays: WindowArrays::default(), works: Vec::new() }
    }

    /// A row; its chunk is read if it is not the one at hand.
    pub(super) fn row(&mut self, model: &Model, row: usize) -> Result<WindowRow<'_>, ReplayError> {
        if !self.rows.contains(&row) {
            let rows = self.recording.rows();
            if row >= rows {
                return Err(RecordError::NoSuchRows { from: row, to: row.saturating_add(1), rows }.into());
            }
            let step = self.recording.chunk_rows();
            let from = row - row % step;
            let wanted = from..rows.min(from + step);
            self.arrays = WindowArrays::read(&self.recording, model, wanted.clone())?;
            self.rows = wanted;
        }
        let at = row - self.rows.start;
        self.works.clear();
        self.works.extend(self.arrays.works.iter().map(|work| work[at]));
        Ok(WindowRow { arrays: &self.arrays, works: &self.works, at, bodies: model.bodies.len() })
    }
}

impl WindowArrays {
    fn read(recording: &Recording, model: &Model, rows: Range<usize>) -> Result<Self, RecordError> {
        // What the array is called, and how many numbers each body has in it.
        let read = |name: &str, numbers: usize| {
            let array = recording.read_rows(name, rows.clone())?;
            if array.data.len() != rows.len() * model.bodies.len() * numbers {
                return Err(RecordError::Corrupt {
                    path: recording.path().to_path_buf(),
                    reason: format!("`{name}` has not {numbers} numbers for each of {} bodies", model.bodies.len()),
                });
            }
            Ok(array.data)
        };
        let contracts = model.bodies.iter().any(|body| body.contraction().is_some());
        let work = |name: &str| Ok(recording.read_rows(&format!("work_{name}"), rows.clone())?.data);
        Ok(Self {
            time: recording.read_rows("time", rows.clone())?.data,
            position: read("position", 3)?,
            gradient: read("placement_gradient", 9)?,
            velocity: read("velocity", 3)?,
            gradient_rate: read("gradient_rate", 9)?,
            contraction: if contracts { read("contraction", 9)? } else { Vec::new() },
            works: model.works().iter().map(|it| work(it.name())).collect::<Result<_, RecordError>>()?,
        })
    }
}

impl WindowRow<'_> {
    pub(super) fn time(&self) -> f64 {
        self.arrays.time[self.at]
    }

    pub(super) fn works(&self) -> &[f64] {
        self.works
    }

    pub(super) fn position(&self, body: usize) -> Vec3 {
        self.vector(&self.arrays.position, body)
    }

    pub(super) fn gradient(&self, body: usize) -> Mat3 {
        self.matrix(&self.arrays.gradient, body)
    }

    pub(super) fn velocity(&self, body: usize) -> Vec3 {
        self.vector(&self.arrays.velocity, body)
    }

    pub(super) fn gradient_rate(&self, body: usize) -> Mat3 {
        self.matrix(&self.arrays.gradient_rate, body)
    }

    /// G; of a recording with contractile bodies only.
    pub(super) fn contraction(&self, body: usize) -> Mat3 {
        self.matrix(&self.arrays.contraction, body)
    }

    fn vector(&self, numbers: &[f64], body: usize) -> Vec3 {
        Vec3::from_column_slice(&numbers[3 * (self.at * self.bodies + body)..][..3])
    }

    /// Recorded row by row.
    fn matrix(&self, numbers: &[f64], body: usize) -> Mat3 {
        Mat3::from_row_slice(&numbers[9 * (self.at * self.bodies + body)..][..9])
    }
}
