//! Watches a run and works out what is kept of it, from its rows and events.
//!
//! Rows come from the dense output. Where nothing takes the samples, there are none but the start and the end.

mod attitude;
mod column;
mod layout;

pub(crate) use layout::ColumnPlaces;

use crate::keep::Keep;
use crate::value::Value;
use attitude::{Distance, LowestFace, Tilt, Turns};
use column::{ColumnSource, ColumnStatistic, Listed};
use gyration::model::Model;
use gyration_record::RecordError;
use gyration_sim::Sink;
use gyration_sim::events::Event;

/// Works out what is kept of one run.
pub(crate) struct Extractor {
    extractions: Vec<Extraction>,
    /// Whether something is taken at events.
    at_events: bool,
}

/// Works out one thing.
enum Extraction {
    Statistic(ColumnStatistic),
    Count { event: usize, body: Option<usize>, count: i64 },
    At { event: usize, body: Option<usize>, listed: Listed },
    Samples(Listed),
    Face(LowestFace),
    Tilt(Tilt),
    Turns(Turns),
    Distance(Distance),
}

impl Extractor {
    /// Watches runs of a model.
    ///
    /// # Errors
    /// A column or a body that the model does not have, in words.
    pub fn new(keeps: &[(String, Keep)], model: &Model, layout: &ColumnPlaces) -> Result<Self, String> {
        let extractions =
            keeps.iter().map(|(_, keep)| extraction(keep, model, layout)).collect::<Result<_, String>>()?;
        Ok(Self { extractions, at_events: keeps.iter().any(|(_, keep)| matches!(keep, Keep::At { .. })) })
    }

    /// What is kept, in order.
    pub fn finish(self) -> Vec<Value> {
        let value = |extraction| match extraction {
            Extraction::Statistic(statistic) => statistic.value(),
            Extraction::Count { count, .. } => Value::Integer(count),
            Extraction::At { listed, .. } | Extraction::Samples(listed) => listed.value(),
            Extraction::Face(face) => face.value(),
            Extraction::Tilt(tilt) => tilt.value(),
            Extraction::Turns(turns) => turns.value(),
            Extraction::Distance(distance) => distance.value(),
        };
        self.extractions.into_iter().map(value).collect()
    }
}

fn extraction(keep: &Keep, model: &Model, layout: &ColumnPlaces) -> Result<Extraction, String> {
    let body = |name: &String| layout.body(name).map_err(|fix| format!("there is no body \"{name}\": {fix}"));
    let one_of = |name: &Option<String>| name.as_ref().map(body).transpose();
    let source = |column: &String| -> Result<ColumnSource, String> {
        layout.source(column).map_err(|fix| format!("there is no column \"{column}\": {fix}"))
    };
    Ok(match keep {
        Keep::Column { column, measure } => Extraction::Statistic(ColumnStatistic::new(source(column)?, *measure)),
        Keep::Count { event, body } => Extraction::Count { event: *event, body: one_of(body)?, count: 0 },
        Keep::At { event, body, column, pick } => {
            Extraction::At { event: *event, body: one_of(body)?, listed: Listed::new(source(column)?, *pick) }
        }
        Keep::Samples { column, pick } => Extraction::Samples(Listed::new(source(column)?, *pick)),
        Keep::Face { body: name, at_start } => Extraction::Face(LowestFace::new(model, layout, body(name)?, *at_start)),
        Keep::Tilt { body: name } => Extraction::Tilt(Tilt::new(model, layout, body(name)?)),
        Keep::Turns { body: name, axis, of_form } => {
            Extraction::Turns(Turns::new(model, layout, body(name)?, *axis, *of_form))
        }
        Keep::Distance { body: name, along, per } => {
            Extraction::Distance(Distance::new(model, layout, body(name)?, *along, *per))
        }
    })
}

impl Sink for Extractor {
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        for extraction in &mut self.extractions {
            match extraction {
                Extraction::Statistic(statistic) => statistic.row(time, row),
                Extraction::Samples(listed) => listed.row(time, row),
                Extraction::Face(face) => face.row(row),
                Extraction::Tilt(tilt) => tilt.row(row),
                Extraction::Turns(turns) => turns.row(row),
                Extraction::Distance(distance) => distance.row(time, row),
                Extraction::Count { .. } | Extraction::At { .. } => {}
            }
        }
        Ok(())
    }

    fn event(&mut self, found: &Event) -> Result<(), RecordError> {
        for extraction in &mut self.extractions {
            if let Extraction::Count { event, body, count } = extraction
                && *event == found.kind
                && body.is_none_or(|body| body == found.body)
            {
                *count += 1;
            }
        }
        Ok(())
    }

    fn wants_event_rows(&self) -> bool {
        self.at_events
    }

    fn event_row(&mut self, found: &Event, row: &[f64]) -> Result<(), RecordError> {
        for extraction in &mut self.extractions {
            if let Extraction::At { event, body, listed } = extraction
                && *event == found.kind
                && body.is_none_or(|body| body == found.body)
            {
                listed.row(found.time, row);
            }
        }
        Ok(())
    }
}
