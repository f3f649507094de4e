//! Virtual environments with pinned packages: `target/python`, in which the Python tests run, `target/book-python`,
//! with which the site of the documentation is built.
//!
//! One is made once and again whenever the list of packages changes. Debian keeps `venv` in a package of its own, which
//! is installed where that is possible without asking (as root), and named otherwise.

use crate::debian::{can_install, install};
use crate::steps::{Steps, succeeds};
use crate::{root, target_directory};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The interpreter of the environment of the Python tests.
pub fn test_environment(steps: &mut Steps) -> Option<PathBuf> {
    environment(steps, "python", &root().join("xtask/python-requirements.txt"))
}

/// The interpreter of the environment of this name with these packages, made if it is not there; none, with a complaint
/// noted, if it cannot be.
pub fn environment(steps: &mut Steps, name: &str, pinned: &Path) -> Option<PathBuf> {
    let folder = target_directory().join(name);
    let interpreter = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if is_current(&folder, pinned) && succeeds(Command::new(&interpreter).arg("--version")) {
        return Some(interpreter);
    }
    if !has_venv() && !install_venv(steps) {
        return None;
    }
    let made = steps.run("make a Python environment", python().args(["-m", "venv", "--clear"]).arg(&folder))
        && steps.run(
            "install Python packages",
            Command::new(&interpreter)
                .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--requirement"])
                .arg(pinned),
        );
    if !made {
        return None;
    }
    // Written last: an installation that was cut short is made anew.
    if let Err(error) = fs::copy(pinned, stamp(&folder)) {
        steps.complain(format!("{}: {error}", stamp(&folder).display()));
        return None;
    }
    Some(interpreter)
}

fn stamp(folder: &Path) -> PathBuf {
    folder.join("installed-requirements.txt")
}

fn is_current(folder: &Path, pinned: &Path) -> bool {
    matches!((fs::read(stamp(folder)), fs::read(pinned)), (Ok(there), Ok(wanted)) if there == wanted)
}

/// The interpreter of the system.
pub fn python() -> Command {
    Command::new(if cfg!(windows) { "python" } else { "python3" })
}

fn has_venv() -> bool {
    succeeds(python().args(["-c", "import venv, ensurepip"]))
}

/// Installs Debian's package for virtual environments where that can be done without asking.
fn install_venv(steps: &mut Steps) -> bool {
    if !succeeds(python().arg("--version")) {
        steps.complain(
            "Python: python3 (3.11 or later) is not installed; `cargo xtask test --fast` does without".into(),
        );
        return false;
    }
    if !can_install() {
        steps.complain(
            "Python: the module venv or ensurepip is missing; on Debian and Ubuntu: sudo apt-get install python3-venv"
                .into(),
        );
        return false;
    }
    install(steps, "python3-venv")
}
