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
use std::sync::{Arc, Mutex, PoisonError, RwLock};

/// What requests share.
pub(super) enum Shown {
    /// Opened again whenever its header is asked for: it may grow, or another one stand in its place.
    Recording(ShownRecording),
    Live(Live),
}

impl Shown {
    /// The recording that is shown, as it was when its header was asked for last.
    pub(super) fn stored(&self) -> Option<Arc<Stored>> {
        match self {
            Self::Recording(shown) => Some(shown.stored()),
            Self::Live(_) => None,
        }
    }

    /// The scene of what is shown, ready to run.
    pub(super) fn scene(&self) -> Result<Arc<Scene>, BadRequest> {
        match self {
            Self::Live(live) => live.scene().ok_or_else(|| {
                BadRequest(StatusCode::SERVICE_UNAVAILABLE, "the scene is being looked at: ask again".to_owned())
            }),
            Self::Recording(shown) => {
                let stored = shown.stored();
                let mut scene = shown.scene.lock().unwrap_or_else(PoisonError::into_inner);
                match scene.as_ref().filter(|(of, _)| of.recording().is_same_as(stored.recording())) {
                    Some((_, known)) => Ok(Arc::clone(known)),
                    None => {
                        let found = Arc::new(stored.scene()?);
                        *scene = Some((stored, Arc::clone(&found)));
                        Ok(found)
                    }
                }
            }
        }
    }
}

/// A recording that is shown.
pub(super) struct ShownRecording {
    stored: RwLock<Arc<Stored>>,
    /// Its scene, once it was asked for.
    scene: Mutex<Option<(Arc<Stored>, Arc<Scene>)>>,
}

impl ShownRecording {
    pub(super) fn of(stored: Stored) -> Self {
        Self { stored: RwLock::new(Arc::new(stored)), scene: Mutex::default() }
    }

    /// As it was when its header was asked for last.
    fn stored(&self) -> Arc<Stored> {
        Arc::clone(&self.stored.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// As it is on disk now: the one that is known where nothing has come, so that what was made of it holds. Another
    /// one in its place counts as another run.
    pub(super) fn opened_anew(&self) -> Result<Arc<Stored>, ViewError> {
        let mut fresh = Stored::open(self.stored().path())?;
        let mut known = self.stored.write().unwrap_or_else(PoisonError::into_inner);
        let is_same = known.recording().is_same_as(fresh.recording());
        fresh.number(known.header().run + u64::from(!is_same));
        if !is_same || known.header() != fresh.header() {
            *known = Arc::new(fresh);
        }
        Ok(Arc::clone(&known))
    }
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
        let shown = ShownRecording::of(Stored::open(&path).unwrap());
        let first = shown.stored();
        assert!(Arc::ptr_eq(&shown.opened_anew().unwrap(), &first));
        // One of the same scene is another one, too: what stands there now is read.
        std::fs::rename(&path, folder.path().join("aside.gyr")).unwrap();
        record(&path, 0.02);
        let second = shown.opened_anew().unwrap();
        assert_eq!([first.header().run, second.header().run], [1, 2]);
        assert!(Arc::ptr_eq(&shown.stored(), &second) && second.blob("time", 0..3, 1).is_ok());
        let shown = Shown::Recording(shown);
        let scene = shown.scene().unwrap();
        assert!(Arc::ptr_eq(&shown.scene().unwrap(), &scene));
        std::fs::rename(&path, folder.path().join("another.gyr")).unwrap();
        record(&path, 0.03);
        let Shown::Recording(known) = &shown else { unreachable!() };
        assert_eq!(known.opened_anew().unwrap().rows(), 4);
        assert!(!Arc::ptr_eq(&shown.scene().unwrap(), &scene));
    }
}
