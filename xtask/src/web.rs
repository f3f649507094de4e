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
use std::time::Instant;

const TARGET: &str = "wasm32-unknown-unknown";
/// The module as cargo names it.
const MODULE: &str = "gyration_web.wasm";
/// Scenes that take longer natively [s] are not run again in the module by the tests.
const SHORT: f64 = 1.0;

/// A scene that has been run.
struct Ran {
    hash: String,
    /// Wall time [s].
    took: f64,
}

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
    let mut native = cargo();
    native.args(["build", "--release", "--package", "gyration-cli"]);
    let is_built = steps.run("the module", &mut module)
        && steps.run("the program", &mut native)
        && viewer::install(steps)
        && steps.run(
            "the page",
            viewer::npm().args(["run", "--silent", "site", "--", "--emptyOutDir", "--outDir"]).arg(&site),
        );
    if !is_built {
        return;
    }
    let program = target_directory().join("release").join(crate::PROGRAM);
    let ran = match filled(&site, &program) {
        Ok(ran) => ran,
        Err(reason) => return steps.complain(reason),
    };
    let short: Vec<&str> = ran.iter().filter(|(_, ran)| ran.took < SHORT).map(|(name, _)| name.as_str()).collect();
    let Some(browser) = viewer::browser(steps) else { return };
    let mut test = viewer::npm();
    test.args(["run", "test:site"]).env("GYRATION_SITE", &site).env("GYRATION_SITE_SCENES", short.join(" "));
    steps.run_tests("the site", test.env("GYRATION_CHROMIUM", browser).env("NO_COLOR", "1"));
}

/// Puts module, gallery and hashes beside the page.
fn filled(site: &Path, program: &Path) -> Result<BTreeMap<String, Ran>, String> {
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
    let ran = hashed(scenes.into_iter().map(|(name, _)| name), program)?;
    let hashes = ran.iter().map(|(name, ran)| format!("{}:{}", json::quoted(name), json::quoted(&ran.hash)));
    write("hashes.json", format!("{{{}}}\n", hashes.collect::<Vec<_>>().join(",\n")))?;
    Ok(ran)
}

/// Runs the scenes with the native program.
fn hashed(names: impl Iterator<Item = String> + Send, program: &Path) -> Result<BTreeMap<String, Ran>, String> {
    let folder = target_directory().join("site-runs");
    fs::create_dir_all(&folder).map_err(|error| cannot(&folder, &error))?;
    let all = Mutex::new(BTreeMap::new());
    parallel::each(names, |name| {
        let began = Instant::now();
        let hash = hash_of(program, &name, &folder.join(&name));
        let ran = hash.map(|hash| Ran { hash, took: began.elapsed().as_secs_f64() });
        all.lock().unwrap_or_else(PoisonError::into_inner).insert(name, ran);
    });
    all.into_inner().unwrap_or_else(PoisonError::into_inner).into_iter().map(|(name, ran)| Ok((name, ran?))).collect()
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

fn cannot(path: &Path, error: &io::Error) -> String {
    format!("{}: {error}", path.display())
}
