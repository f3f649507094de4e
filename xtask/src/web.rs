//! The site: the page that runs scenes by itself, with the engine as a WebAssembly module.
//!
//! ```text
//! target/site/  page and worker (viewer, Vite)   engine.wasm   gallery.json   hashes.json
//! ```
//!
//! Static files that any web server gives. The hashes are those of the rows that the native program records: the page
//! tells whether its own are the same.

use crate::cargo::cargo;
use crate::recording::row_hash;
use crate::steps::Steps;
use crate::{gallery, json, parallel, root, target_directory, viewer};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, ExitCode};
use std::sync::{Mutex, PoisonError};

const TARGET: &str = "wasm32-unknown-unknown";
/// The module as cargo names it.
const MODULE: &str = "gyration_web.wasm";

/// Builds the site and tests it.
pub fn run() -> ExitCode {
    let mut steps = Steps::default();
    build(&mut steps);
    if steps.conclude() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn build(steps: &mut Steps) {
    let installed = Command::new("rustup").args(["target", "list", "--installed"]).output();
    if !installed.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).lines().any(|line| line == TARGET)) {
        steps.run("install a target", Command::new("rustup").args(["target", "add", TARGET]));
    }
    let site = target_directory().join("site");
    let mut module = cargo();
    module.args(["build", "--profile", "web", "--target", TARGET, "--package", "gyration-web"]);
    // The site tells which commit it is of.
    if let Some(commit) = commit() {
        module.env("GYRATION_COMMIT", commit);
    }
    let mut native = cargo();
    native.args(["build", "--release", "--package", "gyration-cli"]);
    let program = target_directory().join("release").join(crate::PROGRAM);
    let is_built = steps.run("the program", &mut native)
        && steps.run("the module", &mut module)
        && viewer::install(steps)
        && steps.run(
            "the page",
            viewer::npm().args(["run", "--silent", "site", "--", "--emptyOutDir", "--outDir"]).arg(&site),
        );
    if !is_built {
        return;
    }
    if let Err(reason) = filled(&site, &program) {
        return steps.complain(reason);
    }
    let Some(browser) = viewer::browser(steps) else { return };
    let mut test = viewer::npm();
    test.args(["run", "test:site"]).env("GYRATION_SITE", &site).env("GYRATION_BIN", &program);
    steps.run_tests("the site", test.env("GYRATION_CHROMIUM", browser).env("NO_COLOR", "1"));
}

/// Puts module, gallery and hashes beside the page.
fn filled(site: &Path, program: &Path) -> Result<(), String> {
    let module = target_directory().join(TARGET).join("web").join(MODULE);
    fs::copy(&module, site.join("engine.wasm")).map_err(|error| cannot(&module, &error))?;
    let scenes = gallery::listed(Command::new(program))?;
    let mut entries = Vec::new();
    for (name, title) in &scenes {
        let path = root().join("scenes").join(name).with_extension("toml");
        let text = fs::read_to_string(&path).map_err(|error| cannot(&path, &error))?;
        let [name, title, text] = [name, title, &text].map(|text| json::quoted(text));
        entries.push(format!("{{\"name\":{name},\"title\":{title},\"text\":{text}}}"));
    }
    let write = |name: &str, text: String| {
        let path = site.join(name);
        fs::write(&path, text).map_err(|error| cannot(&path, &error))
    };
    write("gallery.json", format!("[{}]\n", entries.join(",\n")))?;
    let hashes = hashed(scenes.into_iter().map(|(name, _)| name), program)?;
    let hashes = hashes.iter().map(|(name, hash)| format!("{}:{}", json::quoted(name), json::quoted(hash)));
    write("hashes.json", format!("{{{}}}\n", hashes.collect::<Vec<_>>().join(",\n")))
}

/// Runs the scenes with the native program.
fn hashed(names: impl Iterator<Item = String> + Send, program: &Path) -> Result<BTreeMap<String, String>, String> {
    let folder = target_directory().join("site-runs");
    fs::create_dir_all(&folder).map_err(|error| cannot(&folder, &error))?;
    let all = Mutex::new(BTreeMap::new());
    parallel::each(names, |name| {
        let hash = hash_of(program, &name, &folder.join(&name));
        all.lock().unwrap_or_else(PoisonError::into_inner).insert(name, hash);
    });
    all.into_inner().unwrap_or_else(PoisonError::into_inner).into_iter().map(|(name, hash)| Ok((name, hash?))).collect()
}

fn hash_of(program: &Path, name: &str, recording: &Path) -> Result<String, String> {
    let mut run = Command::new(program);
    run.args(["run", name, "--quiet", "--force", "--threads", "1", "-o"]).arg(recording);
    let output = run.output().map_err(|error| format!("`{name}`: {error}"))?;
    if !output.status.success() {
        return Err(format!("`{name}`: {}", String::from_utf8_lossy(&output.stderr)));
    }
    row_hash(recording)
}

/// The commit at hand.
fn commit() -> Option<String> {
    let output = Command::new("git").args(["rev-parse", "HEAD"]).current_dir(root()).output().ok()?;
    let commit = String::from_utf8(output.stdout).ok().filter(|_| output.status.success())?;
    Some(commit.trim().to_owned())
}

fn cannot(path: &Path, error: &io::Error) -> String {
    format!("{}: {error}", path.display())
}
