//! What the thread of a live run and its pages share: the store, and what the pages want of the thread.

use gyration_page::store::Store;
use gyration_scene::Scene;
use gyration_threads::Interruption;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// What thread and pages share.
pub(crate) struct LiveState {
    pub(crate) store: Mutex<Store>,
    control: Mutex<PageRequests>,
    /// Rung when `control` changes.
    told: Condvar,
    /// Raised while another run is wanted than the one under way.
    superseded: Arc<AtomicBool>,
    /// Raised while other numbers are asked for than those that are looked at.
    overtaken: Arc<AtomicBool>,
    /// Changes whenever there is something new to take.
    pub(crate) news: tokio::sync::watch::Sender<u64>,
}

/// What pages want of the thread.
#[derive(Default)]
struct PageRequests {
    /// Overrides of a run to begin, if the scene takes them.
    asked: Option<Vec<String>>,
    /// A run to begin: of a scene that took its overrides.
    wanted: Option<Arc<Scene>>,
    /// The last scene that did.
    taken: Option<Arc<Scene>>,
    paused: bool,
    /// Whether a page has come yet.
    watched: bool,
}

impl LiveState {
    /// For a run with these overrides, which begins with the first page.
    pub(super) fn new(overrides: Vec<String>) -> Self {
        Self {
            store: Mutex::new(Store::default()),
            control: Mutex::new(PageRequests { asked: Some(overrides), ..PageRequests::default() }),
            told: Condvar::new(),
            superseded: Arc::default(),
            overtaken: Arc::default(),
            news: tokio::sync::watch::Sender::new(0),
        }
    }

    /// A page has come: the run may begin.
    pub(super) fn watch(&self) {
        self.tell(|control| control.watched = true);
    }

    /// Asks for a run with these overrides; the one under way goes on until the scene has taken them.
    pub(crate) fn restart(&self, overrides: Vec<String>) {
        self.tell(|control| {
            control.asked = Some(overrides);
            self.overtaken.store(true, Ordering::Relaxed);
        });
    }

    /// Asks for overrides again that were given up for others, unless there are still others.
    pub(super) fn ask_again(&self, overrides: Vec<String>) {
        self.tell(|control| {
            control.asked.get_or_insert(overrides);
        });
    }

    /// Lets the run of a scene begin in the place of the one under way.
    pub(super) fn supersede(&self, scene: Scene) {
        let scene = Arc::new(scene);
        self.tell(|control| {
            control.taken = Some(Arc::clone(&scene));
            control.wanted = Some(scene);
            control.paused = false;
            self.superseded.store(true, Ordering::Relaxed);
        });
    }

    /// The last scene that took its overrides.
    pub(super) fn scene(&self) -> Option<Arc<Scene>> {
        self.control().taken.clone()
    }

    /// Gives up looking at overrides, once others are asked for.
    pub(super) fn until_overtaken(&self) -> Interruption {
        Interruption::in_force().raised_by(self.overtaken.clone())
    }

    /// Gives up what a run computes for long, once another is wanted.
    pub(super) fn until_superseded(&self) -> Interruption {
        Interruption::in_force().raised_by(self.superseded.clone())
    }

    /// Halts the run, or lets it go on.
    pub(crate) fn pause(&self, paused: bool) {
        self.tell(|control| control.paused = paused);
        self.tell_pause();
    }

    /// Begins a run in the store, which forgets whether the one before waited.
    pub(super) fn begin(&self, publish: impl FnOnce(&mut Store)) {
        publish(&mut self.store());
        self.tell_pause();
    }

    /// Says in the store whether the run waits.
    fn tell_pause(&self) {
        // Held until it is said: of two who say it the later one knows the last word.
        let control = self.control();
        self.store().pause(control.paused);
        drop(control);
        self.announce();
    }

    /// The store; a thread that died with it locked left it whole, since nothing in it is done in two steps.
    pub(crate) fn store(&self) -> MutexGuard<'_, Store> {
        self.store.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Wakes the pages.
    pub(super) fn announce(&self) {
        self.news.send_modify(|count| *count += 1);
    }

    fn tell(&self, change: impl FnOnce(&mut PageRequests)) {
        change(&mut self.control());
        self.told.notify_all();
    }

    fn control(&self) -> MutexGuard<'_, PageRequests> {
        self.control.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until a run is asked for and watched; its overrides.
    pub(super) fn next_asked(&self) -> Vec<String> {
        self.wait_for(|control| {
            let asked = control.asked.take_if(|_| control.watched)?;
            self.overtaken.store(false, Ordering::Relaxed);
            Some(asked)
        })
    }

    /// Waits until a run is wanted; its scene.
    pub(super) fn next_wanted(&self) -> Arc<Scene> {
        self.wait_for(|control| {
            let wanted = control.wanted.take()?;
            self.superseded.store(false, Ordering::Relaxed);
            Some(wanted)
        })
    }

    /// Waits until there is something to take.
    fn wait_for<T>(&self, take: impl Fn(&mut PageRequests) -> Option<T>) -> T {
        let mut control = self.control();
        loop {
            if let Some(taken) = take(&mut control) {
                return taken;
            }
            control = self.told.wait(control).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Waits while the run is paused; whether another one is wanted.
    pub(super) fn is_superseded(&self) -> bool {
        let mut control = self.control();
        while control.paused && control.wanted.is_none() {
            control = self.told.wait(control).unwrap_or_else(PoisonError::into_inner);
        }
        control.wanted.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration_page::store::{Cursor, Message};
    use serde_json::json;

    /// A pause that is asked for after a run was wanted and before its rows begin.
    #[test]
    fn a_store_that_begins_anew_is_told_of_a_pause() {
        let shared = LiveState::new(Vec::new());
        shared.pause(true);
        shared.begin(|store| store.begin(&json!({}), Vec::new(), Vec::new()));
        let told = shared.store().take(&mut Cursor::default());
        let paused = |message: &Message| matches!(message, Message::Text(text) if text.contains("\"paused\":true"));
        assert!(told.iter().any(paused), "{told:?}");
    }
}
