//! The bar of a study: a bar with rate, remaining time and runs that ended early; Ctrl-C.

use crate::error::CliError;
use crate::progress::Terminal;
use gyration_sim::format::{duration, significant};
use gyration_study::{StudyMonitor, StudyProgress};
use std::time::Instant;

/// Watches a study.
pub struct StudyBar {
    terminal: Terminal,
    began: Instant,
}

impl StudyBar {
    /// Begins to watch.
    ///
    /// # Errors
    /// [`CliError::Signal`].
    pub fn new(with_bar: bool) -> Result<Self, CliError> {
        Ok(Self { terminal: Terminal::new(with_bar)?, began: Instant::now() })
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.terminal.finish();
    }
}

impl StudyMonitor for StudyBar {
    fn after_rows(&mut self, progress: &StudyProgress) -> bool {
        let StudyProgress { done, total, made, early } = *progress;
        self.terminal.draw(|bar, now| {
            let rate = made as f64 / (now - self.began).as_secs_f64();
            bar.set_length(total);
            bar.set_position(done);
            bar.set_prefix(format!("{done} of {total} runs"));
            let early = if early == 0 { String::new() } else { format!(", {early} ended early") };
            let left = duration((total - done) as f64 / rate);
            bar.set_message(format!("{} runs/s, {left} left{early}", significant(rate, 3)));
        });
        self.terminal.is_interrupted()
    }
}
