//! A recording in memory: all that one on disk would hold of the rows so far, for its exports.

use crate::Attributes;
use crate::array::{ArrayInfo, DataType};
use crate::error::RecordError;
use crate::event::Event;
use crate::layout::Layout;
use crate::metadata::Group;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Rows and events of a run, in memory.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rows {
    times: Vec<f64>,
    /// The rows, one after the other.
    values: Vec<f64>,
    events: Vec<Event>,
}

impl Rows {
    /// Appends a row.
    pub fn push(&mut self, time: f64, row: impl IntoIterator<Item = f64>) {
        self.times.push(time);
        self.values.extend(row);
    }

    /// Appends an event.
    pub fn push_event(&mut self, event: Event) {
        self.events.push(event);
    }
}

/// The numbers of a recording in memory.
#[derive(Debug)]
pub(crate) struct Memory {
    rows: Arc<Rows>,
    /// Numbers in a row.
    width: usize,
    /// Where the growing arrays stand in a row.
    places: BTreeMap<String, Range<usize>>,
    fixed: BTreeMap<String, Vec<f64>>,
    labels: Vec<(String, Vec<String>)>,
}

impl Memory {
    /// The numbers with their metadata.
    ///
    /// # Errors
    /// `Layout`, `RowLength`.
    pub(crate) fn new(layout: &Layout, attributes: Attributes, rows: Arc<Rows>) -> Result<(Self, Group), RecordError> {
        layout.check()?;
        if layout.ragged.is_some() {
            return Err(RecordError::layout("entries of samples are recorded on disk only"));
        }
        let width = layout.row_len();
        if rows.values.len() != width * rows.times.len() {
            let found = rows.values.len() / rows.times.len().max(1);
            return Err(RecordError::RowLength { expected: width, found });
        }
        let mut group = Group::new(layout, attributes)?;
        group.set_rows("time", rows.times.len());
        group.set_rows("event", rows.events.len());
        let (mut places, mut end) = (BTreeMap::new(), 0);
        for array in &layout.arrays {
            places.insert(array.name.clone(), end..end + array.row_len());
            end += array.row_len();
        }
        let fixed = layout.fixed.iter().map(|fixed| (fixed.spec.name.clone(), fixed.values.clone()));
        Ok((Self { rows, width, places, fixed: fixed.collect(), labels: layout.labels.clone() }, group))
    }

    /// The bytes of rows that an array has, as a file would hold them.
    pub(crate) fn bytes(&self, array: &ArrayInfo, rows: Range<usize>) -> Vec<u8> {
        let Rows { times, values, events } = &*self.rows;
        match array.name.as_str() {
            "time" => doubles(&times[rows]),
            "event_time" => events[rows].iter().flat_map(|event| event.time.to_le_bytes()).collect(),
            "event_kind" => codes(events[rows].iter().map(|event| Some(event.kind))),
            "event_body" => codes(events[rows].iter().map(|event| event.body)),
            name => match (self.places.get(name), self.fixed.get(name)) {
                (Some(place), _) => {
                    let row = |row: usize| &values[row * self.width..][place.clone()];
                    rows.flat_map(|at| doubles(row(at))).collect()
                }
                (None, Some(fixed)) => {
                    let stride = array.row_len();
                    doubles(fixed.get(rows.start * stride..rows.end * stride).unwrap_or(fixed))
                }
                (None, None) => Vec::new(),
            },
        }
    }

    /// The labels of a dimension.
    pub(crate) fn labels(&self, array: &ArrayInfo) -> Vec<String> {
        debug_assert_eq!(array.data_type, DataType::String);
        let found = self.labels.iter().find(|(dim, _)| *dim == array.name);
        found.map_or_else(Vec::new, |(_, labels)| labels.clone())
    }
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// Codes as 32 bits, −1 for none; there are no more kinds and bodies than that.
fn codes(values: impl Iterator<Item = Option<usize>>) -> Vec<u8> {
    values.flat_map(|code| code.map_or(-1, |code| code as i32).to_le_bytes()).collect()
}
