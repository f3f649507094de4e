//! The Python package: built as a wheel in the development profile, installed into the environment of the Python tests,
//! tested.
//!
//!   maturin build → pip install → pytest → stubtest (types against what is there)
//!
//! The tests print their sums as test programs of Rust do (`crates/gyration-py/tests/conftest.py`).

use crate::steps::Steps;
use crate::{root, target_directory};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds, installs and tests the package.
pub fn tests(steps: &mut Steps, interpreter: &Path) {
    let Some(wheel) = build(steps, interpreter) else { return };
    let install = ["install", "--quiet", "--disable-pip-version-check", "--no-deps", "--force-reinstall"];
    if !steps.run("install the Python package", python(interpreter, "pip").args(install).arg(&wheel)) {
        return;
    }
    let tests = root().join("crates/gyration-py/tests");
    // `-p no:cacheprovider`: nothing is left in the checkout.
    let quietly = ["-q", "-p", "no:cacheprovider"];
    steps.run_tests("tests of the Python package", python(interpreter, "pytest").args(quietly).arg(&tests));
    let mut types = python(interpreter, "mypy.stubtest");
    steps
        .run("types of the Python package", types.args(["gyration", "--mypy-config-file"]).arg(tests.join("mypy.ini")));
}

/// The wheel, in a folder of its own.
fn build(steps: &mut Steps, interpreter: &Path) -> Option<PathBuf> {
    let folder = target_directory().join("python-package");
    // Of an earlier version there must be nothing left to be taken for this one.
    let _ = fs::remove_dir_all(&folder);
    let mut maturin = python(interpreter, "maturin");
    maturin.args(["build", "--quiet", "--compatibility", "linux", "--manifest-path", "crates/gyration-py/Cargo.toml"]);
    maturin.arg("--interpreter").arg(interpreter).arg("--out").arg(&folder);
    if !steps.run("build the Python package", &mut maturin) {
        return None;
    }
    let files = fs::read_dir(&folder).ok()?.filter_map(Result::ok).map(|entry| entry.path());
    let wheel = files.into_iter().find(|path| path.extension() == Some(OsStr::new("whl")));
    if wheel.is_none() {
        steps.complain(format!("{} has no wheel", folder.display()));
    }
    wheel
}

/// A module of the environment, run in the root of the repository.
fn python(interpreter: &Path, module: &str) -> Command {
    let mut command = Command::new(interpreter);
    command.args(["-m", module]).current_dir(root()).env("PYTHONDONTWRITEBYTECODE", "1");
    command
}
