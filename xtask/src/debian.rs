//! Programs that tests need from Debian's packages, installed where that can be done without asking.

use crate::steps::{Steps, succeeds};
use std::path::PathBuf;
use std::process::Command;

/// Whether packages can be installed without asking: as root, on Debian and what descends from it.
pub fn can_install() -> bool {
    let output = Command::new("id").arg("-u").output();
    let is_root = output.is_ok_and(|output| output.stdout.trim_ascii() == b"0");
    is_root && succeeds(Command::new("apt-get").arg("--version"))
}

/// Installs a package, by lists that are new.
pub fn install(steps: &mut Steps, package: &str) -> bool {
    steps.run("refresh the package lists", Command::new("apt-get").args(["update", "-q"]))
        && steps.run(
            &format!("install {package}"),
            Command::new("apt-get").args(["install", "-y", "-q", "--no-install-recommends", package]),
        )
}

/// Where a program is found.
pub fn on_path(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    std::env::split_paths(&folders).map(|folder| folder.join(name)).find(|path| path.is_file())
}
