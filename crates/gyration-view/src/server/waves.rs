//! What the page asks of the waves of a lattice.
//!
//! ```text
//! GET api/bands?path=                       bands along a path, or along the usual one
//! GET api/wave?path=&branch=&amplitude=     the wave at the first point of the path
//! ```

use super::shown::{BadRequest, Shown, apart, refused};
use crate::waves::Waves;
use axum::Router;
use axum::extract::{Query, State};
use axum::http::header;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use serde::Deserialize;
use std::sync::{Arc, Mutex, PoisonError};

/// What requests for waves share: the cell that was linearized last.
struct Lattice {
    shown: Arc<Shown>,
    known: Mutex<Option<Arc<Waves>>>,
}

/// The routes of waves.
pub(super) fn routes(shown: Arc<Shown>) -> Router {
    let lattice = Arc::new(Lattice { shown, known: Mutex::new(None) });
    Router::new().route("/api/bands", get(bands)).route("/api/wave", get(wave)).with_state(lattice)
}

impl Lattice {
    /// The waves of what is shown now.
    fn waves(&self) -> Result<Arc<Waves>, BadRequest> {
        // A thread that died with it locked left it whole.
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let scene = self.shown.scene()?;
        if let Some(waves) = known.as_ref().filter(|waves| Arc::ptr_eq(waves.scene(), &scene)) {
            return Ok(Arc::clone(waves));
        }
        let waves = Arc::new(Waves::of(scene).map_err(refused)?);
        *known = Some(Arc::clone(&waves));
        Ok(waves)
    }
}

#[derive(Debug, Deserialize)]
struct BandsQuery {
    path: Option<String>,
}

#[derive(Debug, Deserialize)]
struct WaveQuery {
    path: String,
    branch: usize,
    amplitude: f64,
}

async fn bands(
    State(lattice): State<Arc<Lattice>>,
    Query(BandsQuery { path }): Query<BandsQuery>,
) -> Result<Response, BadRequest> {
    let found = apart(move || lattice.waves()?.bands(path.as_deref()).map_err(refused)).await?;
    Ok(([(header::CONTENT_TYPE, "application/json")], found.to_string()).into_response())
}

async fn wave(
    State(lattice): State<Arc<Lattice>>,
    Query(WaveQuery { path, branch, amplitude }): Query<WaveQuery>,
) -> Result<Response, BadRequest> {
    let found = apart(move || lattice.waves()?.wave(&path, branch, amplitude).map_err(refused)).await?;
    Ok(([(header::CONTENT_TYPE, "application/octet-stream")], found).into_response())
}
