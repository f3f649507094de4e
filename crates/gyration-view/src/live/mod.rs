//! A scene that runs as it is watched: a thread that steps it, and what it publishes for any number of pages.
//!
//! The thread never waits for a page: it appends to a store, and each page takes from the store what it has not had
//! yet, in its own time. It waits only where it is told to: for the first page, and while it is paused.

mod runner;
mod store;

pub(crate) use store::{Cursor, Message, Store};

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// A scene that runs as it is watched.
#[derive(Clone)]
pub struct Live {
    shared: Arc<Shared>,
}

/// What thread and pages share.
pub(crate) struct Shared {
    pub(crate) store: Mutex<Store>,
    control: Mutex<Control>,
    /// Rung when `control` changes.
    told: Condvar,
    /// Changes whenever there is something new to take.
    pub(crate) news: tokio::sync::watch::Sender<u64>,
}

/// What pages want of the thread.
#[derive(Debug, Default)]
struct Control {
    /// A run to begin, with these overrides.
    wanted: Option<Vec<String>>,
    paused: bool,
    /// Whether a page has come yet.
    watched: bool,
}

/// Which scene, and which program runs it.
#[derive(Debug, Clone)]
pub(crate) struct Subject {
    pub(crate) scene: String,
    pub(crate) provenance: gyration_sim::Provenance,
}

impl Live {
    /// Prepares to run a scene, by path or name, from its first watcher on; `overrides` as of `--set`.
    ///
    /// # Errors
    /// Those of the system, which may have no thread to give.
    pub fn start(
        scene: &str,
        overrides: &[String],
        provenance: gyration_sim::Provenance,
    ) -> Result<Self, std::io::Error> {
        let shared = Arc::new(Shared {
            store: Mutex::new(Store::default()),
            control: Mutex::new(Control { wanted: Some(overrides.to_vec()), ..Control::default() }),
            told: Condvar::new(),
            news: tokio::sync::watch::Sender::new(0),
        });
        let subject = Subject { scene: scene.to_owned(), provenance };
        let of_thread = Arc::clone(&shared);
        std::thread::Builder::new().name("run".into()).spawn(move || runner::run(&of_thread, &subject))?;
        Ok(Self { shared })
    }

    /// A page has come: the run may begin.
    pub(crate) fn watch(&self) -> Arc<Shared> {
        self.shared.tell(|control| control.watched = true);
        Arc::clone(&self.shared)
    }
}

impl Shared {
    /// Lets the run begin anew with these overrides.
    pub(crate) fn restart(&self, overrides: Vec<String>) {
        self.tell(|control| {
            control.wanted = Some(overrides);
            control.paused = false;
        });
    }

    /// Halts the run, or lets it go on.
    pub(crate) fn pause(&self, paused: bool) {
        self.tell(|control| control.paused = paused);
        self.store().pause(paused);
        self.announce();
    }

    /// The store; a thread that died with it locked left it whole, since nothing in it is done in two steps.
    pub(crate) fn store(&self) -> MutexGuard<'_, Store> {
        self.store.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Wakes the pages.
    fn announce(&self) {
        self.news.send_modify(|count| *count += 1);
    }

    fn tell(&self, change: impl FnOnce(&mut Control)) {
        change(&mut self.control());
        self.told.notify_all();
    }

    fn control(&self) -> MutexGuard<'_, Control> {
        self.control.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until a run is wanted and watched; its overrides.
    fn next(&self) -> Vec<String> {
        let mut control = self.control();
        loop {
            if control.watched
                && let Some(overrides) = control.wanted.take()
            {
                return overrides;
            }
            control = self.told.wait(control).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Waits while the run is paused; whether another one is wanted.
    fn is_superseded(&self) -> bool {
        let mut control = self.control();
        while control.paused && control.wanted.is_none() {
            control = self.told.wait(control).unwrap_or_else(PoisonError::into_inner);
        }
        control.wanted.is_some()
    }
}
