//! Watches a run and works out what is kept of it, from its rows and events.
//!
//! Rows come from the dense output. Where nothing takes the samples, there are none but the start and the end.

mod attitude;
mod column;
mod layout;

pub(crate) use layout::Layout;

use crate::keep::Keep;
use crate::value::Value;
use attitude::{Distance, Face, Tilt, Turns};
use column::{Listed, Measured, Source};
use gyration::model::Model;
use gyration_record::RecordError;
use gyration_sim::Sink;
use gyration_sim::events::Event;

/// Works out what is kept of one run.
pub(crate) struct Extractor {
    watchers: Vec<Watcher>,
    /// Whether something is taken at events.
    at_events: bool,
}

/// Works out one thing.
enum Watcher {
    Measured(Measured),
    Count { event: usize, body: Option<usize>, count: i64 },
    At { event: usize, body: Option<usize>, listed: Listed },
    Samples(Listed),
    Face(Face),
    Tilt(Tilt),
    Turns(Turns),
    Distance(Distance),
}

impl Extractor {
    /// Watches runs of a model.
    ///
    /// # Errors
    /// A column or a body that the model does not have, in words.
    pub fn new(keeps: &[(String, Keep)], model: &Model, layout: &Layout) -> Result<Self, String> {
        let watchers = keeps.iter().map(|(_, keep)| watcher(keep, model, layout)).collect::<Result<_, String>>()?;
        Ok(Self { watchers, at_events: keeps.iter().any(|(_, keep)| matches!(keep, Keep::At { .. })) })
    }

    /// What is kept, in order.
    pub fn finish(self) -> Vec<Value> {
        let value = |watcher| match watcher {
            Watcher::Measured(measured) => measured.value(),
            Watcher::Count { count, .. } => Value::Integer(count),
            Watcher::At { listed, .. } | Watcher::Samples(listed) => listed.value(),
            Watcher::Face(face) => face.value(),
            Watcher::Tilt(tilt) => tilt.value(),
            Watcher::Turns(turns) => turns.value(),
            Watcher::Distance(distance) => distance.value(),
        };
        self.watchers.into_iter().map(value).collect()
    }
}

fn watcher(keep: &Keep, model: &Model, layout: &Layout) -> Result<Watcher, String> {
    let body = |name: &String| layout.body(name).map_err(|fix| format!("there is no body \"{name}\": {fix}"));
    let one_of = |name: &Option<String>| name.as_ref().map(body).transpose();
    let source = |column: &String| -> Result<Source, String> {
        layout.source(column).map_err(|fix| format!("there is no column \"{column}\": {fix}"))
    };
    Ok(match keep {
        Keep::Column { column, measure } => Watcher::Measured(Measured::new(source(column)?, *measure)),
        Keep::Count { event, body } => Watcher::Count { event: *event, body: one_of(body)?, count: 0 },
        Keep::At { event, body, column, pick } => {
            Watcher::At { event: *event, body: one_of(body)?, listed: Listed::new(source(column)?, *pick) }
        }
        Keep::Samples { column, pick } => Watcher::Samples(Listed::new(source(column)?, *pick)),
        Keep::Face { body: name, at_start } => Watcher::Face(Face::new(model, layout, body(name)?, *at_start)),
        Keep::Tilt { body: name } => Watcher::Tilt(Tilt::new(model, layout, body(name)?)),
        Keep::Turns { body: name, axis, of_form } => {
            Watcher::Turns(Turns::new(model, layout, body(name)?, (*axis, *of_form)))
        }
        Keep::Distance { body: name, along, per } => {
            Watcher::Distance(Distance::new(model, layout, body(name)?, (*along, *per)))
        }
    })
}

impl Sink for Extractor {
    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        for watcher in &mut self.watchers {
            match watcher {
                Watcher::Measured(measured) => measured.row(time, row),
                Watcher::Samples(listed) => listed.row(time, row),
                Watcher::Face(face) => face.row(row),
                Watcher::Tilt(tilt) => tilt.row(row),
                Watcher::Turns(turns) => turns.row(row),
                Watcher::Distance(distance) => distance.row(time, row),
                Watcher::Count { .. } | Watcher::At { .. } => {}
            }
        }
        Ok(())
    }

    fn event(&mut self, found: &Event) -> Result<(), RecordError> {
        for watcher in &mut self.watchers {
            if let Watcher::Count { event, body, count } = watcher
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
        for watcher in &mut self.watchers {
            if let Watcher::At { event, body, listed } = watcher
                && *event == found.kind
                && body.is_none_or(|body| body == found.body)
            {
                listed.row(found.time, row);
            }
        }
        Ok(())
    }
}
