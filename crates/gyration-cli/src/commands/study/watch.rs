//! Watching a study: a bar with rate, remaining time and runs that ended early; Ctrl-C.

use crate::error::CliError;
use crate::output;
use crate::progress::interruption;
use gyration_sim::format::{duration, significant};
use gyration_study::{Progress, Watcher};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Between two looks of the bar.
const REFRESH: Duration = Duration::from_millis(100);

/// Watches a study.
pub struct Watch {
    bar: Option<Bar>,
    interrupted: Arc<AtomicBool>,
}

struct Bar {
    bar: ProgressBar,
    began: Instant,
    drawn: Instant,
}

impl Watch {
    /// Begins to listen for Ctrl-C, and to draw a bar if it is wanted and stderr is a terminal.
    ///
    /// # Errors
    /// [`CliError::Signal`].
    pub fn new(with_bar: bool) -> Result<Self, CliError> {
        let bar = (with_bar && stderr().is_terminal()).then(Bar::new);
        Ok(Self { bar, interrupted: interruption()? })
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.bar.finish_and_clear();
        }
    }
}

impl Watcher for Watch {
    fn look(&mut self, progress: &Progress) -> bool {
        if let Some(bar) = &mut self.bar {
            bar.update(progress);
        }
        self.interrupted.load(Ordering::Relaxed)
    }
}

impl Bar {
    fn new() -> Self {
        let template = if output::colored() { "{prefix} {wide_bar:.cyan} {msg}" } else { "{prefix} {wide_bar} {msg}" };
        let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr());
        // A template of ours is well-formed; were it not, the plain bar would do.
        bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
        let now = Instant::now();
        Self { bar, began: now, drawn: now }
    }

    fn update(&mut self, progress: &Progress) {
        let now = Instant::now();
        if now - self.drawn < REFRESH {
            return;
        }
        self.drawn = now;
        let Progress { done, total, made, early } = *progress;
        let rate = made as f64 / (now - self.began).as_secs_f64();
        let remaining = (total - done) as f64 / rate;
        self.bar.set_length(total);
        self.bar.set_position(done);
        self.bar.set_prefix(format!("{done} of {total} runs"));
        let early = if early == 0 { String::new() } else { format!(", {early} ended early") };
        self.bar.set_message(format!("{} runs/s, {} left{early}", significant(rate, 3), duration(remaining)));
    }
}
