//! Running the problems with a known answer, and writing their page.

use crate::cargo::cargo;
use crate::steps::Steps;
use crate::{answers, root};
use std::path::PathBuf;
use std::process::ExitCode;

/// The page of known answers.
pub fn page_path() -> PathBuf {
    root().join("docs/known-answers.md")
}

/// Runs the problems; if all pass, writes the page.
pub fn run() -> ExitCode {
    let mut steps = Steps::default();
    let mut command = cargo();
    command.args(["test", "--package", "gyration-validation", "--no-fail-fast", "--", "--show-output"]);
    if steps.run_tests("known answers", &mut command) {
        write_page(&mut steps);
    } else {
        eprintln!("xtask: the page is left as it is");
    }
    if steps.conclude() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn write_page(steps: &mut Steps) {
    let answers = &steps.tally.answers;
    let unreadable = steps.tally.unreadable.first();
    let outcome = match unreadable {
        Some(line) => Err(format!("cannot read the known answer: {line}")),
        None => std::fs::write(page_path(), answers::page(answers))
            .map_err(|error| format!("{}: {error}", page_path().display())),
    };
    match outcome {
        Ok(()) => println!("{}: {} known answers", page_path().display(), answers.len()),
        Err(reason) => steps.complain(reason),
    }
}
