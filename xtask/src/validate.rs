//! Running the problems with a known answer and those that others publish, and writing their pages.

use crate::cargo::cargo;
use crate::steps::Steps;
use crate::{answers, published, root};
use std::path::PathBuf;
use std::process::ExitCode;

/// The page of known answers.
pub fn page_path() -> PathBuf {
    root().join("docs/known-answers.md")
}

/// The page of what others publish.
pub fn published_path() -> PathBuf {
    root().join("docs/published.md")
}

/// Runs the problems; if all pass, writes the pages.
pub fn run() -> ExitCode {
    let mut steps = Steps::default();
    let mut command = cargo();
    command.args(["test", "--package", "gyration-validation", "--no-fail-fast", "--", "--show-output"]);
    if steps.run_tests("known answers", &mut command) {
        write_pages(&mut steps);
    } else {
        eprintln!("xtask: the pages are left as they are");
    }
    if steps.conclude() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn write_pages(steps: &mut Steps) {
    let (answers, findings) = (&steps.tally.answers, &steps.tally.findings);
    let unreadable = steps.tally.unreadable.first();
    let outcome = match unreadable {
        Some(line) => Err(format!("cannot read the line: {line}")),
        None => write(page_path(), answers::page(answers)).and(write(published_path(), published::page(findings))),
    };
    match outcome {
        Ok(()) => println!("{} known answers and {} published numbers", answers.len(), findings.len()),
        Err(reason) => steps.complain(reason),
    }
}

fn write(path: PathBuf, page: String) -> Result<(), String> {
    std::fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))
}
