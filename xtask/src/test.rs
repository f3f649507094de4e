//! The test command: every check of the repository, in the order in which a mistake is cheapest to find.

use crate::steps::{Steps, succeeds};
use crate::{answers, gallery, package, python, root, validate, viewer};
use std::process::{Command, ExitCode};

/// How much to check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    Full,
    /// Without documentation, viewer, Python and cargo-deny.
    Fast,
}

/// Where the random cases of the property tests start, unless the environment says otherwise: the same commit then
/// gives the same verdict wherever it is tested. `PROPTEST_RNG_SEED=7 cargo xtask test` looks elsewhere.
const SEED: &str = "20261121";
const SEED_VARIABLE: &str = "PROPTEST_RNG_SEED";

/// Runs every check and prints the sums.
pub fn run(extent: Extent) -> ExitCode {
    let mut steps = Steps::default();
    for component in ["fmt", "clippy"] {
        install_component(&mut steps, component);
    }
    steps.run("format", cargo().args(["fmt", "--all", "--check"]));
    steps.run("lints", cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]));
    if extent == Extent::Full {
        let mut doc = cargo();
        // The program has the name of the library, and so would its pages.
        doc.args(["doc", "--workspace", "--exclude", "gyration-cli", "--no-deps", "--document-private-items"]);
        steps.run("documentation", doc.env("RUSTDOCFLAGS", "-D warnings"));
    }
    // The output of tests that pass is shown: it has the measured errors of the known answers.
    steps.run_tests("tests", cargo().args(["test", "--workspace", "--no-fail-fast", "--", "--show-output"]));
    check_known_answers(&mut steps);
    gallery::check(&mut steps);
    match extent {
        Extent::Full => {
            viewer::tests(&mut steps);
            python_tests(&mut steps);
            dependencies(&mut steps);
        }
        Extent::Fast => steps.skip("documentation, tests of the viewer and in Python, and cargo-deny (--fast)"),
    }
    if steps.conclude() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The cargo that started this program, in the root of the repository.
pub fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    if std::env::var_os(SEED_VARIABLE).is_none() {
        command.env(SEED_VARIABLE, SEED);
    }
    command
}

/// Asks rustup for a part of the toolchain that a minimal installation lacks.
fn install_component(steps: &mut Steps, command: &str) {
    if !succeeds(cargo().args([command, "--version"])) {
        let name = if command == "fmt" { "rustfmt" } else { command };
        steps.run("install a component", Command::new("rustup").args(["component", "add", name]).current_dir(root()));
    }
}

/// The page of known answers must list those that the tests printed; digits may differ.
fn check_known_answers(steps: &mut Steps) {
    for line in std::mem::take(&mut steps.tally.unreadable) {
        steps.complain(format!("cannot read the known answer: {line}"));
    }
    let page = std::fs::read_to_string(validate::page_path()).unwrap_or_default();
    let differences = answers::differences(&page, &steps.tally.answers);
    if !differences.is_empty() {
        steps.complain(format!(
            "docs/known-answers.md is out of step (run `cargo xtask validate`): {}",
            differences.join("; ")
        ));
    }
}

/// Tests in modules called `python` are ignored unless there is an interpreter with the pinned packages; those of the Python
/// package need it installed.
fn python_tests(steps: &mut Steps) {
    if let Some(interpreter) = python::environment(steps) {
        // The whole workspace again, so that nothing is compiled twice with other features.
        let mut command = cargo();
        command.args(["test", "--workspace", "--test", "tests", "--", "--ignored", "python::"]);
        steps.run_tests("Python tests", command.env("GYRATION_PYTHON", &interpreter));
        package::tests(steps, &interpreter);
    }
}

/// Licences, advisories and sources of dependencies.
fn dependencies(steps: &mut Steps) {
    if succeeds(cargo().args(["deny", "--version"])) {
        steps.run("dependencies", cargo().args(["deny", "check"]));
    } else {
        steps.skip("licences and advisories of dependencies: cargo-deny is not installed");
    }
}
