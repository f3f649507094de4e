//! Watching a run: a bar on the terminal that says what limits the step, and Ctrl-C.
//!
//! The first Ctrl-C (or SIGTERM) lets the run end with a checkpoint, the second ends the program at once: what was
//! flushed is on disk and can be resumed too.

use crate::error::{CliError, code};
use crate::output;
use gyration_sim::format::{duration, significant};
use gyration_sim::{Monitor, Progress, Reason, limit_in_words};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Between two looks of the bar.
const REFRESH: Duration = Duration::from_millis(100);
/// Over this wall time the rate is averaged.
const AVERAGED: Duration = Duration::from_secs(5);
/// Ticks of the bar's length.
const TICKS: u64 = 1000;

/// Watches a run.
pub struct Watch {
    bar: Option<Bar>,
    interrupted: Arc<AtomicBool>,
}

struct Bar {
    bar: ProgressBar,
    drawn: Instant,
    /// Wall and simulated time [s] at the beginning of the present average.
    since: (Instant, f64),
    /// Simulated seconds a second.
    rate: f64,
}

impl Watch {
    /// Begins to listen for Ctrl-C, and to draw a bar if it is wanted and stderr is a terminal.
    ///
    /// # Errors
    /// [`CliError::Signal`].
    pub fn new(with_bar: bool) -> Result<Self, CliError> {
        let interrupted = interruption()?;
        let bar = (with_bar && stderr().is_terminal()).then(Bar::new);
        Ok(Self { bar, interrupted })
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.bar.finish_and_clear();
        }
    }
}

/// Listens for Ctrl-C: true after the first; the second ends the program at once.
///
/// # Errors
/// [`CliError::Signal`].
pub fn interruption() -> Result<Arc<AtomicBool>, CliError> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(code::INTERRUPTED));
        }
    })?;
    Ok(interrupted)
}

impl Monitor for Watch {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        if let Some(bar) = &mut self.bar {
            bar.update(progress);
        }
        self.interrupted.load(Ordering::Relaxed).then_some(Reason::Interrupted)
    }
}

impl Bar {
    fn new() -> Self {
        let template = if output::colored() { "{prefix} {wide_bar:.cyan} {msg}" } else { "{prefix} {wide_bar} {msg}" };
        let bar = ProgressBar::with_draw_target(Some(TICKS), ProgressDrawTarget::stderr());
        // A template of ours is well-formed; were it not, the plain bar would do.
        bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
        let now = Instant::now();
        Self { bar, drawn: now, since: (now, f64::NAN), rate: f64::NAN }
    }

    fn update(&mut self, progress: &Progress) {
        let Progress { time, end, .. } = *progress;
        if self.since.1.is_nan() {
            self.since.1 = progress.step.start;
        }
        let now = Instant::now();
        if now - self.drawn < REFRESH {
            return;
        }
        self.drawn = now;
        let elapsed = now - self.since.0;
        self.rate = (time - self.since.1) / elapsed.as_secs_f64();
        if elapsed > AVERAGED {
            self.since = (now, time);
        }
        let remaining = (end - time) / self.rate;
        let limit = limit_in_words(progress.model, &progress.step.limit);
        self.bar.set_prefix(format!("t = {time:.4} of {end} s"));
        self.bar.set_message(format!(
            "{} s/s, {} left, step {:.1e} s limited by {limit}",
            significant(self.rate, 3),
            duration(remaining),
            progress.step.end - progress.step.start,
        ));
        self.bar.set_position((TICKS as f64 * time / end) as u64);
    }
}
