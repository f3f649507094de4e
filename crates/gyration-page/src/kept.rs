//! The run so far as its scene records it, to be saved: the files are those that `gyration export` makes of a
//! recording.

use crate::places::ScenePlaces;
use gyration_record::export::{CsvTable, gltf};
use gyration_record::{Attributes, Event, Layout, RecordError, Recording, Rows};
use std::path::PathBuf;
use std::sync::Arc;

/// A format in which a run is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileFormat {
    /// A table, a line a sample.
    Csv,
    /// The motion as an animation in space.
    Glb,
}

/// Rows and events of a run with what a recording says of them.
pub struct KeptRun {
    /// Stands in errors.
    name: PathBuf,
    layout: Layout,
    attributes: Attributes,
    places: ScenePlaces,
    rows: Arc<Rows>,
}

impl KeptRun {
    /// Before the first row.
    pub(crate) fn new(name: &str, layout: Layout, attributes: Attributes, places: ScenePlaces) -> Self {
        Self { name: name.into(), layout, attributes, places, rows: Arc::default() }
    }

    /// Keeps what the scene records of a row.
    pub fn add_row(&mut self, time: f64, row: &[f64]) {
        Arc::make_mut(&mut self.rows).push(time, self.places.of(row).flatten().copied());
    }

    /// Keeps an event.
    pub fn add_event(&mut self, event: Event) {
        Arc::make_mut(&mut self.rows).push_event(event);
    }

    /// A part of a file, from zero; none behind the last one. A part of a table is a chunk of its rows.
    ///
    /// # Errors
    /// Those of the exports.
    pub fn part(&self, format: FileFormat, part: usize) -> Result<Option<Vec<u8>>, RecordError> {
        let mut bytes = Vec::new();
        match format {
            FileFormat::Csv => {
                let recording = self.recording(Attributes::new())?;
                let Some(rows) = recording.chunks().nth(part) else { return Ok(None) };
                let table = CsvTable::of(&recording)?;
                if part == 0 {
                    table.write_head(&mut bytes)?;
                }
                table.write_rows(rows, &mut bytes)?;
            }
            FileFormat::Glb if part == 0 => {
                gltf(&self.recording(self.attributes.clone())?, &mut bytes)?;
            }
            FileFormat::Glb => return Ok(None),
        }
        Ok(Some(bytes))
    }

    fn recording(&self, attributes: Attributes) -> Result<Recording, RecordError> {
        Recording::in_memory(&self.name, &self.layout, attributes, Arc::clone(&self.rows))
    }
}
