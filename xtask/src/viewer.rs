//! The page of the viewer: its checks and its tests in a browser.
//!
//! Node and npm must be there. A browser is Debian's Chromium, which is installed where that is possible without asking
//! (as root), and named otherwise; `GYRATION_CHROMIUM` names another one.

use crate::debian::{self, can_install, on_path};
use crate::root;
use crate::steps::{Steps, succeeds};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Names under which Chromium is found.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Checks, builds and tests the page with the program that the tests of the workspace built.
pub fn tests(steps: &mut Steps, program: &Path, browser: &Path) {
    if !install(steps) {
        return;
    }
    steps.run("types and lints of the viewer", npm().args(["run", "--silent", "check"]));
    // Some tests look at the bundle itself.
    steps.run("build the page", npm().args(["run", "--silent", "build"]));
    let mut command = npm();
    // No colours: the output is read.
    command.arg("test").env("GYRATION_BIN", program).env("GYRATION_CHROMIUM", browser).env("NO_COLOR", "1");
    steps.run_tests("tests of the viewer", &mut command);
}

/// Installs its packages, unless they are there: the build of the program has done so, if it was to have a page.
pub fn install(steps: &mut Steps) -> bool {
    if !succeeds(npm().arg("--version")) {
        steps.complain("viewer: Node 20 or later is not installed; `cargo xtask test --fast` does without".into());
        return false;
    }
    let install = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"];
    packages_are_current() || steps.run("install packages of the viewer", npm().args(install))
}

/// Whether the packages installed are at least as new as the list of them.
fn packages_are_current() -> bool {
    let modified = |path: &str| std::fs::metadata(root().join("viewer").join(path)).and_then(|found| found.modified());
    match (modified("node_modules/.package-lock.json"), modified("package-lock.json")) {
        (Ok(installed), Ok(wanted)) => installed >= wanted,
        _ => false,
    }
}

/// npm, in the folder of the viewer.
pub fn npm() -> Command {
    let mut command = Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" });
    command.current_dir(root().join("viewer"));
    command
}

/// A browser, installed if there is none.
pub fn browser(steps: &mut Steps) -> Option<PathBuf> {
    let named = std::env::var_os("GYRATION_CHROMIUM").map(PathBuf::from);
    let found = || named.clone().or_else(|| BROWSERS.iter().find_map(|name| on_path(name)));
    if found().is_none() {
        if !can_install() {
            steps.complain("viewer: no browser; on Debian and Ubuntu: sudo apt-get install chromium".into());
            return None;
        }
        debian::install(steps, "chromium");
    }
    found()
}
