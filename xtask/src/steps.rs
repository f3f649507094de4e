//! Running programs, one step after another, saying what is run.
//!
//! A step that fails does not stop those after it: one run shows everything that is wrong. Steps that do not need one
//! another may run in a lane beside: it has steps of its own, which are added at the end.

use crate::child::{self, Cost};
use crate::console::Console;
use crate::report::TestReport;
use crate::tally::Tally;
use std::process::{Command, Stdio};
use std::time::Instant;

/// The steps run so far.
#[derive(Debug, Default)]
pub struct Steps {
    /// What the test programs said.
    pub tally: Tally,
    report: TestReport,
    console: Console,
    complaints: Vec<String>,
    skipped: Vec<String>,
}

impl Steps {
    /// Steps of a lane beside this one, to be given back by [`Steps::add`].
    pub fn beside(&self) -> Self {
        Self { console: self.console.beside(), ..Self::default() }
    }

    /// Takes in the steps of another lane.
    pub fn add(&mut self, other: Self) {
        self.tally.add(other.tally);
        self.report.add(other.report);
        self.complaints.extend(other.complaints);
        self.skipped.extend(other.skipped);
    }

    /// Runs a command; it passes if it exits with zero.
    pub fn run(&mut self, title: &str, command: &mut Command) -> bool {
        self.run_reading(title, command, |_| true)
    }

    /// Runs a command and reads its output; `shown` says whether a line is printed.
    pub fn run_reading(&mut self, title: &str, command: &mut Command, mut shown: impl FnMut(&str) -> bool) -> bool {
        self.announce(title, command);
        let console = &mut self.console;
        let outcome = child::run(command, |line| {
            if shown(line) {
                console.line(line);
            }
        });
        let (outcome, cost) = told(outcome);
        self.finish(title, cost);
        let passed = outcome.is_ok();
        if let Err(reason) = outcome {
            self.complain(format!("{title}: {reason}"));
        }
        passed
    }

    /// Runs a test command, showing and tallying its output; it passes if it exits with zero and ran something.
    pub fn run_tests(&mut self, title: &str, command: &mut Command) -> bool {
        self.announce(title, command);
        let (tally, outcome, cost) = self.tallied(command);
        self.finish(title, cost);
        self.judge(title, tally, outcome)
    }

    /// Runs several test programs as one stage; it passes if all exit with zero and anything was run.
    pub fn stage(&mut self, title: &str, programs: impl FnOnce(&mut Stage)) -> bool {
        self.begin(title, "");
        let started = Instant::now();
        let mut stage = Stage { steps: self, tally: Tally::default(), outcome: Ok(()), cpu: 0.0 };
        programs(&mut stage);
        let Stage { tally, outcome, cpu, .. } = stage;
        self.finish(title, Cost { wall: started.elapsed().as_secs_f64(), cpu });
        self.judge(title, tally, outcome)
    }

    /// Makes checks that are no test program, as one stage; each passes or says what is wrong.
    pub fn checks(&mut self, title: &str, checks: impl FnOnce() -> Vec<Result<(), String>>) {
        self.begin(title, "");
        let started = Instant::now();
        let outcomes = checks();
        let passed = outcomes.iter().filter(|outcome| outcome.is_ok()).count();
        self.console.line(&format!("{passed} of {} passed", outcomes.len()));
        self.finish(title, Cost { wall: started.elapsed().as_secs_f64(), cpu: 0.0 });
        if outcomes.is_empty() {
            self.complain(format!("{title}: nothing was checked"));
        }
        self.tally.passed += passed;
        outcomes.into_iter().filter_map(Result::err).for_each(|reason| self.complain(format!("{title}: {reason}")));
    }

    /// Takes in what a test command said, and how it ended.
    fn judge(&mut self, title: &str, tally: Tally, outcome: Result<(), String>) -> bool {
        let (ran, failed) = (tally.passed + tally.failed > 0, tally.failed);
        let names = tally.names.join(", ");
        self.tally.add(tally);
        let success = outcome.is_ok();
        if failed > 0 {
            // Counted already, test by test.
            self.complaints.push(format!("{title}: {failed} tests failed: {names}"));
        } else if let Err(reason) = outcome {
            self.complain(format!("{title}: did not build, or a test program died: {reason}"));
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
        self.skipped.push(reason.to_owned());
    }

    /// Prints what everything took, what was skipped, what is wrong and, last, the sums; true if all is well and
    /// something was run. What is wrong stands in the last line as well: of a long log often nothing else is kept.
    pub fn conclude(&self) -> bool {
        print!("\n{}", self.report.text());
        for reason in &self.skipped {
            println!("skipped: {reason}");
        }
        for reason in &self.complaints {
            println!("failed: {reason}");
        }
        println!("{}", self.sums());
        self.all_is_well()
    }

    /// How much passed and failed, and what.
    fn sums(&self) -> String {
        let sums = format!("{} passed, {} failed", self.tally.passed, self.tally.failed);
        let wrong = self.complaints.iter().map(|reason| reason.lines().next().unwrap_or_default());
        let wrong: Vec<_> = wrong.collect();
        if wrong.is_empty() { sums } else { format!("{sums}: {}", wrong.join("; ")) }
    }

    /// Whether nothing is wrong so far.
    pub fn is_clean(&self) -> bool {
        self.complaints.is_empty() && self.tally.failed == 0
    }

    fn all_is_well(&self) -> bool {
        self.is_clean() && self.tally.passed > 0
    }

    /// Runs a command, showing and tallying what it says.
    fn tallied(&mut self, command: &mut Command) -> (Tally, Result<(), String>, Cost) {
        let mut tally = Tally::default();
        let console = &mut self.console;
        let outcome = child::run(command, |line| {
            console.line(line);
            tally.read(line);
        });
        let (outcome, cost) = told(outcome);
        (tally, outcome, cost)
    }

    fn announce(&mut self, title: &str, command: &Command) {
        self.begin(title, &words(command));
    }

    fn begin(&mut self, title: &str, words: &str) {
        self.console.begin();
        self.console.line(&format!("\n==> {title}: {words}"));
    }

    fn finish(&mut self, title: &str, cost: Cost) {
        self.console.line(&format!("<== {title}: {:.0} s", cost.wall));
        self.console.end();
        self.report.stage(title, cost);
    }
}

/// A stage of several test programs.
#[derive(Debug)]
pub struct Stage<'a> {
    steps: &'a mut Steps,
    tally: Tally,
    outcome: Result<(), String>,
    cpu: f64,
}

impl Stage<'_> {
    /// Runs one of them.
    pub fn program(&mut self, title: &str, command: &mut Command) {
        self.steps.console.line(&format!("\n--> {title}: {}", words(command)));
        let (tally, outcome, cost) = self.steps.tallied(command);
        if tally.passed + tally.failed > 0 {
            self.steps.report.program(title, cost);
        }
        self.tally.add(tally);
        self.cpu += cost.cpu;
        if let (Ok(()), Err(reason)) = (&self.outcome, outcome) {
            self.outcome = Err(format!("{title}: {reason}"));
        }
    }
}

/// Whether a command can be run and exits with zero; its output is not shown.
pub fn succeeds(command: &mut Command) -> bool {
    let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}

fn words(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

/// How a command ended, in words; it may not have started.
fn told(outcome: std::io::Result<(Result<(), String>, Cost)>) -> (Result<(), String>, Cost) {
    outcome.unwrap_or_else(|error| (Err(format!("cannot be started: {error}")), Cost::default()))
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
        assert!(steps.judge("good", said(2, 0), Ok(())));
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
        assert!(!steps.judge("empty", said(0, 0), Ok(())));
        assert!(!steps.all_is_well());
    }

    #[test]
    fn a_test_program_that_dies_after_a_good_one_fails() {
        let mut steps = Steps::default();
        assert!(!steps.judge("dies", said(2, 0), Err("signal 9".into())));
        assert_eq!(counts(&steps), (2, 1));
    }

    #[test]
    fn failed_tests_are_counted_as_the_program_says() {
        let mut steps = Steps::default();
        assert!(!steps.judge("fails", said(2, 3), Err("exit status 101".into())));
        assert_eq!(counts(&steps), (2, 3));
    }

    #[test]
    fn a_program_that_dies_fails_its_stage_and_those_after_it_run() {
        let mut steps = Steps::default();
        let program = |script: &str| {
            let mut command = Command::new("sh");
            command.args(["-c", script]);
            command
        };
        let mut beside = steps.beside();
        let passed = beside.stage("programs", |stage| {
            for mut command in [program("exit 3"), program("exit 0")] {
                stage.program("one", &mut command);
            }
        });
        assert!(!passed);
        steps.add(beside);
        assert_eq!(counts(&steps), (0, 1));
        assert!(steps.complaints[0].contains("one: exit status: 3"), "{:?}", steps.complaints);
    }
}
