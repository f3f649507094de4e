//! Running programs, one step after another, saying what is run.
//!
//! A step that fails does not stop those after it: one run shows everything that is wrong.

use crate::tally::Tally;
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};
use std::time::Instant;

/// The steps run so far.
#[derive(Debug, Default)]
pub struct Steps {
    /// What the test programs said.
    pub tally: Tally,
    complaints: Vec<String>,
    skipped: Vec<String>,
}

impl Steps {
    /// Runs a command; it passes if it exits with zero.
    pub fn run(&mut self, title: &str, command: &mut Command) -> bool {
        let started = announce(title, command);
        let outcome = match command.status() {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => Err(status.to_string()),
            Err(error) => Err(format!("cannot be started: {error}")),
        };
        finish(title, started);
        let passed = outcome.is_ok();
        if let Err(reason) = outcome {
            self.complain(format!("{title}: {reason}"));
        }
        passed
    }

    /// Runs a test command, showing and tallying its output; it passes if it exits with zero and ran something.
    pub fn run_tests(&mut self, title: &str, command: &mut Command) -> bool {
        let started = announce(title, command);
        let outcome = tallied(command);
        finish(title, started);
        match outcome {
            Ok((tally, success)) => self.judge(title, tally, success),
            Err(error) => {
                self.complain(format!("{title}: {error}"));
                false
            }
        }
    }

    /// Takes in what a test command said, and whether it exited with zero.
    fn judge(&mut self, title: &str, tally: Tally, success: bool) -> bool {
        let (ran, failed) = (tally.passed + tally.failed > 0, tally.failed);
        self.tally.add(tally);
        if failed > 0 {
            // Counted already, test by test.
            self.complaints.push(format!("{title}: {failed} tests failed"));
        } else if !success {
            self.complain(format!("{title}: did not build, or a test program died"));
        } else if !ran {
            self.complain(format!("{title}: no test was run"));
        }
        success && ran && failed == 0
    }

    /// Notes something that is wrong beside the tests; it counts as one failure.
    pub fn complain(&mut self, reason: String) {
        eprintln!("xtask: {reason}");
        self.tally.failed += 1;
        self.complaints.push(reason);
    }

    /// Notes a step that was not run, and why.
    pub fn skip(&mut self, reason: &str) {
        println!("\n==> skipped: {reason}");
        self.skipped.push(reason.to_owned());
    }

    /// Prints what was skipped, what is wrong and, last, the sums; true if all is well and something was run.
    pub fn conclude(&self) -> bool {
        println!();
        for reason in &self.skipped {
            println!("skipped: {reason}");
        }
        for reason in &self.complaints {
            println!("failed: {reason}");
        }
        println!("{} passed, {} failed", self.tally.passed, self.tally.failed);
        self.all_is_well()
    }

    /// Whether nothing is wrong so far.
    pub fn is_clean(&self) -> bool {
        self.complaints.is_empty() && self.tally.failed == 0
    }

    fn all_is_well(&self) -> bool {
        self.is_clean() && self.tally.passed > 0
    }
}

/// Whether a command can be run and exits with zero; its output is not shown.
pub fn succeeds(command: &mut Command) -> bool {
    let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}

fn announce(title: &str, command: &Command) -> Instant {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    let line: Vec<_> = words.map(|word| word.to_string_lossy()).collect();
    println!("\n==> {title}: {}", line.join(" "));
    let _ = std::io::stdout().flush();
    Instant::now()
}

fn finish(title: &str, started: Instant) {
    println!("<== {title}: {:.0} s", started.elapsed().as_secs_f64());
}

/// Runs a command, copying its standard output to ours, and tallies it; with whether it exited with zero.
fn tallied(command: &mut Command) -> std::io::Result<(Tally, bool)> {
    let mut tally = Tally::default();
    let mut child = command.stdout(Stdio::piped()).spawn()?;
    if let Some(output) = child.stdout.take() {
        for line in BufReader::new(output).split(b'\n') {
            // Not `lines`: a test may print what is not UTF-8.
            let line = String::from_utf8_lossy(&line?).into_owned();
            println!("{line}");
            tally.read(&line);
        }
    }
    let status = child.wait()?;
    Ok((tally, status.success()))
}

#[cfg(test)]
mod tests {
    use super::*;

    // These tests print nothing that looks like a result: the test command reads the output of this program too.

    fn said(passed: usize, failed: usize) -> Tally {
        Tally { passed, failed, ..Tally::default() }
    }

    fn counts(steps: &Steps) -> (usize, usize) {
        (steps.tally.passed, steps.tally.failed)
    }

    #[test]
    fn a_failing_step_fails_the_whole_and_counts_once() {
        let mut steps = Steps::default();
        assert!(steps.judge("good", said(2, 0), true));
        assert!(steps.all_is_well());
        assert!(!steps.run("bad", Command::new("sh").args(["-c", "exit 3"])));
        assert!(!steps.all_is_well());
        assert_eq!(counts(&steps), (2, 1));
    }

    #[test]
    fn a_program_that_cannot_be_started_fails() {
        let mut steps = Steps::default();
        assert!(!steps.run("missing", &mut Command::new("/nonexistent/program")));
        assert_eq!(counts(&steps), (0, 1));
    }

    #[test]
    fn running_no_test_at_all_fails() {
        let mut steps = Steps::default();
        assert!(!steps.all_is_well());
        assert!(!steps.judge("empty", said(0, 0), true));
        assert!(!steps.all_is_well());
    }

    #[test]
    fn a_test_program_that_dies_after_a_good_one_fails() {
        let mut steps = Steps::default();
        assert!(!steps.judge("dies", said(2, 0), false));
        assert_eq!(counts(&steps), (2, 1));
    }

    #[test]
    fn failed_tests_are_counted_as_the_program_says() {
        let mut steps = Steps::default();
        assert!(!steps.judge("fails", said(2, 3), false));
        assert_eq!(counts(&steps), (2, 3));
    }
}
