//! Watching what takes long: a bar on the terminal, and Ctrl-C.
//!
//! The first Ctrl-C (or SIGTERM) lets a run end with a checkpoint, the second ends the program at once: what was
//! flushed is on disk and can be resumed too.

use crate::error::{CliError, code};
use crate::output;
use crate::waiting::Waiting;
use gyration_sim::format::{duration, significant};
use gyration_sim::{Monitor, Progress, Reason, limit_in_words};
use gyration_threads::Interruption;
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

/// A bar, and whether Ctrl-C has come.
pub struct Terminal {
    bar: Option<ProgressBar>,
    drawn: Instant,
    interrupted: Arc<AtomicBool>,
}

impl Terminal {
    /// Begins to listen for Ctrl-C, and to draw a bar if it is wanted and stderr is a terminal.
    ///
    /// # Errors
    /// [`CliError::Signal`].
    pub fn new(with_bar: bool) -> Result<Self, CliError> {
        let interrupted = interruption()?;
        let bar = (with_bar && stderr().is_terminal()).then(bar);
        Ok(Self { bar, drawn: Instant::now(), interrupted })
    }

    /// Lets the bar be drawn anew, if there is one and the last time is long enough ago.
    pub fn draw(&mut self, draw: impl FnOnce(&ProgressBar, Instant)) {
        let now = Instant::now();
        if let Some(bar) = self.bar.as_ref().filter(|_| now - self.drawn >= REFRESH) {
            self.drawn = now;
            draw(bar, now);
        }
    }

    /// The interruption by Ctrl-C.
    pub fn interruption(&self) -> Interruption {
        Interruption::in_force().raised_by(self.interrupted.clone())
    }

    /// Whether Ctrl-C has come.
    #[cfg(feature = "study")]
    pub fn is_interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let template = if output::colored() { "{prefix} {wide_bar:.cyan} {msg}" } else { "{prefix} {wide_bar} {msg}" };
    let bar = ProgressBar::with_draw_target(Some(TICKS), ProgressDrawTarget::stderr());
    // A template of ours is well-formed; were it not, the plain bar would do.
    bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}

/// Listens for Ctrl-C: true after the first; the second ends the program at once.
fn interruption() -> Result<Arc<AtomicBool>, CliError> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(code::INTERRUPTED));
        }
    })?;
    Ok(interrupted)
}

/// Watches a run: its bar says what limits the step, and how many bodies share it.
pub struct RunProgress {
    terminal: Terminal,
    /// The line before the first step, which may take long.
    first: Option<Waiting>,
    /// Wall and simulated time [s] at the beginning of the present average.
    since: (Instant, f64),
    /// Bodies of the run.
    bodies: usize,
}

impl RunProgress {
    /// Begins to watch a run of so many bodies.
    ///
    /// # Errors
    /// [`CliError::Signal`].
    pub fn new(with_bar: bool, bodies: usize) -> Result<Self, CliError> {
        let terminal = Terminal::new(with_bar)?;
        Ok(Self { terminal, first: None, since: (Instant::now(), f64::NAN), bodies })
    }

    /// Says on the terminal that the first step is waited for, until it comes.
    pub fn await_first_step(&mut self) {
        self.first = Some(Waiting::for_what("the first step".to_owned(), self.terminal.bar.is_some()));
    }

    /// The interruption by Ctrl-C.
    pub fn interruption(&self) -> Interruption {
        self.terminal.interruption()
    }

    /// Removes the bar.
    pub fn finish(&mut self) {
        self.first = None;
        self.terminal.finish();
    }
}

impl Monitor for RunProgress {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        let Self { terminal, first, since, bodies } = self;
        *first = None;
        if since.1.is_nan() {
            since.1 = progress.step.start;
        }
        terminal.draw(|bar, now| {
            let Progress { time, end, .. } = *progress;
            let elapsed = now - since.0;
            let rate = (time - since.1) / elapsed.as_secs_f64();
            if elapsed > AVERAGED {
                *since = (now, time);
            }
            let limit = limit_in_words(progress.model, &progress.step.limit);
            bar.set_prefix(format!("t = {time:.4} of {end} s"));
            bar.set_message(format!(
                "{} s/s, {} left, step {:.1e} s{} limited by {limit}",
                significant(rate, 3),
                duration((end - time) / rate),
                progress.step.end - progress.step.start,
                sharing(progress.model.bodies.len(), *bodies),
            ));
            bar.set_position((TICKS as f64 * time / end) as u64);
        });
        // Ctrl-C is an interruption in force.
        None
    }
}

/// How many bodies of so many share the step that holds the run up; nothing where they are all, or one alone.
fn sharing(island: usize, bodies: usize) -> String {
    if island < 2 || island == bodies { String::new() } else { format!(" of {island} of {bodies} bodies") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration_scene::{Scene, gallery_scene};
    use gyration_sim::{MemorySink, RunPlan, Simulation};
    use std::path::Path;

    /// Writes down how many bodies share the step that holds a run up.
    #[derive(Default)]
    struct Shares(Vec<usize>);

    impl Monitor for Shares {
        fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
            self.0.push(progress.model.bodies.len());
            None
        }
    }

    /// The first domino falls alone, then on the next: the step that holds the run up is of one, then of two and more.
    #[test]
    fn the_line_tells_how_many_bodies_share_the_step() {
        let text = gallery_scene("dominoes").unwrap();
        let scene = Scene::parse("dominoes.toml", text, Path::new(""), &["time.end=0.3".to_owned()]).unwrap();
        let built = scene.built();
        let mut run = Simulation::new(&built.model, &built.state, RunPlan::from(built)).unwrap();
        let mut shares = Shares::default();
        run.begin(&mut MemorySink::default()).unwrap();
        run.run(&mut MemorySink::default(), &mut shares).unwrap();
        let bodies = built.model.bodies.len();
        assert!(shares.0.contains(&1) && shares.0.iter().any(|island| *island > 1), "{:?}", shares.0);
        assert!(shares.0.iter().all(|island| *island <= bodies));
        assert_eq!(
            [1, 2, bodies].map(|island| sharing(island, bodies)),
            ["", &format!(" of 2 of {bodies} bodies"), ""]
        );
    }
}
