//! A line on the terminal while something takes long that has no steps to tell of: it says what, and goes when that is
//! done.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// What is done by then needs no line.
const SOON: Duration = Duration::from_millis(500);
/// Between two looks of the line.
const REFRESH: Duration = Duration::from_millis(100);

/// The line, until it is dropped.
pub struct Waiting {
    done: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Waiting {
    /// Begins to wait for something; says nothing unless that is wanted and stderr is a terminal.
    pub fn for_what(what: String, is_wanted: bool) -> Self {
        if !is_wanted || !stderr().is_terminal() {
            return Self { done: None, thread: None };
        }
        let (done, waits) = channel();
        // A system without another thread does without the line.
        let thread = thread::Builder::new().spawn(move || show(what, &waits)).ok();
        Self { done: Some(done), thread }
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.done = None;
        if let Some(thread) = self.thread.take() {
            // Nothing in it panics; were it so, only the line would be missing.
            let _ = thread.join();
        }
    }
}

/// Does some work, and says so on the terminal if it takes long.
pub fn waiting<T>(what: String, is_wanted: bool, work: impl FnOnce() -> T) -> T {
    let _line = Waiting::for_what(what, is_wanted);
    work()
}

/// Draws the line until nobody waits any longer.
fn show(what: String, waits: &Receiver<()>) {
    let goes_on = |pause| waits.recv_timeout(pause) == Err(RecvTimeoutError::Timeout);
    if !goes_on(SOON) {
        return;
    }
    let line = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr()).with_elapsed(SOON);
    // A template of ours is well-formed; were it not, the plain line would do.
    let style = ProgressStyle::with_template("{spinner} {msg}, {elapsed}");
    line.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    line.set_message(what);
    line.tick();
    while goes_on(REFRESH) {
        line.tick();
    }
    line.finish_and_clear();
}
