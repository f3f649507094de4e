//! A scene that runs as it is watched: a thread that looks at the numbers asked for, one that steps the run, and what
//! it publishes for any number of pages.
//!
//! The run never waits for a page: it appends to a store, and each page takes from the store what it has not had yet,
//! in its own time. It waits only where it is told to: for the first page, and while it is paused.

mod runner;
mod shared;
mod wish;

pub(crate) use shared::LiveState;
pub use wish::Wish;

use gyration_scene::Scene;
use gyration_sim::Provenance;
use runner::Subject;
use std::io;
use std::sync::Arc;

/// What one of the threads does, for ever.
type Work = fn(&LiveState, &Subject);

/// A scene that runs as it is watched.
#[derive(Clone)]
pub struct Live {
    shared: Arc<LiveState>,
}

impl Live {
    /// Prepares to run a scene, by path or name, from its first watcher on; `overrides` as of `--set`.
    ///
    /// # Errors
    /// Those of the system, which may have no thread to give.
    pub fn start(scene: &str, overrides: &[String], provenance: Provenance) -> Result<Self, io::Error> {
        let shared = Arc::new(LiveState::new(overrides.to_vec()));
        let subject = Subject { scene: scene.to_owned(), provenance };
        for (name, work) in [("look", runner::look as Work), ("run", runner::run)] {
            let (shared, subject) = (Arc::clone(&shared), subject.clone());
            std::thread::Builder::new().name(name.into()).spawn(move || work(&shared, &subject))?;
        }
        Ok(Self { shared })
    }

    /// The scene that runs, or has run last; none before it has been looked at.
    pub(crate) fn scene(&self) -> Option<Arc<Scene>> {
        self.shared.scene()
    }

    /// A page has come: the run may begin.
    pub(crate) fn watch(&self) -> Arc<LiveState> {
        self.shared.watch();
        Arc::clone(&self.shared)
    }
}
