//! The test command: every check of the repository, in the order in which a mistake is cheapest to find.

use crate::cargo::cargo;
use crate::programs::{self, TestPrograms};
use crate::steps::{Steps, succeeds};
use crate::{answers, campaign, fill, gallery, golden, package, published, python, root, supply, validate, viewer};
use std::process::{Command, ExitCode};
use std::sync::mpsc::{self, Receiver, Sender};

/// How much to check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    Full,
    /// Without documentation, viewer, Python, and advisories and licences of dependencies.
    Fast,
}

/// Runs every check and prints the sums.
///
/// What needs no compiler runs in a lane beside: it waits for networks, browsers and Python rather than for a core.
pub fn run(extent: Extent) -> ExitCode {
    let mut steps = Steps::default();
    for component in ["fmt", "clippy"] {
        install_component(&mut steps, component);
    }
    if extent == Extent::Full {
        let mut beside = steps.beside();
        let (sender, receiver) = mpsc::channel();
        std::thread::scope(|threads| {
            let lane = threads.spawn(move || {
                beside_rust(&mut beside, &receiver);
                beside
            });
            rust(&mut steps, extent, &sender);
            // Without tests that were built there is nothing to wait for.
            drop(sender);
            match lane.join() {
                Ok(lane) => steps.add(lane),
                Err(_) => steps.complain("the lane of viewer and Python died".into()),
            }
        });
    } else {
        rust(&mut steps, extent, &mpsc::channel().0);
        steps
            .skip("documentation, tests of the viewer and in Python, advisories and licences of dependencies (--fast)");
    }
    if steps.conclude() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The checks of the Rust code; what was built for the tests goes to the lane beside as soon as it is there.
fn rust(steps: &mut Steps, extent: Extent, built: &Sender<TestPrograms>) {
    steps.run("format", cargo().args(["fmt", "--all", "--check"]));
    fill::check(steps);
    steps.run("lints", cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]));
    if let Some(found) = programs::build(steps) {
        let _ = built.send(found.clone());
        // The output of tests that pass is shown: it has the measured errors of the known answers.
        programs::run(steps, "tests", &found.programs, |program| {
            program.arg("--show-output");
        });
        check_pages(steps);
        gallery::check(steps, &found.gyration);
        golden::check(steps, &found.gyration);
        campaign::check(steps, &found.gyration);
    }
    steps.run_tests("examples in the documentation", cargo().args(["test", "--workspace", "--doc", "--no-fail-fast"]));
    if extent == Extent::Full {
        let mut doc = cargo();
        // The program has the name of the library, and so would its pages.
        doc.args(["doc", "--workspace", "--exclude", "gyration-cli", "--no-deps", "--document-private-items"]);
        steps.run("documentation", doc.env("RUSTDOCFLAGS", "-D warnings"));
        supply::check(steps);
    }
}

/// The viewer and Python: what they need is fetched while Rust is compiled, and they are tested once the program is
/// built.
fn beside_rust(steps: &mut Steps, built: &Receiver<TestPrograms>) {
    let browser = viewer::browser(steps);
    let interpreter = python::test_environment(steps);
    let emulator = golden::emulator(steps);
    let Ok(built) = built.recv() else { return };
    if let Some(interpreter) = interpreter {
        // Tests in modules called `python` are ignored without an interpreter with the pinned packages.
        programs::run(steps, "Python tests", programs::integration(&built.programs), |program| {
            program.args(["--ignored", "python::"]).env("GYRATION_PYTHON", &interpreter);
        });
        package::tests(steps, &interpreter);
    }
    if let Some(browser) = browser {
        viewer::tests(steps, &built.gyration, &browser);
    }
    if let Some(emulator) = emulator {
        golden::check_emulated(steps, &built.gyration, &emulator);
    }
}

/// Asks rustup for a part of the toolchain that a minimal installation lacks.
fn install_component(steps: &mut Steps, command: &str) {
    if !succeeds(cargo().args([command, "--version"])) {
        let name = if command == "fmt" { "rustfmt" } else { command };
        steps.run("install a component", Command::new("rustup").args(["component", "add", name]).current_dir(root()));
    }
}

/// The pages of known answers and of what others publish must list those that the tests printed; digits may differ.
fn check_pages(steps: &mut Steps) {
    for line in std::mem::take(&mut steps.tally.unreadable) {
        steps.complain(format!("cannot read the line: {line}"));
    }
    let page = |path| std::fs::read_to_string(path).unwrap_or_default();
    let answers = answers::differences(&page(validate::page_path()), &steps.tally.answers);
    let published = published::differences(&page(validate::published_path()), &steps.tally.findings);
    for (name, differences) in [("docs/known-answers.md", answers), ("docs/published.md", published)] {
        if !differences.is_empty() {
            steps.complain(format!("{name} is out of step (run `cargo xtask validate`): {}", differences.join("; ")));
        }
    }
}
