//! What the page asks of the fields of a recording.
//!
//! ```text
//! GET api/fields?row=&width=      the map of a sample, with a width [m] or the usual one
//! ```

use super::shown::{BadRequest, Shown, apart, refused};
use crate::error::ViewError;
use crate::fields::message;
use crate::stored::Stored;
use axum::Router;
use axum::extract::{Query, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use gyration_sim::replay::ReplayError;
use gyration_sim::{FieldMaps, NoFields};
use serde::Deserialize;
use std::sync::{Arc, Mutex, PoisonError};

/// What requests for fields share: the recording as it was when its model was built again.
struct Medium {
    shown: Arc<Shown>,
    known: Mutex<Option<(Arc<Stored>, FieldMaps)>>,
}

/// The route of fields.
pub(super) fn routes(shown: Arc<Shown>) -> Router {
    let medium = Arc::new(Medium { shown, known: Mutex::new(None) });
    Router::new().route("/api/fields", get(fields)).with_state(medium)
}

#[derive(Debug, Deserialize)]
struct FieldsQuery {
    row: usize,
    width: Option<f64>,
}

impl Medium {
    fn map(&self, FieldsQuery { row, width }: FieldsQuery) -> Result<Vec<u8>, BadRequest> {
        let Some(stored) = self.shown.stored() else {
            let words = "fields are those of a recording: run the scene, and view what it has recorded";
            return Err(BadRequest(StatusCode::NOT_FOUND, words.to_owned()));
        };
        // A thread that died with it locked left it whole. One map after the other: each takes all the time there is.
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let (_, maps) = match known.take_if(|(of, _)| Arc::ptr_eq(of, &stored)) {
            Some(same) => known.insert(same),
            None => known.insert((Arc::clone(&stored), FieldMaps::of(stored.recording()).map_err(told)?)),
        };
        message(maps, row, width).map_err(told)
    }
}

/// What is wrong, and what to do.
fn told(error: NoFields) -> BadRequest {
    let help = error.in_scene();
    match (error, help) {
        (NoFields::Replay(ReplayError::Record(error)), _) => ViewError::Record(error).into(),
        (NoFields::Replay(error), _) => ViewError::Replay(error).into(),
        (error, Some(help)) => refused(format!("{error}: {help}")),
        (error, None) => refused(error.to_string()),
    }
}

async fn fields(State(medium): State<Arc<Medium>>, Query(query): Query<FieldsQuery>) -> Result<Response, BadRequest> {
    let found = apart(move || medium.map(query)).await?;
    Ok(([(header::CONTENT_TYPE, "application/octet-stream")], found).into_response())
}
