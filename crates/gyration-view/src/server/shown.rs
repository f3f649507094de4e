//! What requests share, and how they are refused.

use crate::error::ViewError;
use crate::live::Live;
use crate::stored::Stored;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use gyration_record::RecordError;
use gyration_scene::Scene;
use gyration_threads::Interruption;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

/// What requests share.
pub(super) enum Shown {
    /// Opened again whenever its header is asked for: it may grow.
    Recording(RwLock<Arc<Stored>>),
    Live(Live),
}

impl Shown {
    /// The recording that is shown, as it was when its header was asked for last.
    pub(super) fn stored(&self) -> Option<Arc<Stored>> {
        match self {
            Self::Recording(stored) => Some(Arc::clone(&stored.read().unwrap_or_else(PoisonError::into_inner))),
            Self::Live(_) => None,
        }
    }

    /// The scene of what is shown, ready to run; that of a recording is `known` once it was asked for.
    pub(super) fn scene(&self, known: Option<&Arc<Scene>>) -> Result<Arc<Scene>, BadRequest> {
        match (self, known) {
            (Self::Live(live), _) => live.scene().ok_or_else(|| {
                BadRequest(StatusCode::SERVICE_UNAVAILABLE, "the scene is being looked at: ask again".to_owned())
            }),
            (Self::Recording(_), Some(scene)) => Ok(Arc::clone(scene)),
            (Self::Recording(stored), None) => {
                let stored = Arc::clone(&stored.read().unwrap_or_else(PoisonError::into_inner));
                Ok(Arc::new(stored.scene()?))
            }
        }
    }
}

/// A recording as it is on disk now: the one that is known where nothing has come, so that what was made of it holds.
pub(super) fn opened_anew(known: &RwLock<Arc<Stored>>) -> Result<Arc<Stored>, ViewError> {
    let path = known.read().unwrap_or_else(PoisonError::into_inner).path().to_path_buf();
    let fresh = Stored::open(&path)?;
    let mut known = known.write().unwrap_or_else(PoisonError::into_inner);
    if known.header() != fresh.header() {
        *known = Arc::new(fresh);
    }
    Ok(Arc::clone(&known))
}

/// A request that cannot be met, in words.
#[derive(Debug)]
pub(super) struct BadRequest(pub(super) StatusCode, pub(super) String);

impl From<ViewError> for BadRequest {
    fn from(error: ViewError) -> Self {
        let status = match &error {
            ViewError::Record(RecordError::NoSuchArray { .. }) => StatusCode::NOT_FOUND,
            ViewError::Record(RecordError::NoSuchRows { .. }) => StatusCode::RANGE_NOT_SATISFIABLE,
            _ => StatusCode::INTERNAL_SERVER_ERROR,
        };
        Self(status, error.to_string())
    }
}

impl IntoResponse for BadRequest {
    fn into_response(self) -> Response {
        (self.0, [(header::CONTENT_TYPE, "text/plain; charset=utf-8")], self.1).into_response()
    }
}

/// A request that is understood and cannot be met, for this reason.
pub(super) fn refused(reason: String) -> BadRequest {
    BadRequest(StatusCode::UNPROCESSABLE_ENTITY, reason)
}

/// What takes long; other requests are answered meanwhile. It is given up once nobody waits for the answer.
pub(super) async fn apart<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, BadRequest> + Send + 'static,
) -> Result<T, BadRequest> {
    let asked = Asked::default();
    let interruption = Interruption::default().raised_by(Arc::clone(&asked.0));
    let done = tokio::task::spawn_blocking(move || interruption.within(work)).await;
    done.map_err(|error| BadRequest(StatusCode::INTERNAL_SERVER_ERROR, error.to_string()))?
}

/// Somebody who waits for an answer: the flag is raised when this goes.
#[derive(Debug, Default)]
struct Asked(Arc<AtomicBool>);

impl Drop for Asked {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration_sim::{Job, Provenance, Unwatched};
    use std::path::Path;

    /// Records a fall of a duration \[s\] at the path.
    fn record(path: &Path, end: f64) {
        let text = format!(
            "time = {{ end = {end}, sample = 0.01 }}\n\
             [[body]]\nname = \"ball\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 1\n"
        );
        let scene = Scene::parse("fall.toml", &text, Path::new(""), &[]).unwrap();
        let provenance = Provenance { version: "0.0.0".into(), commit: None };
        Job::of(&scene, &provenance).record(path, &mut Unwatched).unwrap();
    }

    /// Without that a page that goes on to another map would wait for the last one.
    #[test]
    fn work_for_which_nobody_waits_is_given_up() {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
        let (given_up, told) = std::sync::mpsc::channel();
        let work = move || {
            // Ten seconds, if it never is.
            let asks = (0..10_000).take_while(|_| Interruption::due().is_none());
            let asked = asks.inspect(|_| std::thread::sleep(std::time::Duration::from_millis(1))).count();
            given_up.send(asked < 10_000).unwrap();
            Ok(())
        };
        let waited = async { tokio::time::timeout(std::time::Duration::from_millis(1), apart(work)).await };
        assert!(runtime.block_on(waited).is_err());
        assert!(told.recv().unwrap());
        assert!(runtime.block_on(apart(|| Ok(Interruption::due()))).is_ok_and(|due| due.is_none()));
    }

    #[test]
    fn a_recording_to_which_nothing_has_come_stays_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fall.gyr");
        record(&path, 0.02);
        let first = Arc::new(Stored::open(&path).unwrap());
        let known = RwLock::new(Arc::clone(&first));
        assert!(Arc::ptr_eq(&opened_anew(&known).unwrap(), &first));
        std::fs::remove_dir_all(&path).unwrap();
        record(&path, 0.03);
        let second = opened_anew(&known).unwrap();
        assert_eq!([first.rows(), second.rows()], [3, 4]);
        assert!(Arc::ptr_eq(&known.read().unwrap(), &second));
    }
}
