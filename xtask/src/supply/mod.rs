//! What the program is made of besides its own code: advisories, licences and sources of locked packages.
//!
//! `cargo deny` and `npm audit` ask the databases of advisories where these can be had. Where they cannot, and always
//! besides, the packages that are locked are compared with a list of those that somebody has looked up
//! (`xtask/supply-chain.txt`): nothing comes in unseen. `cargo xtask supply` writes the list anew, to be committed
//! after a look at what is new in it.

mod list;
mod locked;

use crate::cargo::cargo;
use crate::root;
use crate::steps::{Steps, succeeds};
use list::List;
use locked::locked;
use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};

fn list_path() -> PathBuf {
    root().join("xtask/supply-chain.txt")
}

/// Checks what can be checked here.
pub fn check(steps: &mut Steps) {
    crates(steps);
    packages(steps);
    if let Err(reason) = compared() {
        steps.complain(reason);
    }
}

/// Writes the list of what is locked; its remarks stay.
pub fn run() -> ExitCode {
    let old = std::fs::read_to_string(list_path()).unwrap_or_default();
    let written = locked().map(|packages| List::parse(&old).with(packages));
    let written = written.and_then(|list| {
        std::fs::write(list_path(), list.text()).map_err(|error| format!("{}: {error}", list_path().display()))
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("xtask: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// RustSec's advisories, licences and sources, where cargo-deny is installed.
fn crates(steps: &mut Steps) {
    if !succeeds(cargo().args(["deny", "--version"])) {
        return steps
            .skip("advisories of crates: cargo-deny is not installed; the list of those looked up was compared");
    }
    if succeeds(cargo().args(["deny", "fetch"])) {
        steps.run("dependencies", cargo().args(["deny", "check"]));
    } else {
        steps.run("dependencies", cargo().args(["deny", "--offline", "check", "bans", "licenses", "sources"]));
        steps.skip("advisories of crates: their database is not to be had; the list of those looked up was compared");
    }
}

/// The registry's advisories on what builds and tests the page.
fn packages(steps: &mut Steps) {
    let mut audit = Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" });
    audit.current_dir(root().join("viewer")).args(["audit", "--package-lock-only"]).stdin(Stdio::null());
    match audit.output() {
        Ok(output) if output.status.success() => {}
        // Anything else than an answer of the registry is no finding.
        Ok(output) if String::from_utf8_lossy(&output.stdout).contains("Severity:") => {
            steps.complain(format!("npm audit: {}", String::from_utf8_lossy(&output.stdout).trim()));
        }
        _ => steps.skip("npm audit: the registry gives no answer; the list of packages looked up was compared"),
    }
}

/// What is locked against the list, and licences against those that `deny.toml` allows.
fn compared() -> Result<(), String> {
    let read = |path: PathBuf| std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()));
    let list = List::parse(&read(list_path())?);
    let mut wrong = list.differences(&locked()?);
    wrong.extend(list.refused(&list::allowed(&read(root().join("deny.toml"))?)));
    match wrong.as_slice() {
        [] => Ok(()),
        wrong => Err(format!("xtask/supply-chain.txt (look them up, then `cargo xtask supply`): {}", wrong.join("; "))),
    }
}
